#include "sim/base/levels.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>

#include "assets/character.h"
#include "assets/levels/gate.h"
#include "assets/levels/paint.h"
#include "assets/levels/palette.h"
#include "assets/levels/surface.h"
#include "assets/people/lods.h"

namespace flaneur {

namespace {

constexpr std::array<size_t, k_person_levels> k_level_triangles = {0, 3000, 1500, 500, 180};
constexpr int k_painted_from = 3;  // levels that may lose the seams of their textures
constexpr int k_attempts = 4;      // with the more triangles the farther the one before was off
constexpr float k_least_part = 2;  // pixels: what is smaller may go
constexpr float k_most_error = 4;  // pixels that a place may move by at first

std::string percent(float share, const char* format) {
    char text[24];
    std::snprintf(text, sizeof text, format, double(100 * share));
    return text;
}

// Why a level may not stand for the finest.
std::string fault_of(const LevelDifference& d, int level) {
    const LevelDifference& most = k_most_difference[size_t(level)];
    std::string fault;
    auto judge = [&](const char* what, float is, float may) {
        if (is <= may) return;
        fault += (fault.empty() ? "" : ", ") + std::string(what) + " differs by " + percent(is, "%.2f %%") +
                 ", more than " + percent(may, "%.0f %%");
    };
    judge("silhouette", d.silhouette, most.silhouette);
    judge("colour", d.colour, most.colour);
    return fault;
}

// Whether so many triangles are worth a level below so many.
bool is_coarser(size_t triangles, size_t before) { return triangles * 10 <= before * 8; }

// The level's triangles, or none where none that are coarser than `finer` may stand for the finest.
std::vector<uint32_t> try_level(Character& c, const std::vector<uint32_t>& base, size_t finer, int level,
                                LevelGate& gate, MeasuredLevel& measured) {
    const LevelDifference& most = k_most_difference[size_t(level)];
    const float pixel = c.body.height / pixels_of_level(level);  // metres
    auto wanted = float(k_level_triangles[size_t(level)]);
    float error = k_most_error * pixel;
    bool paints = level >= k_painted_from;
    for (int n = 0; n < k_attempts && is_coarser(size_t(wanted), finer); ++n) {
        const LevelSurface surface = make_surface(c, base, weighed_places(c), !paints);
        const DrawnTriangles drawn = with_vertices(
            c, surface, simplified(c, surface, size_t(wanted), k_least_part * pixel, error), pixel);
        std::vector<uint32_t> tried = paints ? painted(c, surface, drawn) : drawn.vertices;
        const size_t triangles = tried.size() / 3;
        const std::string count = std::to_string(triangles) + " triangles";
        if (triangles == 0 || !is_coarser(triangles, finer)) {
            measured.refused.push_back(count + ", as few as keep its parts and seams, are no gain");
            return {};
        }
        const LevelDifference d = difference_of(gate, c, tried, level);
        if (is_within(d, level)) {
            measured.silhouette = d.silhouette;
            measured.colour = d.colour;
            return tried;
        }
        measured.refused.push_back(count + ": " + fault_of(d, level));
        const float outline = d.silhouette / most.silhouette, colour = d.colour / most.colour;
        if (colour > outline) paints = false;
        const float more = clamp(std::max(outline, colour), 1.5f, 3);
        wanted = std::max(wanted * more, float(triangles) * 1.3f);
        error /= more;
    }
    return {};
}

}  // namespace

void build_lods(Character& c) {
    c.lods.resize(1);
    c.found.levels.clear();
    if (c.vertices.empty() || c.lods[0].empty()) return;
    if (!is_coarser(k_level_triangles.back(), c.lods[0].size() / 3)) return order_levels(c);
    LevelGate gate = make_gate(c);
    std::vector<uint32_t> base = without_palettes(c);  // what the next level is made of
    for (int level = 1; level < k_person_levels; ++level) {
        MeasuredLevel measured;
        std::vector<uint32_t> used = try_level(c, base, c.lods.back().size() / 3, level, gate, measured);
        if (used.empty()) {  // the next finer one stands in
            used = c.lods.back();
            if (!c.found.levels.empty()) {
                measured.silhouette = c.found.levels.back().silhouette;
                measured.colour = c.found.levels.back().colour;
            }
        } else if (level < k_painted_from) {
            base = used;
        }
        measured.pixels = pixels_of_level(level);
        measured.triangles = used.size() / 3;
        c.found.levels.push_back(std::move(measured));
        c.lods.push_back(std::move(used));
    }
    order_levels(c);
}

}  // namespace flaneur
