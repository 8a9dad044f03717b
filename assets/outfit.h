// Colours of skin, hair and clothes, drawn by chance for each walker.
#pragma once

#include <array>
#include <cstdint>

#include "assets/character.h"

namespace flaneur {

// What this walker of `person`'s shape shows: sRGB with R in the lowest byte, one for each Tint; [none] is
// white. The same arguments always dress alike.
std::array<uint32_t, k_tint_count> outfit(const PersonOptions& person, uint64_t seed, uint32_t walker);

}  // namespace flaneur
