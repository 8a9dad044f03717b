#include "assets/props.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "sim/base/math.h"
#include "sim/base/rng.h"

namespace flaneur {

namespace {

struct Sphere {
    std::vector<Vec3> points;
    std::vector<uint32_t> triangles;
};

// An icosahedron, each triangle split into four and brought to the unit sphere: 42 points, 80 triangles.
Sphere make_sphere() {
    constexpr float g = 1.618034f;
    Sphere s;
    s.points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    const uint32_t faces[] = {0, 11, 5,  0, 5,  1, 0, 1, 7, 0, 7,  10, 0, 10, 11, 1, 5, 9, 5, 11,
                              4, 11, 10, 2, 10, 7, 6, 7, 1, 8, 3,  9,  4, 3,  4,  2, 3, 2, 6, 3,
                              6, 8,  3,  8, 9,  4, 9, 5, 2, 4, 11, 6,  2, 10, 8,  6, 7, 9, 8, 1};
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    auto middle = [&](uint32_t a, uint32_t b) {
        auto [place, fresh] = middles.try_emplace(std::minmax(a, b), static_cast<uint32_t>(s.points.size()));
        if (fresh) s.points.push_back((s.points[a] + s.points[b]) * 0.5f);
        return place->second;
    };
    for (size_t t = 0; t < std::size(faces); t += 3) {
        uint32_t a = faces[t], b = faces[t + 1], c = faces[t + 2];
        uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        for (uint32_t i : {a, ab, ca, b, bc, ab, c, ca, bc, ab, bc, ca}) s.triangles.push_back(i);
    }
    for (Vec3& p : s.points) p = p / length(p);
    return s;
}

// A mass of leaves: a sphere with a bumpy skin. Its normals lean away from the crown's middle, so that the
// masses of one crown are lit as one.
void add_clump(PropMesh& mesh, Vec3 centre, Vec3 size, Vec3 crown, Vec3 crown_size, RandomKey key,
               uint32_t draw) {
    static const Sphere sphere = make_sphere();
    auto first = static_cast<uint32_t>(mesh.vertices.size());
    for (size_t i = 0; i < sphere.points.size(); ++i) {
        const Vec3& p = sphere.points[i];
        float bump = random_between(key, 0.86f, 1.12f, draw + static_cast<uint32_t>(i));
        Vec3 at = centre + Vec3{p.x * size.x, (p.y < 0 ? p.y * 0.8f : p.y) * size.y, p.z * size.z} * bump;
        Vec3 out{(at.x - crown.x) / crown_size.x, (at.y - crown.y) / crown_size.y,
                 (at.z - crown.z) / crown_size.z};
        float depth = length(out);  // 0 in the middle of the crown .. 1 at its skin
        float shade = lerp(0.62f, 1.04f, smoothstep(0.25f, 1.0f, depth)) *
                      lerp(0.80f, 1.06f, smoothstep(-0.8f, 0.6f, out.y));
        mesh.vertices.push_back({at, normalize_or(p * 0.65f + out, p), PropPart::leaves, shade});
    }
    for (uint32_t i : sphere.triangles) mesh.indices.push_back(first + i);
}

// Five to seven clumps about a larger one.
void add_crown(PropMesh& mesh, Vec3 centre, float radius, float half_height, RandomKey key) {
    Vec3 size{radius, half_height, radius};
    add_clump(mesh, centre + Vec3{0, 0.12f * half_height, 0}, size * 0.72f, centre, size, key, 1000);
    uint32_t clumps = 5 + static_cast<uint32_t>(random_bits(key, 0) % 3);
    float turn = random_between(key, 0, 2 * k_pi, 1);
    for (uint32_t i = 0; i < clumps; ++i) {
        // Golden-angle steps round the crown, alternately low and high.
        SinCos around = sin_cos(turn + 2.399963f * static_cast<float>(i));
        float up = (i % 2 ? 0.35f : -0.35f) + random_between(key, -0.18f, 0.18f, 10 + i);
        float away = 0.56f * std::sqrt(1 - up * up);
        Vec3 at = centre +
                  Vec3{around.sine * away * radius, up * 0.72f * half_height, around.cosine * away * radius};
        float share = random_between(key, 0.42f, 0.54f, 30 + i);
        add_clump(mesh, at, size * share, centre, size, key, 2000 + i * 64);
    }
}

// A round or square post from `foot` to `top`.
void add_post(PropMesh& mesh, Vec3 foot, Vec3 top, float foot_radius, float top_radius, uint32_t sides,
              PropPart part, bool cap) {
    auto first = static_cast<uint32_t>(mesh.vertices.size());
    Vec3 axis = normalize_or(top - foot, {0, 1, 0});
    Quat stand = rotation_between({0, 1, 0}, axis);
    for (uint32_t i = 0; i < sides; ++i) {
        SinCos around = sin_cos(2 * k_pi * (static_cast<float>(i) + 0.5f) / static_cast<float>(sides));
        Vec3 out = rotate(stand, Vec3{around.sine, 0, around.cosine});
        mesh.vertices.push_back({foot + out * foot_radius, out, part, 0.9f});
        mesh.vertices.push_back({top + out * top_radius, out, part, 1});
    }
    for (uint32_t i = 0; i < sides; ++i) {
        uint32_t a = first + 2 * i, b = first + 2 * ((i + 1) % sides);
        for (uint32_t v : {a, b, b + 1, a, b + 1, a + 1}) mesh.indices.push_back(v);
    }
    if (!cap) return;
    auto rim = static_cast<uint32_t>(mesh.vertices.size());
    for (uint32_t i = 0; i < sides; ++i) {
        PropMesh::Vertex v = mesh.vertices[first + 2 * i + 1];
        v.normal = axis;
        mesh.vertices.push_back(v);
    }
    for (uint32_t i = 1; i + 1 < sides; ++i) {
        for (uint32_t v : {rim, rim + i, rim + i + 1}) mesh.indices.push_back(v);
    }
}

// A box of half extents `half` about `centre`, turned by `yaw`.
void add_box(PropMesh& mesh, Vec3 centre, Vec3 half, float yaw, PropPart part) {
    Quat turn = rotation_y(yaw);
    for (int axis = 0; axis < 3; ++axis) {
        for (float sign : {-1.0f, 1.0f}) {
            Vec3 n{axis == 0 ? sign : 0, axis == 1 ? sign : 0, axis == 2 ? sign : 0};
            Vec3 u{n.y, n.z, n.x};
            Vec3 v = cross(n, u);
            auto first = static_cast<uint32_t>(mesh.vertices.size());
            for (auto [a, b] : {std::pair{-1.0f, -1.0f}, {1.0f, -1.0f}, {1.0f, 1.0f}, {-1.0f, 1.0f}}) {
                Vec3 corner = n + u * a + v * b;
                Vec3 scaled{corner.x * half.x, corner.y * half.y, corner.z * half.z};
                mesh.vertices.push_back({centre + rotate(turn, scaled), rotate(turn, n), part, 1});
            }
            for (uint32_t i : {0, 1, 2, 0, 2, 3}) mesh.indices.push_back(first + i);
        }
    }
}

void add_tree(PropMesh& mesh, const Prop& tree) {
    RandomKey key{tree.seed, 0, 0, Purpose::tree};
    float fork = tree.height * random_between(key, 0.30f, 0.38f, 100);
    float thickness = 0.018f * tree.height + 0.04f;
    Vec3 lean{random_between(key, -0.03f, 0.03f, 101), 1, random_between(key, -0.03f, 0.03f, 102)};
    Vec3 crown_foot = tree.position + lean * fork;
    add_post(mesh, tree.position, crown_foot + lean * (0.25f * tree.height), thickness, thickness * 0.6f, 7,
             PropPart::trunk, false);
    float half = (tree.height - fork) * 0.52f;
    add_crown(mesh, crown_foot + lean * half, tree.radius, half, key);
}

void add_lamp(PropMesh& mesh, const Prop& lamp) {
    Vec3 up{0, lamp.height, 0};
    add_post(mesh, lamp.position, lamp.position + Vec3{0, 0.7f, 0}, 0.09f, 0.08f, 8, PropPart::metal, false);
    add_post(mesh, lamp.position + Vec3{0, 0.7f, 0}, lamp.position + up, 0.055f, 0.035f, 8, PropPart::metal,
             false);
    Vec2 out = heading_direction(lamp.yaw) * 0.55f;
    Vec3 head = lamp.position + up + at_height(out, 0.08f);
    add_post(mesh, lamp.position + up, head, 0.035f, 0.03f, 6, PropPart::metal, false);
    add_box(mesh, head, {0.11f, 0.045f, 0.26f}, lamp.yaw, PropPart::metal);
    add_box(mesh, head - Vec3{0, 0.05f, 0}, {0.09f, 0.01f, 0.22f}, lamp.yaw, PropPart::light);
}

void add_bench(PropMesh& mesh, const Prop& bench) {
    Quat turn = rotation_y(bench.yaw);
    auto part = [&](Vec3 centre, Vec3 half, PropPart what) {
        add_box(mesh, bench.position + rotate(turn, centre), half, bench.yaw, what);
    };
    for (float z : {-0.15f, 0.0f, 0.15f}) part({0, 0.44f, z}, {0.9f, 0.02f, 0.06f}, PropPart::wood);
    for (float y : {0.62f, 0.78f}) part({0, y, -0.25f}, {0.9f, 0.06f, 0.02f}, PropPart::wood);
    for (float x : {-0.75f, 0.75f}) {
        part({x, 0.21f, 0}, {0.03f, 0.21f, 0.2f}, PropPart::metal);
        part({x, 0.6f, -0.27f}, {0.03f, 0.25f, 0.02f}, PropPart::metal);
    }
}

}  // namespace

void add_prop(PropMesh& mesh, const Prop& prop) {
    switch (prop.kind) {
        case PropKind::tree:
            add_tree(mesh, prop);
            break;
        case PropKind::lamp:
            add_lamp(mesh, prop);
            break;
        case PropKind::bench:
            add_bench(mesh, prop);
            break;
        case PropKind::bollard:
            add_post(mesh, prop.position, prop.position + Vec3{0, prop.height, 0}, 0.07f, 0.06f, 8,
                     PropPart::metal, true);
            break;
        default:
            break;
    }
}

}  // namespace flaneur
