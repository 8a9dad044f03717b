// Values of the simulation as the renderer wants them.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

#include "sim/base/vec.h"

namespace flaneur {

inline glm::vec3 to_glm(Vec3 v) { return {v.x, v.y, v.z}; }

// A component of a unit vector, in 127ths.
inline int8_t packed(float v) { return static_cast<int8_t>(std::lround(clamp(v, -1, 1) * 127)); }

}  // namespace flaneur
