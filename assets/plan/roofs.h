// Pitched roofs of masses, and what masses and roofs are made from.
#pragma once

#include <functional>

#include "assets/plan/masses.h"

namespace flaneur {

// Adds the walls and the roof of a mass whose roof is pitched. False, with nothing added, where its outline
// does not allow for that roof.
bool add_pitched_mass(City& city, const Mass& mass);

// Counter-clockwise from outside.
void add_triangle(City& city, Vec3 a, Vec3 b, Vec3 c, uint32_t building);
void add_quad(City& city, Vec3 a, Vec3 b, Vec3 c, Vec3 d, uint32_t building);
// A region at heights of its own, facing up or down.
void add_region(City& city, const Region& region, bool up, uint32_t building,
                const std::function<float(Point)>& height);
// All around the footprint, from its bottom to `top`.
void add_walls(City& city, const Mass& mass, float top);

}  // namespace flaneur
