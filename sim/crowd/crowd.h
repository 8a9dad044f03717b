// The walkers: who they are, where they are, and the stages that move them. Structure of arrays, index =
// walker id.
//
// One tick (1/60 s) is think, find_neighbours, steer, move, in this order. Stages read the state of the tick
// before and write to arrays of their own; `move` writes the next state and swaps it in. So the result
// depends neither on the number of threads nor on the order of walkers within a stage. Decisions (think,
// find_neighbours, steer) are taken at 15 Hz: walker i decides on ticks with tick % 4 == i % 4. Nothing is
// allocated once a crowd is made.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/base/parallel_for.h"
#include "sim/base/result.h"
#include "sim/base/vec.h"
#include "sim/city/city.h"
#include "sim/city/navmesh.h"
#include "sim/crowd/demand.h"

namespace flaneur {

inline constexpr float k_tick = 1.0f / 60;       // seconds
inline constexpr uint32_t k_decision_ticks = 4;  // a walker decides every so many ticks
inline constexpr int k_corners = 32;             // of a path, at most
inline constexpr int k_neighbours = 12;          // that a walker minds, at most
inline constexpr float k_neighbour_reach = 4;    // metres

// What a walker does at its goal.
enum class Errand : uint8_t { wander, arrive };  // pause and go somewhere else; stand there

struct Crowd {
    uint32_t count = 0, capacity = 0;

    // State, hashed. Velocity and position are those at the end of the last tick.
    std::vector<Vec3> position;     // on the ground, between the feet
    std::vector<Vec2> velocity;     // metres a second
    std::vector<float> heading;     // where the body faces: yaw about +y, 0 = +z, growing towards +x
    std::vector<float> turn_rate;   // of the heading, radians a second
    std::vector<uint32_t> polygon;  // of the mesh, under the position
    std::vector<GroundHit> under;   // the ground there

    // Identity, constant.
    std::vector<float> preferred_speed;  // metres a second, 0.7 .. 1.9
    std::vector<float> radius;           // of the body, metres
    std::vector<float> lateral;          // how far out corners are taken, metres
    std::vector<uint32_t> body;          // index into the bodies that the program has
    std::vector<float> scale;            // of that body
    std::vector<Errand> errand;

    // Errands.
    Demand demand;  // what draws them; constant
    std::vector<NavPoint> goal;
    std::vector<Vec2> goal_facing;      // the way to look there; (0, 0): no matter
    std::vector<Stay> goal_stay;        // how long to stand there
    std::vector<uint32_t> trip;         // how many goals it has had
    std::vector<uint32_t> pause_until;  // tick; stands before it
    std::vector<Vec3> corners;          // k_corners a walker: the way ahead
    std::vector<uint8_t> corner,
        corner_count;               // corners[corner] is walked to; corner == corner_count: no way
    std::vector<uint8_t> path_due;  // PathDue
    std::vector<Vec2> leg_start;    // where the leg to the current corner began
    std::vector<float> closest;     // to the current corner so far, metres, for noticing that one is stuck
    std::vector<uint32_t> closest_tick;
    std::vector<uint8_t> stuck;  // replans in a row that did not help
    std::vector<uint8_t> jam;    // all that did not, less progress made since; 0..k_most_jam
    uint32_t next_path = 0;      // the walker from which path requests are served next

    // Decisions.
    std::vector<Vec2> wanted;          // velocity that the errand asks for
    std::vector<uint8_t> looks;        // 1: stands at its goal, and looks the way one does there
    std::vector<Vec2> chosen;          // velocity that steering allows
    std::vector<uint32_t> neighbours;  // k_neighbours a walker, nearest first, as of its last decision
    std::vector<uint8_t> neighbour_count;

