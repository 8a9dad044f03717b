// Bipeds that step when they must, over ground that may move: the rule of the "procedural animation showcase"
// (a Unity project of 2D humanoids), on bodies that the gait's pose draws.
//
// Each follows a point, which goes along a closed way or where it is driven. A ray down from 5 m above to 12
// m below the place ahead of that point says where a foot is wanted. Feet stay planted until that place is
// farther than their reach; then the farther foot steps, and only while both are down. It rises in the first
// half of its step and comes down in the second. The body stays in the middle of both feet and the point.
//
// Ours beyond that: the place is foreseen for as long as the step takes; each foot has a line of its own,
// half a step's width beside the way; a whole sole finds one surface, and where there is none, or too far,
// the nearest that legs reach; nobody steps onto what is about to leave; a planted foot keeps its place in
// the frame of the mover that it stands on. How the body sinks, leans and swings is the gait's and the
// pose's.
//
//     Gait gait;                                     // started, on surroundings_of(ground)
//     SetDown made = make_bipeds(ways, walkers, likes, false, {&ground, &movers}, gait, seed);
//     for (uint32_t tick = 0;; ++tick) {
//         step_movers(movers, tick);
//         step_bipeds(made.bipeds, {&ground, &movers}, gait, workers, seed, tick);
//     }
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/base/parallel_for.h"
#include "sim/gait/gait.h"
#include "sim/movers/movers.h"

namespace flaneur {

// The ray of the document, metres above and below the body's ground.
inline constexpr float k_ray_above = 5, k_ray_below = 12;

// A closed line on the ground plane that followed points go along; of two places, there and back.
struct BipedWay {
    std::vector<Vec2> line;
    std::vector<float> along;  // of each corner: metres from the first; one more for the whole
};
BipedWay make_way(std::vector<Vec2> line);
struct WayPoint {
    Vec2 place, ahead;  // unit
};
WayPoint point_on(const BipedWay& way, float along);
// Metres along it of its nearest place.
float nearest_along(const BipedWay& way, Vec2 place);
// The same of its places within `most` metres of `from` along it.
float nearest_along(const BipedWay& way, Vec2 place, float from, float most);

inline constexpr uint32_t k_still_ground = ~0u;
// Where a foot stands: in the frame of a mover, or in the world.
struct Foothold {
    uint32_t mover = k_still_ground;
    Vec3 place{};
    float yaw = 0;
    Vec3 normal{0, 1, 0};
};

// One of them. Made of words alone, as it is saved and hashed as bytes.
struct Biped {
    uint32_t way = 0;
    float along = 0;          // metres of its way, of the place that its point goes for
    float likes = 1;          // m/s, on level ground
    Vec2 point{};             // that is followed
    float speed = 0;          // m/s, of the point
    Vec2 ahead{0, 1};         // where it leads, unit
    Vec2 body{}, velocity{};  // of the root; m/s over what bears it
    float heading = 0, turn_rate = 0;
    Foothold feet[2];      // where they stand, or stood before they left
    Foothold target{};     // of the one in the air
    uint32_t swings = 2;   // Side of that, or 2: both are down
    float lasts = 0.5f;    // seconds, of its step
    float share = 0;       // of that, gone by
    float due = 0;         // share of the time that both are down, 0: one has landed .. 1: the next may leave
    float apart = 0;       // metres from the place wanted to the farther foot, as one landed
    Vec3 wanted[2];        // where each foot is wanted, on what the ray meets
    uint32_t meets[2]{};   // 1: it met something that one walks on within a leg's range
    float reach = 0;       // metres
    uint32_t waits = 0;    // ticks since it wanted to step and found no place
    float kept = 0;        // seconds in all for which it has found none
    float aside = 0;       // metres to the left of its way that it goes
    float reels = 0;       // seconds for which it still does nothing but step after a push
    uint32_t is_down = 0;  // 1: it lies or gets up, and others move it
    // Radians that the head is turned to what it looks at, up and to the left, and how fast, 1/s.
    Vec2 gaze{}, gaze_rate{};
};

// What one of them, or all, are told from outside.
struct BipedOrders {
    uint32_t driven = ~0u;  // who goes to `goal`, if there is one, else by `wish`, m/s
    uint32_t has_goal = 0;
    Vec3 goal{};
    Vec2 wish{};
    Vec3 looked_at{};    // by all who can turn their heads there
    uint32_t looks = 0;  // 0: nobody looks
};

struct Bipeds {
    std::vector<BipedWay> ways;
    std::vector<Biped> all;
    std::vector<uint32_t> walkers;  // by biped, ascending: whose block and lane of the gait it has
    // By biped, as others leave it: metres that it has ahead, and how far to the left of its way it is to go.
    std::vector<float> room, aside;
    BipedOrders orders;
    bool is_flat = false;  // each in one vertical plane, as the document has it
    // Of one tick alone: places on their ways, and metres from body to point.
    std::vector<float> was_along, was_lead;
    std::vector<Vec2> was_feet;  // three each: where they stand, and where one is about to
};

inline constexpr float k_all_room = 1e9f;  // Bipeds::room where nobody else is

// Set down along their ways, in turns, where both feet find still ground. Of the gait they have those
// `walkers`, ascending, whose feet are placed anew, and not where `others` stand; `likes` are their speeds,
// m/s. Where not all find room, `placed` is how many do when no more are asked for, and `bipeds` are not to
// be used.
struct SetDown {
    Bipeds bipeds;
    size_t placed = 0;
};
SetDown make_bipeds(std::vector<BipedWay> ways, std::span<const uint32_t> walkers,
                    std::span<const float> likes, bool is_flat, const MovingGround& ground, Gait& gait,
                    uint64_t seed, std::span<const Vec2> others = {});

// One goes on from where its feet have come to, as the gait has them, with its body at `body`.
void go_on_standing(Bipeds& bipeds, size_t biped, Vec2 body, float heading, const MovingGround& ground,
                    Gait& gait, uint32_t tick);
// A push changes how fast its body goes, m/s: it steps to where that would come to rest (the extrapolated
// centre of mass x + v / sqrt(g / l): Hof, Gazendam & Sinke 2005).
void shove(Bipeds& bipeds, size_t biped, Vec2 change, const Gait& gait);

// A tick, after the movers'. Allocates nothing; the same on any number of threads.
void step_bipeds(Bipeds& bipeds, const MovingGround& ground, Gait& gait, Workers& workers, uint64_t seed,
                 uint32_t tick);

// How far a foot is from where it is wanted, metres: of its ankle or of its ball, whichever is farther.
float off_wanted(const Bipeds& bipeds, const Gait& gait, size_t biped, Side side);
// Where a foothold is now.
Foothold in_world(const Movers& movers, const Foothold& own);

}  // namespace flaneur
