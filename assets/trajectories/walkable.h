// Where people can be on a ground, as other programs want to know it.
#pragma once

#include <vector>

#include "assets/trajectories/trajectories.h"

namespace flaneur {

struct Ground;

// All ground that is walked on (is_walked), seen from above, up to the walls of houses: outlines in whole
// millimetres, the largest first. What stands in the way of paths, as trees and cars do, is not taken out,
// walls that have ground on both sides are not told, and of levels above each other all count. Less than
// 0.1 square metres is left out.
std::vector<WalkablePolygon> walkable_area(const Ground& ground);

}  // namespace flaneur
