#include "assets/gltf/material.h"

#include <stb/stb_image_resize.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <bit>
#include <string>

#include "assets/files/picture.h"
#include "sim/base/math.h"

namespace flaneur {

namespace {

constexpr int k_most_edge = 1024;             // texels of what is kept: nobody in a crowd shows more
constexpr size_t k_most_pixels = 32'000'000;  // of one image
constexpr size_t k_least_breadth = 128;       // that one to be shrunk counts as having: a strip takes as long
constexpr int k_opaque = 0;                   // cuts nothing away

// What is told of a material, by whichever way it is told.
struct GltfLook {
    const tinygltf::Value* extension = nullptr;  // KHR_texture_transform
    std::vector<double> factor;
    int texture = -1, texcoord = 0;
};

double number(const tinygltf::Value& object, const char* key, double otherwise) {
    if (!object.IsObject() || !object.Has(key) || !object.Get(key).IsNumber()) return otherwise;
    double v = object.Get(key).GetNumberAsDouble();
    return v > -1e6 && v < 1e6 ? v : otherwise;
}

double entry(const tinygltf::Value& object, const char* key, int index, double otherwise) {
    if (!object.IsObject() || !object.Has(key)) return otherwise;
    const tinygltf::Value& array = object.Get(key);
    if (!array.IsArray() || size_t(index) >= array.ArrayLen() || !array.Get(index).IsNumber())
        return otherwise;
    double v = array.Get(index).GetNumberAsDouble();
    return v > -1e6 && v < 1e6 ? v : otherwise;
}

const tinygltf::Value* find_extension(const tinygltf::ExtensionMap& map, const char* name) {
    auto found = map.find(name);
    return found == map.end() || !found->second.IsObject() ? nullptr : &found->second;
}

// What is black and glows, as surfaces do that were lit when they were made, has its colour from the glow.
void take_glow(const tinygltf::Material& material, GltfLook& look) {
    bool black = look.factor.size() >= 3 && std::max({look.factor[0], look.factor[1], look.factor[2]}) < 1e-3;
    bool glows = material.emissiveFactor.size() == 3 &&
                 *std::max_element(material.emissiveFactor.begin(), material.emissiveFactor.end()) > 0;
    if (!black || !glows || look.texture >= 0) return;
    const auto* extension = find_extension(material.extensions, "KHR_materials_emissive_strength");
    double strength = extension ? number(*extension, "emissiveStrength", 1) : 1;
    for (size_t i = 0; i < 3; ++i) look.factor[i] = material.emissiveFactor[i] * strength;
    look.texture = material.emissiveTexture.index;
    look.texcoord = material.emissiveTexture.texCoord;
    look.extension = find_extension(material.emissiveTexture.extensions, "KHR_texture_transform");
}

// pbrMetallicRoughness, or the older KHR_materials_pbrSpecularGlossiness where only that has something to
// say.
GltfLook look_of(const tinygltf::Material& material) {
    const auto& pbr = material.pbrMetallicRoughness;
    GltfLook look{nullptr, pbr.baseColorFactor, pbr.baseColorTexture.index, pbr.baseColorTexture.texCoord};
    look.extension = find_extension(pbr.baseColorTexture.extensions, "KHR_texture_transform");
    take_glow(material, look);
    auto old = material.extensions.find("KHR_materials_pbrSpecularGlossiness");
    if (old == material.extensions.end() || look.texture >= 0 || !old->second.IsObject()) return look;
    for (int i = 0; i < 4; ++i) {
        if (look.factor.size() < 4) look.factor.resize(4, 1);
        look.factor[size_t(i)] = entry(old->second, "diffuseFactor", i, 1);
    }
    if (!old->second.Has("diffuseTexture")) return look;
    const tinygltf::Value& texture = old->second.Get("diffuseTexture");
    look.texture = int(number(texture, "index", -1));
    look.texcoord = int(number(texture, "texCoord", 0));
    return look;
}

void move_uvs(const tinygltf::Value& transform, GltfSurface& surface) {
    auto at = [&](const char* key, int i, double otherwise) {
        return float(entry(transform, key, i, otherwise));
    };
    Vec2 scale{at("scale", 0, 1), at("scale", 1, 1)};
    SinCos turn = sin_cos(clamp(float(number(transform, "rotation", 0)), -100, 100));
    surface.origin = {at("offset", 0, 0), at("offset", 1, 0)};
    surface.u_axis = {turn.cosine * scale.x, turn.sine * scale.z};
    surface.v_axis = {-turn.sine * scale.x, turn.cosine * scale.z};
    surface.texcoord = int(number(transform, "texCoord", surface.texcoord));
}

// Why it cannot be shown; empty if it can.
std::string decode(const std::vector<unsigned char>& bytes, size_t& pixels_left, Texture& texture) {
    if (bytes.empty()) return "is not to be had";
    size_t most = std::min(k_most_pixels, pixels_left), pixels = 0;
    auto picture = decode_picture(bytes, most, &pixels);
    pixels_left -= pixels;
    if (!picture) return picture.error().message;
    texture.width = std::min(picture->width, k_most_edge);
    texture.height = std::min(picture->height, k_most_edge);
    if (texture.width == picture->width && texture.height == picture->height) {
        texture.rgba = std::move(picture->rgba);
        return {};
    }
    size_t more = size_t(std::max(picture->width, picture->height)) * k_least_breadth;
    more -= std::min(more, pixels);
    if (pixels + more > most) return "is too long for its breadth";
    pixels_left -= more;
    texture.rgba.resize(size_t(texture.width) * size_t(texture.height) * 4);
    bool fits = stbir_resize_uint8_srgb(picture->rgba.data(), picture->width, picture->height, 0,
                                        texture.rgba.data(), texture.width, texture.height, 0, 4, 3, 0);
    return fits ? "" : "is too large";
}

// Brings the alpha at which a texture is cut to the middle, where the renderer cuts.
void set_alpha(Texture& texture, int cut) {
    for (size_t i = 3; i < texture.rgba.size(); i += 4) {
        int alpha = texture.rgba[i];
        if (cut == k_opaque)
            alpha = 255;
        else
            alpha = alpha >= cut ? 255 - (255 - alpha) * 127 / std::max(256 - cut, 1) : alpha * 127 / cut;
        texture.rgba[i] = uint8_t(alpha);
    }
}

// EXT_texture_webp's where there is one; one that only KHR_texture_basisu names will be refused by name.
int image_of(const tinygltf::Texture& texture) {
    const auto* webp = find_extension(texture.extensions, "EXT_texture_webp");
    const auto* basis = find_extension(texture.extensions, "KHR_texture_basisu");
    if (webp) return int(number(*webp, "source", texture.source));
    return texture.source < 0 && basis ? int(number(*basis, "source", -1)) : texture.source;
}

uint16_t texture_of(const tinygltf::Model& model, int index, int cut, GltfScene& scene,
                    KnownTextures& known) {
    constexpr uint16_t k_none = CharacterVertex::k_no_texture;
    if (index < 0 || size_t(index) >= model.textures.size()) return k_none;
    int image = image_of(model.textures[size_t(index)]);
    auto [slot, is_new] = known.slots.insert({{image, cut}, k_none});
    if (!is_new) return slot->second;
    Texture texture;
    std::string why = "is not to be had";
    if (image >= 0 && size_t(image) < model.images.size())
        why = decode(model.images[size_t(image)].image, known.pixels_left, texture);
    if (why.empty() && scene.textures.size() >= known.most) why = "is one too many";
    if (!why.empty()) {
        scene.notes.push_back("Image " + std::to_string(image) + " " + why + "; its surfaces go plain.");
        return k_none;
    }
    set_alpha(texture, cut);
    slot->second = uint16_t(scene.textures.size());
    scene.textures.push_back(std::move(texture));
    return slot->second;
}

}  // namespace

GltfSurface surface_of(const tinygltf::Model& model, int material, GltfScene& scene, KnownTextures& known) {
    GltfSurface surface;
    if (material < 0 || size_t(material) >= model.materials.size()) return surface;
    const tinygltf::Material& m = model.materials[size_t(material)];
    GltfLook look = look_of(m);
    auto unit = [](double v) { return v > 0 ? float(std::min(v, 1.0)) : 0.0f; };
    if (look.factor.size() >= 3)
        surface.colour = {unit(look.factor[0]), unit(look.factor[1]), unit(look.factor[2])};
    // Assimp writes black beside a texture, and means white.
    if (look.texture >= 0 && length(surface.colour) < 1e-3f) surface.colour = {1, 1, 1};
    surface.two_sided = m.doubleSided;
    int cut = k_opaque;
    if (m.alphaMode == "MASK" || m.alphaMode == "BLEND") {
        float alpha = look.factor.size() == 4 ? unit(look.factor[3]) : 1;
        float least = m.alphaMode == "MASK" ? unit(m.alphaCutoff) : 0.5f;
        surface.visible = alpha >= least;
        cut = alpha > 0 ? int(clamp(255 * least / alpha, 1, 255)) : 1;
    }
    surface.texcoord = look.texcoord;
    if (look.extension) move_uvs(*look.extension, surface);
    if (surface.texcoord < 0 || surface.texcoord > 7) surface.texcoord = 0;
    if (look.texture >= 0 && surface.visible)
        surface.texture = texture_of(model, look.texture, cut, scene, known);
    return surface;
}

}  // namespace flaneur
