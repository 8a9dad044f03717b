// What the surfaces of a glTF file look like: base colours and their textures.
#pragma once

#include <map>
#include <utility>

#include "assets/gltf/read.h"

namespace flaneur {

struct GltfSurface {
    Vec3 colour{1, 1, 1};  // linear
    bool visible = true;   // not where it is more than half transparent
    bool two_sided = false;
    uint16_t texture = CharacterVertex::k_no_texture;
    int texcoord = 0;  // which set, 0..7
    // A vertex's own u and v to the texture's: KHR_texture_transform.
    Vec2 u_axis{1, 0}, v_axis{0, 1}, origin{0, 0};  // x = u, z = v
};

struct KnownTextures {
    std::map<std::pair<int, int>, uint16_t>
        slots;                        // by image and by the alpha, 0..255, below which it is cut away
    size_t pixels_left = 64'000'000;  // to decode
    size_t most = 64;
};

// Decodes the texture, at its first use, into scene.textures; says in scene.notes what cannot be shown.
GltfSurface surface_of(const tinygltf::Model& model, int material, GltfScene& scene, KnownTextures& known);

}  // namespace flaneur
