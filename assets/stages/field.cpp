#include "assets/stages/field.h"

#include <array>
#include <cmath>

#include "assets/colour.h"
#include "assets/stages/solids.h"
#include "sim/base/math.h"
#include "sim/base/rng.h"

namespace flaneur {

namespace {

constexpr float k_thick = 0.5f, k_wall = 1.6f;  // metres, of the walls
constexpr int k_sides = 32;                     // of a pillar
constexpr int k_rings = 26, k_spokes = 72;      // of the hills around
constexpr float k_far = 420;                    // metres that they reach
constexpr int k_trees = 90;
constexpr uint32_t k_stone = rgb(0xb4aea2), k_sandstone = rgb(0xc9ae86), k_slate = rgb(0x8b9096),
                   k_meadow = rgb(0x748c50), k_wood = rgb(0x5c7a43);

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

// The land around: level at the walls, then hills.
float land(Vec2 p, float turn) {
    const float away = length(p) - 1.45f * k_field_half, up = smoothstep(0, 0.7f * k_far, away);
    auto roll = [&](float x, float from) { return sin_cos(x * 0.014f + from).sine; };
    return -0.02f + up * (20 + 9 * roll(p.x + 0.6f * p.z, turn) + 7 * roll(1.7f * p.z - p.x, 2 * turn));
}

void add_land(Scenery& s, RandomKey key) {
    const float turn = 2 * k_pi * random_unit(key);
    const auto first = static_cast<uint32_t>(s.vertices.size());
    for (int ring = 0; ring <= k_rings; ++ring)
        for (int spoke = 0; spoke < k_spokes; ++spoke) {
            const SinCos at = sin_cos(2 * k_pi * static_cast<float>(spoke) / k_spokes);
            const float share = static_cast<float>(ring) / k_rings;
            // From within the walls, where the field's own ground lies over it.
            const float far = 0.9f * k_field_half + share * share * k_far;
            const Vec2 p = Vec2{at.cosine, at.sine} * far;
            constexpr float k_step = 2;
            const float height = land(p, turn);
            const Vec3 normal{height - land(p + Vec2{k_step, 0}, turn), k_step,
                              height - land(p + Vec2{0, k_step}, turn)};
            const float wood =
                smoothstep(0.25f, 0.7f, 0.5f + 0.5f * sin_cos(p.x * 0.031f - p.z * 0.023f + turn).sine);
            const uint32_t colour = wood * share > 0.3f ? k_wood : k_meadow;
            s.vertices.push_back(
                {at_height(p, height - (ring == 0 ? 0.3f : 0)), normalize_or(normal, {0, 1, 0}), {}, colour});
        }
    for (uint32_t ring = 0; ring < k_rings; ++ring)
        for (uint32_t spoke = 0; spoke < k_spokes; ++spoke) {
            const uint32_t next = (spoke + 1) % k_spokes, a = first + ring * k_spokes + spoke,
                           b = first + ring * k_spokes + next, c = a + k_spokes, d = b + k_spokes;
            for (const uint32_t k : {a, b, c, b, d, c}) s.indices.push_back(k);
            s.pictures.insert(s.pictures.end(), 2, ~0u);
            s.uses.insert(s.uses.end(), 2, SceneryUse::backdrop);
        }
}

void add_trees(City& city, RandomKey key) {
    const float turn = 2 * k_pi * random_unit(key);
    for (uint32_t k = 0; k < k_trees; ++k) {
        const SinCos at = sin_cos(2 * k_pi * random_unit(key, 10 + 3 * k));
        const float share = random_unit(key, 11 + 3 * k);
        const Vec2 p = Vec2{at.cosine, at.sine} * lerp(1.7f * k_field_half, 150, share * share);
        const float size = random_unit(key, 12 + 3 * k);
        city.props.push_back({.kind = PropKind::tree,
                              .position = at_height(p, land(p, turn)),
                              .height = lerp(5, 12, size),
                              .radius = lerp(1.8f, 4, size),
                              .seed = k});
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
    add_land(city.scenery, key);
    index_city(city);
    add_trees(city, key);
    list_obstacles(city);
    return city;
}

}  // namespace flaneur
