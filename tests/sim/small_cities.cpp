#include "tests/sim/small_cities.h"

namespace flaneur {

void add_quad(City& city, Vec3 a, Vec3 b, Vec3 c, Vec3 d, Surface kind) {
    auto base = static_cast<uint32_t>(city.ground_vertices.size());
    for (Vec3 v : {a, b, c, d}) city.ground_vertices.push_back(v);
    for (uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) city.ground_indices.push_back(base + i);
    city.ground_kinds.push_back(kind);
    city.ground_kinds.push_back(kind);
}

void add_floor(City& city, Vec2 low, Vec2 high, float y, Surface kind) {
    add_quad(city, {high.x, y, high.z}, {high.x, y, low.z}, {low.x, y, low.z}, {low.x, y, high.z}, kind);
}

void add_wall(City& city, Vec3 a, Vec3 b, float height, FaceKind kind) {
    city.faces.push_back({a, b, a.y + height, b.y + height, kind});
}

City corridor(float length, float width) {
    City city;
    city.name = "corridor";
    float h = width / 2;
    add_floor(city, {0, -h}, {length, h}, 0, Surface::sidewalk);
    add_wall(city, {0, 0, -h}, {length, 0, -h}, 3);
    add_wall(city, {length, 0, h}, {0, 0, h}, 3);
    index_city(city);
    return city;
}

City corner(float length, float width) {
    City city;
    city.name = "corner";
    add_floor(city, {0, 0}, {length, width}, 0, Surface::sidewalk);
    add_floor(city, {length - width, width}, {length, length}, 0, Surface::sidewalk);
    add_wall(city, {0, 0, 0}, {length, 0, 0}, 3);
    add_wall(city, {length, 0, 0}, {length, 0, length}, 3);
    add_wall(city, {length - width, 0, length}, {length - width, 0, width}, 3);
    add_wall(city, {length - width, 0, width}, {0, 0, width}, 3);
    index_city(city);
    return city;
}

City square(float size) {
    City city;
    city.name = "square";
    float h = size / 2;
    add_floor(city, {-h, -h}, {h, h}, 0, Surface::plaza);
    add_wall(city, {-h, 0, -h}, {h, 0, -h}, 3);
    add_wall(city, {h, 0, -h}, {h, 0, h}, 3);
    add_wall(city, {h, 0, h}, {-h, 0, h}, 3);
    add_wall(city, {-h, 0, h}, {-h, 0, -h}, 3);
    index_city(city);
    return city;
}

City street() {
    constexpr float k_kerb = 0.12f;
    City city;
    city.name = "street";
    add_floor(city, {-40, -4}, {-2, 4}, 0, Surface::road);
    add_floor(city, {2, -4}, {40, 4}, 0, Surface::road);
    add_floor(city, {-2, -4}, {2, 4}, 0, Surface::crossing);
    add_floor(city, {-40, -8}, {40, -4}, k_kerb, Surface::sidewalk);
    add_floor(city, {-40, 4}, {40, 8}, k_kerb, Surface::sidewalk);
    add_wall(city, {40, 0, -4}, {-40, 0, -4}, k_kerb, FaceKind::kerb);
    add_wall(city, {-40, 0, 4}, {40, 0, 4}, k_kerb, FaceKind::kerb);
    add_wall(city, {-40, k_kerb, -8}, {40, k_kerb, -8}, 10);
    add_wall(city, {40, k_kerb, 8}, {-40, k_kerb, 8}, 10);
    index_city(city);
    return city;
}

City steps() {
    constexpr int k_steps = 10;
    constexpr float k_rise = 0.15f, k_tread = 0.35f;
    City city;
    city.name = "steps";
    add_floor(city, {-10, -20}, {10, 0}, 0, Surface::plaza);
    float y = 0, z = 0;
    for (int i = 0; i < k_steps; ++i) {
        add_wall(city, {10, y, z}, {-10, y, z}, k_rise, FaceKind::riser);
        y += k_rise;
        if (i + 1 < k_steps) add_floor(city, {-10, z}, {10, z + k_tread}, y, Surface::steps), z += k_tread;
    }
    add_floor(city, {-10, z}, {10, z + 10}, y, Surface::plaza);
    index_city(city);
    return city;
}

}  // namespace flaneur
