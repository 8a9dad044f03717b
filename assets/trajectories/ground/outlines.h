// Outlines joined and cut, in whole millimetres. Private to assets/trajectories.
#pragma once

#include <vector>

#include "assets/plan/polygons.h"
#include "assets/trajectories/trajectories.h"

namespace flaneur {

// Wound so that outlines over each other count as one.
void add_outline(Rings& rings, const std::vector<Vec2>& outline);
// Their union, the largest piece first.
std::vector<WalkablePolygon> united_area(const Rings& rings);
std::vector<WalkablePolygon> area_without(const Rings& rings, const Rings& holes);
// 24 corners about a place.
std::vector<Vec2> circle_about(Vec2 middle, float radius);

}  // namespace flaneur
