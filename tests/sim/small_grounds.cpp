#include "tests/sim/small_grounds.h"

namespace flaneur {

void add_quad(Ground& ground, Vec3 a, Vec3 b, Vec3 c, Vec3 d, Surface kind) {
    auto base = static_cast<uint32_t>(ground.vertices.size());
    for (Vec3 v : {a, b, c, d}) ground.vertices.push_back(v);
    for (uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) ground.indices.push_back(base + i);
    ground.kinds.push_back(kind);
    ground.kinds.push_back(kind);
}

void add_floor(Ground& ground, Vec2 low, Vec2 high, float y, Surface kind) {
    add_quad(ground, {high.x, y, high.z}, {high.x, y, low.z}, {low.x, y, low.z}, {low.x, y, high.z}, kind);
}

void add_wall(Ground& ground, Vec3 a, Vec3 b, float height, FaceKind kind) {
    ground.faces.push_back({a, b, a.y + height, b.y + height, kind});
}

Ground corridor(float length, float width) {
    Ground ground;
    ground.name = "corridor";
    float h = width / 2;
    add_floor(ground, {0, -h}, {length, h}, 0, Surface::sidewalk);
    add_wall(ground, {0, 0, -h}, {length, 0, -h}, 3);
    add_wall(ground, {length, 0, h}, {0, 0, h}, 3);
    index_ground(ground);
    return ground;
}

Ground corner(float length, float width) {
    Ground ground;
    ground.name = "corner";
    add_floor(ground, {0, 0}, {length, width}, 0, Surface::sidewalk);
    add_floor(ground, {length - width, width}, {length, length}, 0, Surface::sidewalk);
    add_wall(ground, {0, 0, 0}, {length, 0, 0}, 3);
    add_wall(ground, {length, 0, 0}, {length, 0, length}, 3);
    add_wall(ground, {length - width, 0, length}, {length - width, 0, width}, 3);
    add_wall(ground, {length - width, 0, width}, {0, 0, width}, 3);
    index_ground(ground);
    return ground;
}

Ground square(float size) {
    Ground ground;
    ground.name = "square";
    float h = size / 2;
    add_floor(ground, {-h, -h}, {h, h}, 0, Surface::plaza);
    add_wall(ground, {-h, 0, -h}, {h, 0, -h}, 3);
    add_wall(ground, {h, 0, -h}, {h, 0, h}, 3);
    add_wall(ground, {h, 0, h}, {-h, 0, h}, 3);
    add_wall(ground, {-h, 0, h}, {-h, 0, -h}, 3);
    index_ground(ground);
    return ground;
}

Ground street() {
    constexpr float k_kerb = 0.12f;
    Ground ground;
    ground.name = "street";
    add_floor(ground, {-40, -4}, {-2, 4}, 0, Surface::road);
    add_floor(ground, {2, -4}, {40, 4}, 0, Surface::road);
    add_floor(ground, {-2, -4}, {2, 4}, 0, Surface::crossing);
    add_floor(ground, {-40, -8}, {40, -4}, k_kerb, Surface::sidewalk);
    add_floor(ground, {-40, 4}, {40, 8}, k_kerb, Surface::sidewalk);
    add_wall(ground, {40, 0, -4}, {-40, 0, -4}, k_kerb, FaceKind::kerb);
    add_wall(ground, {-40, 0, 4}, {40, 0, 4}, k_kerb, FaceKind::kerb);
    add_wall(ground, {-40, k_kerb, -8}, {40, k_kerb, -8}, 10);
    add_wall(ground, {40, k_kerb, 8}, {-40, k_kerb, 8}, 10);
    index_ground(ground);
    return ground;
}

Ground bridge() {
    Ground ground;
    ground.name = "bridge";
    add_floor(ground, {-40, -10}, {40, 10}, 0, Surface::plaza);
    add_floor(ground, {-10, -2}, {10, 2}, 5, Surface::path);
    add_quad(ground, {30, 0.01f, 2}, {30, 0.01f, -2}, {10, 5, -2}, {10, 5, 2}, Surface::path);
    add_quad(ground, {-10, 5, 2}, {-10, 5, -2}, {-30, 0.01f, -2}, {-30, 0.01f, 2}, Surface::path);
    for (float side : {-1.0f, 1.0f}) {
        for (float z : {-2.0f, 2.0f}) {
            Face f{{10 * side, 0, z}, {29 * side, 0, z}, 5, 0.25f, FaceKind::facade};
            ground.faces.push_back(f);
        }
    }
    index_ground(ground);
    return ground;
}

void add_solid_box(Ground& ground, Vec3 low, Vec3 high) {
    Vec3 corners[8];
    for (uint32_t i = 0; i < 8; ++i)
        corners[i] = {i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z};
    constexpr uint32_t k_sides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                        {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (const auto& side : k_sides) {
        ground.solids.push_back({corners[side[0]], corners[side[1]], corners[side[2]]});
        ground.solids.push_back({corners[side[0]], corners[side[2]], corners[side[3]]});
    }
}

Ground steps() {
    constexpr int k_steps = 10;
    constexpr float k_rise = 0.15f, k_tread = 0.35f;
    Ground ground;
    ground.name = "steps";
    add_floor(ground, {-10, -20}, {10, 0}, 0, Surface::plaza);
    float y = 0, z = 0;
    for (int i = 0; i < k_steps; ++i) {
        add_wall(ground, {10, y, z}, {-10, y, z}, k_rise, FaceKind::riser);
        y += k_rise;
        if (i + 1 < k_steps) add_floor(ground, {-10, z}, {10, z + k_tread}, y, Surface::steps), z += k_tread;
    }
    add_floor(ground, {-10, z}, {10, z + 10}, y, Surface::plaza);
    index_ground(ground);
    return ground;
}

}  // namespace flaneur
