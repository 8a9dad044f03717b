// The shapes that props are made of. Private to assets/props*.
#pragma once

#include <vector>

#include "assets/props/props.h"
#include "sim/base/math.h"
#include "sim/base/rng.h"

namespace flaneur {

// A round or square post from `foot` to `top`.
void add_post(PropMesh& mesh, Vec3 foot, Vec3 top, float foot_radius, float top_radius, uint32_t sides,
              PropPart part, bool cap);
// A box of half extents `half` about `centre`, turned by `yaw`.
void add_box(PropMesh& mesh, Vec3 centre, Vec3 half, float yaw, PropPart part);
// A quad, counter-clockwise from outside.
void add_quad(PropMesh& mesh, Vec3 a, Vec3 b, Vec3 c, Vec3 d, PropPart part, float shade = 1);
// A smooth skin over rows of `columns` points each, seen from outside with rows upwards and columns to the
// left.
void add_sheet(PropMesh& mesh, const std::vector<Vec3>& points, size_t columns, PropPart part);
// Turned on a lathe about the upright through `foot`: (radius, height) from the foot up, seen from outside.
void add_turned(PropMesh& mesh, Vec3 foot, const std::vector<Vec2>& profile, uint32_t sides, PropPart part);
// A ball with a bumpy skin, squashed below. Its normals lean away from the middle of the whole, `crown`, so
// that several are lit as one; its lightness is times `shade`.
void add_clump(PropMesh& mesh, Vec3 centre, Vec3 size, Vec3 crown, Vec3 crown_size, RandomKey key,
               uint32_t draw, float shade = 1, PropPart part = PropPart::leaves);

// A prop's own axes: x to its left, z ahead.
struct PropFrame {
    Vec3 origin;
    Quat turn;
    float yaw;

    explicit PropFrame(const Prop& prop) : origin(prop.position), turn(rotation_y(prop.yaw)), yaw(prop.yaw) {}
    Vec3 at(float x, float y, float z) const { return origin + rotate(turn, Vec3{x, y, z}); }
};

void add_tree(PropMesh& mesh, const Prop& tree);
void add_car(PropMesh& mesh, const Prop& car);
// Without its wheels: hatchback, saloon or estate.
void add_car_body(PropMesh& mesh, const PropFrame& frame, size_t shape);
void add_fountain(PropMesh& mesh, const Prop& fountain);
void add_statue(PropMesh& mesh, const Prop& statue);

}  // namespace flaneur
