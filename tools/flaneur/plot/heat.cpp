#include "tools/flaneur/plot/heat.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "tools/flaneur/plot/plot.h"
#include "tools/flaneur/plot/svg_pieces.h"

namespace flaneur {
namespace {

constexpr double k_wide = 900, k_most_high = 900;
constexpr double k_left = 76, k_right = 130, k_top = 84, k_bottom = 62;
constexpr int k_shades = 64;
constexpr const char* k_style =
    ".title{font-size:17px;font-weight:600}.sub{font-size:11px;fill:#666}.axis{font-size:12px;fill:#444}"
    ".tick{font-size:11px;fill:#777}.right{text-anchor:end}.middle{text-anchor:middle}"
    ".wall{fill:none;stroke:#222;stroke-width:1.5;stroke-linejoin:round}";

struct Ink {
    double r, g, b;
};
// Viridis at each eighth.
constexpr std::array<Ink, 9> k_viridis = {{{68, 1, 84},
                                           {71, 44, 122},
                                           {59, 81, 139},
                                           {44, 113, 142},
                                           {33, 144, 141},
                                           {39, 173, 129},
                                           {92, 200, 99},
                                           {170, 220, 50},
                                           {253, 231, 37}}};

std::string shade(int k) {
    const double at = 8.0 * k / (k_shades - 1);
    const auto low = std::min(static_cast<size_t>(at), k_viridis.size() - 2);
    const double share = at - static_cast<double>(low);
    const Ink a = k_viridis[low], b = k_viridis[low + 1];
    auto mixed = [&](double from, double to) { return static_cast<int>(from + (to - from) * share + 0.5); };
    char text[8];
    std::snprintf(text, sizeof text, "#%02x%02x%02x", mixed(a.r, b.r), mixed(a.g, b.g), mixed(a.b, b.b));
    return text;
}

int shade_of(float value, double most) {
    const double share = most > 0 ? static_cast<double>(value) / most : 0;
    return static_cast<int>(std::clamp(share, 0.0, 1.0) * (k_shades - 1) + 0.5);
}

}  // namespace

std::string heat_svg(const HeatMap& map) {
    const size_t rows = map.columns > 0 ? map.values.size() / map.columns : 0;
    const double columns = static_cast<double>(std::max<size_t>(map.columns, 1));
    double pixels = (k_wide - k_left - k_right) / columns;  // of a square
    pixels =
        std::min(pixels, (k_most_high - k_top - k_bottom) / static_cast<double>(std::max<size_t>(rows, 1)));
    const double floor = k_top + pixels * static_cast<double>(rows), right = k_left + pixels * columns;
    double most = 0;
    for (const float value : map.values)
        if (std::isfinite(value)) most = std::max(most, static_cast<double>(value));
    std::string svg = svg_begin(k_wide, std::max(floor, k_top + 160) + k_bottom, k_style);
    svg += svg_label(k_left, 28, "title", map.title) + svg_label(k_left, 48, "sub", map.note);
    // Runs of one shade in a row are one bar. No edge is smoothed, so that no seam shows between bars.
    svg += "<g shape-rendering=\"crispEdges\">\n";
    for (size_t row = 0; row < rows; ++row)
        for (size_t begin = 0; begin < map.columns;) {
            const float* const values = map.values.data() + row * map.columns;
            size_t end = begin + 1;
            if (!std::isfinite(values[begin])) {
                begin = end;
                continue;
            }
            const int own = shade_of(values[begin], most);
            while (end < map.columns && std::isfinite(values[end]) && shade_of(values[end], most) == own)
                ++end;
            const double top = k_top + pixels * static_cast<double>(row);
            svg += printed("<path d=\"M%.2f %.2fH%.2fV%.2f", k_left + pixels * static_cast<double>(begin),
                           top, k_left + pixels * static_cast<double>(end), top + pixels);
            svg += printed("H%.2fz\" fill=\"", k_left + pixels * static_cast<double>(begin));
            svg += shade(own) + "\"/>\n";
            begin = end;
        }
    svg += "</g>\n";
    auto px = [&](double x) { return k_left + (x - map.x) / map.square * pixels; };
    auto py = [&](double y) { return k_top + (map.y - y) / map.square * pixels; };
    // A picture in the picture, which cuts off what goes beyond it.
    svg += printed("<svg x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\">\n", k_left - 1, k_top - 1,
                   right - k_left + 2, floor - k_top + 2);
    for (const std::vector<std::pair<double, double>>& outline : map.outlines) {
        if (outline.size() < 2) continue;
        svg += "<path class=\"wall\" d=\"M";
        for (const auto& [x, y] : outline)
            svg += printed("%.1f %.1f ", px(x) - k_left + 1, py(y) - k_top + 1);
        svg += "z\"/>\n";
    }
    svg += "</svg>\n";
    const double wide = columns * map.square, high = static_cast<double>(rows) * map.square;
    const double across = grid_step(100 * wide) / 100, up = grid_step(100 * high) / 100;
    for (double x = std::ceil(map.x / across) * across; x <= map.x + wide * (1 + 1e-9); x += across)
        svg += svg_label(px(x), floor + 17, "tick middle", short_number(std::fabs(x) < across / 2 ? 0 : x));
    for (double y = std::ceil((map.y - high) / up) * up; y <= map.y + high * 1e-9; y += up)
        svg += svg_label(k_left - 8, py(y) + 4, "tick right", short_number(std::fabs(y) < up / 2 ? 0 : y));
    svg += svg_label((k_left + right) / 2, floor + 40, "axis middle", "x, metres");
    svg += svg_label(8, k_top - 10, "axis", "y, metres");
    // The scale.
    const double bar = right + 24, bar_high = std::max(floor - k_top, 160.0);
    for (int k = 0; k < k_shades; ++k) {
        svg += printed("<rect x=\"%.1f\" y=\"%.2f\" width=\"16\" height=\"%.2f\" fill=\"", bar,
                       k_top + bar_high * (k_shades - 1 - k) / k_shades, bar_high / k_shades + 0.3);
        svg += shade(k) + "\"/>\n";
    }
    svg += svg_label(bar, k_top - 10, "axis", map.unit);
    if (most > 0) {
        const double mark = grid_step(100 * most) / 100;
        for (double v = 0; v <= most * (1 + 1e-9); v += mark)
            svg += svg_label(bar + 22, k_top + bar_high * (1 - v / most) + 4, "tick", short_number(v));
    }
    return svg + "</svg>\n";
}

}  // namespace flaneur
