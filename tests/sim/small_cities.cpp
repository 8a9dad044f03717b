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

City bridge() {
    City city;
    city.name = "bridge";
    add_floor(city, {-40, -10}, {40, 10}, 0, Surface::plaza);
    add_floor(city, {-10, -2}, {10, 2}, 5, Surface::path);
    add_quad(city, {30, 0.01f, 2}, {30, 0.01f, -2}, {10, 5, -2}, {10, 5, 2}, Surface::path);
    add_quad(city, {-10, 5, 2}, {-10, 5, -2}, {-30, 0.01f, -2}, {-30, 0.01f, 2}, Surface::path);
    for (float side : {-1.0f, 1.0f}) {
        for (float z : {-2.0f, 2.0f}) {
            Face f{{10 * side, 0, z}, {29 * side, 0, z}, 5, 0.25f, FaceKind::facade};
            city.faces.push_back(f);
        }
    }
    index_city(city);
    return city;
}

void add_solid_box(City& city, Vec3 low, Vec3 high) {
    Scenery& s = city.scenery;
    auto base = static_cast<uint32_t>(s.vertices.size());
    for (uint32_t i = 0; i < 8; ++i) {
        Vec3 at{i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z};
        s.vertices.push_back({at, {0, 1, 0}, {0, 0}});
    }
    constexpr uint32_t k_sides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                        {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (const auto& side : k_sides) {
        for (uint32_t i : {side[0], side[1], side[2], side[0], side[2], side[3]})
            s.indices.push_back(base + i);
        for (int k = 0; k < 2; ++k) s.pictures.push_back(~0u), s.uses.push_back(SceneryUse::solid);
    }
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
