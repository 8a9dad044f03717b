#include <algorithm>
#include <cmath>
#include <vector>

#include "assets/city.h"
#include "assets/colour.h"
#include "assets/props.h"
#include "sim/base/rng.h"
#include "tools/flaneur/convert.h"
#include "tools/flaneur/extract.h"

namespace flaneur {

namespace {

constexpr uint32_t k_ground_colours[k_surface_count] = {
    rgb(0x45474a),  // road
    rgb(0xa39e95),  // sidewalk
    rgb(0xd9d5cc),  // crossing: its stripes
    rgb(0xb0a48f),  // plaza
    rgb(0xa99c84),  // path
    rgb(0xa8a195),  // steps
    rgb(0x6f8a4c),  // grass
    rgb(0x3d5560),  // water
};
constexpr uint32_t k_ground_materials[k_surface_count] = {
    k_material_road, k_material_sidewalk, k_material_crossing, k_material_plaza,
    k_material_path, k_material_steps,    k_material_grass,    k_material_water};
constexpr uint32_t k_kerb = rgb(0x8c8984), k_riser = rgb(0x9a948a), k_garden_wall = rgb(0xb5a88f);
constexpr uint32_t k_flat_roof = rgb(0x8b8983), k_cornice = rgb(0xb5ac9c), k_tile_roof = rgb(0xb5694a),
                   k_slate_roof = rgb(0x5b626b);

CityVertex vertex(Vec3 position, Vec3 normal, uint32_t colour, glm::vec2 uv, uint32_t material,
                  uint16_t extra = 0) {
    CityVertex v{};
    v.position = to_glm(position);
    v.colour = colour;
    v.uv = uv;
    v.normal[0] = packed(normal.x);
    v.normal[1] = packed(normal.y);
    v.normal[2] = packed(normal.z);
    v.material = static_cast<uint16_t>(material);
    v.extra = extra;
    return v;
}

uint32_t add_vertex(CityMesh& mesh, const CityVertex& v) {
    mesh.vertices.push_back(v);
    return static_cast<uint32_t>(mesh.vertices.size() - 1);
}

void add_ground(CityMesh& mesh, const City& city) {
    for (size_t t = 0; t < city.ground_kinds.size(); ++t) {
        Vec3 p[3];
        for (size_t k = 0; k < 3; ++k) p[k] = city.ground_vertices[city.ground_indices[3 * t + k]];
        Vec3 normal = normalize_or(cross(p[1] - p[0], p[2] - p[0]), {0, 1, 0});
        auto kind = static_cast<size_t>(city.ground_kinds[t]);
        for (Vec3 v : p) {
            glm::vec2 uv{v.x, v.z};
            if (city.ground_kinds[t] == Surface::crossing) uv = {dot(on_ground(v), city.ground_axes[t]), 0};
            mesh.indices.push_back(
                add_vertex(mesh, vertex(v, normal, k_ground_colours[kind], uv, k_ground_materials[kind])));
        }
    }
}

void add_faces(CityMesh& mesh, const City& city) {
    for (const Face& f : city.faces) {
        Vec3 along = f.b - f.a;
        float width = length(on_ground(along));
        Vec3 normal = normalize_or(cross(Vec3{along.x, 0, along.z}, Vec3{0, 1, 0}), {0, 0, 1});
        uint32_t colour = f.kind == FaceKind::kerb    ? k_kerb
                          : f.kind == FaceKind::riser ? k_riser
                                                      : k_garden_wall;
        uint32_t material = k_material_stone;
        uint16_t extra = 0;
        if (f.kind == FaceKind::facade) {
            material = k_material_facade;
            if (f.building < city.buildings.size()) {
                const Building& b = city.buildings[f.building];
                float tone = 0.94f + 0.12f * random_unit({b.seed, 0, 0, Purpose::colour});
                colour = shaded(b.wall_colour ? b.wall_colour : k_wall_colours[b.style % k_wall_colour_count],
                                tone);
                extra = static_cast<uint16_t>(std::lround(clamp(b.storey, 1, 20) * 100));
                if (b.has_shop) extra = static_cast<uint16_t>(extra | 0x8000u);
            } else {
                colour = k_wall_colours[0];
                extra = 320;
            }
        }
        auto corner = [&](Vec3 at, float y, float u, float foot) {
            return add_vertex(mesh, vertex({at.x, y, at.z}, normal, colour, {u, y - foot}, material, extra));
        };
        float foot = std::min(f.a.y, f.b.y);
        uint32_t a = corner(f.a, f.a.y, 0, foot), b = corner(f.b, f.b.y, width, foot);
        uint32_t c = corner(f.b, f.b_top, width, foot), d = corner(f.a, f.a_top, 0, foot);
        for (uint32_t i : {a, b, c, a, c, d}) mesh.indices.push_back(i);
    }
}

void add_roofs(CityMesh& mesh, const City& city) {
    // What has no facade is no house but a wall, and its roof a coping.
    std::vector<uint8_t> is_house(city.buildings.size(), 0);
    for (const Face& f : city.faces) {
        if (f.kind == FaceKind::facade && f.building < is_house.size()) is_house[f.building] = 1;
    }
    for (size_t t = 0; t < city.roof_buildings.size(); ++t) {
        Vec3 p[3];
        for (size_t k = 0; k < 3; ++k) p[k] = city.roof_vertices[city.roof_indices[3 * t + k]];
        Vec3 normal = normalize_or(cross(p[1] - p[0], p[2] - p[0]), {0, 1, 0});
        uint32_t building = city.roof_buildings[t];
        uint32_t seed = building < city.buildings.size() ? city.buildings[building].seed : 0;
        RandomKey key{seed, 1, 0, Purpose::colour};
        bool slate = random_unit(key) < 0.4f;
        uint32_t colour = normal.y > 0.95f ? k_flat_roof : slate ? k_slate_roof : k_tile_roof;
        if (building < city.buildings.size() && city.buildings[building].roof_colour)
            colour = city.buildings[building].roof_colour;
        if (normal.y < 0.3f) colour = k_cornice;
        if (building >= is_house.size() || !is_house[building]) colour = k_garden_wall;
        colour = shaded(colour, random_between(key, 0.9f, 1.08f, 1));
        for (Vec3 v : p) {
            mesh.indices.push_back(add_vertex(mesh, vertex(v, normal, colour, {v.x, v.z}, k_material_roof)));
        }
    }
}

void add_props(CityMesh& mesh, const City& city) {
    for (const Prop& prop : city.props) {
        PropMesh made;
        add_prop(made, prop);
        RandomKey key{prop.seed, 2, 0, Purpose::colour};
        float age = random_unit(key);
        auto mix_channel = [&](uint32_t a, uint32_t b) {
            return static_cast<uint32_t>(lerp(static_cast<float>(a), static_cast<float>(b), age));
        };
        uint32_t leaves = 0xff000000u | mix_channel(0x5f, 0x87) | mix_channel(0x7d, 0x99) << 8 |
                          mix_channel(0x45, 0x4e) << 16;
        auto first = static_cast<uint32_t>(mesh.vertices.size());
        for (const auto& v : made.vertices) {
            uint32_t colour = leaves, material = k_material_leaves;
            switch (v.part) {
                case PropPart::leaves:
                    break;
                case PropPart::trunk:
                    colour = rgb(0x6b5a48), material = k_material_trunk;
                    break;
                case PropPart::metal:
                    colour = rgb(0x3c4044), material = k_material_metal;
                    break;
                case PropPart::wood:
                    colour = rgb(0x8a6a48), material = k_material_trunk;
                    break;
                case PropPart::light:
                    colour = rgb(0xf2ead8), material = k_material_metal;
                    break;
            }
            add_vertex(mesh, vertex(v.position, v.normal, shaded(colour, v.shade), {0, 0}, material));
        }
        for (uint32_t i : made.indices) mesh.indices.push_back(first + i);
    }
}

}  // namespace

SceneMeshes extract_scene(const City& city, const std::vector<Character>& characters) {
    SceneMeshes scene;
    if (!city.scenery.holds_ground) add_ground(scene.city, city);
    add_faces(scene.city, city);
    add_roofs(scene.city, city);
    add_props(scene.city, city);
    add_scenery(city.scenery, scene.city);
    for (const Character& c : characters) scene.people.push_back(extract_character(c));
    return scene;
}

}  // namespace flaneur
