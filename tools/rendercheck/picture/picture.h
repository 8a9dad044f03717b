// Pictures that renderers write: PNG of 8 or 16 bits by libpng, OpenEXR by its own library.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sim/base/result.h"

namespace flaneur {

enum class Precision {
    eight,    // PNG, 8 bits a channel or fewer: sRGB
    sixteen,  // PNG, 16 bits a channel: sRGB
    floats,   // EXR: linear light, or whatever the channel is
};

struct CheckedPicture {
    int width = 0, height = 0;
    Precision precision = Precision::eight;
    std::vector<uint8_t> rgba;  // rows from the top; of deeper pictures what a screen would show of them
    std::vector<float> deep;    // RGBA of deeper ones: 0 .. 1 of `sixteen`, what the file says of `floats`
};

// More pixels are refused before memory is taken for them: 64 Mi, as of 8192x8192.
inline constexpr size_t k_most_checked_pixels = size_t{1} << 26;

// The error's sentence has no subject: "has 30000x30000 pixels, more than ...".
Result<CheckedPicture> read_picture(std::span<const uint8_t> bytes);
// Of a regular file. The error's sentence has the path as its subject.
Result<CheckedPicture> load_picture(const std::string& path);

// "WxH"
std::string told_size(const CheckedPicture& picture);
// "8 bits a channel"
const char* told_precision(Precision precision);

// A PNG of 8 bits a channel, RGB where all is opaque, and nothing besides the pixels; small rather than soon.
Result<std::vector<uint8_t>> write_png(const std::vector<uint8_t>& rgba, int width, int height);

// What follows takes OpenEXR alone.
Result<CheckedPicture> read_exr(std::span<const uint8_t> bytes);

}  // namespace flaneur
