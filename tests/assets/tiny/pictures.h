// Small pictures as other programs write them, to be read as they are or broken first.
#pragma once

#include <png.h>

#include <cstdint>
#include <cstdio>
#include <vector>
// After <cstdio>, which it needs.
#include <jpeglib.h>

#include "assets/files/file.h"

namespace flaneur {

inline constexpr int k_tiny_width = 37, k_tiny_height = 21;

// Of a pixel of all of them: slopes, and an edge.
uint8_t tiny_sample(int x, int y, int channel);

struct PngKind {
    int colour, bits;  // PNG_COLOR_TYPE_...
    bool interlaced = false, see_through = false;
};
Bytes png_of(const PngKind& kind);
Bytes jpeg_of(J_COLOR_SPACE space, int channels, bool progressive);
Bytes webp_of(bool lossless);

}  // namespace flaneur
