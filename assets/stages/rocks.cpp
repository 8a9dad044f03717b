#include "assets/stages/rocks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "assets/colour.h"
#include "sim/base/math.h"
#include "sim/base/rng.h"

namespace flaneur {

namespace {

constexpr float k_room = 4;       // of the stage, square metres a walker
constexpr float k_bumps = 0.16f;  // of a boulder's radius
constexpr int k_fine = 5;         // how often a boulder's octahedron is divided

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
    float patch = rock_noise(p * 0.35f, seed) + 0.5f * rock_noise(p * 0.9f, seed + 1);
    return shaded(mixed(rgb(0x9a8f80), rgb(0x6a635c), clamp(0.5f + 0.6f * patch, 0, 1)),
                  1 + 0.10f * rock_noise(p * 3.1f, seed + 2));
}

}  // namespace

RockMesh make_ball(int times) {
    RockMesh ball;
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

RockMesh make_torus(float ring, float tube, int around, int across) {
    RockMesh torus;
    for (int i = 0; i < around; ++i)
        for (int j = 0; j < across; ++j) {
            const SinCos along = sin_cos(2 * k_pi * static_cast<float>(i) / static_cast<float>(around)),
                         about = sin_cos(2 * k_pi * static_cast<float>(j) / static_cast<float>(across));
            const float out = ring + tube * about.cosine;
            torus.vertices.push_back({out * along.cosine, tube * about.sine, out * along.sine});
            const int next_i = (i + 1) % around, next_j = (j + 1) % across;
            auto at = [&](int a, int b) { return static_cast<uint32_t>(a * across + b); };
            const uint32_t a = at(i, j), b = at(i, next_j), c = at(next_i, next_j), d = at(next_i, j);
            for (const uint32_t v : {a, b, c, a, c, d}) torus.indices.push_back(v);
        }
    return torus;
}

RockMesh placed(RockMesh solid, Vec3 axis, Vec3 middle) {
    const Quat turn = rotation_between({0, 1, 0}, axis);
    for (Vec3& v : solid.vertices) v = middle + rotate(turn, v);
    return solid;
}

float rock_noise(Vec3 p, uint64_t seed) {
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

RockMesh make_boulder(Vec3 middle, float radius, uint64_t seed) {
    RockMesh boulder = make_ball(k_fine);
    for (Vec3& v : boulder.vertices) {
        const float bump = rock_noise(v * 1.3f, seed + 3) + 0.4f * rock_noise(v * 3, seed + 4);
        v = middle + v * (radius * (1 + k_bumps * bump));
    }
    return boulder;
}

void draw_rock(Scenery& s, const RockMesh& solid, uint64_t seed) {
    const auto first = static_cast<uint32_t>(s.vertices.size());
    std::vector<Vec3> normals(solid.vertices.size());
    for (const Vec3 v : solid.vertices) s.vertices.push_back({v, {}, {}, ~0u});
    for (size_t i = 0; i < solid.indices.size(); i += 3) {
        const uint32_t* t = &solid.indices[i];
        const Vec3 a = solid.vertices[t[0]], b = solid.vertices[t[1]], c = solid.vertices[t[2]];
        for (size_t k = 0; k < 3; ++k) {
            normals[t[k]] += cross(b - a, c - a);
            s.indices.push_back(first + t[k]);
        }
        s.pictures.push_back(~0u);
        s.uses.push_back(SceneryUse::ground);
    }
    for (size_t v = 0; v < normals.size(); ++v) {
        Scenery::Vertex& vertex = s.vertices[first + v];
        const float size = length(normals[v]);
        vertex.normal = size > 0 ? normals[v] / size : Vec3{0, 1, 0};
        vertex.colour = rock(vertex.position, seed);
    }
}

void add_rock(Compound& c, const RockMesh& solid) {
    const auto first = static_cast<uint32_t>(c.vertices.size());
    c.vertices.insert(c.vertices.end(), solid.vertices.begin(), solid.vertices.end());
    for (const uint32_t v : solid.indices) c.indices.push_back(first + v);
    Vec3 sum;
    for (const Vec3 v : solid.vertices) sum += v;
    c.middles.push_back(sum / static_cast<float>(solid.vertices.size()));
}

City make_stage(std::string_view name, int walkers) {
    City city;
    city.ground.name = name;
    const float half = std::sqrt(static_cast<float>(walkers) * k_room) / 2 + 10;
    city.ground.vertices = {{-half, 0, -half}, {-half, 0, half}, {half, 0, half}, {half, 0, -half}};
    city.ground.indices = {0, 1, 2, 0, 2, 3};
    city.ground.kinds.assign(2, Surface::plaza);
    city.ground_axes.assign(2, {1, 0});
    city.scenery.holds_ground = true;
    index_city(city);
    return city;
}

}  // namespace flaneur
