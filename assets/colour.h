// Colours in 8-bit sRGB, R in the lowest byte, opaque.
#pragma once

#include <cstdint>
#include <initializer_list>

#include "sim/base/vec.h"

namespace flaneur {

// From the usual hexadecimal notation, 0xrrggbb.
constexpr uint32_t rgb(uint32_t hex) {
    return 0xff000000u | (hex & 0xffu) << 16 | (hex & 0xff00u) | (hex >> 16 & 0xffu);
}

// Each channel times `factor` >= 0, at most full.
constexpr uint32_t shaded(uint32_t colour, float factor) {
    uint32_t out = 0xff000000u;
    for (int shift : {0, 8, 16}) {
        float channel = static_cast<float>(colour >> shift & 0xffu) * factor;
        out |= static_cast<uint32_t>(clamp(channel, 0, 255)) << shift;
    }
    return out;
}

}  // namespace flaneur
