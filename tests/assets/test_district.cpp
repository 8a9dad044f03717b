#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "assets/cities.h"
#include "tests/assets/city_checks.h"

namespace flaneur {
namespace {

TEST(District, SameSeedSameCity) {
    EXPECT_EQ(hash_city(generate_district({7, 2})), hash_city(generate_district({7, 2})));
    EXPECT_NE(hash_city(generate_district({7, 2})), hash_city(generate_district({8, 2})));
}

TEST(District, IsSoundForSizesAndSeeds) {
    for (uint64_t seed = 1; seed <= 6; ++seed) {
        for (int blocks : {1, static_cast<int>(seed % 3) + 2, seed == 4 ? 7 : 2}) {
            City city = generate_district({seed, blocks});
            SCOPED_TRACE(testing::Message() << "seed " << seed << ", blocks " << blocks);
            check_city(city);
        }
    }
}

TEST(District, StaysSmall) {
    for (uint64_t seed = 1; seed <= 4; ++seed) {
        City city = generate_district({seed, 4});
        EXPECT_LT(city.ground.kinds.size() + city.ground.faces.size() * 2 + city.roof_buildings.size(),
                  60'000u);
    }
}

// No place has two grounds, so what random points find agrees with the triangles' areas.
TEST(District, GroundLiesNowhereTwice) {
    City city = generate_district({3, 3});
    double ground_area = 0;
    for (size_t t = 0; t < city.ground.kinds.size(); ++t) ground_area += map_area(city, t);
    size_t samples = 0, covered = 0, twice = 0;
    for (uint32_t i = 0; i < 40'000; ++i) {
        RandomKey key{5, i, 0, Purpose::spawn};
        Vec2 p{random_between(key, city.ground.low.x, city.ground.high.x, 0),
               random_between(key, city.ground.low.z, city.ground.high.z, 1)};
        int n = triangles_at(city, p);
        ++samples;
        covered += n > 0;
        twice += n > 1;
    }
    EXPECT_EQ(twice, 0u);
    double whole = static_cast<double>((city.ground.high.x - city.ground.low.x) *
                                       (city.ground.high.z - city.ground.low.z));
    EXPECT_NEAR(static_cast<double>(covered) / static_cast<double>(samples), ground_area / whole, 0.01);
}

TEST(District, HasWhatItPromises) {
    City city = generate_district({1, 4});
    std::array<double, k_surface_count> areas{};
    for (size_t t = 0; t < city.ground.kinds.size(); ++t)
        areas[static_cast<size_t>(city.ground.kinds[t])] += map_area(city, t);
    for (Surface kind : {Surface::road, Surface::sidewalk, Surface::crossing, Surface::plaza, Surface::path,
                         Surface::steps, Surface::grass, Surface::water}) {
        EXPECT_GT(areas[static_cast<size_t>(kind)], 10) << static_cast<int>(kind);
    }
    std::array<int, k_prop_count> props{};
    for (const Prop& p : city.props) ++props[static_cast<size_t>(p.kind)];
    EXPECT_GT(props[static_cast<size_t>(PropKind::tree)], 100);
    EXPECT_GT(props[static_cast<size_t>(PropKind::lamp)], 30);
    EXPECT_GT(props[static_cast<size_t>(PropKind::bench)], 5);
    // Barriers are only ever added.
    for (int kind = 0; kind < static_cast<int>(PropKind::barrier); ++kind)
        EXPECT_GT(props[static_cast<size_t>(kind)], 0) << kind;
    std::array<int, k_destination_count> places{};
    for (const Destination& p : city.destinations) ++places[static_cast<size_t>(p.kind)];
    for (int kind = 0; kind < k_destination_count; ++kind)
        EXPECT_GT(places[static_cast<size_t>(kind)], 0) << kind;
}

// Real steps: treads a step apart in height, with risers of 0.15 to 0.16 m between them.
TEST(District, FlightHasRealRisers) {
    City city = generate_district({1, 4});
    int risers = 0;
    for (const Face& f : city.ground.faces) {
        if (f.kind != FaceKind::riser) continue;
        ++risers;
        EXPECT_NEAR(f.a_top - f.a.y, 0.155f, 0.005f);
        EXPECT_NEAR(f.b_top - f.b.y, 0.155f, 0.005f);
    }
    EXPECT_GE(risers, 14);
    // On the square and on the stair street: level treads, each a whole number of risers above the lowest.
    std::vector<float> heights;
    for (size_t t = 0; t < city.ground.kinds.size(); ++t) {
        if (city.ground.kinds[t] != Surface::steps) continue;
        EXPECT_GT(triangle_normal(city, t).y, 0.9999f);
        heights.push_back(city.ground.vertices[city.ground.indices[t * 3]].y);
    }
    std::sort(heights.begin(), heights.end());
    EXPECT_GT(heights.back() - heights.front(), 20 * 0.155f);
}

// One stands on the ground wherever one goes to, clear of walls, and looks somewhere.
TEST(District, DestinationsCanBeStoodOn) {
    for (uint64_t seed : {1u, 2u, 3u}) {
        City city = generate_district({seed, 3});
        for (const Destination& place : city.destinations) {
            std::optional<GroundHit> hit = ground_at(city.ground, place.position, 0.1f, 0.1f);
            ASSERT_TRUE(hit);
            EXPECT_NE(hit->kind, Surface::water);
            EXPECT_FALSE(closest_wall(city.ground, place.position + Vec3{0, 1, 0}, 0.2f));
            EXPECT_NEAR(length(place.facing), 1, 1e-3f);
            EXPECT_GT(place.weight, 0);
        }
    }
}

// A street climbs: somewhere on a carriageway the ground falls by 4 to 9 in a hundred.
TEST(District, AStreetSlopes) {
    City city = generate_district({1, 4});
    float steepest = 0;
    for (size_t t = 0; t < city.ground.kinds.size(); ++t) {
        if (city.ground.kinds[t] != Surface::road || map_area(city, t) < 1) continue;
        Vec3 n = triangle_normal(city, t);
        steepest = std::max(steepest, std::sqrt(n.x * n.x + n.z * n.z) / n.y);
    }
    EXPECT_GT(steepest, 0.04f);
    EXPECT_LT(steepest, 0.09f);
}

TEST(District, WallColoursAreOpaque) {
    ASSERT_GT(k_wall_colour_count, 4);
    for (int i = 0; i < k_wall_colour_count; ++i) EXPECT_EQ(k_wall_colours[i] >> 24, 0xffu);
    for (const Building& b : generate_district({2, 2}).buildings) EXPECT_LT(b.style, k_wall_colour_count);
}

}  // namespace
}  // namespace flaneur
