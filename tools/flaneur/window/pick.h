// Who is under the cursor.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "renderer/scene.h"
#include "sim/world.h"
#include "tools/flaneur/options/options.h"

namespace flaneur {

inline constexpr float k_far_sight = 200'000;  // metres that are looked: from above the largest map, too

// The way from the eye through a point of a picture of this size, pixels from the upper left corner; a unit
// vector.
glm::vec3 ray_through(const Camera& camera, Size size, glm::vec2 pixel);

// The nearest walker whose body that way meets before any wall, `slack` radians beside it at most: by slot.
std::optional<uint32_t> walker_along(const World& world, const Camera& camera, glm::vec3 way, float slack);

}  // namespace flaneur
