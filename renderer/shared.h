// shaders/shared.h for C++: GLSL's names mean GLM's types.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace flaneur {

using glm::mat4;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using uint = uint32_t;

#include "shaders/shared.h"

static_assert(sizeof(JointTransform) == 32);
static_assert(sizeof(WalkerInstance) == 40);
static_assert(sizeof(ImpostorCell) == 32);
static_assert(sizeof(ImpostorInstance) == 64);
static_assert(sizeof(FrameConstants) == 2 * 64 + 24 * 16);

}  // namespace flaneur
