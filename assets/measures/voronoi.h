// Voronoi cells: everybody has the ground that is nearer to them than to anybody else, cut off where it is
// too far, and by walls. B. Steffen, A. Seyfried, Methods for measuring pedestrian density, flow, speed and
// direction with minimal scatter, Physica A 389, 2010; PedPy: compute_individual_voronoi_polygons.
//
// Of a cell that a wall cuts in two, the piece counts in which one stands. Who stands off the ground has no
// cell, but takes ground from others. Of those who stand on the same spot each has the cell that one of them
// had.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "assets/measures/cell_ground.h"

namespace flaneur {

// People of one moment, sorted into squares. `of` outlives it.
struct PeopleGrid {
    std::span<const Vec2> of;
    Vec2 low = {};
    float square = 1;  // metres
    int columns = 1, rows = 1;
    std::vector<uint32_t> begins = {};  // of each square in `who`, and last how many there are
    std::vector<uint32_t> who = {};
};
PeopleGrid people_grid(std::span<const Vec2> people);
// Metres from people[who] to whoever is nearest; infinite where nobody else is.
float distance_to_nearest(const PeopleGrid& people, uint32_t who);

// Corners are told from where its owner stands.
struct VoronoiCell {
    std::vector<std::vector<Vec2>> rings;  // holes turn the other way; none: no cell
    bool is_convex = false;                // one ring, which is
    double area = 0;                       // square metres
    std::vector<uint32_t> neighbours;      // whose cells it shares an edge with
    // Not to be read.
    std::vector<Vec2> open, scratch;
    std::vector<uint32_t> cutters;
};
// Of people[who]. `cell` may be used again and again, which saves memory from being asked for.
void make_cell(const PeopleGrid& people, uint32_t who, const CellGround& ground, VoronoiCell& cell);

// Where to measure: outlines, with holes or not, which do not overlap.
struct MeasuredArea {
    CellGround ground;
    double square_metres = 0;  // of it that are walkable
};
// All of an area that is not known is walkable. Cells that are looked for in it reach no farther than
// `cut_off`.
MeasuredArea measured_area(std::span<const WalkablePolygon> outlines,
                           std::span<const WalkablePolygon> walkable, CutOff cut_off = {});
bool is_in(const MeasuredArea& area, Vec2 place);
// Square metres of somebody's cell that lie in it.
double area_within(const MeasuredArea& area, const VoronoiCell& cell, Vec2 owner);

// People to a square metre of a zone that is walkable everywhere, by cells that no wall cuts: what lies in it
// of each cell, over the cell's area, all of which is summed up and divided by the zone's area. It does not
// jump when somebody steps in. `people` are all who are there, those outside too.
double voronoi_density(std::span<const Vec2> zone, std::span<const Vec2> people, CutOff cut_off);

}  // namespace flaneur
