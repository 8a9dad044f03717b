#include "assets/gltf/mesh.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>

#include "assets/gltf/accessor.h"
#include "assets/gltf/material.h"
#include "assets/gltf/sheets.h"

namespace flaneur {

namespace {

// sRGB's transfer curve by square roots, within 0.4 % (no libm: the same bits everywhere).
uint32_t to_srgb_byte(float linear) {
    float a = std::sqrt(clamp(linear, 0, 1)), b = std::sqrt(a), c = std::sqrt(b);
    float s = linear < 0.0031308f ? 12.92f * std::max(linear, 0.0f)
                                  : 0.585122381f * a + 0.783140355f * b - 0.368262736f * c;
    return uint32_t(clamp(s * 255 + 0.5f, 0, 255));
}

std::vector<uint32_t> as_triangles(const std::vector<uint32_t>& in, int mode) {
    if (mode == TINYGLTF_MODE_TRIANGLES || mode == -1)
        return std::vector<uint32_t>(in.begin(), in.end() - std::ptrdiff_t(in.size() % 3));
    std::vector<uint32_t> out;
    for (size_t i = 2; i < in.size(); ++i) {
        if (mode == TINYGLTF_MODE_TRIANGLE_FAN)
            out.insert(out.end(), {in[0], in[i - 1], in[i]});
        else if (i % 2 == 0)
            out.insert(out.end(), {in[i - 2], in[i - 1], in[i]});
        else
            out.insert(out.end(), {in[i - 1], in[i - 2], in[i]});
    }
    return out;
}

// Sets of four influences: JOINTS_0/WEIGHTS_0, then JOINTS_1/WEIGHTS_1.
Result<void> read_influences(const tinygltf::Model& model, const tinygltf::Primitive& source,
                             const std::string& what, GltfPrimitive& out) {
    size_t count = out.positions.size();
    for (int set = 0; set < 2; ++set) {
        auto joints = source.attributes.find("JOINTS_" + std::to_string(set));
        auto weights = source.attributes.find("WEIGHTS_" + std::to_string(set));
        if (joints == source.attributes.end() || weights == source.attributes.end()) break;
        auto j = read_accessor(model, joints->second, "the joints of " + what, count);
        auto w = read_accessor(model, weights->second, "the weights of " + what, count);
        if (!j) return j.error();
        if (!w) return w.error();
        if (j->count != count || w->count != count || j->components != 4 || w->components != 4)
            return Error{what + " has joints or weights that do not fit its vertices"};
        std::vector<GltfPrimitive::Influence> wider;
        for (size_t v = 0; v < count; ++v) {
            for (int i = 0; i < 4 * set; ++i)
                wider.push_back(out.influences[v * size_t(4 * set) + size_t(i)]);
            for (size_t i = 0; i < 4; ++i) {
                float joint = j->values[v * 4 + i], weight = w->values[v * 4 + i];
                if (!(joint >= 0 && joint < 65536)) return Error{what + " has a joint index out of range"};
                wider.push_back({uint16_t(joint), std::max(weight, 0.0f)});
            }
        }
        out.influences = std::move(wider);
        out.influences_per_vertex = 4 * (set + 1);
    }
    return {};
}

Result<void> read_colours(const tinygltf::Model& model, const tinygltf::Primitive& source,
                          const std::string& what, Vec3 factor, GltfPrimitive& out) {
    AccessorData colours;
    if (auto found = source.attributes.find("COLOR_0"); found != source.attributes.end()) {
        auto data = read_accessor(model, found->second, "the colours of " + what, out.positions.size());
        if (!data) return data.error();
        if (data->count == out.positions.size() && data->components >= 3) colours = std::move(*data);
    }
    for (size_t v = 0; v < out.positions.size(); ++v) {
        Vec3 c = factor;
        if (colours.count > 0) {
            const float* p = &colours.values[v * size_t(colours.components)];
            c = {c.x * p[0], c.y * p[1], c.z * p[2]};
        }
        out.colours.push_back(0xff000000u | to_srgb_byte(c.z) << 16 | to_srgb_byte(c.y) << 8 |
                              to_srgb_byte(c.x));
    }
    return {};
}

Result<GltfPrimitive> read_primitive(const tinygltf::Model& model, const tinygltf::Primitive& source,
                                     const std::string& what, const GltfSurface& surface,
                                     size_t most_vertices) {
    GltfPrimitive out;
    out.material = source.material;
    out.two_sided = surface.two_sided;
    // As many as there are positions, if there are any.
    auto vectors = [&](const char* name, int components, size_t count) -> Result<AccessorData> {
        auto found = source.attributes.find(name);
        if (found == source.attributes.end()) return AccessorData{};
        bool first = count == 0;
        auto data = read_accessor(model, found->second, std::string(name) + " of " + what,
                                  first ? most_vertices : count);
        if (data && data->components != components)
            return Error{std::string(name) + " of " + what + " has a wrong type; export it again"};
        if (data && !first && data->count != count)
            return Error{std::string(name) + " of " + what + " is there for " + std::to_string(data->count) +
                         " of " + std::to_string(count) + " vertices; export it again"};
        return data;
    };
    auto positions = vectors("POSITION", 3, 0);
    if (!positions) return positions.error();
    if (positions->count == 0) return out;
    auto normals = vectors("NORMAL", 3, positions->count);
    if (!normals) return normals.error();
    for (size_t v = 0; v < positions->count; ++v) {
        const float* p = &positions->values[v * 3];
        out.positions.push_back({p[0], p[1], p[2]});
    }
    if (normals->count == positions->count)
        for (size_t v = 0; v < normals->count; ++v) {
            const float* p = &normals->values[v * 3];
            out.normals.push_back(normalize_or({p[0], p[1], p[2]}, {0, 1, 0}));
        }

    auto uvs = vectors(("TEXCOORD_" + std::to_string(surface.texcoord)).c_str(), 2, positions->count);
    if (!uvs) return uvs.error();
    if (uvs->count == positions->count && surface.texture != CharacterVertex::k_no_texture) {
        for (size_t v = 0; v < uvs->count; ++v) {
            Vec2 uv{uvs->values[v * 2], uvs->values[v * 2 + 1]};
            out.uvs.push_back(surface.origin + Vec2{dot(surface.u_axis, uv), dot(surface.v_axis, uv)});
        }
        out.texture = surface.texture;
    }
    if (auto done = read_colours(model, source, what, surface.colour, out); !done) return done.error();
    if (auto done = read_influences(model, source, what, out); !done) return done.error();

    std::vector<uint32_t> indices;
    if (source.indices >= 0) {
        auto data = read_indices(model, source.indices, "the indices of " + what);
        if (!data) return data.error();
        indices = std::move(*data);
        for (uint32_t i : indices)
            if (i >= out.positions.size()) return Error{what + " has an index beyond its vertices"};
    } else {
        for (size_t i = 0; i < out.positions.size(); ++i) indices.push_back(uint32_t(i));
    }
    out.indices = as_triangles(indices, source.mode);
    return out;
}

}  // namespace

Result<std::vector<std::vector<GltfPrimitive>>> read_meshes(const tinygltf::Model& model, const GltfUse& use,
                                                            GltfScene& scene) {
    std::vector<std::vector<GltfPrimitive>> meshes(model.meshes.size());
    KnownTextures known;
    known.most = use.most_textures;
    size_t vertices = 0, corners = 0, morphed = 0;
    for (size_t m = 0; m < model.meshes.size(); ++m)
        for (size_t p = 0; p < model.meshes[m].primitives.size(); ++p) {
            const tinygltf::Primitive& source = model.meshes[m].primitives[p];
            bool triangles = source.mode == -1 || (source.mode >= TINYGLTF_MODE_TRIANGLES &&
                                                   source.mode <= TINYGLTF_MODE_TRIANGLE_FAN);
            if (!triangles) continue;
            std::string what = "mesh " + std::to_string(m) + ", primitive " + std::to_string(p);
            GltfSurface surface = surface_of(model, source.material, scene, known);
            if (!surface.visible) continue;
            auto primitive = read_primitive(model, source, what, surface, use.most_vertices);
            if (!primitive) return primitive.error();
            if (primitive->positions.empty()) continue;
            add_backs(*primitive);
            morphed += !source.targets.empty();
            vertices += primitive->positions.size();
            corners += primitive->indices.size();
            if (vertices > use.most_vertices || corners > use.most_corners) return too_much(use);
            meshes[m].push_back(std::move(*primitive));
        }
    if (morphed > 0)
        scene.notes.push_back("The morph targets of " + std::to_string(morphed) +
                              " surfaces are left out; they keep the shape at rest.");
    return meshes;
}

}  // namespace flaneur
