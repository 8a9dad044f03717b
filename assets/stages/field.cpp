#include "assets/stages/field.h"

#include <array>
#include <cmath>

#include "assets/colour.h"
#include "assets/stages/meadow.h"
#include "assets/stages/solids.h"
#include "sim/base/math.h"
#include "sim/base/rng.h"

namespace flaneur {

namespace {

constexpr float k_thick = 0.5f, k_wall = 1.6f;  // metres, of the walls
constexpr int k_sides = 32;                     // of a pillar
constexpr uint32_t k_stone = rgb(0xb4aea2), k_sandstone = rgb(0xc9ae86), k_slate = rgb(0x8b9096);

struct Pillar {
    Vec2 middle;
    float radius, height;  // metres
    uint32_t colour;
};
constexpr Pillar k_pillars[] = {{{-8.5f, -5}, 1.5f, 3.2f, k_stone},
                                {{7, -9.5f}, 1, 4.2f, k_sandstone},
                                {{-3, 9.5f}, 2.1f, 2.3f, k_slate}};
constexpr Vec2 k_block{8.5f, 6.5f};
constexpr float k_block_half = 1.5f, k_block_turn = 0.4f;

std::vector<Vec2> square_at(Vec2 middle, float half, float turn) {
    const SinCos to = sin_cos(turn);
    std::vector<Vec2> outline;
    for (const Vec2 corner : {Vec2{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
        outline.push_back(middle + Vec2{corner.x * to.cosine - corner.z * to.sine,
                                        corner.x * to.sine + corner.z * to.cosine} *
                                       half);
    return outline;
}

std::vector<Vec2> circle_at(Vec2 middle, float radius) {
    std::vector<Vec2> outline;
    for (int k = 0; k < k_sides; ++k) {
        const SinCos at = sin_cos(2 * k_pi * static_cast<float>(k) / k_sides);
        outline.push_back(middle + Vec2{at.cosine, at.sine} * radius);
    }
    return outline;
}

void add_solid(Scenery& s, const std::vector<Vec2>& outline, float height, uint32_t colour,
               bool round = false) {
    add_courses(s, outline, 0, height, colour, SceneryUse::solid, round);
    add_lid(s, outline, height, shaded(colour, 1.04f), SceneryUse::solid);
}

void add_walls(Scenery& s) {
    constexpr float in = k_field_half, out = k_field_half + k_thick;
    for (const float side : {-1.0f, 1.0f}) {
        const float low = side < 0 ? -out : in, high = side < 0 ? -in : out;
        add_solid(s, {{low, -out}, {high, -out}, {high, out}, {low, out}}, k_wall, k_stone);
        add_solid(s, {{-in, low}, {in, low}, {in, high}, {-in, high}}, k_wall, k_stone);
    }
}

}  // namespace

City build_field(uint64_t seed) {
    const RandomKey key{seed, 0, 0, Purpose::city};
    City city;
    city.ground.name = "field";
    constexpr float half = k_field_half;
    city.ground.vertices = {{-half, 0, -half}, {-half, 0, half}, {half, 0, half}, {half, 0, -half}};
    city.ground.indices = {0, 1, 2, 0, 2, 3};
    city.ground.kinds.assign(2, Surface::grass);
    city.ground_axes.assign(2, {1, 0});
    add_walls(city.scenery);
    for (const Pillar& pillar : k_pillars)
        add_solid(city.scenery, circle_at(pillar.middle, pillar.radius), pillar.height, pillar.colour, true);
    add_solid(city.scenery, square_at(k_block, k_block_half, k_block_turn), 2 * k_block_half, k_sandstone);
    const Meadow meadow{
        .level = 1.45f * half, .from = 0.9f * half, .below = 0.02f, .turn = 2 * k_pi * random_unit(key)};
    add_land(city.scenery, meadow);
    index_city(city);
    add_trees(city, meadow, 1.7f * half, key);
    list_obstacles(city);
    return city;
}

}  // namespace flaneur
