// A walled field with three pillars and a block in it, among hills: where one finds a way by rays alone.
#pragma once

#include "assets/city.h"

namespace flaneur {

inline constexpr float k_field_half = 20;  // metres from its middle to each wall
City build_field(uint64_t seed);

}  // namespace flaneur
