#include "tests/renderer/synthetic_scene.h"

#include <array>
#include <cmath>

#include "renderer/shapes.h"

namespace flaneur {
namespace {

constexpr float k_pi = 3.14159265f;

constexpr uint32_t rgb(uint32_t hex) { return vertex_colour(hex); }

uint32_t scaled(uint32_t colour, float factor) {
    uint32_t out = 0xff000000u;
    for (int c = 0; c < 3; ++c) {
        const float value = std::min(static_cast<float>(colour >> (8 * c) & 255) * factor, 255.0f);
        out |= static_cast<uint32_t>(value) << (8 * c);
    }
    return out;
}

uint32_t hash(uint32_t x) {
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}
float unit(uint32_t key) { return static_cast<float>(hash(key) >> 8) / 16777216.0f; }

void set_normal(int8_t (&out)[4], glm::vec3 n) {
    for (int i = 0; i < 3; ++i) out[i] = static_cast<int8_t>(std::lround(n[i] * 127));
}

void add_tree(CityMesh& mesh, glm::vec3 foot) {
    add_block(mesh, {foot.x - 0.14f, foot.z - 0.14f}, {foot.x + 0.14f, foot.z + 0.14f}, foot.y, 2.4f,
              {k_material_trunk, rgb(0x6b5a48)}, {k_material_trunk, rgb(0x6b5a48)});
    constexpr int rings = 8, sectors = 12;
    const uint32_t first = static_cast<uint32_t>(mesh.vertices.size());
    for (int ring = 0; ring <= rings; ++ring)
        for (int sector = 0; sector <= sectors; ++sector) {
            const float polar = k_pi * static_cast<float>(ring) / rings;
            const float turn = 2 * k_pi * static_cast<float>(sector % sectors) / sectors;
            const glm::vec3 n(std::sin(polar) * std::cos(turn), std::cos(polar),
                              -std::sin(polar) * std::sin(turn));
            const float bump =
                1 + 0.18f * (unit(static_cast<uint32_t>(ring * 64 + sector % sectors + 9)) - 0.5f);
            CityVertex vertex{};
            vertex.position = foot + glm::vec3(0, 4.1f, 0) + n * glm::vec3(2.1f, 1.9f, 2.1f) * bump;
            vertex.colour = rgb(0x6f8a48);
            vertex.uv = {static_cast<float>(sector) * 0.8f, static_cast<float>(ring) * 0.8f};
            set_normal(vertex.normal, n);
            vertex.material = static_cast<uint16_t>(k_material_leaves);
            mesh.vertices.push_back(vertex);
        }
    for (uint32_t ring = 0; ring < rings; ++ring)
        for (uint32_t sector = 0; sector < sectors; ++sector) {
            const uint32_t a = first + ring * (sectors + 1) + sector, b = a + sectors + 1;
            for (uint32_t index : {a, b, b + 1, a, b + 1, a + 1}) mesh.indices.push_back(index);
        }
}

// Joints of a body 1.74 m tall in its bind pose: hips, spine, chest, upper chest, neck, head, then arms and
// legs, as sim/body/body.h orders them.
constexpr int k_joints = k_palette_joints;
const glm::vec3 k_bind[k_joints] = {
    {0, 0.95f, 0},      {0, 1.06f, 0},         {0, 1.18f, 0},         {0, 1.30f, 0},      {0, 1.46f, 0},
    {0, 1.55f, 0.01f},  {0.03f, 1.42f, 0},     {0.18f, 1.42f, 0},     {0.19f, 1.10f, 0},  {0.19f, 0.85f, 0},
    {-0.03f, 1.42f, 0}, {-0.18f, 1.42f, 0},    {-0.19f, 1.10f, 0},    {-0.19f, 0.85f, 0}, {0.09f, 0.92f, 0},
    {0.09f, 0.50f, 0},  {0.09f, 0.07f, 0},     {0.09f, 0.02f, 0.13f}, {-0.09f, 0.92f, 0}, {-0.09f, 0.50f, 0},
    {-0.09f, 0.07f, 0}, {-0.09f, 0.02f, 0.13f}};
constexpr int k_parents[k_joints] = {-1, 0,  1,  2, 3,  4,  3,  6, 7,  8,  3,
                                     10, 11, 12, 0, 14, 15, 16, 0, 18, 19, 20};

struct Part {
    int joint;
    glm::vec3 low, high;  // radii come from the box
    int tint;
};
const Part k_parts[] = {{0, {-0.16f, 0.86f, -0.11f}, {0.16f, 1.06f, 0.11f}, 4},
                        {2, {-0.15f, 1.00f, -0.10f}, {0.15f, 1.25f, 0.11f}, 3},
                        {3, {-0.19f, 1.18f, -0.11f}, {0.19f, 1.47f, 0.12f}, 3},
                        {4, {-0.055f, 1.42f, -0.06f}, {0.055f, 1.56f, 0.05f}, 1},
                        {5, {-0.075f, 1.51f, -0.09f}, {0.075f, 1.74f, 0.10f}, 1},
                        {5, {-0.085f, 1.60f, -0.115f}, {0.085f, 1.76f, 0.06f}, 2},
                        {7, {0.135f, 1.07f, -0.055f}, {0.245f, 1.46f, 0.055f}, 3},
                        {8, {0.145f, 0.84f, -0.045f}, {0.235f, 1.13f, 0.045f}, 3},
                        {9, {0.16f, 0.74f, -0.04f}, {0.22f, 0.88f, 0.05f}, 1},
                        {11, {-0.245f, 1.07f, -0.055f}, {-0.135f, 1.46f, 0.055f}, 3},
                        {12, {-0.235f, 0.84f, -0.045f}, {-0.145f, 1.13f, 0.045f}, 3},
                        {13, {-0.22f, 0.74f, -0.04f}, {-0.16f, 0.88f, 0.05f}, 1},
                        {14, {0.01f, 0.48f, -0.09f}, {0.17f, 0.96f, 0.09f}, 4},
                        {15, {0.03f, 0.06f, -0.07f}, {0.15f, 0.54f, 0.06f}, 4},
                        {16, {0.045f, 0.0f, -0.08f}, {0.135f, 0.11f, 0.20f}, 5},
                        {18, {-0.17f, 0.48f, -0.09f}, {-0.01f, 0.96f, 0.09f}, 4},
                        {19, {-0.15f, 0.06f, -0.07f}, {-0.03f, 0.54f, 0.06f}, 4},
                        {20, {-0.135f, 0.0f, -0.08f}, {-0.045f, 0.11f, 0.20f}, 5}};

// A rounded box of `rings` x `sectors` quads, whose upper vertices follow the parent joint in part.
void add_part(PersonMesh& mesh, const Part& part, int rings, int sectors, std::vector<uint32_t>& indices) {
    const uint32_t first = static_cast<uint32_t>(mesh.vertices.size());
    const glm::vec3 centre = (part.low + part.high) * 0.5f, half = (part.high - part.low) * 0.5f;
    auto squarish = [](float x) { return std::copysign(std::sqrt(std::fabs(x)), x); };
    for (int ring = 0; ring <= rings; ++ring)
        for (int sector = 0; sector < sectors; ++sector) {
            const float polar = k_pi * static_cast<float>(ring) / static_cast<float>(rings);
            const float turn = 2 * k_pi * static_cast<float>(sector) / static_cast<float>(sectors);
            const glm::vec3 n(std::sin(polar) * std::cos(turn), std::cos(polar),
                              -std::sin(polar) * std::sin(turn));
            const float across = std::sqrt(std::max(std::sin(polar), 0.0f));
            PersonVertex vertex{};
            vertex.position =
                centre + half * glm::vec3(across * std::cos(turn), squarish(n.y), -across * std::sin(turn));
            vertex.colour = 0xffffffffu;
            set_normal(vertex.normal, glm::normalize(n / half * 0.1f));
            vertex.normal[3] = static_cast<int8_t>(part.tint);
            const bool is_shared = ring < rings / 3 && k_parents[part.joint] >= 0;
            vertex.joints[0] = static_cast<uint8_t>(part.joint);
            vertex.joints[1] = static_cast<uint8_t>(is_shared ? k_parents[part.joint] : part.joint);
            vertex.weights[0] = is_shared ? 160 : 255;
            vertex.weights[1] = static_cast<uint8_t>(255 - vertex.weights[0]);
            vertex.texture = ~0u;
            mesh.vertices.push_back(vertex);
        }
    const uint32_t s = static_cast<uint32_t>(sectors);
    for (uint32_t ring = 0; ring < static_cast<uint32_t>(rings); ++ring)
        for (uint32_t sector = 0; sector < s; ++sector) {
            const uint32_t a = first + ring * s + sector, b = first + ring * s + (sector + 1) % s;
            if (ring > 0) indices.insert(indices.end(), {a, a + s, b});
            if (ring + 1 < static_cast<uint32_t>(rings)) indices.insert(indices.end(), {b, a + s, b + s});
        }
}

PersonMesh synthetic_person() {
    PersonMesh mesh;
    constexpr int sizes[][2] = {{8, 8}, {5, 5}, {3, 4}, {2, 3}};  // about 1800, 720, 290 and 110 triangles
    for (const auto& size : sizes) {
        mesh.lods.emplace_back();
        for (const Part& part : k_parts) add_part(mesh, part, size[0], size[1], mesh.lods.back());
    }
    return mesh;
}

glm::vec4 turn_about(glm::vec3 axis, float angle) {
    return {axis * std::sin(angle / 2), std::cos(angle / 2)};
}

glm::vec4 product(glm::vec4 a, glm::vec4 b) {
    const glm::vec3 u(a), v(b);
    return {a.w * v + b.w * u + glm::cross(u, v), a.w * b.w - glm::dot(u, v)};
}

glm::vec3 rotated(glm::vec4 q, glm::vec3 v) {
    const glm::vec3 u(q), t = 2.0f * glm::cross(u, v);
    return v + q.w * t + glm::cross(u, t);
}

constexpr uint32_t k_cloth[] = {0x3a3d42, 0x26324a, 0x4f6a8a, 0x1f2023, 0xb08a5a, 0x6a6b4a, 0xe9e1d2,
                                0xf2f0ec, 0x6b2b35, 0xa4532f, 0x2f6b6b, 0xc59a3d, 0xb23a36, 0x7fb0d0};
constexpr uint32_t k_skin[] = {0xf3e7db, 0xeadaba, 0xd7bd96, 0xa07e56, 0x825c43, 0x604134};
constexpr uint32_t k_hair[] = {0x1c1a19, 0x3b2a20, 0x5a4030, 0x8a6a45, 0x9a9894};

template <size_t N>
uint32_t pick(const uint32_t (&colours)[N], uint32_t key) {
    return rgb(colours[hash(key) % N]);
}

// Appends a body in a stride of `phase` radians, on the ground at `place`; returns where its hips are.
glm::vec3 add_pose(std::vector<JointTransform>& palette, glm::vec3 place, float yaw, float phase,
                   float height) {
    const float swing = 0.45f * std::sin(phase);
    const glm::vec3 x(1, 0, 0);
    std::array<glm::vec4, k_joints> local;
    local.fill({0, 0, 0, 1});
    local[0] = turn_about({0, 1, 0}, yaw);
    local[14] = turn_about(x, -swing);
    local[18] = turn_about(x, swing);
    local[15] = turn_about(x, 0.25f + 0.35f * std::max(0.0f, -std::cos(phase)));
    local[19] = turn_about(x, 0.25f + 0.35f * std::max(0.0f, std::cos(phase)));
    local[7] = turn_about(x, 0.8f * swing);
    local[11] = turn_about(x, -0.8f * swing);
    local[8] = local[12] = turn_about(x, -0.35f);

    const size_t first = palette.size();
    std::array<glm::vec3, k_joints> joints;
    std::array<glm::vec4, k_joints> turns;
    for (int j = 0; j < k_joints; ++j) {
        const int parent = k_parents[j];
        turns[j] = parent < 0 ? local[j] : product(turns[parent], local[j]);
        joints[j] = parent < 0
                        ? place + k_bind[0] * height
                        : joints[parent] + rotated(turns[parent], (k_bind[j] - k_bind[parent]) * height);
        palette.push_back({turns[j], glm::vec4(joints[j] - rotated(turns[j], k_bind[j] * height), 0)});
    }
    // Down onto the ground, by the lower heel.
    auto sole = [&](int foot) { return joints[foot].y - k_bind[foot].y * height - place.y; };
    const float drop = std::min(sole(16), sole(20));
    for (size_t j = first; j < palette.size(); ++j) palette[j].translation.y -= drop;
    return joints[0] - glm::vec3(0, drop, 0);
}

std::vector<JointTransform> synthetic_strides() {
    std::vector<JointTransform> strides;
    for (int pose = 0; pose < k_stride_poses; ++pose) {
        const float phase = 2 * k_pi * static_cast<float>(pose % k_stride_phases) / k_stride_phases;
        const size_t first = strides.size();
        const glm::vec3 hips = add_pose(strides, {0, 0, 0}, 0, phase, 1);
        for (size_t j = first; j < strides.size(); ++j) strides[j].translation -= glm::vec4(hips, 0);
    }
    return strides;
}

}  // namespace

void add_walker(SyntheticScene& scene, glm::vec3 place, float yaw, float phase, uint32_t look) {
    const float height = 0.92f + 0.14f * unit(look * 7 + 3);
    const uint32_t first = static_cast<uint32_t>(scene.palette.size());
    WalkerDraw walker{};
    walker.centre = add_pose(scene.palette, place, yaw, phase, height);
    walker.radius = 0.95f * height;
    walker.heading = yaw;
    walker.phase = phase / (2 * k_pi);
    walker.instance.palette = first;
    walker.instance.scale = height;
    const uint32_t tints[k_tints] = {0xffffffffu,
                                     pick(k_skin, look * 11 + 1),
                                     pick(k_hair, look * 13 + 2),
                                     pick(k_cloth, look * 17 + 3),
                                     pick(k_cloth, look % 4 + 90),
                                     rgb(0x2a2523),
                                     rgb(0xb23a36)};
    for (int i = 0; i < k_tints; ++i) walker.instance.tints[i] = tints[i];
    scene.walkers.push_back(walker);
    const GroundPlane level{place, {0, 1, 0}};
    scene.grounds.push_back({{level, level}, level, {}});
}

CityMesh synthetic_city() {
    CityMesh mesh;
    const uint32_t walls[] = {0xd8c9ae, 0xe6dcc8, 0xd2a86a, 0xa5694f, 0xb7b3ab};
    // The street runs along z; sidewalks on both sides are 0.12 m higher.
    add_ground(mesh, {-4, -120}, {4, -6}, 0, k_material_road, rgb(0x45474a));
    add_ground(mesh, {-4, -2}, {4, 120}, 0, k_material_road, rgb(0x45474a));
    {  // a crossing: u runs across the street
        const std::array<glm::vec3, 4> corners = {glm::vec3(-4, 0, -2), {4, 0, -2}, {4, 0, -6}, {-4, 0, -6}};
        add_quad(mesh, corners, {glm::vec2(0, 0), {8, 0}, {8, 4}, {0, 4}}, k_material_crossing,
                 rgb(0xdcd9d0));
    }
    for (float side : {-1.0f, 1.0f}) {
        const float near = 4 * side, far = 8 * side;
        add_ground(mesh, {std::min(near, far), -120}, {std::max(near, far), 120}, 0.12f, k_material_sidewalk,
                   rgb(0xa39e95));
        const glm::vec3 a(near, 0, -120), b(near, 0, 120);
        add_wall(mesh, side > 0 ? a : b, side > 0 ? b : a, 0.12f, k_material_stone, rgb(0x8c8984), 0);
    }
    uint32_t number = 0;
    for (float z = -120; z < 120; z += 15, ++number)
        for (float side : {-1.0f, 1.0f}) {
            const uint32_t key = number * 2 + (side > 0);
            if (side > 0 && z == 15) continue;  // the square
            const float height = 3.2f * static_cast<float>(3 + hash(key) % 4);
            const uint32_t wall = scaled(rgb(walls[hash(key + 77) % 5]), 0.94f + 0.12f * unit(key + 31));
            const glm::vec2 low(side > 0 ? 8.0f : -22.0f, z), high(side > 0 ? 22.0f : -8.0f, z + 15);
            const uint16_t windows = facade_extra(3.2f, hash(key + 5) % 3 != 0, key % 4 == 0 ? 1 : -1,
                                                  static_cast<WindowKind>(key % 4));
            add_block(mesh, low, high, 0.12f, height, {k_material_facade, wall, windows, key},
                      {k_material_roof, key % 3 ? rgb(0x8f979c) : rgb(0xb5694a)});
        }
    add_ground(mesh, {8, 15}, {22, 30}, 0.12f, k_material_plaza, rgb(0xb0a898));
    add_ground(mesh, {11, 19}, {17, 26}, 0.14f, k_material_grass, rgb(0x6f8a4c));
    add_tree(mesh, {14, 0.14f, 22});
    for (float z = -100; z < 120; z += 20) add_tree(mesh, {5.2f, 0.12f, z});
    return mesh;
}

SyntheticScene synthetic_scene(int people) {
    SyntheticScene scene;
    scene.meshes.city = synthetic_city();
    scene.meshes.people.push_back(synthetic_person());
    scene.meshes.people[0].strides = synthetic_strides();
    for (int i = 0; i < people; ++i) {
        const uint32_t key = static_cast<uint32_t>(i) * 5 + 1;
        const float side = i % 2 ? 1.0f : -1.0f;
        const glm::vec3 place(side * (4.8f + 2.6f * unit(key)), 0.12f, -60 + 150 * unit(key + 1));
        add_walker(scene, place, unit(key + 2) < 0.5f ? 0.0f : k_pi, 2 * k_pi * unit(key + 3),
                   static_cast<uint32_t>(i));
    }
    return scene;
}

Camera street_camera() {
    return {
        .eye = {-6.4f, 1.72f, -16}, .target = {-3.2f, 1.5f, 0}, .vertical_fov = 0.56f, .near_plane = 0.1f};
}

Camera overview_camera() {
    return {.eye = {-30, 35, -58}, .target = {2, 2, 10}, .vertical_fov = 0.6f, .near_plane = 0.5f};
}

}  // namespace flaneur
