#include <gtest/gtest.h>
#include <sys/resource.h>
#include <tiffio.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "assets/plan/ground_plan.h"
#include "assets/terrain/terrain.h"
#include "tests/assets/city_checks.h"
#include "tests/assets/tiny/terrain.h"
#include "tests/folder.h"

namespace flaneur {
namespace {

namespace fs = std::filesystem;

constexpr LonLatBox k_box{7.41, 43.73, 7.42, 43.74};

// A slope that a spline keeps as it is: 1000 metres a degree to the east, 600 to the north.
int slope_from(double west, double north, int column, int row, int steps) {
    return static_cast<int>(
        std::lround((west + double(column) / steps) * 1200 + (north - double(row) / steps) * 600 - 30000));
}

TEST(Terrain, TilesSayHowHighTheGroundIs) {
    TestFolder folder;
    std::string path = folder / "N43E007.hgt";
    write_hgt(path, 1201, [](int column, int row) { return slope_from(7, 44, column, row, 1200); });
    Result<Terrain> terrain = read_terrain(path, k_box);
    ASSERT_TRUE(terrain) << terrain.error().message;
    EXPECT_LT(terrain->heights.size(), 1000u) << "the window only";
    EXPECT_NEAR(height_at(*terrain, 7.415, 43.735), 7.415 * 1200 + 43.735 * 600 - 30000, 0.6);
}

TEST(Terrain, GeoTiffsOfAllKindsAgree) {
    TestFolder folder;
    for (bool floats : {false, true}) {
        for (bool tiled : {false, true}) {
            for (uint16_t compression : {uint16_t{COMPRESSION_NONE}, uint16_t{COMPRESSION_ADOBE_DEFLATE}}) {
                std::string path = folder / "slope.tif";
                write_tiff(path, 61, 50, {floats, tiled, floats, 2, compression},
                           [](int column, int row) { return slope_from(7.4, 43.75, column, row, 1200); });
                Result<Terrain> terrain = read_terrain(path, k_box);
                ASSERT_TRUE(terrain) << terrain.error().message;
                EXPECT_NEAR(height_at(*terrain, 7.415, 43.735), 7.415 * 1200 + 43.735 * 600 - 30000, 0.6);
            }
        }
    }
}

TEST(Terrain, HolesAreFilledAndTheFarSeaIsLevel) {
    TestFolder folder;
    std::string path = folder / "N43E007.hgt";
    write_hgt(path, 1201, [](int column, int) {
        return column > 496 ? -32768 : column == 490 ? -32768 : 40;
    });
    Result<Terrain> terrain = read_terrain(path, k_box);
    ASSERT_TRUE(terrain);
    EXPECT_FLOAT_EQ(height_at(*terrain, 7 + 490 / 1200.0, 43.735), 40);
    EXPECT_FLOAT_EQ(height_at(*terrain, 7 + 507.9 / 1200.0, 43.735), 0);
    for (float h : terrain->heights) EXPECT_TRUE(h == 40 || h == 0);
}

TEST(Terrain, WhatCannotBeUsedIsRefusedByName) {
    TestFolder folder;
    auto refused = [&](const std::string& name, const std::string& why) {
        Result<Terrain> terrain = read_terrain(folder / name, k_box);
        ASSERT_FALSE(terrain) << name;
        EXPECT_NE(terrain.error().message.find(name), std::string::npos) << terrain.error().message;
        EXPECT_NE(terrain.error().message.find(why), std::string::npos) << terrain.error().message;
    };
    auto flat = [](int, int) { return 3; };
    refused("nowhere.tif", "no file");
    write_hgt(folder / "N40E000.hgt", 1201, flat);
    refused("N40E000.hgt", "N43E007");
    write_hgt(folder / "monaco.hgt", 1201, flat);
    refused("monaco.hgt", "south-west corner");
    write_hgt(folder / "N43E007.hgt", 77, flat);
    refused("N43E007.hgt", "cut short");
    write_tiff(folder / "small.tif", 8, 8, {}, flat);
    refused("small.tif", "does not cover");
    write_tiff(folder / "utm.tif", 61, 50, {true, false, true, 1}, flat);
    refused("utm.tif", "EPSG:32632");
    write_hgt(folder / "N43E007.hgt", 1201, [](int, int) { return -32768; });
    refused("N43E007.hgt", "nothing but voids");
    for (const char* name : {"noise.tif", "noise.hgt.zip", "noise.asc"})
        std::ofstream(folder / name) << "neither a picture nor an archive";
    refused("noise.tif", "no TIFF");
    refused("noise.hgt.zip", "no zip");
    refused("noise.asc", "GeoTIFF");
}

// A few kilobytes that claim to hold gigabytes of samples.
TEST(Terrain, BombsAreRefusedEarly) {
    TestFolder folder;
    for (bool tiled : {false, true}) {
        write_tiff(folder / "bomb.tif", 61, 50, {true, tiled, true, 2, COMPRESSION_ADOBE_DEFLATE},
                   [](int, int) { return 3; });
        TIFF* tiff = TIFFOpen((folder / "bomb.tif").c_str(), "r+");
        ASSERT_TRUE(tiff);
        TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, 100'000);
        TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, 100'000);
        if (tiled) {
            TIFFSetField(tiff, TIFFTAG_TILEWIDTH, 32'768);
            TIFFSetField(tiff, TIFFTAG_TILELENGTH, 32'768);
        } else {
            TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 100'000);
        }
        TIFFRewriteDirectory(tiff);
        TIFFClose(tiff);
        rusage before{}, after{};
        getrusage(RUSAGE_SELF, &before);
        Result<Terrain> terrain = read_terrain(folder / "bomb.tif", k_box);
        getrusage(RUSAGE_SELF, &after);
        ASSERT_FALSE(terrain);
        EXPECT_NE(terrain.error().message.find("strips that are not read"), std::string::npos)
            << terrain.error().message;
        EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 100 << 10) << "kilobytes";
    }
}

TEST(Terrain, SpoiltFilesDoNotCrash) {
    TestFolder folder;
    write_tiff(folder / "whole.tif", 61, 50, {true, true, true, 2, COMPRESSION_ADOBE_DEFLATE},
               [](int column, int row) { return column + row; });
    std::ifstream in(folder / "whole.tif", std::ios::binary);
    std::string whole{std::istreambuf_iterator<char>(in), {}};
    int refused = 0;
    for (uint64_t seed = 0; seed < 300; ++seed) {
        std::string spoilt = whole;
        for (uint32_t i = 0; i < 6; ++i) {
            uint64_t r = random_bits({seed, 0, 0, Purpose::spawn}, i);
            spoilt[r % spoilt.size()] = static_cast<char>(r >> 56);
        }
        if (seed % 3 == 0) spoilt.resize(spoilt.size() * (seed + 1) / 302);
        std::ofstream(folder / "spoilt.tif", std::ios::binary) << spoilt;
        Result<Terrain> terrain = read_terrain(folder / "spoilt.tif", k_box);
        refused += !terrain;
        if (!terrain) continue;
        for (float h : terrain->heights) ASSERT_TRUE(std::isfinite(h));
    }
    EXPECT_GT(refused, 50);
}

TEST(Terrain, BothFilesOfMonacoAgree) {
    fs::path maps = fs::path(FLANEUR_SHARED_DIR) / "corpus" / "osm";
    if (!fs::exists(maps)) GTEST_SKIP() << "There is no " << maps << ".";
    Result<Terrain> tile = read_terrain((maps / "N43E007_srtm3_monaco.hgt.zip").string(), k_box);
    Result<Terrain> tiff = read_terrain((maps / "monaco_srtm.tif").string(), k_box);
    ASSERT_TRUE(tile) << tile.error().message;
    ASSERT_TRUE(tiff) << tiff.error().message;
    // The GeoTIFF was cropped from the tile by nearest samples, half a sample off.
    float highest = 0;
    for (double u = 0.1; u < 1; u += 0.1) {
        for (double v = 0.1; v < 1; v += 0.1) {
            double longitude = k_box.west + 0.01 * u, latitude = k_box.south + 0.01 * v;
            float h = height_at(*tiff, longitude, latitude);
            EXPECT_NEAR(h, height_at(*tile, longitude + 0.5 / 1200, latitude - 0.5 / 1200), 0.05f);
            highest = std::max(highest, h);
        }
    }
    EXPECT_GT(highest, 100);
    LonLatBox portland{-122.69, 45.50, -122.66, 45.53};
    Result<Terrain> ned = read_terrain((maps / "portland_ned_float32.tif").string(), portland);
    ASSERT_TRUE(ned) << ned.error().message;
    EXPECT_NEAR(height_at(*ned, -122.675, 45.515), 15, 12);
}

// However the areas are cut, every piece of ground lies in the plane of its half square, and neighbours meet.
TEST(Terrain, GroundLiesInPlanesAndHasNoGaps) {
    GroundPlan plan;
    plan.low = {-50, -40}, plan.high = {55, 47};
    plan.cell = 16;
    auto hill = [](Vec2 p) { return 12 / (1 + 0.0004f * dot(p, p)) + 0.1f * p.x; };
    plan.terrain = hill;
    facet_terrain(plan);
    Area road, rest;
    road.rank = 1;
    road.kind = Surface::road;
    add_strip(road.rings, {{-60, -31}, {3, 7.7f}, {60, 22}}, 4, 4, true);
    rest.rank = 2;
    rest.kind = Surface::grass;
    rest.rings = {rectangle(to_point(plan.low), to_point(plan.high))};
    plan.areas = {road, rest};
    City city;
    lay_ground(plan, city);
    index_city(city);
    EXPECT_TRUE(city.ground.faces.empty()) << "both areas lie on the terrain";
    for (size_t t = 0; t < city.ground.kinds.size(); ++t) {
        if (map_area(city, t) > 0.01) {
            EXPECT_GT(triangle_normal(city, t).y, 0.93f);
        }
    }
    for (uint64_t i = 0; i < 2000; ++i) {
        RandomKey key{i, 0, 0, Purpose::spawn};
        Vec2 p{random_between(key, -49.9f, 54.9f), random_between(key, -39.9f, 46.9f, 1)};
        std::optional<GroundHit> hit = ground_at(city.ground, at_height(p, terrain_at(plan, p)), 1, 1);
        ASSERT_TRUE(hit);
        EXPECT_NEAR(hit->height, terrain_at(plan, p), 2e-3f);
        EXPECT_NEAR(hit->height, hill(p), 0.6f);
    }
}

}  // namespace
}  // namespace flaneur
