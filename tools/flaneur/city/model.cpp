#include "tools/flaneur/city/model.h"

#include <algorithm>
#include <array>

#include "tools/extract/extract.h"

namespace flaneur {

namespace {

enum Part : size_t { k_ground, k_facades, k_roofs, k_props, k_scenery, k_parts };
constexpr std::array<const char*, k_parts> k_part_names = {"ground", "facades", "roofs", "props", "scenery"};

struct DrawnKind {
    const char* name;
    Part part;
    float roughness, metallic;
};
// By k_material_* of shaders/shared.h.
constexpr std::array<DrawnKind, 16> k_kinds = {{{"road", k_ground, 0.95f, 0},
                                                {"sidewalk", k_ground, 0.9f, 0},
                                                {"crossing", k_ground, 0.85f, 0},
                                                {"plaza", k_ground, 0.85f, 0},
                                                {"path", k_ground, 1, 0},
                                                {"steps", k_ground, 0.9f, 0},
                                                {"grass", k_ground, 1, 0},
                                                {"water", k_ground, 0.1f, 0},
                                                {"ballast", k_ground, 1, 0},
                                                {"sleepers", k_ground, 1, 0},
                                                {"facade", k_facades, 0.9f, 0},
                                                {"stone", k_ground, 0.9f, 0},
                                                {"roof", k_roofs, 0.85f, 0},
                                                {"leaves", k_props, 0.9f, 0},
                                                {"trunk", k_props, 1, 0},
                                                {"metal", k_props, 0.5f, 0.6f}}};
static_assert(k_kinds.size() == k_material_metal + 1);

Vec3 from_glm(glm::vec3 v) { return {v.x, v.y, v.z}; }

void add_corner(StillSurface& surface, Vec3 position, Vec3 normal, uint32_t colour) {
    surface.indices.push_back(static_cast<uint32_t>(surface.positions.size()));
    surface.positions.push_back(position);
    surface.normals.push_back(normalize_or(normal, {0, 1, 0}));
    surface.colours.push_back(colour | 0xff000000u);
}

// The brightest of each channel, so that no vertex is more than its material.
uint32_t brightest(const std::vector<uint32_t>& colours) {
    uint32_t out = 0xff000000u;
    for (uint32_t colour : colours)
        for (int shift : {0, 8, 16})
            out = (out & ~(0xffu << shift)) | std::max(out >> shift & 0xffu, colour >> shift & 0xffu)
                                                  << shift;
    return out;
}

void add_drawn(const CityMesh& drawn, StillModel& model) {
    std::array<StillSurface, k_kinds.size()> surfaces;
    for (size_t at = 0; at < drawn.indices.size(); ++at) {
        if (drawn.seen_from[at / 3] == SeenFrom::far) continue;
        const uint32_t* corners = &drawn.indices[at - at % 3];
        if (corners[1] == corners[2]) continue;  // only joins a wall's pieces
        const CityVertex& v = drawn.vertices[drawn.indices[at]];
        if (v.material == k_material_scenery) continue;  // is taken from the city, with its pictures
        if (v.material == k_material_shade) continue;
        Vec3 normal{static_cast<float>(v.normal[0]), static_cast<float>(v.normal[1]),
                    static_cast<float>(v.normal[2])};
        add_corner(surfaces[std::min<size_t>(v.material, k_material_metal)], from_glm(v.position), normal,
                   v.colour);
    }
    for (size_t kind = 0; kind < k_kinds.size(); ++kind) {
        StillSurface& surface = surfaces[kind];
        surface.material = model.materials.size();
        const DrawnKind& k = k_kinds[kind];
        model.materials.push_back({k.name, brightest(surface.colours), k.roughness, k.metallic});
        model.meshes[k.part].surfaces.push_back(std::move(surface));
    }
}

// A surface for each picture and one without; the backdrop's apart from the others.
void add_scenery(const Scenery& scenery, StillModel& model) {
    size_t kinds = scenery.images.size() + 1;
    std::vector<StillSurface> surfaces(2 * kinds);
    for (size_t t = 0; t < scenery.pictures.size(); ++t) {
        size_t kind = std::min<size_t>(scenery.pictures[t], scenery.images.size());
        StillSurface& surface = surfaces[scenery.uses[t] == SceneryUse::backdrop ? kinds + kind : kind];
        for (size_t k = 0; k < 3; ++k) {
            const Scenery::Vertex& v = scenery.vertices[scenery.indices[3 * t + k]];
            add_corner(surface, v.position, v.normal, v.colour);
            surface.uvs.push_back(v.uv);
        }
    }
    for (size_t s = 0; s < surfaces.size(); ++s) {
        if (surfaces[s].indices.empty()) continue;
        size_t kind = s % kinds;
        StillMaterial material{(s < kinds ? "scenery " : "backdrop ") + std::to_string(kind + 1),
                               brightest(surfaces[s].colours)};
        if (kind < scenery.images.size()) {
            material.picture = static_cast<int>(kind);
            material.is_cut = true;
        } else {
            surfaces[s].uvs.clear();
        }
        surfaces[s].material = model.materials.size();
        model.materials.push_back(material);
        model.meshes[k_scenery].surfaces.push_back(std::move(surfaces[s]));
    }
    model.pictures = scenery.images;
}

}  // namespace

StillModel city_model(const City& city) {
    StillModel model;
    for (const char* name : k_part_names) model.meshes.push_back({name, {}});
    add_drawn(extract_scene(city, {}).city, model);
    add_scenery(city.scenery, model);
    return model;
}

}  // namespace flaneur
