#include "tools/flaneur/sheets/caption.h"

#include <stb/stb_easy_font.h>

#include <algorithm>
#include <array>

namespace flaneur {

namespace {

constexpr std::array<uint8_t, 3> k_ink = {0x3a, 0x3d, 0x42};

struct LetterCorner {  // as stb_easy_font lays them out
    float x, y, z;
    uint8_t colour[4];
};
static_assert(sizeof(LetterCorner) == 16);

}  // namespace

void draw_caption(std::vector<uint8_t>& rgba, Size size, int x, int y, int scale, const std::string& line) {
    std::string text;
    for (char c : line) text += c >= ' ' && c <= '~' ? c : '?';
    std::vector<LetterCorner> corners(64 * (text.size() + 1));
    auto quads = static_cast<size_t>(stb_easy_font_print(
        0, 0, text.data(), nullptr, corners.data(), static_cast<int>(corners.size() * sizeof(LetterCorner))));
    for (size_t q = 0; q < quads; ++q) {  // rectangles: upper left, upper right, lower right, lower left
        const LetterCorner &a = corners[4 * q], &b = corners[4 * q + 2];
        auto along = [&](float v, int from, int most) {
            return std::clamp(from + static_cast<int>(v * static_cast<float>(scale)), 0, most);
        };
        for (int row = along(a.y, y, size.height); row < along(b.y, y, size.height); ++row) {
            for (int column = along(a.x, x, size.width); column < along(b.x, x, size.width); ++column) {
                size_t pixel =
                    static_cast<size_t>(row) * static_cast<size_t>(size.width) + static_cast<size_t>(column);
                std::copy(k_ink.begin(), k_ink.end(), rgba.begin() + static_cast<std::ptrdiff_t>(4 * pixel));
            }
        }
    }
}

}  // namespace flaneur
