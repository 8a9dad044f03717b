// Density by Voronoi cells (B. Steffen, A. Seyfried, Methods for measuring pedestrian density, flow, speed
// and direction with minimal scatter, Physica A 389, 2010): everybody has the ground that is nearer to them
// than to anybody else, over which they are spread evenly; a zone's density is what lies in it of all of
// them, over its area. It does not jump when somebody steps in.
#pragma once

#include <span>
#include <vector>

#include "sim/base/vec.h"

namespace flaneur {

// Nobody's cell reaches farther than this, metres: as a 24-sided polygon about them. Walls do not cut it.
inline constexpr float k_cell_reach = 3;

// The cell of people[who], its corners one way round.
std::vector<Vec2> voronoi_cell(std::span<const Vec2> people, size_t who);

// What of a polygon lies in one that is convex, to a centimetre; both go either way round. Of one that is not
// convex, edges that fold back may be left, which have no area.
std::vector<Vec2> part_within(std::span<const Vec2> polygon, std::span<const Vec2> convex);

// People to a square metre of a zone. `people` are all who are there, those outside too.
double voronoi_density(std::span<const Vec2> zone, std::span<const Vec2> people);

}  // namespace flaneur
