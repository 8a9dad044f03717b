#include "assets/stages/asteroid.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "assets/colour.h"
#include "sim/base/rng.h"

namespace flaneur {

namespace {

constexpr int k_fine = 5;             // how often an octahedron is divided
constexpr float k_room = 4;           // of the stage, square metres a walker
constexpr Vec3 k_boulder{17, -7, 9};  // its middle, metres
constexpr float k_boulder_radius = 5, k_bumps = 0.16f;

struct Ball {
    std::vector<Vec3> vertices;  // unit
    std::vector<uint32_t> indices;
};

// An octahedron each of whose triangles becomes four, so many times.
Ball make_ball(int times) {
    Ball ball;
    ball.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    ball.indices = {4, 0, 2, 0, 5, 2, 5, 1, 2, 1, 4, 2, 0, 4, 3, 5, 0, 3, 1, 5, 3, 4, 1, 3};
    for (int n = 0; n < times; ++n) {
        std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
        auto middle = [&](uint32_t a, uint32_t b) {
            auto [slot, is_new] = middles.insert(
                {{std::min(a, b), std::max(a, b)}, static_cast<uint32_t>(ball.vertices.size())});
            if (is_new) ball.vertices.push_back(normalize_or(ball.vertices[a] + ball.vertices[b], {0, 1, 0}));
            return slot->second;
        };
        std::vector<uint32_t> finer;
        for (size_t i = 0; i < ball.indices.size(); i += 3) {
            uint32_t a = ball.indices[i], b = ball.indices[i + 1], c = ball.indices[i + 2];
            uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            for (uint32_t v : {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca}) finer.push_back(v);
        }
        ball.indices = std::move(finer);
    }
    return ball;
}

// Between -1 and 1, smooth, unlike itself beyond a metre.
float noise(Vec3 p, uint64_t seed) {
    Vec3 low{std::floor(p.x), std::floor(p.y), std::floor(p.z)}, in = p - low;
    auto at = [&](float x, float y, float z) {
        auto bits = [](float v) { return static_cast<uint32_t>(static_cast<int32_t>(v)); };
        uint64_t place = mix(mix(mix(seed ^ bits(x)) ^ bits(y)) ^ bits(z));
        return 2 * random_unit({place, 0, 0, Purpose::city}) - 1;
    };
    float u = smoothstep(0, 1, in.x), v = smoothstep(0, 1, in.y), w = smoothstep(0, 1, in.z);
    auto along = [&](float y, float z) { return lerp(at(low.x, y, z), at(low.x + 1, y, z), u); };
    auto across = [&](float z) { return lerp(along(low.y, z), along(low.y + 1, z), v); };
    return lerp(across(low.z), across(low.z + 1), w);
}

uint32_t mixed(uint32_t a, uint32_t b, float t) {
    uint32_t out = 0xff000000u;
    for (int shift : {0, 8, 16}) {
        float channel =
            lerp(static_cast<float>(a >> shift & 0xffu), static_cast<float>(b >> shift & 0xffu), t);
        out |= static_cast<uint32_t>(channel) << shift;
    }
    return out;
}

// Rock: lighter and darker patches, and grain.
uint32_t rock(Vec3 p, uint64_t seed) {
    float patch = noise(p * 0.35f, seed) + 0.5f * noise(p * 0.9f, seed + 1);
    return shaded(mixed(rgb(0x9a8f80), rgb(0x6a635c), clamp(0.5f + 0.6f * patch, 0, 1)),
                  1 + 0.10f * noise(p * 3.1f, seed + 2));
}

// Adds a ball's triangles; place(unit vector) says where they are.
template <class Place>
void draw(Scenery& s, const Ball& ball, uint64_t seed, Place place) {
    auto first = static_cast<uint32_t>(s.vertices.size());
    std::vector<Vec3> normals(ball.vertices.size());
    for (Vec3 v : ball.vertices) s.vertices.push_back({place(v), {}, {}, ~0u});
    for (size_t i = 0; i < ball.indices.size(); i += 3) {
        const uint32_t* t = &ball.indices[i];
        Vec3 a = s.vertices[first + t[0]].position, b = s.vertices[first + t[1]].position,
             c = s.vertices[first + t[2]].position;
        for (size_t k = 0; k < 3; ++k) {
            normals[t[k]] += cross(b - a, c - a);
            s.indices.push_back(first + t[k]);
        }
        s.pictures.push_back(~0u);
        s.uses.push_back(SceneryUse::ground);
    }
    for (size_t v = 0; v < normals.size(); ++v) {
        Scenery::Vertex& vertex = s.vertices[first + v];
        float size = length(normals[v]);
        vertex.normal = size > 0 ? normals[v] / size : ball.vertices[v];
        vertex.colour = rock(vertex.position, seed);
    }
}

City make_stage(int walkers) {
    City city;
    city.ground.name = "asteroid";
    float half = std::sqrt(static_cast<float>(walkers) * k_room) / 2 + 10;
    city.ground.vertices = {{-half, 0, -half}, {-half, 0, half}, {half, 0, half}, {half, 0, -half}};
    city.ground.indices = {0, 1, 2, 0, 2, 3};
    city.ground.kinds.assign(2, Surface::plaza);
    city.ground_axes.assign(2, {1, 0});
    city.scenery.holds_ground = true;
    index_city(city);
    return city;
}

}  // namespace

Asteroid make_asteroid(uint64_t seed, int walkers) {
    Asteroid a{{}, make_stage(walkers)};
    Compound& c = a.compound;
    c.spheres = {{{0, 0, 0}, 9}, {{8.5f, 4, 2}, 6}, {{-8, -3, 4}, 6.5f}, {{2, -8, -5}, 5.5f}};
    c.capsules = {{{-1, 6, 0}, {2, 15, -1.5f}, 2.4f}, {{-10, -2, 3}, {-19, 4, -2}, 2.8f}};
    Ball ball = make_ball(k_fine);
    Scenery& s = a.stage.scenery;
    for (const Sphere& sphere : c.spheres)
        draw(s, ball, seed, [&](Vec3 v) { return sphere.centre + v * sphere.radius; });
    for (const Capsule& capsule : c.capsules) {
        Quat turn = rotation_between({0, 1, 0}, normalize_or(capsule.b - capsule.a, {0, 1, 0}));
        draw(s, ball, seed,
             [&](Vec3 v) { return (v.y >= 0 ? capsule.b : capsule.a) + rotate(turn, v) * capsule.radius; });
    }
    auto first = s.vertices.size();
    draw(s, ball, seed, [&](Vec3 v) {
        float bump = noise(v * 1.3f, seed + 3) + 0.4f * noise(v * 3, seed + 4);
        return k_boulder + v * (k_boulder_radius * (1 + k_bumps * bump));
    });
    for (size_t v = first; v < s.vertices.size(); ++v) c.vertices.push_back(s.vertices[v].position);
    c.indices = ball.indices;
    index_compound(c);
    return a;
}

}  // namespace flaneur
