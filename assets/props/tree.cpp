#include <algorithm>
#include <array>
#include <cmath>

#include "assets/props/shapes.h"

namespace flaneur {

namespace {

struct Clump {
    Vec3 centre, size;
};

// How far out a place lies in an ellipsoid: 0 in its middle, 1 at its skin.
float reach(const Clump& c, Vec3 at) {
    Vec3 off = at - c.centre;
    return length(Vec3{off.x / c.size.x, off.y / c.size.y, off.z / c.size.z});
}

// Sprays of leaves are this long and half as wide as shares of a crown's radius.
constexpr float k_spray = 0.17f, k_half_width = 0.11f;

// A spray of leaves about `at`, folded along its length: two triangles seen from the side of `out`. All of a
// crown's are lit as one, by normals that lean away from its middle.
void add_spray(PropMesh& mesh, Vec3 at, Vec3 out, float size, const Clump& crown, RandomKey key,
               uint32_t draw) {
    Vec3 jitter{random_between(key, -0.6f, 0.6f, draw), random_between(key, -0.4f, 0.6f, draw + 1),
                random_between(key, -0.6f, 0.6f, draw + 2)};
    Vec3 face = normalize_or(out + jitter, out);
    float turn = random_between(key, 0, 2 * k_pi, draw + 3);
    SinCos t = sin_cos(turn);
    Vec3 side = normalize_or(cross(face, Vec3{t.sine, -0.35f, t.cosine}), {1, 0, 0});
    Vec3 along = cross(side, face);
    Vec3 off = at - crown.centre;
    Vec3 away{off.x / crown.size.x, off.y / crown.size.y, off.z / crown.size.z};
    Vec3 normal = normalize_or(away + out * 0.5f + jitter * 0.22f, out);
    float shade = lerp(0.72f, 1.04f, smoothstep(0.45f, 1.05f, length(away))) *
                  lerp(0.78f, 1.06f, smoothstep(-0.75f, 0.55f, away.y)) *
                  random_between(key, 0.86f, 1.14f, draw + 4);
    float half = size * k_spray, wide = size * k_half_width;
    Vec3 fold = face * (-0.35f * wide);
    auto first = static_cast<uint32_t>(mesh.vertices.size());
    for (Vec3 p : {at - along * half, at - side * wide + fold, at + along * half, at + side * wide + fold})
        mesh.vertices.push_back({p, normal, PropPart::leaves, shade});
    for (uint32_t i : {0, 1, 2, 0, 2, 3}) mesh.indices.push_back(first + i);
}

// Clumps about a larger one, dark within, and sprays of leaves over all.
void add_crown(PropMesh& mesh, const Clump& crown, RandomKey key) {
    constexpr uint32_t k_clumps = 6, k_sprays = 240, k_far_sprays = 48;
    std::array<Clump, k_clumps> clumps;
    clumps[0] = {crown.centre + Vec3{0, 0.14f * crown.size.y, 0}, crown.size * 0.70f};
    float turn = random_between(key, 0, 2 * k_pi, 1);
    for (uint32_t i = 1; i < k_clumps; ++i) {
        // Golden-angle steps round the crown, alternately low and high.
        SinCos around = sin_cos(turn + 2.399963f * static_cast<float>(i));
        float up = (i % 2 ? 0.35f : -0.38f) + random_between(key, -0.18f, 0.18f, 10 + i);
        float away = 0.55f * std::sqrt(1 - up * up);
        clumps[i] = {crown.centre + Vec3{around.sine * away * crown.size.x, up * 0.72f * crown.size.y,
                                         around.cosine * away * crown.size.z},
                     crown.size * random_between(key, 0.40f, 0.52f, 30 + i)};
    }
    bool is_far = mesh.is_far;
    mesh.is_far = true;  // what is within needs no detail
    for (uint32_t i = 0; i < (is_far ? 4 : k_clumps); ++i)
        add_clump(mesh, clumps[i].centre, clumps[i].size * (is_far ? 0.95f : 0.76f), crown.centre, crown.size,
                  key, 1000 + i * 64, is_far ? 0.95f : 0.86f);
    mesh.is_far = is_far;
    // Round each clump from pole to pole; none within another.
    uint32_t sprays = (is_far ? k_far_sprays : k_sprays) / k_clumps, draw = 4000;
    float size = crown.size.x * (is_far ? 1.5f : 1.0f);
    for (uint32_t i = 0; i < k_clumps; ++i) {
        for (uint32_t k = 0; k < sprays; ++k, draw += 8) {
            float up = 1 - 2 * (static_cast<float>(k) + 0.5f) / static_cast<float>(sprays);
            SinCos around = sin_cos(2.399963f * static_cast<float>(k) + turn);
            float flat = std::sqrt(1 - up * up), skin = random_between(key, 0.80f, 1.02f, draw + 5);
            Vec3 out{around.sine * flat, up, around.cosine * flat};
            Vec3 at =
                clumps[i].centre +
                Vec3{out.x * clumps[i].size.x, out.y * clumps[i].size.y, out.z * clumps[i].size.z} * skin;
            bool is_hidden = std::any_of(clumps.begin(), clumps.end(), [&](const Clump& c) {
                return &c != &clumps[i] && reach(c, at) < 0.72f;
            });
            if (!is_hidden) add_spray(mesh, at, out, size, crown, key, draw);
        }
    }
}

}  // namespace

void add_tree(PropMesh& mesh, const Prop& tree) {
    RandomKey key{tree.seed, 0, 0, Purpose::tree};
    float fork = tree.height * random_between(key, 0.27f, 0.34f, 100);
    float thickness = 0.018f * tree.height + 0.03f;
    Vec3 lean{random_between(key, -0.03f, 0.03f, 101), 1, random_between(key, -0.03f, 0.03f, 102)};
    Vec3 crown_foot = tree.position + lean * fork;
    float half = (tree.height - fork) * 0.52f;
    // Some are slender.
    float slender = lerp(0.8f, 1.04f, smoothstep(0.1f, 0.5f, random_unit(key, 103)));
    Clump crown{crown_foot + lean * half, {tree.radius * slender, half, tree.radius * slender}};
    add_post(mesh, tree.position, crown_foot, thickness, thickness * 0.66f, 6, PropPart::trunk, false);
    add_post(mesh, crown_foot, crown.centre, thickness * 0.66f, thickness * 0.3f, 6, PropPart::trunk, false);
    if (!mesh.is_far) {
        float turn = random_between(key, 0, 2 * k_pi, 104);
        for (uint32_t i = 0; i < 3; ++i) {
            SinCos around = sin_cos(turn + 2.0944f * static_cast<float>(i));
            Vec3 tip = crown.centre + Vec3{around.sine * 0.5f * crown.size.x, -0.1f * half,
                                           around.cosine * 0.5f * crown.size.z};
            Vec3 from = tree.position + lean * (fork * (0.86f + 0.07f * static_cast<float>(i)));
            add_post(mesh, from, tip, thickness * 0.42f, thickness * 0.2f, 4, PropPart::trunk, false);
        }
    }
    add_crown(mesh, crown, key);
}

}  // namespace flaneur
