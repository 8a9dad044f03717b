// Well-known text of polygons (OGC 06-103r4), as other programs write walkable areas: POLYGON ((x y, ..), ..)
// and MULTIPOLYGON. Its y is our -z.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "assets/trajectories/trajectories.h"

namespace flaneur {

std::string wkt_of(const std::vector<WalkablePolygon>& area);
// The error's sentence has no subject.
Result<std::vector<WalkablePolygon>> parse_wkt(std::string_view text);

}  // namespace flaneur