    // Scratch of one tick.
    std::vector<Vec3> next_position;
    std::vector<Vec2> next_velocity;
    std::vector<uint32_t> next_polygon;
    std::vector<uint32_t> cell;  // of each walker
    std::vector<uint32_t>
        cell_first;  // walkers sorted by cell: cell c holds [cell_first[c], cell_first[c + 1])
    struct Seen {
        Vec3 position;
        uint32_t id;
    };
    std::vector<Seen> sorted;
    uint32_t cells_x = 0, cells_z = 0;  // powers of two; the plane is wrapped onto them
    std::vector<uint32_t> requests;     // walkers whose path is sought this tick
};

inline constexpr uint8_t k_most_jam = 8;

// Metres that the middles of two walkers keep apart. One on a stroll or a trip whom a jam holds longer than
// any queue, some 15 s and more, turns its shoulders ever further, others theirs for it, and at last it slips
// past.
inline float room_between(const Crowd& c, uint32_t i, uint32_t j) {
    auto held = [&](uint32_t k) { return c.errand[k] == Errand::wander ? std::max(c.jam[k] - 4, 0) : 0; };
    return (c.radius[i] + c.radius[j]) * (1 - 0.25f * static_cast<float>(std::max(held(i), held(j))));
}

enum class PathDue : uint8_t { no, same_goal, new_goal };

struct Walker {
    NavPoint place;
    float heading = 0;
    float preferred_speed = 1.34f;
    float radius = 0.25f;
    float lateral = 0.3f;
    uint32_t body = 0;
    float scale = 1;
    Errand errand = Errand::wander;
};

// An empty crowd with room for `capacity` walkers.
Crowd make_crowd(uint32_t capacity);

// Adds a walker that stands still; returns its id. `place` must be on the mesh, and there must be room.
uint32_t add_walker(Crowd& crowd, const City& city, const Walker& walker);

// Gives a walker a goal; its path is found in the next ticks.
void send_to(Crowd& crowd, uint32_t walker, NavPoint goal);

// Whether a walker stands where it was sent.
bool has_arrived(const Crowd& crowd, uint32_t walker);

// The walkers who share a body.
struct Folk {
    float share = 1;      // of all walkers, against the others' shares
    float speed = 1.34f;  // the mean that they prefer, metres a second
    float most = 1.9f;    // nobody prefers to go faster
};

// A crowd of `walkers` spread over the city's sidewalks, plazas and paths without touching (in a large city
// over those about the middle of its houses, one walker to some 60 square metres), under way to where people
// go at that `hour` of the day (0..24), or to random goals where the city has no destinations.
// Each belongs by chance to one of the folk, whose place in the list is its body. Refuses more walkers than
// fit.
Result<Crowd> populate(const City& city, const Navmesh& mesh, Workers& workers, uint32_t walkers,
                       std::span<const Folk> folk, uint64_t seed, float hour = 17.5f);

// Goals, paths and the velocity that each walker would like. Serves a bounded number of path requests a tick.
void think(Crowd& crowd, const City& city, const Navmesh& mesh, Workers& workers, uint32_t tick,
           uint64_t seed);

// Sorts everyone by place; then the k_neighbours nearest others within k_neighbour_reach, ties by id.
void find_neighbours(Crowd& crowd, Workers& workers, uint32_t tick);

// A velocity near the wanted one that avoids others and the mesh's border: optimal reciprocal collision
// avoidance (van den Berg et al. 2011), then a speed that keeps headway (Tordeux et al. 2016).
void steer(Crowd& crowd, const Navmesh& mesh, Workers& workers, uint32_t tick);

// Turns and moves everyone by one tick, on the mesh, within what legs can do. Comes after find_neighbours.
void move(Crowd& crowd, const City& city, const Navmesh& mesh, Workers& workers);

// All four.
void step_crowd(Crowd& crowd, const City& city, const Navmesh& mesh, Workers& workers, uint32_t tick,
                uint64_t seed);

// Of everything that the next tick depends on.
uint64_t hash_crowd(const Crowd& crowd);

}  // namespace flaneur
