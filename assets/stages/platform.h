// A stone platform of any convex outline in still water, for those who go along circles on it.
#pragma once

#include <span>

#include "assets/city.h"
#include "sim/base/result.h"

namespace flaneur {

// Its corners lie as make_platform() takes them, at height 0. Refuses what that refuses, and what is so
// narrow that nobody can stand on it.
// Metres from its edge that nobody's middle comes nearer, so that feet are on it:
// NavmeshSettings::agent_radius.
inline constexpr float k_off_the_edge = 0.6f;
Result<City> build_platform(std::span<const Vec2> corners);

}  // namespace flaneur
