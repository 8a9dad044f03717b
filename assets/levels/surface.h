// The surface of a character as it is made coarser: vertices that look alike at one place are one point, so
// that hard edges hold nothing fast, and those that do not are several, which are seams; backs of sheets are
// left out until the end.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/character.h"

namespace flaneur {

struct LevelSurface {
    std::vector<uint32_t> corners;  // triangles over points
    std::vector<Vec3> places;       // of points, in the bind pose
    std::vector<Vec3> weighed;      // the same as errors are measured
    // By point: the vertices that are one there, members[first[p]] to members[first[p + 1]].
    std::vector<uint32_t> first, members;
    std::vector<uint8_t> two_sided;  // by point
    std::vector<uint32_t> place;     // by point: the first of those at its place
    // By point: what hangs together at all, numbered from 0, and of that what hangs together without a seam.
    std::vector<uint32_t> part, chart;
    uint32_t parts = 0, charts = 0;
};

// Of some triangles over c.vertices; `weighed` by vertex. Points differ by place, weights, colour and
// texture; by where they lie on the texture only if `keeps_uv`, or where it is cut by its alpha.
LevelSurface make_surface(const Character& c, const std::vector<uint32_t>& corners,
                          const std::vector<Vec3>& weighed, bool keeps_uv);

// About so many triangles over the surface's points, its parts sharing them by area; more where places would
// move by over `most_error` metres. No part, head, hand or foot that is larger than `least` metres goes or
// shrinks by half: where it would, its part keeps more.
std::vector<uint32_t> simplified(const Character& c, const LevelSurface& surface, size_t triangles,
                                 float least, float most_error);

// Triangles as they are drawn, and the points that they came from.
struct DrawnTriangles {
    std::vector<uint32_t> vertices, points;  // of one length
};

// At each corner the vertex whose normal fits best; sheets get their backs again. Few triangles within a
// round body make it thinner: each part is blown up until it holds what it held, by at most `most_growth`
// metres, with vertices of its own appended to `c`.
DrawnTriangles with_vertices(Character& c, const LevelSurface& surface, const std::vector<uint32_t>& corners,
                             float most_growth);

// By texture: whether something of it can be seen through.
std::vector<uint8_t> find_cut(const std::vector<Texture>& textures);

}  // namespace flaneur
