// Closed pieces beside the implicit body: what is worn or carried and is too thin or too hard for it. Body
// heights, bind pose, before the warp.
#pragma once

#include <span>
#include <vector>

#include "sim/base/vec.h"

namespace flaneur {

// Triangles counter-clockwise seen from outside; where the surface has an edge, a place stands twice with two
// normals.
struct SolidMesh {
    std::vector<Vec3> positions, normals;
    std::vector<uint32_t> indices;
};

// Three directions square to each other: a piece's own x, y and z.
struct Frame {
    Vec3 origin;
    Vec3 side{1, 0, 0}, up{0, 1, 0}, front{0, 0, 1};
    Vec3 at(Vec3 p) const { return origin + side * p.x + up * p.y + front * p.z; }
};
Frame make_frame(Vec3 origin, Vec3 up, Vec3 front);  // up is kept, front made square to it

// A box with edges rounded over: the superellipsoid |x/a|^n + |y/b|^n + |z/c|^n = 1 with n = 2 / `soft`;
// `soft` is 1 for an ellipsoid, less for a box.
SolidMesh make_pillow(const Frame& frame, Vec3 half, float soft, int around = 16, int rings = 8);

// A band or rod along a path: `width` across `across`, `thick` square to it. Rounded ends close it.
SolidMesh make_band(std::span<const Vec3> path, Vec3 across, float width, float thick, int sides = 6);
// The same bent to a ring.
SolidMesh make_ring(std::span<const Vec3> path, Vec3 across, float width, float thick, int sides = 6);

// A profile turned about `frame.up`: (radius, height) from the inner lower end over the outside to the top or
// back to the start; `depth` scales it along `frame.front`. Closed at both ends by their middles.
struct Turn {
    float radius, height;
};
SolidMesh make_turned(const Frame& frame, std::span<const Turn> profile, float depth, int around = 20);

}  // namespace flaneur
