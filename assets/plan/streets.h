// Streets as people drew them on a map: centre lines with widths, and what belongs to them.
#pragma once

#include <vector>

#include "assets/plan/ground_plan.h"
#include "sim/lamps/crossings.h"

namespace flaneur {

struct Street {
    std::vector<Vec2> line;     // centre of the carriageway
    float width = 7;            // of the carriageway, kerb to kerb
    float left = 3, right = 3;  // sidewalks' widths, as seen along the line; 0: none
    bool round_start = true, round_end = true;
};
// Carriageway and sidewalks. Round ends leave no notch where streets meet.
void add_street(GroundPlan& plan, const Street& street);

// A street as seen from a junction: the unit direction away from it, and half the carriageway's width.
struct JunctionArm {
    Vec2 direction;
    float half_width = 3.5f;
};
// Rounds the corners between neighbouring arms to about `radius` metres. Returns for each arm how far from
// the junction its kerbs become straight.
std::vector<float> add_corners(GroundPlan& plan, Vec2 junction, const std::vector<JunctionArm>& arms,
                               float radius);

// A crossing over the carriageway at `centre`: people walk along the unit vector `across`, cars along
// `along`. At both ends the sidewalk's kerb is dropped and rises over 1.2 m. An unmarked one
// has no stripes. Returns where it is; its height is 0, and no lamp rules it.
Crossing add_crossing(GroundPlan& plan, Vec2 centre, Vec2 along, Vec2 across, float half_width, float breadth,
                      bool marked);

// A kerb dropped over `breadth` metres about `kerb`, a place on it. The sidewalk rises from there along the
// unit vector `out`, square to the kerb, over 1.2 m.
void add_dropped_kerb(GroundPlan& plan, Vec2 kerb, Vec2 out, float breadth);

// A flight of steps along a line of at least two points.
struct Flight {
    std::vector<Vec2> line;
    float width = 2.6f;
    float from = 0, to = 0;  // heights of its ends, metres (not above the terrain)
    int risers = 0;          // 0: as many as make them about 0.16 m high
};
// Flat treads between risers that are equally far apart; the first half tread and the last are level with the
// ends. Risers are at least 0.1 m, so that there are none where the ends are about level, and at most 0.25 m.
void add_flight(GroundPlan& plan, const Flight& flight);
int riser_count(float rise, int stated);

float length_of(const std::vector<Vec2>& line);
// The part of a line from `from` to `to` metres along it; at least two points for from < to.
std::vector<Vec2> part_of(const std::vector<Vec2>& line, float from, float to);

}  // namespace flaneur
