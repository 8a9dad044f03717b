// A glTF 2.0 file as plain, validated data: what characters and cities need of it and nothing else.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "assets/character.h"
#include "assets/gltf/affine.h"

namespace tinygltf {
class Model;
}

namespace flaneur {

struct GltfNode {
    std::string name;
    int parent = -1, mesh = -1, skin = -1;
    Affine local, world;  // at rest
    bool shown = true;    // part of the scene that the file opens with
};

struct GltfSkin {
    std::vector<int> joints;            // nodes
    std::vector<Affine> inverse_binds;  // one a joint
};

struct GltfPrimitive {
    std::vector<Vec3> positions, normals;  // normals may be empty
    std::vector<Vec2> uvs;                 // may be empty; x = u, z = v
    std::vector<uint32_t> colours;         // sRGB, one a vertex, the material's factor included
    struct Influence {
        uint16_t joint;  // index into the skin's joints
        float weight;
    };
    std::vector<Influence> influences;  // influences_per_vertex for each vertex; empty: no skin
    int influences_per_vertex = 0;
    std::vector<uint32_t> indices;  // triangles
    uint16_t texture = CharacterVertex::k_no_texture;
    int material = -1;
    bool two_sided = false;
};

struct GltfScene {
    std::vector<GltfNode> nodes;
    std::vector<GltfSkin> skins;
    std::vector<std::vector<GltfPrimitive>> meshes;
    std::vector<Texture> textures;
    std::vector<std::string>
        humanoid;                    // by node: the bone's name where a VRM extension gives one, else empty
    std::vector<std::string> clips;  // animations, by name or "animation 3"
    std::vector<std::string> notes;
};

// How much is taken in.
struct GltfUse {
    size_t most_vertices, most_corners, most_textures;
};
inline constexpr GltfUse k_character_use = {1'000'000, 8'000'000, 64};
inline constexpr GltfUse k_city_use = {4'000'000, 24'000'000, 256};

// What to say of more vertices or triangles than that.
Error too_much(const GltfUse& use);

// The file as tinygltf reads it, unchecked but for its size; images are encoded still. Refuses, in a sentence
// that begins with `path`, what cannot be read.
Result<tinygltf::Model> parse_gltf(const std::string& path);
// The same from memory; other files that it names are looked for in `folder`.
Result<tinygltf::Model> parse_gltf(std::span<const uint8_t> bytes, const std::string& folder,
                                   const std::string& path);

// Refuses, in a sentence that begins with `path`, what breaks the format where it matters.
Result<GltfScene> read_scene(const tinygltf::Model& model, const std::string& path,
                             const GltfUse& use = k_character_use);

}  // namespace flaneur
