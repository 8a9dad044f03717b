// Ground on which people's Voronoi cells lie: a walkable area, made ready to cut small things by.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "assets/trajectories/trajectories.h"
#include "sim/ground/rectangle.h"

namespace flaneur {

// How far a cell reaches: a polygon of so many sides about whose it is, its corners `radius` metres away, the
// first one to the east. PedPy's Cutoff(radius, quad_segments) has 4 quad_segments sides.
struct CutOff {
    float radius = 0;  // 0: as far as the ground does
    int sides = 12;
};

// A tree of halves: what of the area lies about a box of it, farther than cells from there reach. A leaf has
// few edges, or is not much larger than a cell.
struct CellGround {
    enum class Shape : uint8_t { none, all, convex, any };  // of what is there
    struct Piece {
        Rectangle box;                         // whose cells it is for
        uint32_t halves = 0;                   // the first of two that stand together; 0: a leaf
        Shape shape = Shape::none;             // of a leaf
        std::vector<std::vector<Vec2>> rings;  // of a leaf; outlines turn to one side, holes to the other
    };
    CutOff cut_off;
    Rectangle box{};  // of all
    std::vector<Piece> pieces =
        {};  // the first one is all of it; none: the area is not known, and is everywhere
};
CellGround cell_ground(std::span<const WalkablePolygon> area, CutOff cut_off);

const CellGround::Piece& piece_at(const CellGround& ground, Vec2 place);
// In how many of the rings a place lies is odd.
bool is_on(const CellGround::Piece& piece, Vec2 place);

// Leaves what of a polygon lies where dot(normal, p) <= most.
void cut_by(std::vector<Vec2>& polygon, std::vector<Vec2>& scratch, Vec2 normal, float most);
// Leaves what of a polygon lies in one that is convex and turns as signed_area_of() counts up, which is moved
// by `by`.
void cut_by(std::vector<Vec2>& polygon, std::vector<Vec2>& scratch, std::span<const Vec2> convex,
            Vec2 by = {});
bool is_convex_ring(std::span<const Vec2> ring);

}  // namespace flaneur
