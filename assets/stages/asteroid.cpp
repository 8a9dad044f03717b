#include "assets/stages/asteroid.h"

#include "sim/base/math.h"

namespace flaneur {

namespace {

constexpr int k_fine = 5;             // how often an octahedron is divided
constexpr Vec3 k_boulder{17, -7, 9};  // its middle, metres
constexpr float k_boulder_radius = 5;

RockMesh ball_of(const RockMesh& ball, const Sphere& sphere) {
    RockMesh out = ball;
    for (Vec3& v : out.vertices) v = sphere.centre + v * sphere.radius;
    return out;
}

RockMesh ball_of(const RockMesh& ball, const Capsule& capsule) {
    const Quat turn = rotation_between({0, 1, 0}, normalize_or(capsule.b - capsule.a, {0, 1, 0}));
    RockMesh out = ball;
    for (Vec3& v : out.vertices) v = (v.y >= 0 ? capsule.b : capsule.a) + rotate(turn, v) * capsule.radius;
    return out;
}

}  // namespace

void draw_round(Scenery& scenery, const Compound& c, uint64_t seed) {
    const RockMesh ball = make_ball(k_fine);
    for (const Sphere& sphere : c.spheres) draw_rock(scenery, ball_of(ball, sphere), seed);
    for (const Capsule& capsule : c.capsules) draw_rock(scenery, ball_of(ball, capsule), seed);
}

SmallWorld make_asteroid(uint64_t seed, int walkers) {
    SmallWorld a{{}, {}, make_stage("asteroid", walkers)};
    Compound& c = a.compound;
    c.spheres = {{{0, 0, 0}, 9}, {{8.5f, 4, 2}, 6}, {{-8, -3, 4}, 6.5f}, {{2, -8, -5}, 5.5f}};
    c.capsules = {{{-1, 6, 0}, {2, 15, -1.5f}, 2.4f}, {{-10, -2, 3}, {-19, 4, -2}, 2.8f}};
    draw_round(a.stage.scenery, c, seed);
    const RockMesh boulder = make_boulder(k_boulder, k_boulder_radius, seed);
    draw_rock(a.stage.scenery, boulder, seed);
    add_rock(c, boulder);
    index_compound(c);
    return a;
}

SmallWorld make_rock(const RockMesh& solid, uint64_t seed, int walkers) {
    SmallWorld a{{}, {}, make_stage("rock", walkers)};
    add_rock(a.compound, solid);
    draw_rock(a.stage.scenery, solid, seed);
    index_compound(a.compound);
    return a;
}

}  // namespace flaneur
