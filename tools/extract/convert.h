// Values of the simulation as the renderer wants them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

#include "sim/base/vec.h"
#include "tools/extract/extract.h"

namespace flaneur {

inline glm::vec3 to_glm(Vec3 v) { return {v.x, v.y, v.z}; }

// A component of a unit vector, in 127ths.
inline int8_t packed(float v) { return static_cast<int8_t>(std::lround(clamp(v, -1, 1) * 127)); }

inline JointTransform transform_of(Vec3 at, Quat turn) {
    return {{turn.x, turn.y, turn.z, turn.w}, {at.x, at.y, at.z, 0}};
}

// What is no person, about `centre`, whose joints come next in the palette.
inline WalkerDraw thing_to_draw(const PeopleFrame& frame, uint32_t mesh, uint32_t id, Vec3 centre,
                                float radius, float scale = 1) {
    WalkerDraw draw;
    draw.mesh = mesh;
    draw.is_upright = false;
    draw.id = id;
    draw.instance.scale = scale;
    draw.instance.palette = static_cast<uint32_t>(frame.palette.size());
    std::ranges::fill(draw.instance.tints, 0xffffffffu);
    draw.centre = to_glm(centre);
    draw.radius = radius;
    return draw;
}
// Adds one all of whose joints are there.
inline void add_rigid(PeopleFrame& frame, const WalkerDraw& draw, const JointTransform& there) {
    frame.palette.resize(frame.palette.size() + k_palette_joints, there);
    frame.walkers.push_back(draw);
}

}  // namespace flaneur
