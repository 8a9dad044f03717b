#include "sim/lamps/crossings.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace flaneur {

namespace {

constexpr float k_square = 12;           // metres
constexpr float k_of_one_junction = 26;  // metres between two of its crossings
constexpr float k_same_axis = 0.7071f;
constexpr float k_post_reach = 6;     // metres
constexpr float k_same_level = 2.5f;  // metres

uint32_t first_of(std::vector<uint32_t>& joined, uint32_t i) {
    while (joined[i] != i) i = joined[i] = joined[joined[i]];
    return i;
}

struct Bounds {
    Vec2 low, high;
};
Bounds bounds_of(const Crossing& c) {
    const Vec2 over = c.across * c.half_length, side = c.along * c.half_width, at = on_ground(c.centre);
    const Vec2 reach{std::fabs(over.x) + std::fabs(side.x) + k_kerb_reach,
                     std::fabs(over.z) + std::fabs(side.z) + k_kerb_reach};
    return {at - reach, at + reach};
}

}  // namespace

OnCrossing on_crossing(const Crossing& c, Vec2 place) {
    const Vec2 from = place - on_ground(c.centre);
    const float area = cross(c.across, c.along);
    return {cross(from, c.along) / area, cross(c.across, from) / area};
}

Vec2 behind_kerb(const Crossing& c, uint32_t kerb, float back, float aside) {
    const Vec2 over = way_over(c, kerb), square{-c.along.z, c.along.x};
    const Vec2 out = dot(square, over) > 0 ? -square : square;
    return on_ground(c.centre) - over * c.half_length + out * back + c.along * aside;
}

void set_lamps(Crossings& crossings, std::span<const uint8_t> ruled, uint64_t seed) {
    std::vector<Crossing>& all = crossings.all;
    std::vector<uint32_t> joined(all.size());
    std::iota(joined.begin(), joined.end(), 0u);
    for (uint32_t a = 0; a < all.size(); ++a)
        for (uint32_t b = a + 1; ruled[a] != 0 && b < all.size(); ++b)
            if (ruled[b] != 0 && length(all[a].centre - all[b].centre) < k_of_one_junction) {
                const uint32_t p = first_of(joined, a), q = first_of(joined, b);
                joined[std::max(p, q)] = std::min(p, q);
            }
    for (uint32_t first = 0; first < all.size(); ++first) {
        if (ruled[first] == 0 || joined[first] != first) continue;
        // Of each direction, the widest carriageway.
        float breadths[2] = {0, 0};
        auto direction_of = [&](const Crossing& c) {
            return std::fabs(dot(c.along, all[first].along)) < k_same_axis ? 1u : 0u;
        };
        auto is_of_it = [&](uint32_t i) { return ruled[i] != 0 && first_of(joined, i) == first; };
        for (uint32_t i = first; i < all.size(); ++i)
            if (is_of_it(i)) {
                float& breadth = breadths[direction_of(all[i])];
                breadth = std::max(breadth, 2 * all[i].half_length);
            }
        const auto plans = plan_junction({breadths, breadths[1] > 0 ? size_t{2} : size_t{1}},
                                         {seed, first, 0, Purpose::lamp});
        const auto at = static_cast<uint32_t>(crossings.plans.size());
        crossings.plans.insert(crossings.plans.end(), plans.begin(), plans.end());
        for (uint32_t i = first; i < all.size(); ++i)
            if (is_of_it(i)) all[i].plan = at + direction_of(all[i]);
    }
}

void take_lamps(Crossings& crossings) {
    crossings.plans.clear();
    for (Crossing& c : crossings.all) c.plan = k_no_lamp;
}

uint32_t crossing_of_post(const Crossings& crossings, Vec3 place) {
    uint32_t nearest = k_no_lamp;
    float least = k_post_reach;
    for (uint32_t i = 0; i < crossings.all.size(); ++i) {
        const Crossing& c = crossings.all[i];
        if (!is_ruled(c) || std::fabs(c.centre.y - place.y) > k_same_level) continue;
        for (const float way : {-1.0f, 1.0f}) {
            const Vec2 end = on_ground(c.centre) + c.across * (c.half_length * way);
            const float far = length(end - on_ground(place));
            if (far < least) least = far, nearest = i;
        }
    }
    return nearest;
}

CrossingGrid make_crossing_grid(const Crossings& crossings) {
    CrossingGrid grid;
    Vec2 high;
    bool is_any = false;
    for (const Crossing& c : crossings.all) {
        if (!is_ruled(c)) continue;
        const Bounds b = bounds_of(c);
        grid.low = is_any ? Vec2{std::min(grid.low.x, b.low.x), std::min(grid.low.z, b.low.z)} : b.low;
        high = is_any ? Vec2{std::max(high.x, b.high.x), std::max(high.z, b.high.z)} : b.high;
        is_any = true;
    }
    if (!is_any) return grid;
    grid.width = static_cast<int>((high.x - grid.low.x) / k_square) + 1;
    grid.height = static_cast<int>((high.z - grid.low.z) / k_square) + 1;
    std::vector<std::vector<uint32_t>> squares(static_cast<size_t>(grid.width * grid.height));
    for (uint32_t i = 0; i < crossings.all.size(); ++i) {
        if (!is_ruled(crossings.all[i])) continue;
        const Bounds b = bounds_of(crossings.all[i]);
        auto square = [](float from, float to) { return static_cast<int>((to - from) / k_square); };
        for (int z = square(grid.low.z, b.low.z); z <= square(grid.low.z, b.high.z); ++z)
            for (int x = square(grid.low.x, b.low.x); x <= square(grid.low.x, b.high.x); ++x)
                squares[static_cast<size_t>(z * grid.width + x)].push_back(i);
    }
    grid.first.push_back(0);
    for (const auto& square : squares) {
        grid.items.insert(grid.items.end(), square.begin(), square.end());
        grid.first.push_back(static_cast<uint32_t>(grid.items.size()));
    }
    return grid;
}

std::span<const uint32_t> crossings_near(const CrossingGrid& grid, Vec2 place) {
    const Vec2 at = (place - grid.low) / k_square;
    if (!(at.x >= 0 && at.z >= 0)) return {};
    const auto x = static_cast<int>(at.x), z = static_cast<int>(at.z);
    if (x >= grid.width || z >= grid.height) return {};
    const auto square = static_cast<size_t>(z * grid.width + x);
    return {grid.items.data() + grid.first[square], grid.first[square + 1] - grid.first[square]};
}

}  // namespace flaneur
