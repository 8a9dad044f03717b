#include "assets/stages/planets.h"

#include <cmath>
#include <span>

#include "assets/stages/asteroid.h"
#include "sim/base/math.h"

namespace flaneur {

namespace {

constexpr float k_gap = 4.6f;  // metres from one ground to the next
constexpr int k_row = 9, k_ring_points = 36;
constexpr int k_around = 128, k_across = 56;

Vec3 unit(Vec3 v) { return normalize_or(v, {0, 1, 0}); }

void add_ball(SmallWorld& w, Vec3 middle, float radius) {
    w.compound.spheres.push_back({middle, radius});
    const Vec3 ground[] = {middle + Vec3{radius, 0, 0}};
    add_body(w.gravity, std::span(&middle, 1), ground, k_planet_pull);
}

void add_capsule(SmallWorld& w, const Capsule& c) {
    w.compound.capsules.push_back(c);
    const Vec3 along = unit(c.b - c.a);
    const Vec3 aside = unit(cross(along, {0.3f, 0.9f, -0.2f}));
    std::vector<Vec3> points, ground;
    for (int i = 0; i < k_row; ++i) {
        points.push_back(lerp(c.a, c.b, static_cast<float>(i) / (k_row - 1)));
        for (const Vec3 out : {aside, -aside, cross(along, aside), -cross(along, aside)})
            ground.push_back(points.back() + out * c.radius);
    }
    add_body(w.gravity, points, ground, k_planet_pull);
}

void add_torus(SmallWorld& w, float ring, float tube, Vec3 axis, Vec3 middle, uint64_t seed) {
    const RockMesh torus = placed(make_torus(ring, tube, k_around, k_across), axis, middle);
    add_rock(w.compound, torus);
    draw_rock(w.stage.scenery, torus, seed);
    const RockMesh line = placed(make_torus(ring, 0, k_ring_points, 3), axis, middle);
    std::vector<Vec3> points;
    for (size_t v = 0; v < line.vertices.size(); v += 3) points.push_back(line.vertices[v]);
    add_body(w.gravity, points, torus.vertices, k_planet_pull);
}

void add_boulder(SmallWorld& w, Vec3 middle, float radius, uint64_t seed) {
    const RockMesh boulder = make_boulder(middle, radius, seed);
    add_rock(w.compound, boulder);
    draw_rock(w.stage.scenery, boulder, seed);
    add_body(w.gravity, std::span(&middle, 1), boulder.vertices, k_planet_pull);
}

}  // namespace

SmallWorld make_planets(uint64_t seed, int walkers) {
    SmallWorld w{{}, {}, make_stage("planets", walkers)};
    constexpr float k_home = 8, k_second = 5, k_moon = 3, k_bar = 2.8f, k_stone = 5;
    constexpr float k_ring = 7, k_tube = 2.6f;
    add_ball(w, {}, k_home);
    const Vec3 second = unit({0.75f, 0.6f, 0.28f}) * (k_home + k_gap + k_second);
    add_ball(w, second, k_second);
    add_ball(w, second + unit({0.15f, 0.9f, -0.4f}) * (k_second + k_gap + k_moon), k_moon);
    const Vec3 over = unit({-0.85f, 0.5f, 0.15f}), bar = over * (k_home + k_gap + k_bar);
    const Vec3 along = unit(cross(over, {0.2f, 0.1f, 1})) * 5;
    add_capsule(w, {bar - along, bar + along, k_bar});
    // Its tube is everywhere as far from the home as the others are.
    const Vec3 below = unit({0.1f, -0.9f, -0.42f});
    const float slant = k_home + k_gap + k_tube;
    add_torus(w, k_ring, k_tube, below, below * std::sqrt(slant * slant - k_ring * k_ring), seed);
    add_boulder(w, unit({-0.35f, -0.25f, 0.9f}) * (k_home + k_gap + 1.12f * k_stone), k_stone, seed);
    draw_round(w.stage.scenery, w.compound, seed);
    index_compound(w.compound);
    return w;
}

}  // namespace flaneur
