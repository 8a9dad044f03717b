// A square by a river, built of what the district is built of: a street with a zebra crossing to the north,
// houses all round, two flights of steps down to a quay, and a parapet above it to lean a hand on.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/city.h"

namespace flaneur {

// Metres: the quay lies at `k_quay_height`, from z = 10.8 to 24, and +z is the river.
inline constexpr float k_quay_height = -1.53f;
// Who drank too much staggers here, between the flights and the water.
inline const std::vector<Vec2> k_quay_platform{{6, 15.6f}, {30, 15.6f}, {30, 22.6f}, {6, 22.6f}};

City build_quayside(uint64_t seed);

}  // namespace flaneur
