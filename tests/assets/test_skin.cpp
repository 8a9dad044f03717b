// Of walls and roofs in one plane one is drawn, and nothing is missing.
#include <gtest/gtest.h>

#include <cmath>

#include "assets/cities.h"
#include "assets/skin.h"
#include "sim/base/rng.h"
#include "tests/folder.h"
#include "tests/sketch.h"

namespace flaneur {
namespace {

// A wall along x that faces +z, by its lower left and upper right corners.
Face wall(float x0, float x1, float low, float high, float z, uint32_t building,
          FaceKind kind = FaceKind::facade) {
    return {{x0, low, z}, {x1, low, z}, high, high, kind, building};
}

City city_of(std::vector<Face> faces) {
    City city;
    city.ground.faces = std::move(faces);
    city.buildings.resize(4);
    return city;
}

// A level triangle that faces up, with its square corner at x, z.
void add_roof(City& city, float x, float y, float z, float side, uint32_t building) {
    for (Vec3 p : {Vec3{x, y, z}, {x, y, z + side}, {x + side, y, z}}) {
        city.roof_indices.push_back(static_cast<uint32_t>(city.roof_vertices.size()));
        city.roof_vertices.push_back(p);
    }
    city.roof_buildings.push_back(building);
}

float area_of(const Remnant& remnant) {
    float sum = 0;
    for (const std::vector<Vec3>& piece : remnant.pieces)
        for (size_t k = 2; k < piece.size(); ++k)
            sum += length(cross(piece[k - 1] - piece[0], piece[k] - piece[0])) * 0.5f;
    return sum;
}

TEST(Skin, OfTwoWallsInOnePlaneTheFirstIsDrawn) {
    // The second begins in the first's middle and is half as high.
    City city = city_of({wall(0, 10, 0, 12, 5, 0), wall(5, 20, 0, 6, 5, 1)});
    Skin skin = skin_of(city);
    ASSERT_EQ(skin.faces.size(), 1u);
    EXPECT_EQ(skin.faces[0].of, 1u);
    EXPECT_NEAR(area_of(skin.faces[0]), 60, 0.1f);
    for (const auto& piece : skin.faces[0].pieces) {
        for (Vec3 p : piece) {
            EXPECT_GT(p.x, 9.99f);
            EXPECT_FLOAT_EQ(p.z, 5);
        }
        EXPECT_GT(cross(piece[1] - piece[0], piece[2] - piece[0]).z, 0) << "it faces as the wall did";
    }
    EXPECT_TRUE(skin.roofs.empty());
}

TEST(Skin, AWallInAnotherIsNotDrawn) {
    Skin skin = skin_of(city_of({wall(0, 10, 0, 12, 5, 0), wall(2, 8, 1, 6, 5.002f, 1)}));
    ASSERT_EQ(skin.faces.size(), 1u);
    EXPECT_LT(area_of(skin.faces[0]), 0.05f);
}

TEST(Skin, AHoleLeavesWhatIsAround) {
    Skin skin = skin_of(city_of({wall(4, 6, 2, 4, 5, 0), wall(0, 10, 0, 12, 5, 1)}));
    ASSERT_EQ(skin.faces.size(), 1u);
    EXPECT_EQ(skin.faces[0].of, 1u);
    EXPECT_NEAR(area_of(skin.faces[0]), 116, 0.1f);
}

TEST(Skin, FacadesComeBeforeGardenWalls) {
    Skin skin = skin_of(city_of({wall(0, 10, 0, 2, 5, 0, FaceKind::garden_wall), wall(5, 15, 0, 6, 5, 1)}));
    ASSERT_EQ(skin.faces.size(), 1u);
    EXPECT_EQ(skin.faces[0].of, 0u);
    EXPECT_NEAR(area_of(skin.faces[0]), 10, 0.1f);
}

TEST(Skin, WhatDoesNotFightIsWhole) {
    // Back to back; a centimetre before, and 8 mm; beside; above; at an angle; in the other's line beyond it;
    // a garden wall in its like.
    Face back = wall(0, 10, 0, 12, 5, 1);
    std::swap(back.a, back.b);
    for (const Face& other :
         {back, wall(0, 10, 0, 12, 5.01f, 1), wall(5, 20, 0, 6, 5.008f, 1), wall(10, 20, 0, 12, 5, 1),
          wall(0, 10, 12, 20, 5, 1), Face{{0, 0, 5}, {10, 0, 7}, 12, 12, {}, 1}})
        EXPECT_TRUE(skin_of(city_of({wall(0, 10, 0, 12, 5, 0), other})).faces.empty());
    Face front{{0, 0, 0}, {7, 0, 7}, 12, 12, FaceKind::facade, 0},
        next{{6.9f, 0, 7}, {14, 0, 13.9f}, 12, 12, FaceKind::facade, 1};
    EXPECT_TRUE(skin_of(city_of({front, next})).faces.empty());
    Face garden = wall(0, 10, 0, 2, 5, 2, FaceKind::garden_wall);
    EXPECT_TRUE(skin_of(city_of({garden, garden})).faces.empty());
}

TEST(Skin, WallsThatCrossAtASmallAngleAreCutWhereTheyAreClose) {
    // Two degrees: within 6 mm over 34 cm.
    Face slanting{{0, 0, 5 - 5 * 0.0349f}, {10, 0, 5 + 5 * 0.0349f}, 10, 10, FaceKind::facade, 1};
    Skin skin = skin_of(city_of({wall(0, 10, 0, 10, 5, 0), slanting}));
    ASSERT_EQ(skin.faces.size(), 1u);
    EXPECT_NEAR(area_of(skin.faces[0]), 100 - 3.4f, 0.3f);
}

TEST(Skin, RoofsInOnePlaneAreDrawnOnce) {
    City city = city_of({});
    add_roof(city, 0, 8, 0, 10, 0);
    add_roof(city, 2, 8.001f, 2, 4, 1);  // within the first
    add_roof(city, 0, 8.02f, 0, 10, 1);  // above
    Skin skin = skin_of(city);
    ASSERT_EQ(skin.roofs.size(), 1u);
    EXPECT_EQ(skin.roofs[0].of, 1u);
    EXPECT_LT(area_of(skin.roofs[0]), 0.05f);
    City alike = city_of({});
    for (int i = 0; i < 2; ++i) add_roof(alike, 0, 8, 0, 10, 0);
    EXPECT_TRUE(skin_of(alike).roofs.empty());
}

TEST(Skin, GroundIsDrawnBeforeRoofs) {
    City city = city_of({});
    add_roof(city, 0, 5, 0, 10, 0);
    city.ground.vertices = {{0, 5, 0}, {0, 5, 5}, {5, 5, 0}};
    city.ground.indices = {0, 1, 2};
    city.ground.kinds = {Surface::path};
    Skin skin = skin_of(city);
    ASSERT_EQ(skin.roofs.size(), 1u);
    EXPECT_NEAR(area_of(skin.roofs[0]), 50 - 12.5f, 0.1f);
}

bool is_in(const std::vector<Vec3>& polygon, Vec3 p, Vec3 normal) {
    for (size_t k = 0; k < polygon.size(); ++k) {
        Vec3 a = polygon[k], b = polygon[(k + 1) % polygon.size()];
        if (length(b - a) > 1e-5f && dot(cross(b - a, p - a), normal) < -0.004f * length(b - a)) return false;
    }
    return true;
}

// Whether a face is drawn at a place, to 7 mm.
bool is_drawn_at(const City& city, const Skin& skin, Vec3 p, Vec3 normal) {
    auto listed = skin.faces.begin();
    for (uint32_t i = 0; i < city.ground.faces.size(); ++i) {
        bool is_cut = listed != skin.faces.end() && listed->of == i;
        const Remnant* remnant = is_cut ? &*listed++ : nullptr;
        const Face& f = city.ground.faces[i];
        Vec3 n = normalize_or(cross(at_height(on_ground(f.b - f.a), 0), {0, 1, 0}), {0, 0, 1});
        if (dot(n, normal) < 0.997f || std::fabs(dot(n, p - f.a)) > 0.007f) continue;
        std::vector<std::vector<Vec3>> pieces{{f.a, f.b, {f.b.x, f.b_top, f.b.z}, {f.a.x, f.a_top, f.a.z}}};
        if (remnant) pieces = remnant->pieces;
        for (const auto& piece : pieces)
            if (is_in(piece, p, n)) return true;
    }
    return false;
}

// Halves of three heights over one another, twins of two heights under a steep roof, and rows at a slant.
TEST(Skin, NothingIsMissing) {
    Sketch s;
    s.way(box(0, 0, 4000, 2000), "building=yes height=30");
    s.way(box(0, 0, 4000, 2000), "building:part=yes height=12");
    s.way(box(0, 0, 2000, 2000), "building:part=yes height=30 min_height=12");
    s.way(box(1000, 0, 2000, 2000), "building:part=yes height=25 min_height=9");
    s.way(box(6000, 0, 2000, 2000), "building=yes height=14 roof:shape=gabled roof:height=8");
    s.way(box(6000, 0, 2000, 2000), "building=yes height=9 roof:shape=flat");
    for (auto [x, y, height] : {std::tuple(-6000, 0, "9"), {-4997, 301, "12"}, {-3994, 602, "7"}})
        s.way({{x, y}, {x + 2000, y + 600}, {x + 1700, y + 1600}, {x - 300, y + 1000}},
              std::string("building=yes roof:shape=flat height=") + height);
    TestFolder folder;
    Result<City> city = load_osm(folder.write("map.osm", s.xml()));
    ASSERT_TRUE(city) << city.error().message;
    Skin skin = skin_of(*city);
    EXPECT_GE(skin.faces.size(), 8u);
    size_t missing = 0, asked = 0;
    for (const Remnant& cut : skin.faces) {
        const Face& f = city->ground.faces[cut.of];
        Vec3 n = normalize_or(cross(at_height(on_ground(f.b - f.a), 0), {0, 1, 0}), {0, 0, 1});
        for (uint32_t k = 0; k < 200; ++k) {
            RandomKey key{cut.of, k, 0, Purpose::colour};
            float u = random_unit(key, 0), v = random_unit(key, 1);
            Vec3 p = lerp(f.a, f.b, u);
            p.y = lerp(p.y, lerp(f.a_top, f.b_top, u), v);
            ++asked;
            missing += !is_drawn_at(*city, skin, p, n);
        }
    }
    EXPECT_GT(asked, 1000u);
    EXPECT_EQ(missing, 0u);
}

}  // namespace
}  // namespace flaneur
