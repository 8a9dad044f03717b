// Files that break the format: refused with a sentence that says what, or repaired with a note.
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <functional>
#include <limits>
#include <random>

#include "assets/files/picture.h"
#include "assets/gltf/character/character.h"
#include "tests/assets/tiny_man.h"

namespace flaneur {
namespace {

Result<Character> loaded(const Bytes& bytes) {
    auto model = parse_gltf(bytes, "/nowhere", "man.glb");
    return model ? make_character(*model, "man.glb") : model.error();
}

struct Break {
    const char* says;
    std::function<void(TinyMan&)> how;
};

Json& primitive(TinyMan& man) { return man.gltf["meshes"][0]["primitives"][0]; }

TEST(GltfBroken, IsRefusedByName) {
    float nan = std::numeric_limits<float>::quiet_NaN();
    const Break k_breaks[] = {
        {"1.0", [](TinyMan& m) { m.gltf["asset"]["version"] = "1.0"; }},
        {"no asset", [](TinyMan& m) { m.gltf.erase("asset"); }},
        {"nodes that are no list", [](TinyMan& m) { m.gltf["nodes"] = 3; }},
        {"nodes[5] is no object", [](TinyMan& m) { m.gltf["nodes"][5] = "hips"; }},
        {"more than can be taken in",
         [](TinyMan& m) { m.gltf["materials"] = std::vector<Json>(9000, Json::object()); }},
        {"1000000 values", [](TinyMan& m) { m.gltf["extras"] = std::vector<int>(1'100'000, 1); }},
        {"nested too deep",
         [](TinyMan& m) {
             Json deep;
             for (int i = 0; i < 100; ++i) deep = Json::array({deep});
             m.gltf["extras"] = deep;
         }},
        {"requires the extension EXT_magic",
         [](TinyMan& m) { m.gltf["extensionsRequired"] = {"EXT_magic"}; }},
        {"broken compressed data",
         [](TinyMan& m) {
             primitive(m)["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0}};
             m.gltf["accessors"][tiny_positions].erase("bufferView");
         }},
        {"as it says", [](TinyMan& m) { m.gltf["buffers"][0]["byteLength"] = 1'000'000'000'000; }},
        {"how long it is", [](TinyMan& m) { m.gltf["buffers"][0]["byteLength"] = -4; }},
        {"nothing is downloaded", [](TinyMan& m) { m.gltf["buffers"][0]["uri"] = "http://a.b/c.bin"; }},
        {"man.bin", [](TinyMan& m) { m.gltf["buffers"][0]["uri"] = "man.bin"; }},
        {"its own folder", [](TinyMan& m) { m.gltf["buffers"][0]["uri"] = "../../etc/hostname"; }},
        {"its own folder", [](TinyMan& m) { m.gltf["buffers"][0]["uri"] = "a/..%2f../etc%2Fhostname"; }},
        {"its own folder", [](TinyMan& m) { m.gltf["buffers"][0]["uri"] = "%2fetc%2fhostname"; }},
        {"not base64", [](TinyMan& m) { m.gltf["buffers"][0]["uri"] = "data:;base64,%%%%"; }},
        {"names no file",
         [](TinyMan& m) {
             m.gltf["buffers"].push_back({{"byteLength", 4}});
         }},
        {"beyond its buffer", [](TinyMan& m) { m.gltf["accessors"][tiny_positions]["count"] = 100'000; }},
        {"at most", [](TinyMan& m) { m.gltf["accessors"][tiny_positions]["count"] = 4'000'000'000; }},
        {"at most 2147483647",
         [](TinyMan& m) {
             m.gltf["accessors"][tiny_positions]["sparse"] = {
                 {"count", uint64_t{1} << 63},
                 {"indices", {{"bufferView", 3}, {"componentType", 5123}}},
                 {"values", {{"bufferView", 0}}}};
         }},
        {"at most 2147483647", [](TinyMan& m) { m.gltf["nodes"][k_tiny_mesh]["mesh"] = int64_t{1} << 32; }},
        {"buffer view 99", [](TinyMan& m) { m.gltf["accessors"][tiny_positions]["bufferView"] = 99; }},
        {"buffer that does not exist", [](TinyMan& m) { m.gltf["bufferViews"][0]["buffer"] = 7; }},
        {"accessor 99", [](TinyMan& m) { primitive(m)["attributes"]["POSITION"] = 99; }},
        {"wrong type", [](TinyMan& m) { primitive(m)["attributes"]["POSITION"] = tiny_weights; }},
        {"not finite", [nan](TinyMan& m) { data_of<float>(m, tiny_positions)[7] = nan; }},
        {"index beyond", [](TinyMan& m) { data_of<uint16_t>(m, tiny_indices)[3] = 60'000; }},
        {"not unsigned whole", [](TinyMan& m) { primitive(m)["indices"] = tiny_positions; }},
        {"do not fit its vertices", [](TinyMan& m) { m.gltf["accessors"][tiny_joints]["count"] = 100; }},
        {"of 176 vertices",
         [](TinyMan& m) {
             primitive(m)["attributes"]["NORMAL"] = add_accessor(m, std::vector<float>(30), "VEC3");
         }},
        {"joint that its skin lacks", [](TinyMan& m) { data_of<uint8_t>(m, tiny_joints)[0] = 77; }},
        {"joint that does not exist", [](TinyMan& m) { m.gltf["skins"][0]["joints"][4] = 500; }},
        {"fewer inverse bind", [](TinyMan& m) { m.gltf["accessors"][tiny_binds]["count"] = 20; }},
        {"cannot be inverted", [](TinyMan& m) { data_of<float>(m, tiny_binds)[0] = 0; }},
        {"skin that does not exist", [](TinyMan& m) { m.gltf["nodes"][k_tiny_mesh]["skin"] = 3; }},
        {"mesh that does not exist", [](TinyMan& m) { m.gltf["nodes"][k_tiny_mesh]["mesh"] = 3; }},
        {"child that does not exist", [](TinyMan& m) { m.gltf["nodes"][head]["children"] = {700}; }},
        {"two parents", [](TinyMan& m) { m.gltf["nodes"][head]["children"] = {int(left_foot)}; }},
        {"cycle",
         [](TinyMan& m) {
             m.gltf["nodes"].push_back({{"children", {24}}});
             m.gltf["nodes"].push_back({{"children", {23}}});
         }},
        {"not finite",
         [](TinyMan& m) {
             m.gltf["nodes"][head]["translation"] = {1e30, 0, 0};
         }},
        {"no skinned mesh", [](TinyMan& m) { m.gltf["nodes"][k_tiny_mesh].erase("skin"); }},
        {"no pair of limbs", [](TinyMan& m) { m.gltf["skins"][0]["joints"] = std::vector<int>(22, 0); }},
    };
    for (const Break& broken : k_breaks) {
        TinyMan man = tiny_man();
        broken.how(man);
        auto character = loaded(as_glb(man));
        ASSERT_FALSE(character) << broken.says;
        EXPECT_NE(character.error().message.find(broken.says), std::string::npos)
            << character.error().message;
        EXPECT_TRUE(character.error().message.starts_with("man.glb: "));
    }
}

TEST(GltfBroken, IsRepairedWithANote) {
    const Break k_breaks[] = {
        {"did not sum to 1", [](TinyMan& m) { data_of<float>(m, tiny_weights)[0] = 0.4f; }},
        {"did not sum to 1", [](TinyMan& m) { data_of<float>(m, tiny_weights)[0] = 0; }},
        {"Image 0 is not to be had",
         [](TinyMan& m) {
             m.gltf["images"] = {{{"uri", "away.png"}}};
             m.gltf["textures"] = {{{"source", 0}}};
             m.gltf["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
             primitive(m)["material"] = 0;
         }},
        {"more pixels than can be taken in",
         [](TinyMan& m) {
             std::vector<uint8_t> white(size_t{6000} * 6000 * 3, 255);
             std::string packed = encode_png(white, 6000, 6000, 3);
             Bytes png(packed.begin(), packed.end());
             m.gltf["images"] = {{{"uri", "data:image/png;base64," + as_base64(png)}}};
             m.gltf["textures"] = {{{"source", 0}}};
             m.gltf["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
             primitive(m)["material"] = 0;
         }},
    };
    for (const Break& broken : k_breaks) {
        TinyMan man = tiny_man();
        broken.how(man);
        auto character = loaded(as_glb(man));
        ASSERT_TRUE(character) << character.error().message;
        bool said = false;
        for (const std::string& note : character->notes) said |= note.find(broken.says) != std::string::npos;
        EXPECT_TRUE(said) << broken.says;
    }
}

TEST(GltfBroken, CutShortAnywhereIsRefused) {
    Bytes whole = as_glb(tiny_man());
    for (size_t length = 0; length < whole.size(); length += length < 200 ? 1 : 61)
        EXPECT_FALSE(loaded(Bytes(whole.begin(), whole.begin() + std::ptrdiff_t(length)))) << length;
}

TEST(GltfBroken, ChangedAnywhereIsLoadedOrRefused) {
    Bytes whole = as_glb(tiny_man());
    std::minstd_rand random(1);
    size_t fine = 0;
    for (int n = 0; n < 400; ++n) {  // the fuzzer goes on from here
        Bytes changed = whole;
        for (int i = 0; i < 1 + n % 4; ++i) changed[random() % changed.size()] = uint8_t(random());
        auto character = loaded(changed);
        fine += bool(character);
        if (!character) {
            EXPECT_GT(character.error().message.size(), 25u);
        }
    }
    EXPECT_GT(fine, 20u);
    EXPECT_LT(fine, 380u);
}

TEST(GltfBroken, LimbsInPiecesAreLoadedOrRefused) {
    size_t nodes = tiny_man().gltf["nodes"].size();
    for (size_t cut = 0; cut < nodes; ++cut) {
        for (size_t moved = cut % 3; moved < nodes; moved += 3) {
            TinyMan man = tiny_man();
            man.gltf["nodes"][cut].erase("children");
            man.gltf["nodes"][moved]["translation"] = {0.0, -0.0425, 0.1326};
            auto character = loaded(as_glb(man));
            if (!character) {
                EXPECT_GT(character.error().message.size(), 25u);
                continue;
            }
            for (const std::string& name : character->found.nodes) EXPECT_LT(name.size(), 64u);
        }
    }
}

}  // namespace
}  // namespace flaneur
