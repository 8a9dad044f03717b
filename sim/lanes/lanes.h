// Where those drive who drive: the lanes of a city's carriageways, and the curves through junctions that join
// them. A lane is a line of places about a metre apart, the middle of what is driven on, in the direction of
// those who drive there.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/base/vec.h"
#include "sim/ground/ground.h"
#include "sim/lamps/crossings.h"

namespace flaneur {

inline constexpr uint32_t k_no_lane = ~0u;

// Where carriageways meet, or end. Those who drive come in and leave at gates, mostly where the map ends.
struct RoadNode {
    Vec2 at;
    bool is_gate = false;
};

// A carriageway as it was laid, from one node to another. Left and right are as seen along its line.
struct Road {
    std::vector<Vec2> line;  // its middle, from node to node, metres
    uint32_t from = 0, to = 0;
    float width = 7;                          // kerb to kerb
    int forward = 1, backward = 1;            // lanes; 0: one way
    float parked_left = 0, parked_right = 0;  // metres beside the kerbs that those take who are parked
    float speed = 50 / 3.6f;                  // the limit, m/s
    int rank = 0;                             // who comes from one of a higher rank goes first
    bool is_track = false;  // rails: one lane along the line itself, of trams alone, who go before all
};

struct RoadPlan {
    std::vector<RoadNode> nodes;
    std::vector<Road> roads;
    std::vector<Vec2> tram_stops;  // on a track, or beside those that stop there
    bool drives_left = false;
};

// Where a lane leads over a crossing: metres along it.
struct LaneCrossing {
    uint32_t crossing = 0;  // of Crossings::all
    float from = 0, to = 0;
    uint32_t leaves = 0;  // 1: one comes from the junction there, where its lamp is none of one's own
};

struct Lane {
    uint32_t first = 0, count = 0;  // places: [first, first + count), evenly apart
    float length = 0;               // metres
    float width = 3;                // that one has there
    float speed = 50 / 3.6f;        // the limit, m/s
    float stop = 0;                 // metres along it at which those wait who may not go on
    int32_t rank = 0;
    float turn = 0;             // of a curve through a junction: its angle, more than 0 to the left, radians
    uint32_t node = k_no_lane;  // of a curve: the junction that it leads through
    uint32_t is_gate_in = 0, is_gate_out = 0;  // 1: those who drive come in at its start, leave at its end
    uint32_t is_track = 0;                     // 1: of trams alone
    uint32_t first_next = 0, next_count = 0;   // where it leads on, in Lanes::nexts
    uint32_t first_conflict = 0, conflict_count = 0;  // of a curve: those that cross it, in Lanes::conflicts
    uint32_t first_crossing = 0, crossing_count = 0;  // in Lanes::crossings, by place
    uint32_t first_stop = 0, stop_count = 0;          // of buses or trams, in Lanes::stops, by place
};
inline bool is_curve(const Lane& lane) { return lane.node != k_no_lane; }

struct Lanes {
    std::vector<Lane> all;
    std::vector<Vec3> places;
    std::vector<uint32_t> nexts, conflicts;
    std::vector<LaneCrossing> crossings;
    std::vector<float> stops;  // metres along their lanes
    bool drives_left = false;
};
inline bool has_lanes(const Lanes& lanes) { return !lanes.all.empty(); }

// Lays lanes along roads and curves through their junctions. Lanes that lead nowhere, or that nobody can come
// to, are left out, and so are those on which an obstacle stands. Buses stop where a stop is within 6 m of
// what is wide enough for one. Where a track and a lane cross, or one comes onto the other, both are cut, and
// the pieces are curves that cannot be driven at one time; tracks that lanes come towards are left out.
// Trams halt with their middle at a stop, if there is room. Heights are 0.
Lanes make_lanes(const RoadPlan& plan, const Crossings& crossings, std::span<const Vec2> stops,
                 std::span<const Obstacle> obstacles);
// Sets them onto the ground, which is indexed, within 60 m of height 0.
void settle_lanes(Lanes& lanes, const Ground& ground);

// The place so many metres along a lane, before its start and beyond its end straight on, and the unit
// direction there.
struct OnLane {
    Vec3 at;
    Vec2 along{0, 1};
};
OnLane on_lane(const Lanes& lanes, uint32_t lane, float metres);
// m/s at which its bends are driven there with 2 m/s2 to the side, about what people bear gladly (Reymond,
// Kemeny, Droulez & Berthoz 2001).
float bend_speed(const Lanes& lanes, uint32_t lane, float metres);

inline std::span<const uint32_t> nexts_of(const Lanes& lanes, const Lane& lane) {
    return {lanes.nexts.data() + lane.first_next, lane.next_count};
}
inline std::span<const uint32_t> conflicts_of(const Lanes& lanes, const Lane& lane) {
    return {lanes.conflicts.data() + lane.first_conflict, lane.conflict_count};
}
inline std::span<const LaneCrossing> crossings_of(const Lanes& lanes, const Lane& lane) {
    return {lanes.crossings.data() + lane.first_crossing, lane.crossing_count};
}
inline std::span<const float> stops_of(const Lanes& lanes, const Lane& lane) {
    return {lanes.stops.data() + lane.first_stop, lane.stop_count};
}

}  // namespace flaneur
