// Lanes while they are made. Private to sim/lanes.
#pragma once

#include <vector>

#include "sim/lanes/lanes.h"

namespace flaneur {

struct Draft {
    std::vector<Vec2> line{};
    Lane lane{};
    std::vector<uint32_t> nexts{}, conflicts{};
    uint32_t from = 0, to = 0;  // nodes; of a curve the lanes that it joins
    int place = 0, of = 1;      // counted from the kerb, of so many side by side
    uint32_t road = 0;          // that it was laid along
    bool is_left_out = false;
};

struct LaneMaking {
    const RoadPlan& plan;
    std::vector<std::vector<uint32_t>> roads_at;  // by node, and by place where a lane is cut
    std::vector<float> back_from, back_to;        // by road: metres that junctions take at its ends
    std::vector<Draft> drafts;
    std::vector<std::vector<uint32_t>> into, out_of;  // by node: drafts
};

// The unit direction in which a road leaves one of its nodes.
Vec2 leaves(const Road& road, uint32_t node);
// The angle from one direction to another, more than 0 to the left.
float angle_between(Vec2 a, Vec2 b);

// A lane along a road, or back along it.
void add_lane(LaneMaking& m, uint32_t road, const std::vector<Vec2>& line, bool is_back, int place, int of,
              float width);

// A track lies where it was laid, also through the nodes where tracks meet.
void lay_track(LaneMaking& m, uint32_t road);
void join_tracks(LaneMaking& m, uint32_t node);
// Cuts lanes and tracks where they cross or come together, with conflicts between what is cut out. Tracks
// that lead against lanes for more than a crossing are left out.
void cut_at_tracks(LaneMaking& m);
// Where the front of a tram halts along it, so that its middle is at a stop; `stop`: its lane's.
void find_halts(const LaneMaking& m, const Draft& track, float stop, std::vector<float>& out);

}  // namespace flaneur
