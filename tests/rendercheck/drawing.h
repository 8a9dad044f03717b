// Pictures drawn by tests: a street with far walkers, a few pixels each.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "tests/folder.h"
#include "tools/rendercheck/verdict/verdict.h"

namespace flaneur {

inline uint8_t* pixel(CheckedPicture& picture, int x, int y) {
    return &picture.rgba[4 * (static_cast<size_t>(y) * static_cast<size_t>(picture.width) +
                              static_cast<size_t>(x))];
}

// As much of it as lies in the picture.
inline void paint(CheckedPicture& picture, const PixelBox& box, uint8_t r, uint8_t g, uint8_t b) {
    for (int y = box.top; y < std::min(box.top + box.height, picture.height); ++y)
        for (int x = box.left; x < std::min(box.left + box.width, picture.width); ++x) {
            uint8_t* p = pixel(picture, x, y);
            p[0] = r, p[1] = g, p[2] = b, p[3] = 255;
        }
}

// Walkers stand at x 20, 40, ..., each 4 pixels wide and 10 high.
inline CheckedPicture street(int walkers = 12, int width = 320, int height = 180) {
    CheckedPicture out;
    out.width = width, out.height = height;
    out.rgba.resize(static_cast<size_t>(width) * static_cast<size_t>(height) * 4);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const int brick = (x / 5 + y / 3) % 2 * 25;
            paint(out, {x, y, 1, 1}, static_cast<uint8_t>(90 + brick),
                  static_cast<uint8_t>(60 + y / 3 + brick), static_cast<uint8_t>(40 + x / 4));
        }
    for (int n = 0; n < walkers; ++n)
        paint(out, {20 + 20 * n, 100, 4, 10}, static_cast<uint8_t>(200 - 10 * n), 30,
              static_cast<uint8_t>(20 * n));
    return out;
}

inline std::string png_text(const CheckedPicture& picture) {
    const std::vector<uint8_t> bytes = *write_png(picture.rgba, picture.width, picture.height);
    return {bytes.begin(), bytes.end()};
}

}  // namespace flaneur
