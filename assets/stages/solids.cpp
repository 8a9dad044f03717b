#include "assets/stages/solids.h"

#include <cmath>

#include "assets/colour.h"
#include "sim/base/math.h"

namespace flaneur {

static constexpr float k_course = 0.275f;                // metres
static constexpr float k_light = 0.96f, k_dark = 0.89f;  // every other course

void add_quad(Scenery& s, std::span<const Vec3, 4> corners, uint32_t colour, SceneryUse use) {
    const auto first = static_cast<uint32_t>(s.vertices.size());
    const Vec3 normal = normalize_or(cross(corners[1] - corners[0], corners[2] - corners[0]), {0, 1, 0});
    for (const Vec3 corner : corners) s.vertices.push_back({corner, normal, {}, colour});
    for (const uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u}) s.indices.push_back(first + k);
    s.pictures.insert(s.pictures.end(), 2, ~0u);
    s.uses.insert(s.uses.end(), 2, use);
}

void add_courses(Scenery& s, std::span<const Vec2> outline, float bottom, float top, uint32_t colour,
                 SceneryUse use, bool round) {
    const size_t n = outline.size();
    Vec2 middle{};
    for (const Vec2 corner : outline) middle += corner / static_cast<float>(n);
    for (size_t i = 0; i < n; ++i) {
        const Vec2 a = outline[i], b = outline[(i + 1) % n];
        int course = 0;
        for (float high = top; high > bottom + 1e-3f; high -= k_course, ++course) {
            const float low = std::max(high - k_course, bottom);
            const Vec3 corners[4] = {at_height(a, high), at_height(b, high), at_height(b, low),
                                     at_height(a, low)};
            add_quad(s, corners, shaded(colour, course % 2 == 0 ? k_light : k_dark), use);
            if (!round) continue;
            for (size_t k = s.vertices.size() - 4; k < s.vertices.size(); ++k)
                s.vertices[k].normal =
                    at_height(normalize_or(on_ground(s.vertices[k].position) - middle, {0, 0}), 0);
        }
    }
}

std::vector<Vec2> box_outline(Vec2 low, Vec2 high) {
    return {{low.x, low.z}, {high.x, low.z}, {high.x, high.z}, {low.x, high.z}};
}

void add_block(Scenery& s, Vec2 low, Vec2 high, float bottom, float top, uint32_t colour, SceneryUse use) {
    const std::vector<Vec2> outline = box_outline(low, high);
    add_courses(s, outline, bottom, top, colour, use);
    add_lid(s, outline, top, shaded(colour, 1.04f), use);
}

void add_lid(Scenery& s, std::span<const Vec2> outline, float height, uint32_t colour, SceneryUse use) {
    const auto first = static_cast<uint32_t>(s.vertices.size());
    for (const Vec2 corner : outline)
        s.vertices.push_back({at_height(corner, height), {0, 1, 0}, {}, colour});
    for (uint32_t i = 1; i + 1 < outline.size(); ++i) {
        for (const uint32_t k : {0u, i + 1, i}) s.indices.push_back(first + k);
        s.pictures.push_back(~0u);
        s.uses.push_back(use);
    }
}

}  // namespace flaneur
