// What surfaces look like, told in each of the ways that a file may tell it.
#include <gtest/gtest.h>
#include <tiny_gltf.h>
#include <webp/encode.h>

#include <set>

#include "assets/files/picture.h"
#include "assets/gltf/character/character.h"
#include "sim/base/math.h"
#include "tests/assets/tiny_man.h"

namespace flaneur {
namespace {

Result<Character> read(const TinyMan& man) {
    auto model = parse_gltf(as_glb(man), "/nowhere", "man.glb");
    return model ? make_character(*model, "man.glb") : model.error();
}

Character loaded(const TinyMan& man) {
    auto character = read(man);
    EXPECT_TRUE(character) << character.error().message;
    return std::move(*character);
}

Json& primitive(TinyMan& man) { return man.gltf["meshes"][0]["primitives"][0]; }
size_t vertices_of(TinyMan& man) { return man.gltf["accessors"][tiny_positions]["count"]; }

void add_material(TinyMan& man, Json material) {
    primitive(man)["material"] = man.gltf["materials"].size();
    man.gltf["materials"].push_back(std::move(material));
}

// The same u and v for all vertices.
void add_uvs(TinyMan& man, const char* set, float u, float v) {
    std::vector<float> uvs;
    for (size_t i = 0; i < vertices_of(man); ++i) uvs.insert(uvs.end(), {u, v});
    primitive(man)["attributes"][set] = add_accessor(man, uvs, "VEC2");
}

std::string data_uri(const char* kind, const std::string& bytes) {
    return std::string("data:image/").append(kind) + ";base64," + as_base64({bytes.begin(), bytes.end()});
}

std::string one_texel(uint8_t red, bool webp) {
    const uint8_t k_texel[] = {red, 20, 30, 255};
    if (!webp) return encode_png(k_texel, 1, 1, 4);
    uint8_t* packed = nullptr;
    size_t size = WebPEncodeLosslessRGBA(k_texel, 1, 1, 4, &packed);
    std::string out(reinterpret_cast<const char*>(packed), size);
    WebPFree(packed);
    return out;
}

// A man with a texture of one texel, red as told.
TinyMan textured_man() {
    TinyMan man = tiny_man();
    man.gltf["images"] = {{{"uri", data_uri("png", one_texel(10, false))}}};
    man.gltf["textures"] = {{{"source", 0}}};
    add_uvs(man, "TEXCOORD_0", 0.25f, 0.5f);
    add_material(man, {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    return man;
}
Json& base_texture(TinyMan& man) {
    return man.gltf["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
}

Vec3 colour_of(const Character& c) {
    uint32_t colour = c.vertices[0].colour;
    for (const CharacterVertex& v : c.vertices) EXPECT_EQ(v.colour, colour);
    return {float(colour & 255), float(colour >> 8 & 255), float(colour >> 16 & 255)};
}

bool noted(const Character& c, const std::string& what) {
    for (const std::string& note : c.notes)
        if (note.find(what) != std::string::npos) return true;
    return false;
}

TEST(GltfSurface, WebpIsRead) {
    TinyMan man = textured_man();
    man.gltf["images"].push_back({{"uri", data_uri("webp", one_texel(90, true))}});
    man.gltf["textures"][0]["extensions"]["EXT_texture_webp"]["source"] = 1;
    man.gltf["extensionsRequired"] = {"EXT_texture_webp"};
    Character c = loaded(man);
    ASSERT_EQ(c.textures.size(), 1u);
    EXPECT_EQ(c.textures[0].rgba[0], 90);
    man.gltf["textures"][0].erase("source");
    c = loaded(man);
    ASSERT_EQ(c.textures.size(), 1u);
    EXPECT_EQ(c.textures[0].rgba[0], 90);
}

TEST(GltfSurface, BasisIsNotReadAndNamed) {
    TinyMan man = textured_man();
    man.gltf["images"].push_back({{"uri", data_uri("ktx2", "\xabKTX 20\xbb\r\n\x1a\n and so on")}});
    Json& texture = man.gltf["textures"][0];
    texture["extensions"]["KHR_texture_basisu"]["source"] = 1;
    EXPECT_EQ(loaded(man).textures.size(), 1u) << "the picture to fall back to";
    texture.erase("source");
    EXPECT_TRUE(noted(loaded(man), "Image 1 is a KTX texture"));
    man.gltf["extensionsRequired"] = {"KHR_texture_basisu"};
    auto character = read(man);
    ASSERT_FALSE(character);
    EXPECT_NE(character.error().message.find("KHR_texture_basisu"), std::string::npos);
    EXPECT_NE(character.error().message.find("PNG, JPEG or WebP"), std::string::npos);
}

TEST(GltfSurface, RequiredExtensionsAreReadOrRefusedFirst) {
    for (const char* name :
         {"KHR_texture_transform", "KHR_materials_unlit", "KHR_materials_emissive_strength",
          "KHR_materials_variants", "KHR_mesh_quantization", "VRMC_vrm", "KHR_materials_clearcoat",
          "KHR_lights_punctual"}) {
        TinyMan man = tiny_man();
        man.gltf["extensionsRequired"] = {name};
        EXPECT_TRUE(read(man)) << name;
    }
    for (const char* name :
         {"KHR_materials_magic", "EXT_texture_avif", "VRMC_magic", "EXT_mesh_gpu_instancing"}) {
        TinyMan man = tiny_man();
        man.gltf["extensionsRequired"] = {"KHR_texture_transform", name};
        man.gltf["nodes"] = 3;  // of which nothing is said before the extension
        auto character = read(man);
        ASSERT_FALSE(character) << name;
        EXPECT_NE(character.error().message.find(std::string("requires the extension ") + name),
                  std::string::npos)
            << character.error().message;
    }
}

// The matrix of the extension's text: turned against the clock as seen with v down, after scaling.
TEST(GltfSurface, TexturesAreMovedTurnedAndScaled) {
    TinyMan man = textured_man();
    base_texture(man)["extensions"]["KHR_texture_transform"] = {
        {"offset", {0.5, 0.25}}, {"rotation", double(k_pi / 2)}, {"scale", {2, 4}}, {"texCoord", 1}};
    add_uvs(man, "TEXCOORD_1", 0.25f, 0.125f);
    Character c = loaded(man);
    EXPECT_NEAR(c.vertices[0].u, 0.5f + 4 * 0.125f, 1e-5f);
    EXPECT_NEAR(c.vertices[0].v, 0.25f - 2 * 0.25f, 1e-5f);
}

TEST(GltfSurface, UvSetsAreTold) {
    TinyMan man = textured_man();
    add_uvs(man, "TEXCOORD_1", 0.75f, 0.5f);
    add_uvs(man, "TEXCOORD_2", 0.9f, 0.1f);
    for (auto [set, u] : {std::pair{0, 0.25f}, {1, 0.75f}, {2, 0.9f}}) {
        base_texture(man)["texCoord"] = set;
        EXPECT_FLOAT_EQ(loaded(man).vertices[0].u, u) << set;
    }
}

TEST(GltfSurface, ColoursAreFactorsTimesVertices) {
    TinyMan plain = tiny_man();
    add_material(plain, {{"pbrMetallicRoughness", {{"baseColorFactor", {1, 0.5, 0, 1}}}}});
    Vec3 factor = colour_of(loaded(plain));
    EXPECT_NEAR(factor.x, 255, 1);
    EXPECT_NEAR(factor.y, 188, 1);
    EXPECT_NEAR(factor.z, 0, 1);

    // 0.5 of the red, as each type that a file may have.
    size_t count = vertices_of(plain);
    std::vector<float> floats;
    std::vector<uint16_t> shorts;
    std::vector<uint8_t> bytes;
    for (size_t i = 0; i < count; ++i) {
        floats.insert(floats.end(), {0.5f, 1, 1});
        shorts.insert(shorts.end(), {32768, 65535, 65535, 65535});
        bytes.insert(bytes.end(), {128, 255, 255, 255});
    }
    for (int kind = 0; kind < 3; ++kind) {
        TinyMan man = plain;
        int accessor = kind == 0   ? add_accessor(man, floats, "VEC3")
                       : kind == 1 ? add_accessor(man, shorts, "VEC4")
                                   : add_accessor(man, bytes, "VEC4");
        man.gltf["accessors"][size_t(accessor)]["normalized"] = kind > 0;
        primitive(man)["attributes"]["COLOR_0"] = accessor;
        Vec3 colour = colour_of(loaded(man));
        EXPECT_NEAR(colour.x, 188, 1) << kind;
        EXPECT_NEAR(colour.y, factor.y, 1) << kind;
    }
}

TEST(GltfSurface, WithoutItsTextureAMaterialKeepsItsFactor) {
    TinyMan man = textured_man();
    man.gltf["images"][0]["uri"] = "away.png";
    man.gltf["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {0, 0.5, 1, 1};
    Character c = loaded(man);
    EXPECT_TRUE(c.textures.empty());
    Vec3 colour = colour_of(c);
    EXPECT_NEAR(colour.x, 0, 1);
    EXPECT_NEAR(colour.y, 188, 1);
}

TEST(GltfSurface, UnlitIsAsItsBaseColour) {
    TinyMan man = tiny_man();
    add_material(man, {{"pbrMetallicRoughness", {{"baseColorFactor", {0, 1, 0, 1}}}},
                       {"extensions", {{"KHR_materials_unlit", Json::object()}}}});
    man.gltf["extensionsRequired"] = {"KHR_materials_unlit"};
    EXPECT_EQ(colour_of(loaded(man)), (Vec3{0, 255, 0}));
}

TEST(GltfSurface, BlackThatGlowsHasTheGlowsColour) {
    TinyMan man = tiny_man();
    add_material(man, {{"pbrMetallicRoughness", {{"baseColorFactor", {0, 0, 0, 1}}}},
                       {"emissiveFactor", {0.25, 0, 0}},
                       {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 2}}}}}});
    EXPECT_NEAR(colour_of(loaded(man)).x, 188, 1);
    man.gltf["materials"][0].erase("extensions");
    EXPECT_NEAR(colour_of(loaded(man)).x, 137, 2);
    man.gltf["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {0, 1, 0, 1};
    EXPECT_EQ(colour_of(loaded(man)), (Vec3{0, 255, 0})) << "what has a colour keeps it";

    TinyMan screen = textured_man();
    Json texture = base_texture(screen);
    screen.gltf["materials"][0] = {{"pbrMetallicRoughness", {{"baseColorFactor", {0, 0, 0, 1}}}},
                                   {"emissiveFactor", {1, 1, 1}},
                                   {"emissiveTexture", texture}};
    EXPECT_EQ(loaded(screen).textures.size(), 1u);
}

TEST(GltfSurface, OfVariantsTheDefaultIsShown) {
    TinyMan man = tiny_man();
    auto plain = [](double r, double g) {
        return Json{{"pbrMetallicRoughness", {{"baseColorFactor", {r, g, 0, 1}}}}};
    };
    add_material(man, plain(0, 1));
    add_material(man, plain(1, 0));
    man.gltf["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "green"}}, {{"name", "red"}}};
    primitive(man)["extensions"]["KHR_materials_variants"]["mappings"] = {
        {{"material", 0}, {"variants", {0}}}};
    man.gltf["extensionsRequired"] = {"KHR_materials_variants"};
    EXPECT_EQ(colour_of(loaded(man)), (Vec3{255, 0, 0}));
}

// Normals as bytes, u and v as shares of 65535.
TEST(GltfSurface, QuantisedAttributesAreRead) {
    TinyMan man = textured_man();
    size_t count = vertices_of(man);
    std::vector<uint8_t> normals;
    std::vector<uint16_t> uvs;
    for (size_t i = 0; i < count; ++i) {
        normals.insert(normals.end(), {0, uint8_t(-127), 0, 0});
        uvs.insert(uvs.end(), {16384, 49151});
    }
    int normal = add_accessor(man, normals, "VEC4"), uv = add_accessor(man, uvs, "VEC2");
    Json& of_normals = man.gltf["accessors"][size_t(normal)];
    of_normals["componentType"] = 5120, of_normals["type"] = "VEC3", of_normals["normalized"] = true;
    man.gltf["bufferViews"][of_normals["bufferView"].get<size_t>()]["byteStride"] = 4;
    man.gltf["accessors"][size_t(uv)]["normalized"] = true;
    primitive(man)["attributes"]["NORMAL"] = normal;
    primitive(man)["attributes"]["TEXCOORD_0"] = uv;
    man.gltf["extensionsRequired"] = {"KHR_mesh_quantization"};
    Character c = loaded(man);
    for (uint32_t i : c.lods[0]) {  // coarser levels may have normals of their own
        const CharacterVertex& v = c.vertices[i];
        EXPECT_NEAR(v.normal.y, -1, 1e-3f);
        EXPECT_NEAR(v.u, 0.25f, 1e-3f);
        EXPECT_NEAR(v.v, 0.75f, 1e-3f);
    }
}

// Some values of a sparse accessor lie elsewhere, the others in its own view.
TEST(GltfSurface, SparseColoursAreRead) {
    TinyMan man = tiny_man();
    std::vector<float> green;
    for (size_t i = 0; i < vertices_of(man); ++i) green.insert(green.end(), {0, 1, 0});
    int colours = add_accessor(man, green, "VEC3"),
        indices = add_accessor(man, std::vector<uint16_t>{3, 9}, "SCALAR"),
        values = add_accessor(man, std::vector<float>{1, 0, 0, 1, 0, 0}, "VEC3");
    auto view = [&](int accessor) { return man.gltf["accessors"][size_t(accessor)]["bufferView"]; };
    man.gltf["accessors"][size_t(colours)]["sparse"] = {
        {"count", 2},
        {"indices", {{"bufferView", view(indices)}, {"componentType", 5123}}},
        {"values", {{"bufferView", view(values)}}}};
    primitive(man)["attributes"]["COLOR_0"] = colours;
    Character c = loaded(man);
    std::set<uint32_t> red, others;
    for (uint32_t i : c.lods[0]) (c.vertices[i].colour == 0xff0000ff ? red : others).insert(i);
    EXPECT_EQ(red.size(), 2u);
    EXPECT_EQ(others.size(), vertices_of(man) - 2);
}

}  // namespace
}  // namespace flaneur
