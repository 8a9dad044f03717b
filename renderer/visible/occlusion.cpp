#include "renderer/visible/occlusion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace flaneur {
namespace {

constexpr float k_least_ahead = 0.1f;  // metres: walls nearer to the eye's plane are cut off there
constexpr float k_farthest = 500;      // metres: walls farther away hide little
constexpr float k_margin = 1.002f;  // by what factor a wall is nearer than what it hides: it hides not itself

// A corner on the map: cells from the left and upper edge, and 1 / metres ahead, which is linear over the
// picture.
struct Spot {
    float x, y, nearness;
};

Spot spot_of(const OcclusionMap& map, glm::vec4 clip) {
    const float inverse = 1 / clip.w;
    return {(clip.x * inverse * 0.5f + 0.5f) * static_cast<float>(map.width),
            (clip.y * inverse * 0.5f + 0.5f) * static_cast<float>(map.height), inverse};
}

struct Polygon {
    std::array<Spot, 5> spots;
    size_t count = 0;
};

// A wall on the map, what is not ahead of the eye cut off.
Polygon on_map(const OcclusionMap& map, const View& view, const Wall& wall) {
    std::array<glm::vec4, 4> clip;
    for (size_t k = 0; k < 4; ++k) clip[k] = view.clip_from_world * glm::vec4(wall.corners[k], 1);
    Polygon out;
    for (size_t k = 0; k < 4; ++k) {
        const glm::vec4 &a = clip[k], &b = clip[(k + 1) % 4];
        const float from_a = a.w - k_least_ahead, from_b = b.w - k_least_ahead;
        if (from_a >= 0) out.spots[out.count++] = spot_of(map, a);
        if ((from_a >= 0) != (from_b >= 0))
            out.spots[out.count++] = spot_of(map, a + (b - a) * (from_a / (from_a - from_b)));
    }
    return out;
}

// Where a row's centre line crosses an edge. Its ends are taken from the top, so that two walls with a common
// edge agree.
float crossing(Spot a, Spot b, float y) {
    if (b.y < a.y) std::swap(a, b);
    return a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y));
}

// The first cell whose centre is not before x.
int first_cell(float x, int end) {
    return static_cast<int>(std::ceil(std::clamp(x - 0.5f, 0.0f, static_cast<float>(end))));
}

// Cells whose centres the polygon holds.
void fill(const Polygon& polygon, OcclusionMap& map) {
    const std::span<const Spot> spots(polygon.spots.data(), polygon.count);
    // nearness = at + along . (x, y), from the two edges that span the largest triangle at the first corner.
    const Spot& o = spots[0];
    float area = 0;
    glm::vec2 along(0);
    for (size_t k = 1; k + 1 < spots.size(); ++k) {
        const Spot &a = spots[k], &b = spots[k + 1];
        const float twice = (a.x - o.x) * (b.y - o.y) - (b.x - o.x) * (a.y - o.y);
        if (std::fabs(twice) <= std::fabs(area)) continue;
        area = twice;
        const float da = a.nearness - o.nearness, db = b.nearness - o.nearness;
        along = glm::vec2(da * (b.y - o.y) - db * (a.y - o.y), db * (a.x - o.x) - da * (b.x - o.x)) / twice;
    }
    if (std::fabs(area) < 1e-3f) return;
    float top = o.y, bottom = o.y;
    for (const Spot& s : spots) top = std::min(top, s.y), bottom = std::max(bottom, s.y);
    const int end = first_cell(bottom, map.height);
    for (int row = first_cell(top, map.height); row < end; ++row) {
        const float y = static_cast<float>(row) + 0.5f;
        float left = static_cast<float>(map.width), right = 0;
        for (size_t k = 0; k < spots.size(); ++k) {
            const Spot &a = spots[k], &b = spots[(k + 1) % spots.size()];
            if ((a.y <= y) == (b.y <= y)) continue;
            const float x = crossing(a, b, y);
            left = std::min(left, x), right = std::max(right, x);
        }
        float* cells = &map.nearness[static_cast<size_t>(row * map.width)];
        const int last = first_cell(right, map.width);
        const float begin = o.nearness + along.y * (y - o.y) - along.x * o.x;
        for (int x = first_cell(left, map.width); x < last; ++x)
            cells[x] = std::max(cells[x], begin + along.x * (static_cast<float>(x) + 0.5f));
    }
}

