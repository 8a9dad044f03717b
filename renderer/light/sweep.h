// Light on the host: where the device is a CPU, lanes on every thread light a picture in a third of the time
// that the device's shaders take. By the same formulas, shaders/light/light.h, to the same colours.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/shared.h"
#include "sim/base/parallel_for.h"

namespace flaneur {

// Rows of texels as they lie in memory.
template <class T>
struct Texels {
    const T* first = nullptr;
    size_t stride = 0;  // from row to row, in texels
};

// What the device has drawn, and what lights it.
struct Unlit {
    const FrameConstants* frame = nullptr;
    Texels<int32_t> colours;   // see shaders/base/surface.glsl
    Texels<int32_t> surfaces;  // two a texel
    Texels<float> depths;
    Texels<int32_t> overlay;       // laid over the picture, alpha multiplied in, where frame->way.w says so
    const uint16_t* shadows = {};  // k_shadow_layers maps
    std::span<const vec4> lamps;   // of the lamp map, rows
    int lamps_width = 0;           // texels
    std::span<const vec4> sky;     // k_sky_columns + 1 times k_sky_rows + 1
    bool smooths_edges = true;
};

// The picture's colours on the way: sRGB, R in the lowest byte, and how bright each is. Kept from frame to
// frame.
struct LitPicture {
    std::vector<uint32_t> colours;
    std::vector<uint8_t> lumas;
};

// Lights a picture of frame->screen's size into `pixels`: sRGB, opaque, rows without gaps, R in the lowest
// byte, or B.
void light_picture(const Unlit& unlit, Workers& workers, LitPicture& lit, bool is_blue_first,
                   uint32_t* pixels);

}  // namespace flaneur
