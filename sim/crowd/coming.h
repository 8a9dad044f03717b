// Coming and going: who leaves the crowd where places let people leave, who comes in there instead, and those
// whom somebody sends at a time from one place to another.
//
// Who wanders and gets to a destination may leave there, by Demand::leaving; then another is due to come in
// at such a place near the crowd's home, so that as many stay. One who is sent comes in at its time, goes
// where it is sent and leaves there. Whoever finds no room where it is to come in waits for it; who wanders
// tries another place after five seconds.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sim/base/vec.h"
#include "sim/navigation/navmesh.h"

namespace flaneur {

// A place, or all of an area, on the ground plane.
struct Area {
    std::vector<Vec2> corners;  // one: a place; three or more: of a polygon, either way round
    float height = 0;           // metres: where floors lie over each other, the nearest is meant
};

// People who are sent from one area to another, evenly over a time.
struct Flow {
    Area from, to;
    uint32_t people = 1;
    float begin = 0, end = 0;  // seconds since the first tick; equal: all of them then
    float speed = 0;           // m/s that they like to walk, 0.3..2; 0: as people of their kind do
};
inline constexpr uint32_t k_most_sent = 1'000'000;  // people of all flows

// One who is to come in.
struct Entrant {
    NavPoint place{};      // where; polygon 0: is chosen yet
    NavPoint goal{};       // where one who is sent goes
    float heading = 0;     // yaw
    float speed = 0;       // see Flow
    uint32_t number = 0;   // of all who were ever to come in: chance goes by it
    uint32_t tries = 0;    // how often there was no room
    uint32_t is_sent = 0;  // 1: by a flow
};

struct Coming {
    std::vector<Flow> flows;
    Vec2 home;        // where the crowd is: who comes in instead of others does so
    float reach = 0;  // within so many metres, of a square, where there are such places

    std::vector<Entrant> queue;  // who is to come in, in the order in which they are due
    uint32_t next = 0;           // in the queue: who is the next to try
    uint32_t numbered = 0;       // how many were ever to come in
    uint32_t left = 0, came = 0;
    uint32_t lost = 0;  // of those sent: had no way from there to there

    std::vector<uint32_t> gone, arrivals;  // slots left and taken in this tick; an arrival may take one gone
};

// How many are to come in and have found no room yet.
uint32_t waiting(const Coming& coming);

// One of a flow, by chance; none where no way leads from there to there.
std::optional<Entrant> draw_entrant(const Flow& flow, const Navmesh& mesh, uint32_t number, uint64_t seed);

// How many of a flow have been due by `seconds`.
uint32_t due_by(const Flow& flow, double seconds);

}  // namespace flaneur
