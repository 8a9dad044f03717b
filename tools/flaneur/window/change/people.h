// People come and go where nobody looks.
#pragma once

#include <optional>

#include "renderer/scene.h"
#include "sim/world.h"

namespace flaneur {

// Whether an eye may see somebody there: before it, no farther than 150 m, and no wall in between.
bool may_see(const Ground& ground, const Camera& camera, Vec3 place);

// Adds or removes people until there are `people`, so many at most, out of sight where they fit there; who is
// `kept` goes last. Returns whether there are as many now; an error where no more fit.
Result<bool> approach(World& world, uint32_t people, uint32_t most, const Neighbourhood& home,
                      const Camera& camera, std::optional<uint32_t> kept);

}  // namespace flaneur
