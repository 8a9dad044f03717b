// Colours of skin, hair and clothes, drawn by chance for each walker.
#pragma once

#include <array>
#include <cstdint>

#include "assets/character.h"

namespace flaneur {

// sRGB with R in the lowest byte, one for each Tint; [none] is white. The same (seed, walker) always dresses
// alike.
std::array<uint32_t, k_tint_count> outfit(uint64_t seed, uint32_t walker);

}  // namespace flaneur
