// glTF scenes as cities: what is ground, what is a wall, and what is refused.
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "assets/cities.h"
#include "assets/gltf/city/city.h"
#include "assets/gltf/city/still.h"
#include "assets/gltf/read.h"
#include "sim/base/rng.h"
#include "sim/navigation/navmesh.h"
#include "tests/folder.h"

namespace flaneur {
namespace {

namespace fs = std::filesystem;

const fs::path k_corpus = fs::path(FLANEUR_SHARED_DIR) / "corpus";

// A scene of boxes, each a mesh and a material of its own name.
struct Blocks {
    StillModel model;
    void add(const std::string& name, Vec3 low, Vec3 high) {
        StillSurface s;
        s.material = model.materials.size();
        auto face = [&](Vec3 origin, Vec3 u, Vec3 v) {
            auto first = static_cast<uint32_t>(s.positions.size());
            for (Vec3 p : {origin, origin + u, origin + u + v, origin + v}) {
                s.positions.push_back(p);
                s.normals.push_back(normalize_or(cross(u, v), {0, 1, 0}));
            }
            for (uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) s.indices.push_back(first + i);
        };
        Vec3 x{high.x - low.x, 0, 0}, y{0, high.y - low.y, 0}, z{0, 0, high.z - low.z};
        face(low + y, z, x);
        face(low, x, z);
        face(low + z, x, y);
        face(low, y, x);
        face(low + x, y, z);
        face(low, z, y);
        model.materials.push_back({name});
        model.meshes.push_back({name, {s}});
    }
    Result<City> load(float scale = 1) const {
        std::string glb = still_glb(model);
        auto parsed =
            parse_gltf({reinterpret_cast<const uint8_t*>(glb.data()), glb.size()}, "", "blocks.glb");
        return parsed ? make_gltf_city(*parsed, "blocks.glb", scale) : parsed.error();
    }
};

// A street 60 m long between sidewalks, with a house, a table and a tree on one of them.
Blocks street() {
    Blocks b;
    b.add("asphalt road", {-30, -1, -4}, {30, 0, 4});
    b.add("Sidewalk_North", {-30, -1, -10}, {30, 0.12f, -4});
    b.add("SidewalkSouth", {-30, -1, 4}, {30, 0.12f, 10});
    b.add("house", {0, 0.12f, -10}, {12, 8, -6});
    b.add("table", {-10, 0.9f, -9}, {-8, 1, -7});
    b.add("Tree leaves", {-20, 1, -8}, {-18, 3, -6});
    return b;
}

TEST(GltfCity, EndsInCapitalsToo) {
    TestFolder folder;
    for (const char* name : {"m.glb", "M.GLB"}) {
        Result<City> city = load_city(folder.write(name, still_glb(street().model)), {});
        EXPECT_TRUE(city) << city.error().message;
    }
}

// Each of them would ask about all of the others.
TEST(GltfCity, HeapsOfTrianglesAreRefused) {
    Blocks b = street();
    StillSurface heap;
    for (uint32_t i = 0; i < 70'000; ++i) {
        float x = 0.01f + 1e-6f * static_cast<float>(i % 1000), y = 1e-5f * static_cast<float>(i);
        for (Vec3 p : {Vec3{x, y, 0.01f}, Vec3{x, y, 0.05f}, Vec3{x + 0.04f, y, 0.01f}}) {
            heap.indices.push_back(static_cast<uint32_t>(heap.positions.size()));
            heap.positions.push_back(p);
            heap.normals.push_back({0, 1, 0});
        }
    }
    b.model.meshes.push_back({"heap", {heap}});
    Result<City> city = b.load();
    ASSERT_FALSE(city);
    EXPECT_NE(city.error().message.find("lie over each other"), std::string::npos) << city.error().message;
}

// Each index within its array, normals of unit length, ground facing up.
void expect_sound(const City& c) {
    const Scenery& s = c.scenery;
    ASSERT_EQ(s.indices.size(), 3 * s.pictures.size());
    ASSERT_EQ(s.uses.size(), s.pictures.size());
    for (uint32_t i : s.indices) ASSERT_LT(i, s.vertices.size());
    for (uint32_t p : s.pictures) ASSERT_TRUE(p == ~0u || p < s.images.size());
    for (const Scenery::Vertex& v : s.vertices) ASSERT_NEAR(length(v.normal), 1, 1e-3f);
    for (const Scenery::Picture& p : s.images)
        ASSERT_EQ(p.rgba.size(), size_t{4} * static_cast<size_t>(p.width) * static_cast<size_t>(p.height));
    ASSERT_EQ(c.ground.indices.size(), 3 * c.ground.kinds.size());
    ASSERT_EQ(c.ground_axes.size(), c.ground.kinds.size());
    for (size_t t = 0; t < c.ground.kinds.size(); ++t) {
        Vec3 p[3];
        for (size_t k = 0; k < 3; ++k) {
            ASSERT_LT(c.ground.indices[3 * t + k], c.ground.vertices.size());
            p[k] = c.ground.vertices[c.ground.indices[3 * t + k]];
        }
        ASSERT_GE(normalize_or(cross(p[1] - p[0], p[2] - p[0]), {0, 1, 0}).y, 0.76f);
    }
}

TEST(GltfCity, NamesAndSlopesMakeGroundAndWalls) {
    Result<City> city = street().load();
    ASSERT_TRUE(city) << city.error().message;
    expect_sound(*city);
    auto kind_at = [&](float x, float z) { return ground_at(city->ground, {x, 0.2f, z}); };
    auto road = kind_at(-5, 0), walk = kind_at(-5, 8), below_tree = kind_at(-19, -7);
    ASSERT_TRUE(road && walk && below_tree);
    EXPECT_EQ(road->kind, Surface::road);
    EXPECT_NEAR(road->height, 0, 1e-4f);
    EXPECT_EQ(walk->kind, Surface::sidewalk);
    EXPECT_NEAR(walk->height, 0.12f, 1e-4f);
    EXPECT_NEAR(below_tree->height, 0.12f, 1e-4f);
    EXPECT_FALSE(ground_at(city->ground, {6, 8.2f, -8}, 1, 2)) << "a roof that nothing leads up to";
    EXPECT_FALSE(ground_at(city->ground, {-9, 1.2f, -8}, 0.5f, 0.5f)) << "a table";

    // Kerbs are stepped over; the house is not walked through, and leaves are.
    const Scenery& s = city->scenery;
    size_t walls = 0;
    for (size_t t = 0; t < s.uses.size(); ++t) {
        Vec3 a = s.vertices[s.indices[3 * t]].position, b = s.vertices[s.indices[3 * t + 1]].position,
             c = s.vertices[s.indices[3 * t + 2]].position;
        Vec3 middle = (a + b + c) / 3;
        Vec3 normal = normalize_or(cross(b - a, c - a), {0, 1, 0});
        bool is_kerb = std::fabs(normal.z) > 0.9f && std::fabs(std::fabs(middle.z) - 4) < 1e-3f;
        bool is_leaves = middle.x < -17 && middle.x > -21 && middle.y > 0.9f;
        bool is_house = middle.x > -0.1f && middle.x < 12.1f && middle.y > 1 && std::fabs(normal.y) < 0.1f;
        if (is_kerb || is_leaves || is_house) {
            EXPECT_EQ(s.uses[t] == SceneryUse::solid, is_house)
                << middle.x << " " << middle.y << " " << middle.z;
        }
        walls += is_house;
    }
    EXPECT_EQ(walls, 8u);

    // The map ends on all sides; from there people come, on the ground, looking out.
    EXPECT_GE(city->destinations.size(), 8u);
    for (const Destination& d : city->destinations) {
        EXPECT_EQ(d.kind, DestinationKind::edge);
        EXPECT_NEAR(length(d.facing), 1, 1e-4f);
        auto at = ground_at(city->ground, d.position + Vec3{0, 0.1f, 0});
        ASSERT_TRUE(at);
        EXPECT_NEAR(at->height, d.position.y, 1e-3f);
        EXPECT_GT(dot(d.facing, on_ground(d.position)), 0);
    }
    EXPECT_TRUE(build_navmesh(city->ground, {}, 1));
}

TEST(GltfCity, StandsUprightAboutTheOrigin) {
    Blocks far = street();
    for (StillMesh& mesh : far.model.meshes)
        for (StillSurface& s : mesh.surfaces)
            for (Vec3& p : s.positions) p = Vec3{p.x + 4000, p.y - 90, p.z - 300} * 100;
    Result<City> city = far.load(0.01f);
    ASSERT_TRUE(city) << city.error().message;
    ASSERT_EQ(city->notes.size(), 1u);
    EXPECT_NEAR(city->ground.low.x, -30, 0.01f);
    EXPECT_NEAR(city->ground.high.z, 10, 0.01f);
    auto road = ground_at(city->ground, {-5, 0.2f, 0});
    ASSERT_TRUE(road);
    EXPECT_NEAR(road->height, 0, 0.1f);  // of the level that sidewalks share

    Blocks lying;
    lying.add("ground", {-30, -0.05f, -20}, {30, 0, 20});
    for (StillMesh& mesh : lying.model.meshes)
        for (StillSurface& s : mesh.surfaces)
            for (Vec3& p : s.positions) p = {p.x, -p.z, p.y};
    city = lying.load();
    ASSERT_TRUE(city) << city.error().message;
    EXPECT_NEAR(city->ground.high.x, 30, 0.01f);
    EXPECT_NEAR(city->ground.high.z, 20, 0.01f);
}

TEST(GltfCity, RefusesWhatIsNoCity) {
    auto refused = [](const Blocks& b, float scale, const char* why) {
        Result<City> city = b.load(scale);
        ASSERT_FALSE(city) << why;
        EXPECT_NE(city.error().message.find(why), std::string::npos) << city.error().message;
        EXPECT_TRUE(city.error().message.starts_with("blocks.glb: ")) << city.error().message;
    };
    std::string_view nothing = R"({"asset":{"version":"2.0"}})";
    auto empty =
        parse_gltf({reinterpret_cast<const uint8_t*>(nothing.data()), nothing.size()}, "", "none.gltf");
    ASSERT_TRUE(empty);
    EXPECT_NE(make_gltf_city(*empty, "none.gltf").error().message.find("no triangles"), std::string::npos);
    Blocks house, box;
    house.add("house", {0, 0, 0}, {12, 8, 9});
    box.add("box", {0, 0, 0}, {1, 1, 1});
    refused(house, 1, "nothing to walk on but its top");
    refused(box, 1, "25");
    refused(street(), 1000, "--scale");
    refused(street(), 0.01f, "--scale");
    // Thousands of sheets over one another would fill every cell of the grids.
    Blocks sheets;
    sheets.add("sheet", {-3000, 0, -3000}, {3000, 1, 3000});
    StillSurface& s = sheets.model.meshes[0].surfaces[0];
    std::vector<uint32_t> once = s.indices;
    for (int i = 0; i < 100; ++i) s.indices.insert(s.indices.end(), once.begin(), once.end());
    refused(sheets, 1, "lie over each other");
}

TEST(GltfCity, BrokenBytesNeverCrash) {
    std::string glb = still_glb(street().model);
    size_t loaded = 0, refused = 0;
    for (uint32_t n = 0; n < 240; ++n) {
        RandomKey key{11, n, 0, Purpose::city};
        std::string bytes = glb;
        auto at = [&](uint32_t i) { return static_cast<size_t>(random_bits(key, i) % bytes.size()); };
        if (n % 3 == 0) bytes.resize(at(0));
        for (uint32_t flips = 1 + n % 5; n % 3 != 0 && flips > 0; --flips)
            bytes[at(flips)] = static_cast<char>(random_bits(key, 100 + flips));
        auto parsed =
            parse_gltf({reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()}, "", "broken.glb");
        Result<City> city = parsed ? make_gltf_city(*parsed, "broken.glb") : parsed.error();
        if (city) expect_sound(*city);
        ++(city ? loaded : refused);
    }
    EXPECT_GT(refused, 80u);
    EXPECT_GT(loaded, 20u);
}

#define SKIP_WITHOUT(path) \
    if (!fs::exists(path)) GTEST_SKIP() << (path) << " is not here: real files are not tried"

TEST(GltfCity, LittlestTokyoIsACity) {
    fs::path file = k_corpus / "city" / "LittlestTokyo.glb";
    SKIP_WITHOUT(file);
    Result<City> city = load_gltf_city(file.string(), 0.03f);
    ASSERT_TRUE(city) << city.error().message;
    expect_sound(*city);
    EXPECT_GT(city->scenery.images.size(), 1u);
    double area = 0;
    for (size_t t = 0; t < city->ground.kinds.size(); ++t) {
        Vec3 p[3];
        for (size_t k = 0; k < 3; ++k) p[k] = city->ground.vertices[city->ground.indices[3 * t + k]];
        area += static_cast<double>(length(cross(p[1] - p[0], p[2] - p[0]))) / 2;
    }
    EXPECT_GT(area, 100);
    EXPECT_LT(area, 400);
}

// Single things are refused, whatever they are; nothing crashes.
TEST(GltfCity, CorpusIsLoadedOrRefused) {
    SKIP_WITHOUT(k_corpus / "odd");
    size_t loaded = 0, refused = 0;
    for (const char* folder : {"odd", "city", "characters"})
        for (const auto& entry : fs::recursive_directory_iterator(k_corpus / folder)) {
            std::string kind = entry.path().extension().string(), name = entry.path().string();
            if (kind != ".glb" && kind != ".gltf" && kind != ".vrm") continue;
            Result<City> city = load_gltf_city(name);
            if (city) {
                SCOPED_TRACE(name);
                expect_sound(*city);
                ++loaded;
            } else {
                EXPECT_GT(city.error().message.size(), name.size() + 20) << city.error().message;
                EXPECT_TRUE(city.error().message.starts_with(name + ": ")) << city.error().message;
                ++refused;
            }
        }
    std::cout << loaded + refused << " files tried, " << loaded << " loaded, " << refused
              << " refused, 0 crashed\n";
    EXPECT_GT(refused, 100u);
}

}  // namespace
}  // namespace flaneur
