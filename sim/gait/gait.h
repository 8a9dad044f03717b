// How people step. Each foot has a phase of its own: it stands where it landed until its time in the cycle
// comes, or until its place is out of reach, then swings to a place planned on the real ground. While a
// walker walks, the phases advance with the distance walked, half a cycle apart: the rhythmic case of the
// same rules by which one who stands takes a step aside, catches a push or turns on the spot. Sixteen walkers
// lie side by side in a block.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/base/footwork.h"
#include "sim/base/vec.h"
#include "sim/body/manner.h"
#include "sim/gait/blocks.h"
#include "sim/gait/pram.h"
#include "sim/ground/surroundings.h"

namespace flaneur {

// The cane in a walker's right hand. Places are in the world.
struct Cane {
    uint32_t walker = 0;
    Vec3 tip_hs{};              // from the wrist to the tip, in the hand's axes, metres
    Vec3 tip{}, velocity{};     // where it is to be, and how fast it goes there, m/s
    Vec3 from{}, to{};          // where it stood, and where it stands or will
    Vec3 goal{};                // what `to` moves to, the ground's last word
    Vec2 gone{};                // metres that the body has gone since the tip left the ground
    float share = 1;            // of its way, 0 as it leaves .. 1: it stands
    float left = 0;             // seconds until it stands
    float rise = 0, clear = 0;  // metres that it rises above its way, and that it should
    float held = 0;             // 0: hangs from the hand .. 1: the hand leads it
    uint32_t steps = 0;         // 1: the left foot is in the air, with which it goes
    uint32_t lost = 0;          // 1: no ground for it is within reach, and it is carried
};

// Whether it stands on the ground, and the hand on it.
inline bool is_planted(const Cane& cane) { return cane.share >= 1 && cane.held >= 1 && cane.lost == 0; }

struct Gait {
    size_t count = 0;
    std::vector<GaitBlock> blocks;
    std::vector<PersonBlock> people;
    std::vector<Cane> canes;  // of the few who have one, by walker
    std::vector<Pram> prams;  // the same
};

// What the crowd tells the gait, one value a walker.
struct RootMotion {
    const Vec3* position;    // on the ground
    const Vec2* velocity;    // m/s
    const float* heading;    // yaw about +y, 0 faces +z
    const float* turn_rate;  // rad/s
    // m/s, what the walker would like its velocity to be: feet land and heads look where it leads. Null: the
    // velocity as it is.
    const Vec2* wish = nullptr;
    // m/s2, with which the walker slows down towards it; 0 or null: as people do.
    const float* brakes = nullptr;
};

// Walkers standing on both feet. `bodies[body[i]] * scale[i]` is walker i's, and so is `manner[i]`; without
// manners they are drawn from (seed, i).
void start_gait(Gait& gait, size_t count, const std::vector<Body>& bodies, const uint32_t* body,
                const float* scale, const RootMotion& root, const Surroundings& around, uint64_t seed,
                const Manner* manner = nullptr);

// Room for `capacity` walkers, with nobody in the new places but `body`.
void reserve_gait(Gait& gait, size_t capacity, const Body& body, uint64_t seed);
// The same for one walker of a gait under way, in the place of whoever had that number.
void start_walker(Gait& gait, size_t walker, const Body& body, float scale, Vec3 position, float heading,
                  const Surroundings& around, uint64_t seed, const Manner& manner);
// It walks in another manner from its next steps on.
void change_manner(Gait& gait, size_t walker, const Body& body, float scale, const Manner& manner);
// Which hands hold nothing, as PersonBlock::free_hands.
int32_t free_hands_of(const Wear& wear);
// Nobody has that number any more; its lane keeps a body that stands at the origin.
void end_walker(Gait& gait, size_t walker, const Body& body, uint64_t seed);

// One tick of `dt` seconds for walkers [begin, end): phase, toe-offs, contacts and where the swinging feet
// will land.
void advance_gait(Gait& gait, size_t begin, size_t end, const RootMotion& root, const Surroundings& around,
                  uint64_t seed, uint32_t tick, float dt);

// The same for those who are seen from far away, however long the tick: feet are where an even walk over
// ground that rises evenly has them, and bodies ride on it. Who jumps or leans on a wall ceases to.
void advance_gait_afar(Gait& gait, size_t begin, size_t end, const RootMotion& root,
                       const Surroundings& around, uint64_t seed, uint32_t tick, float dt);

// Of a walker whose root is at `root`.
Footwork footwork(const Gait& gait, size_t walker, Vec3 root);

// Jumps, over a gap or up a ledge say: crouch, flight with both feet, crouch, up again; nothing while a jump
// is under way. Whoever moves the root goes on as before. Walkers also jump by themselves where the next step
// finds no ground, or one more than 0.45 m higher, but ground within 1.8 m.
void jump(Gait& gait, size_t walker);
inline constexpr float k_jump_crouch = 0.34f;  // seconds from its beginning until the feet leave, at least

// The ground under a walker's feet turns by `yaw` about the vertical through `pivot`, then moves by `by`, and
// takes the feet along: on a lift, a ferry, a turntable. Not the root, which is the caller's.
void carry_feet(Gait& gait, size_t walker, Vec3 pivot, float yaw, Vec3 by);

// Metres of one stride (two steps) at speed `v` > 0 for a leg of length `leg`.
float stride_length(float v, float leg);
// Share of the cycle that a foot stands at walking speed `v`.
float duty_factor(float v);
// Strides a second and share of the cycle that a foot stands of a run: 160 to 170 steps a minute and 40 to 23
// % at 2.2 to 5 m/s for a leg of 0.9 m (after Novacheck 1998 and Fukuchi, Fukuchi & Duarte 2017).
float run_frequency(float v, float leg);
float run_duty(float v, float leg);

}  // namespace flaneur