// Each cell takes the least of itself and those about it: what is hidden at a cell's centre need not be
// hidden at its edge.
void shrink(OcclusionMap& map) {
    const int width = map.width, height = map.height;
    map.scratch.resize(map.nearness.size());
    for (int y = 0; y < height; ++y) {
        const float* in = &map.nearness[static_cast<size_t>(y * width)];
        float* out = &map.scratch[static_cast<size_t>(y * width)];
        for (int x = 1; x + 1 < width; ++x) out[x] = std::min(std::min(in[x - 1], in[x]), in[x + 1]);
        out[0] = std::min(in[0], in[std::min(1, width - 1)]);
        out[width - 1] = std::min(in[width - 1], in[std::max(width - 2, 0)]);
    }
    for (int y = 0; y < height; ++y) {
        auto row = [&](int number) {
            return &map.scratch[static_cast<size_t>(std::clamp(number, 0, height - 1) * width)];
        };
        const float *above = row(y - 1), *here = row(y), *below = row(y + 1);
        float* out = &map.nearness[static_cast<size_t>(y * width)];
        for (int x = 0; x < width; ++x) out[x] = std::min(std::min(above[x], here[x]), below[x]);
    }
}

bool faces(const Wall& wall, glm::vec3 eye) {
    const glm::vec3 normal = glm::cross(wall.corners[1] - wall.corners[0], wall.corners[2] - wall.corners[0]);
    return glm::dot(normal, eye - wall.corners[0]) > 0;
}

}  // namespace

void draw_walls(std::span<const WallGroup> groups, std::span<const Wall> walls, const View& view,
                OcclusionMap& map) {
    map.width = k_occlusion_width;
    const float shape = glm::length(view.down) / glm::length(view.right);
    map.height =
        static_cast<int>(std::clamp(std::round(shape * k_occlusion_width), 1.0f, 4.0f * k_occlusion_width));
    map.nearness.assign(static_cast<size_t>(map.width * map.height), 0);
    for (const WallGroup& group : groups) {
        const glm::vec3 nearest = glm::clamp(view.eye, group.low, group.high) - view.eye;
        if (glm::length(nearest) > k_farthest || !sees_box(view, group.low, group.high)) continue;
        for (const Wall& wall : walls.subspan(group.first, group.count)) {
            if (!faces(wall, view.eye)) continue;
            const Polygon polygon = on_map(map, view, wall);
            if (polygon.count >= 3) fill(polygon, map);
        }
    }
    shrink(map);
}

bool is_hidden(const OcclusionMap& map, const View& view, glm::vec3 low, glm::vec3 high) {
    if (map.nearness.empty()) return false;
    float nearness = 0;
    glm::vec2 least(static_cast<float>(map.width), static_cast<float>(map.height)), most(0);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 at(corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y,
                           corner & 4 ? high.z : low.z);
        const glm::vec4 clip = view.clip_from_world * glm::vec4(at, 1);
        if (!(clip.w > k_least_ahead)) return false;
        const Spot spot = spot_of(map, clip);
        nearness = std::max(nearness, spot.nearness);
        least = glm::min(least, glm::vec2(spot.x, spot.y));
        most = glm::max(most, glm::vec2(spot.x, spot.y));
    }
    const int left = static_cast<int>(std::max(least.x, 0.0f)),
              top = static_cast<int>(std::max(least.y, 0.0f));
    const int right = static_cast<int>(std::min(most.x, static_cast<float>(map.width - 1)));
    const int bottom = static_cast<int>(std::min(most.y, static_cast<float>(map.height - 1)));
    for (int y = top; y <= bottom; ++y) {
        const float* row = &map.nearness[static_cast<size_t>(y * map.width)];
        for (int x = left; x <= right; ++x)
            if (!(row[x] > nearness * k_margin)) return false;
    }
    return left <= right && top <= bottom;
}

}  // namespace flaneur
