#include "assets/stages/platform.h"

#include <algorithm>
#include <array>

#include "assets/stages/solids.h"
#include "sim/base/math.h"
#include "sim/base/planar.h"
#include "sim/ways/platform.h"

namespace flaneur {

namespace {

constexpr float k_above_water = 0.55f;    // metres
constexpr float k_below = 1.5f;           // metres that its sides reach below the water
constexpr float k_shore = 300;            // metres of water to each side
constexpr uint32_t k_stone = 0xffa9b0b4;  // sRGB, R in the lowest byte

void add_ground(City& city, std::span<const Vec3> corners, std::span<const uint32_t> indices, Surface kind) {
    Ground& g = city.ground;
    const auto first = static_cast<uint32_t>(g.vertices.size());
    g.vertices.insert(g.vertices.end(), corners.begin(), corners.end());
    for (const uint32_t k : indices) g.indices.push_back(first + k);
    g.kinds.insert(g.kinds.end(), indices.size() / 3, kind);
    city.ground_axes.insert(city.ground_axes.end(), indices.size() / 3, {1, 0});
}

}  // namespace

Result<City> build_platform(std::span<const Vec2> corners) {
    if (const Result<Platform> platform = make_platform(corners); !platform) return platform.error();
    Vec2 middle{};
    for (const Vec2 corner : corners) middle += corner / static_cast<float>(corners.size());
    City city;
    city.ground.name = "platform";
    std::vector<Vec2> outline(corners.begin(), corners.end());
    if (signed_area_of(outline) < 0) std::reverse(outline.begin(), outline.end());
    std::vector<Vec3> rim{at_height(middle, 0)};
    std::vector<uint32_t> fan;
    const auto n = static_cast<uint32_t>(outline.size());
    for (uint32_t i = 0; i < n; ++i) {
        rim.push_back(at_height(outline[i], 0));
        for (const uint32_t k : {0u, 1 + (i + 1) % n, 1 + i}) fan.push_back(k);
    }
    add_courses(city.scenery, outline, -k_above_water - k_below, 0, k_stone, SceneryUse::backdrop);
    add_ground(city, rim, fan, Surface::plaza);
    const float far = k_shore;
    const Vec3 water[] = {{-far, -k_above_water, -far},
                          {-far, -k_above_water, far},
                          {far, -k_above_water, far},
                          {far, -k_above_water, -far}};
    add_ground(city, water, std::array<uint32_t, 6>{0, 1, 2, 0, 2, 3}, Surface::water);
    index_city(city);
    return city;
}

}  // namespace flaneur
