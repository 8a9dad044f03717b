// Flat polygons in whole millimetres: exact, so the same on every machine. X is the city's x, Y its z.
// Boolean operations are Clipper's (Debian's polyclipping); rings wind positively (interior to the left of
// each edge in the X-right, Y-up sense), holes negatively.
#pragma once

#include <cstdint>
#include <optional>
#include <polyclipping/clipper.hpp>
#include <vector>

#include "sim/base/vec.h"

namespace flaneur {

using Point = ClipperLib::IntPoint;
using Ring = ClipperLib::Path;
using Rings = ClipperLib::Paths;

// One outer ring and the holes in it.
struct Region {
    Ring outer;
    Rings holes;
};

// Rounds to the nearest millimetre.
Point to_point(Vec2 metres);
Vec2 to_metres(Point p);
// From west to east, and from north to south.
inline bool point_less(Point a, Point b) { return a.X != b.X ? a.X < b.X : a.Y < b.Y; }

// Twice the signed area, mm^2; exact.
int64_t twice_area(const Ring& ring);
// The area of rings with holes wound the other way, m^2.
double area(const Rings& rings);
// The ring wound positively.
Ring positive(Ring ring);
Ring rectangle(Point low, Point high);
// Even-odd; points on the border count as inside.
bool contains(const Rings& rings, Point p);
bool is_convex(const Ring& ring);
// Whether edges cross each other more than `most` times; looks 4000 edges ahead.
bool is_tangled(const Ring& ring, int most);

// Where the winding number of the rings is not zero.
Rings unite(const Rings& rings);
Rings intersect(const Rings& a, const Rings& b);
Rings subtract(const Rings& a, const Rings& b);
std::vector<Region> regions_of(const Rings& rings);
Rings rings_of(const Region& region);

// Every corner moved inwards along its bisector so that each edge moves by `distance` mm (outwards if
// negative); keeps the number of corners. None where an edge would vanish or the ring would cross itself.
std::optional<Ring> inset(const Ring& ring, int64_t distance);

// All rings moved inwards by so many metres, corners kept sharp; what is too narrow vanishes.
Rings inset_rings(const Rings& rings, float distance);
// The centre of a ring's area. None for a ring that encloses nothing.
std::optional<Vec2> middle_of(const Ring& ring);

// The corner points of a ring less those that stray under `tolerance` mm from the line between their
// neighbours, and repeated ones.
Ring without_collinear(const Ring& ring, int64_t tolerance);

// Adds to `out` positively wound convex pieces whose union covers the line `points` widened by `left` and
// `right` metres (seen along it with +y up: left of walking +z is +x). Bends are rounded on their outer side;
// ends are round
// or square.
void add_strip(Rings& out, const std::vector<Vec2>& points, float left, float right, bool round_start,
               bool round_end);
inline void add_strip(Rings& out, const std::vector<Vec2>& points, float left, float right, bool round_ends) {
    add_strip(out, points, left, right, round_ends, round_ends);
}

// Triangles of a region, as positively wound triples of indices into its points: the outer ring's, then each
// hole's. Their areas add up to the region's exactly for rings that do not cross themselves.
std::vector<uint32_t> triangulate(const Region& region);

}  // namespace flaneur
