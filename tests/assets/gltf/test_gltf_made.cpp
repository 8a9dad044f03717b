// One man written in many ways is the same man.
#include <gtest/gtest.h>
#include <meshoptimizer.h>
#include <tiny_gltf.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "assets/files/picture.h"
#include "assets/gltf/character/character.h"
#include "sim/base/math.h"
#include "tests/assets/tiny_man.h"
#include "tests/folder.h"

namespace flaneur {
namespace {

Character loaded(const Bytes& bytes) {
    auto model = parse_gltf(bytes, "/nowhere", "man");
    EXPECT_TRUE(model) << model.error().message;
    auto character = make_character(*model, "man");
    EXPECT_TRUE(character) << character.error().message;
    return std::move(*character);
}
Character loaded(const TinyMan& man) { return loaded(as_glb(man)); }

void expect_same_body(const Character& a, const Character& b, float tolerance = 1e-4f) {
    for (size_t j = 0; j < k_joint_count; ++j)
        EXPECT_LT(length(a.body.joints[j] - b.body.joints[j]), tolerance) << k_joint_names[j];
    EXPECT_NEAR(a.body.height, b.body.height, tolerance);
    EXPECT_EQ(a.lods[0].size(), b.lods[0].size());
}

bool noted(const Character& c, const std::string& what) {
    for (const std::string& note : c.notes)
        if (note.find(what) != std::string::npos) return true;
    return false;
}

Json& primitive(TinyMan& man) { return man.gltf["meshes"][0]["primitives"][0]; }

void add_material(TinyMan& man, Json material) {
    primitive(man)["material"] = man.gltf["materials"].size();
    man.gltf["materials"].push_back(std::move(material));
}

TEST(GltfMade, StandsAndIsNamed) {
    Character man = loaded(tiny_man());
    EXPECT_NEAR(man.body.height, 1.6f, 0.01f);
    EXPECT_NEAR(leg_length(man.body), leg_length(standard_body(1.7f)), 0.03f);
    for (size_t j = 0; j < k_joint_count; ++j) EXPECT_EQ(man.found.nodes[j], k_joint_names[j]);
    EXPECT_EQ(man.found.skins, 1u);
    EXPECT_EQ(man.found.triangles, 22u * 12);
    EXPECT_EQ(man.found.scale, 1);
    EXPECT_EQ(man.found.ahead, (Vec3{0, 0, 1}));
}

TEST(GltfMade, GltfIsGlb) { expect_same_body(loaded(as_gltf(tiny_man())), loaded(tiny_man())); }

TEST(GltfMade, TurnedItFacesAhead) {
    for (Quat turn : {rotation_y(k_pi), rotation_y(k_pi / 2), rotation_x(k_pi / 2)})
        expect_same_body(loaded(tiny_man(turn)), loaded(tiny_man()), 2e-3f);
}

TEST(GltfMade, CentimetresAreTold) {
    TinyMan man = tiny_man();
    man.gltf["nodes"].push_back({{"children", {0}}, {"scale", {100, 100, 100}}});
    man.gltf["scenes"][0]["nodes"] = {k_tiny_mesh, k_tiny_mesh + 1};
    Character c = loaded(man);
    expect_same_body(c, loaded(tiny_man()), 1e-3f);
    EXPECT_FLOAT_EQ(c.found.scale, 0.01f);
    EXPECT_TRUE(noted(c, "centimetres"));
}

TEST(GltfMade, OnlyTheDefaultSceneIsShown) {
    TinyMan man = tiny_man();
    man.gltf["nodes"].push_back({{"mesh", 0}, {"skin", 0}});
    EXPECT_EQ(loaded(man).found.triangles, 22u * 12);
    man.gltf["scenes"][0]["nodes"].push_back(k_tiny_mesh + 1);
    EXPECT_EQ(loaded(man).found.triangles, 22u * 24);
}

TEST(GltfMade, MorphTargetsAreLeftOutWithANote) {
    TinyMan man = tiny_man();
    primitive(man)["targets"] = {{{"POSITION", tiny_positions}}};
    Character c = loaded(man);
    expect_same_body(c, loaded(tiny_man()));
    EXPECT_TRUE(noted(c, "morph targets"));
}

TEST(GltfMade, SparsePositionsAreRead) {
    TinyMan man = tiny_man();
    Json& accessor = man.gltf["accessors"][tiny_positions];
    size_t count = accessor["count"], view = accessor["bufferView"];
    std::vector<uint16_t> order(count);
    for (size_t i = 0; i < count; ++i) order[i] = uint16_t(i);
    int indices = add_accessor(man, order, "SCALAR");
    Json& sparse = man.gltf["accessors"][tiny_positions];
    sparse.erase("bufferView");
    sparse["sparse"] = {{"count", count},
                        {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                        {"values", {{"bufferView", view}}}};
    expect_same_body(loaded(man), loaded(tiny_man()));
}

// Positions as shorts of a millimetre; the inverse bind matrices bring them back.
TEST(GltfMade, QuantisedPositionsAreRead) {
    TinyMan man = tiny_man();
    size_t count = man.gltf["accessors"][tiny_positions]["count"];
    const float* p = data_of<float>(man, tiny_positions);
    std::vector<uint16_t> shorts;
    for (size_t i = 0; i < 3 * count; ++i) shorts.push_back(uint16_t(int16_t(std::lround(p[i] * 10'000))));
    float* binds = data_of<float>(man, tiny_binds);
    for (int j = 0; j < k_joint_count; ++j)
        for (int i : {0, 5, 10}) binds[16 * j + i] = 1e-4f;
    primitive(man)["attributes"]["POSITION"] = add_accessor(man, shorts, "VEC3");
    man.gltf["accessors"].back()["componentType"] = 5122;
    man.gltf["extensionsRequired"] = {"KHR_mesh_quantization"};
    expect_same_body(loaded(man), loaded(tiny_man()), 1e-3f);
}

TEST(GltfMade, MeshoptIsRead) {
    TinyMan man = tiny_man();
    size_t count = man.gltf["accessors"][tiny_positions]["count"],
           corners = man.gltf["accessors"][tiny_indices]["count"];
    auto pack = [&](int accessor, Bytes encoded, size_t elements, size_t stride, const char* mode) {
        size_t view = man.gltf["accessors"][size_t(accessor)]["bufferView"], begin = man.bytes.size();
        man.bytes.insert(man.bytes.end(), encoded.begin(), encoded.end());
        man.bytes.resize((man.bytes.size() + 3) / 4 * 4);
        man.gltf["bufferViews"][view] = {{"buffer", 1},
                                         {"byteLength", elements * stride},
                                         {"extensions",
                                          {{"EXT_meshopt_compression",
                                            {{"buffer", 0},
                                             {"byteOffset", begin},
                                             {"byteLength", encoded.size()},
                                             {"byteStride", stride},
                                             {"count", elements},
                                             {"mode", mode}}}}}};
    };
    Bytes vertices(meshopt_encodeVertexBufferBound(count, 12)),
        indices(meshopt_encodeIndexBufferBound(corners, count));
    vertices.resize(meshopt_encodeVertexBuffer(vertices.data(), vertices.size(),
                                               data_of<float>(man, tiny_positions), count, 12));
    std::vector<uint32_t> wide;
    for (size_t i = 0; i < corners; ++i) wide.push_back(data_of<uint16_t>(man, tiny_indices)[i]);
    indices.resize(meshopt_encodeIndexBuffer(indices.data(), indices.size(), wide.data(), corners));
    pack(tiny_positions, vertices, count, 12, "ATTRIBUTES");
    pack(tiny_indices, indices, corners, 2, "TRIANGLES");
    man.gltf["buffers"][0]["byteLength"] = man.bytes.size();
    man.gltf["buffers"].push_back(
        {{"byteLength", 1 << 20}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
    man.gltf["extensionsRequired"] = {"EXT_meshopt_compression"};
    expect_same_body(loaded(man), loaded(tiny_man()));

    man.bytes[man.gltf["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]["byteOffset"]
                  .get<size_t>()] ^= 0xff;
    auto broken = parse_gltf(as_glb(man), "", "man");
    ASSERT_FALSE(broken);
    EXPECT_NE(broken.error().message.find("compressed"), std::string::npos);
}

TEST(GltfMade, VrmTellsBonesWithoutNames) {
    Json bones0, bones1;
    const std::pair<const char*, Joint> k_bones[] = {{"hips", hips},
                                                     {"head", head},
                                                     {"leftUpperLeg", left_upper_leg},
                                                     {"leftFoot", left_foot},
                                                     {"rightHand", right_hand}};
    for (auto [name, joint] : k_bones) {
        bones0.push_back({{"bone", name}, {"node", int(joint)}});
        bones1[name] = {{"node", int(joint)}};
    }
    for (auto [extension, bones] : {std::pair{"VRM", bones0}, {"VRMC_vrm", bones1}}) {
        TinyMan man = tiny_man();
        for (Json& node : man.gltf["nodes"]) node.erase("name");
        man.gltf["extensions"][extension]["humanoid"]["humanBones"] = bones;
        Character c = loaded(man);
        expect_same_body(c, loaded(tiny_man()));
        EXPECT_EQ(c.found.nodes[head], "node 5");
    }
}

TEST(GltfMade, TexturesAreCutWhereTheyShould) {
    const uint8_t k_texels[] = {10, 20, 30, 255, 10, 20, 30, 64, 10, 20, 30, 128, 10, 20, 30, 0};
    std::string png = encode_png(k_texels, 2, 2, 4);
    TinyMan man = tiny_man();
    man.gltf["images"] = {{{"uri", "data:image/png;base64," + as_base64({png.begin(), png.end()})}}};
    man.gltf["textures"] = {{{"source", 0}}};
    std::vector<float> uvs(2 * man.gltf["accessors"][tiny_positions]["count"].get<size_t>(), 0.25f);
    primitive(man)["attributes"]["TEXCOORD_0"] = add_accessor(man, uvs, "VEC2");
    Json texture = {{"index", 0},
                    {"extensions", {{"KHR_texture_transform", {{"offset", {0.5, 0}}, {"scale", {2, 1}}}}}}};
    add_material(man, {{"pbrMetallicRoughness", {{"baseColorTexture", texture}}},
                       {"alphaMode", "MASK"},
                       {"alphaCutoff", 0.2}});
    Character c = loaded(man);
    ASSERT_EQ(c.textures.size(), 1u);
    std::vector<bool> shown;
    for (size_t i = 0; i < 4; ++i) shown.push_back(c.textures[0].rgba[4 * i + 3] >= 128);
    EXPECT_EQ(shown, (std::vector<bool>{true, true, true, false}));
    EXPECT_FLOAT_EQ(c.vertices[0].u, 1.0f);
    EXPECT_FLOAT_EQ(c.vertices[0].v, 0.25f);

    man.gltf["materials"][0].erase("alphaMode");
    c = loaded(man);
    for (size_t i = 0; i < 4; ++i) EXPECT_EQ(c.textures[0].rgba[4 * i + 3], 255);
}

// Folders above a file are none of its business; what is beside it or below is, however it is written.
TEST(GltfMade, TexturesLieInItsFolderOrBelow) {
    TestFolder folder;
    std::filesystem::create_directories(folder / "model/textures");
    const uint8_t k_texel[] = {10, 20, 30, 255};
    for (const char* name : {"above.png", "model/textures/wool red.png"})
        folder.write(name, encode_png(k_texel, 1, 1, 4));
    TinyMan man = tiny_man();
    man.gltf["textures"] = {{{"source", 0}}};
    std::vector<float> uvs(2 * man.gltf["accessors"][tiny_positions]["count"].get<size_t>(), 0.25f);
    primitive(man)["attributes"]["TEXCOORD_0"] = add_accessor(man, uvs, "VEC2");
    add_material(man, {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    auto textures_of = [&](const std::string& uri) {
        man.gltf["images"] = {{{"uri", uri}}};
        auto model = parse_gltf(as_glb(man), folder / "model", "man");
        EXPECT_TRUE(model);
        auto character = make_character(*model, "man");
        EXPECT_TRUE(character);
        return character->textures.size();
    };
    EXPECT_EQ(textures_of("textures/wool%20red.png"), 1u);
    EXPECT_EQ(textures_of("./textures/wool red.png"), 1u);
    EXPECT_EQ(textures_of("../above.png"), 0u);
    EXPECT_EQ(textures_of("..%2fabove.png"), 0u);
    EXPECT_EQ(textures_of("textures/../../above.png"), 0u);
    EXPECT_EQ(textures_of(folder / "above.png"), 0u);
}

TEST(GltfMade, SheetsHaveTwoSides) {
    auto triangles = [](bool two_sided) {
        TinyMan man = tiny_man();
        std::vector<float> cape = {-0.3f, 1.4f, -0.2f, 0.3f,  1.4f, -0.2f,
                                   0.3f,  0.5f, -0.2f, -0.3f, 0.5f, -0.2f};
        std::vector<float> normals = {0, 0, -1, 0, 0, -1, 0, 0, -1, 0, 0, -1};
        Json sheet = {
            {"attributes",
             {{"POSITION", add_accessor(man, cape, "VEC3")}, {"NORMAL", add_accessor(man, normals, "VEC3")}}},
            {"indices", add_accessor(man, std::vector<uint16_t>{0, 1, 2, 0, 2, 3}, "SCALAR")},
            {"material", 0}};
        man.gltf["materials"] = {{{"doubleSided", two_sided}}};
        man.gltf["meshes"].push_back({{"primitives", {sheet}}});
        Vec3 at = standard_body(1.7f).joints[upper_chest];
        man.gltf["nodes"].push_back({{"mesh", 1}, {"translation", {-at.x, -at.y, -at.z}}});
        man.gltf["nodes"][upper_chest]["children"].push_back(k_tiny_mesh + 1);
        return loaded(man).found.triangles;
    };
    EXPECT_EQ(triangles(false), 22u * 12 + 2);
    EXPECT_EQ(triangles(true), 22u * 12 + 4);
}

TEST(GltfMade, AHandHoldsOneThing) {
    TinyMan man = tiny_man();
    int slot = k_tiny_mesh + 1;  // a joint that moves no skin
    man.gltf["nodes"].push_back({{"name", "slot"}, {"children", {slot + 1, slot + 2}}});
    man.gltf["nodes"][left_hand]["children"] = {slot};
    man.gltf["skins"][0]["joints"].push_back(slot);
    std::vector<float> binds(data_of<float>(man, tiny_binds),
                             data_of<float>(man, tiny_binds) + 16 * k_joint_count);
    std::vector<float> again(binds.begin() + 16 * left_hand, binds.begin() + 16 * (left_hand + 1));
    binds.insert(binds.end(), again.begin(), again.end());
    man.gltf["skins"][0]["inverseBindMatrices"] = add_accessor(man, binds, "MAT4");
    std::vector<float> blade = {0, 0, 0, 0, 0.05f, 0, 0, 0, 1};
    Json sword = {{"attributes", {{"POSITION", add_accessor(man, blade, "VEC3")}}}};
    man.gltf["meshes"].push_back({{"primitives", {sword}}});
    for (int i = 0; i < 2; ++i) man.gltf["nodes"].push_back({{"mesh", 1}});
    Character c = loaded(man);
    EXPECT_EQ(c.found.triangles, 22u * 12 + 1);
    EXPECT_TRUE(noted(c, "share a slot"));
    EXPECT_NEAR(c.body.height, loaded(tiny_man()).body.height, 1e-4f) << "a sword makes nobody taller";
}

// A skirt wider than the shoulders keeps the arms away.
TEST(GltfMade, ArmsClearASkirt) {
    EXPECT_LT(loaded(tiny_man()).body.carriage, 0.15f);
    TinyMan man = tiny_man();
    float* p = data_of<float>(man, tiny_positions);
    for (int corner = 0; corner < 8; ++corner)
        p[3 * corner] *= 18, p[3 * corner + 1] -= corner < 4 ? 0.25f : 0.1f;
    Character c = loaded(man);
    EXPECT_GT(c.body.carriage, 0.2f);
    EXPECT_LT(c.body.carriage, 0.7f);
}

TEST(GltfMade, StiffFeetBendAtTheBall) {
    TinyMan man = tiny_man();
    uint8_t* joints = data_of<uint8_t>(man, tiny_joints);
    size_t count = man.gltf["accessors"][tiny_joints]["count"];
    for (size_t v = 0; v < count; ++v)
        if (uint8_t& j = joints[4 * v]; j == left_toes || j == right_toes) --j;
    Character c = loaded(man);
    EXPECT_TRUE(c.found.nodes[left_toes].empty());
    bool bends = false;
    for (const CharacterVertex& v : c.vertices) bends |= v.joints[0] == left_toes;
    EXPECT_TRUE(bends);
}

}  // namespace
}  // namespace flaneur
