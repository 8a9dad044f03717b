// A stone platform of any convex outline in still water, for those who go along circles on it.
#pragma once

#include <span>

#include "assets/city.h"
#include "sim/base/result.h"

namespace flaneur {

// Metres from its edge that nobody's middle comes nearer, so that feet are on it:
// NavmeshSettings::agent_radius. Of one that is too narrow for that no navmesh is built.
inline constexpr float k_off_the_edge = 0.6f;
// Its corners lie as make_platform() takes them, at height 0. Refuses what that refuses.
Result<City> build_platform(std::span<const Vec2> corners);

}  // namespace flaneur
