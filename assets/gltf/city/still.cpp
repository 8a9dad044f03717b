#include "assets/gltf/city/still.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "assets/files/picture.h"
#include "assets/gltf/glb.h"

namespace flaneur {

namespace {

constexpr int k_floats = TINYGLTF_COMPONENT_TYPE_FLOAT, k_vertices = TINYGLTF_TARGET_ARRAY_BUFFER;

// A vertex's colour over its material's.
std::array<uint16_t, 4> share_of(uint32_t colour, uint32_t base) {
    std::array<uint16_t, 4> out;
    out.fill(0xffff);
    for (size_t i = 0; i < 3; ++i) {
        int shift = 8 * static_cast<int>(i);
        float whole = std::max(light_of(base, shift), 1e-4f);
        out[i] = static_cast<uint16_t>(std::lround(std::min(light_of(colour, shift) / whole, 1.0f) * 0xffff));
    }
    return out;
}

// Equal vertices become one.
void weld(StillSurface& s) {
    size_t count = s.positions.size();
    std::vector<meshopt_Stream> streams = {{s.positions.data(), sizeof(Vec3), sizeof(Vec3)},
                                           {s.normals.data(), sizeof(Vec3), sizeof(Vec3)}};
    if (!s.uvs.empty()) streams.push_back({s.uvs.data(), sizeof(Vec2), sizeof(Vec2)});
    if (!s.colours.empty()) streams.push_back({s.colours.data(), 4, 4});
    std::vector<uint32_t> remap(count);
    size_t left = meshopt_generateVertexRemapMulti(remap.data(), s.indices.data(), s.indices.size(), count,
                                                   streams.data(), streams.size());
    auto keep = [&](auto& values) {
        if (values.empty()) return;
        meshopt_remapVertexBuffer(values.data(), values.data(), count, sizeof values[0], remap.data());
        values.resize(left);
    };
    keep(s.positions);
    keep(s.normals);
    keep(s.uvs);
    keep(s.colours);
    meshopt_remapIndexBuffer(s.indices.data(), s.indices.data(), s.indices.size(), remap.data());
}

tinygltf::Primitive add_surface(tinygltf::Model& model, StillSurface surface, const StillMaterial& material) {
    weld(surface);
    tinygltf::Primitive out;
    out.mode = TINYGLTF_MODE_TRIANGLES;
    out.material = static_cast<int>(surface.material);
    out.attributes["POSITION"] = add_positions(model, surface.positions);
    out.attributes["NORMAL"] = add_accessor(model, surface.normals, TINYGLTF_TYPE_VEC3, k_floats, k_vertices);
    if (!surface.uvs.empty())
        out.attributes["TEXCOORD_0"] =
            add_accessor(model, surface.uvs, TINYGLTF_TYPE_VEC2, k_floats, k_vertices);
    if (std::any_of(surface.colours.begin(), surface.colours.end(),
                    [&](uint32_t c) { return c != material.colour; })) {
        std::vector<std::array<uint16_t, 4>> shares;
        shares.reserve(surface.colours.size());
        for (uint32_t colour : surface.colours) shares.push_back(share_of(colour, material.colour));
        out.attributes["COLOR_0"] = add_accessor(model, shares, TINYGLTF_TYPE_VEC4,
                                                 TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, k_vertices, true);
    }
    out.indices = add_accessor(model, surface.indices, TINYGLTF_TYPE_SCALAR,
                               TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    return out;
}

void add_material(tinygltf::Model& model, const StillMaterial& m) {
    tinygltf::Material out;
    out.name = m.name;
    auto& pbr = out.pbrMetallicRoughness;
    pbr.baseColorFactor = {1, 1, 1, 1};
    for (int i = 0; i < 3; ++i)
        pbr.baseColorFactor[static_cast<size_t>(i)] = static_cast<double>(light_of(m.colour, 8 * i));
    pbr.roughnessFactor = static_cast<double>(m.roughness);
    pbr.metallicFactor = static_cast<double>(m.metallic);
    pbr.baseColorTexture.index = m.picture;
    if (m.is_cut) out.alphaMode = "MASK";
    model.materials.push_back(out);
}

}  // namespace

std::string still_glb(const StillModel& still) {
    tinygltf::Model model = begin_glb();
    tinygltf::Scene scene;
    for (const StillMaterial& m : still.materials) add_material(model, m);
    for (const Scenery::Picture& p : still.pictures) add_texture(model, p.rgba, p.width, p.height);
    for (const StillMesh& m : still.meshes) {
        tinygltf::Mesh mesh;
        mesh.name = m.name;
        for (const StillSurface& surface : m.surfaces)
            if (!surface.indices.empty())
                mesh.primitives.push_back(add_surface(model, surface, still.materials[surface.material]));
        if (mesh.primitives.empty()) continue;
        tinygltf::Node node;
        node.name = m.name;
        node.mesh = static_cast<int>(model.meshes.size());
        scene.nodes.push_back(static_cast<int>(model.nodes.size()));
        model.meshes.push_back(mesh);
        model.nodes.push_back(node);
    }
    model.scenes.push_back(scene);
    model.defaultScene = 0;
    return finish_glb(model);
}

}  // namespace flaneur
