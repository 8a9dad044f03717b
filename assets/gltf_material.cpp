#include "assets/gltf_material.h"

#include <stb/stb_image.h>
#include <stb/stb_image_resize.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <bit>
#include <memory>
#include <string>

#include "sim/base/math.h"

namespace flaneur {

namespace {

constexpr int k_most_edge = 1024;          // texels of what is kept: nobody in a crowd shows more
constexpr int k_most_pixels = 32'000'000;  // of one image
constexpr int k_opaque = 0;                // cuts nothing away

// What is told of a material, by whichever way it is told.
struct Look {
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

// pbrMetallicRoughness, or the older KHR_materials_pbrSpecularGlossiness where only that has something to
// say.
Look look_of(const tinygltf::Material& material) {
    const auto& pbr = material.pbrMetallicRoughness;
    Look look{nullptr, pbr.baseColorFactor, pbr.baseColorTexture.index, pbr.baseColorTexture.texCoord};
    auto moved = [](const tinygltf::ExtensionMap& map) {
        auto found = map.find("KHR_texture_transform");
        return found == map.end() ? nullptr : &found->second;
    };
    look.extension = moved(pbr.baseColorTexture.extensions);
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

struct FreePixels {
    void operator()(unsigned char* p) const { stbi_image_free(p); }
};

// Why it cannot be shown; empty if it can.
std::string decode(const std::vector<unsigned char>& bytes, int& pixels_left, Texture& texture) {
    auto begins = [&](std::initializer_list<unsigned char> magic) {
        return bytes.size() > magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin());
    };
    if (bytes.empty()) return "is not to be had";
    if (!begins({0x89, 'P', 'N', 'G'}) && !begins({0xff, 0xd8, 0xff})) return "is neither PNG nor JPEG";
    int size = int(bytes.size()), width = 0, height = 0, channels = 0;
    if (!stbi_info_from_memory(bytes.data(), size, &width, &height, &channels) || width <= 0 || height <= 0)
        return "cannot be decoded";
    if (height > k_most_pixels / width) return "has more than 32 million pixels";
    if (width * height > pixels_left) return "is more than can be kept";
    pixels_left -= width * height;
    std::unique_ptr<unsigned char, FreePixels> pixels(
        stbi_load_from_memory(bytes.data(), size, &width, &height, &channels, 4));
    if (!pixels) return "cannot be decoded";
    texture.width = std::min(width, k_most_edge);
    texture.height = std::min(height, k_most_edge);
    texture.rgba.resize(size_t(texture.width) * size_t(texture.height) * 4);
    if (texture.width == width && texture.height == height) {
        std::copy_n(pixels.get(), texture.rgba.size(), texture.rgba.begin());
    } else if (!stbir_resize_uint8_srgb(pixels.get(), width, height, 0, texture.rgba.data(), texture.width,
                                        texture.height, 0, 4, 3, 0)) {
        return "is too large";
    }
    return {};
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

uint16_t texture_of(const tinygltf::Model& model, int index, int cut, GltfScene& scene,
                    KnownTextures& known) {
    constexpr uint16_t k_none = CharacterVertex::k_no_texture;
    if (index < 0 || size_t(index) >= model.textures.size()) return k_none;
    int image = model.textures[size_t(index)].source;
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
    Look look = look_of(m);
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
    if (look.texture >= 0 && surface.visible)
        surface.texture = texture_of(model, look.texture, cut, scene, known);
    return surface;
}

}  // namespace flaneur
