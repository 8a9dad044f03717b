// A city that is written comes back as the same ground.
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>

#include "assets/cities.h"
#include "assets/gltf/city/city.h"
#include "assets/gltf/read.h"
#include "sim/base/rng.h"
#include "tools/flaneur/city/model.h"

namespace flaneur {
namespace {

Result<City> read_back(const City& city) {
    std::string glb = still_glb(city_model(city));
    auto parsed = parse_gltf({reinterpret_cast<const uint8_t*>(glb.data()), glb.size()}, "", "city.glb");
    return parsed ? make_gltf_city(*parsed, "city.glb") : parsed.error();
}

// Random places on ground triangles, by number.
Vec3 place_on(const City& city, uint32_t n) {
    RandomKey key{7, n, 0, Purpose::colour};
    size_t t = std::min(static_cast<size_t>(random_unit(key) * static_cast<float>(city.ground.kinds.size())),
                        city.ground.kinds.size() - 1);
    Vec3 p[3];
    for (size_t k = 0; k < 3; ++k) p[k] = city.ground.vertices[city.ground.indices[3 * t + k]];
    return lerp(lerp(p[0], p[1], random_unit(key, 1)), p[2], 0.1f + 0.8f * random_unit(key, 2));
}

TEST(CityModel, ComesBackAsTheSameGround) {
    City city = generate_district({3, 2});
    Result<City> back = read_back(city);
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_TRUE(back->notes.empty()) << back->notes[0];
    constexpr uint32_t k_places = 20'000;
    uint32_t tried = 0, there = 0, alike = 0;
    for (uint32_t n = 0; n < k_places; ++n) {
        Vec3 p = place_on(city, n);
        auto own = ground_at(city.ground, p, 0.05f, 0.05f);
        if (!own || own->kind == Surface::water) continue;
        ++tried;
        auto other = ground_at(back->ground, p, 0.05f, 0.05f);
        there += other && std::fabs(other->height - own->height) < 0.005f;
        alike += other && other->kind == own->kind;
    }
    EXPECT_GT(tried, k_places / 2);
    EXPECT_GE(there, tried * 999 / 1000);
    EXPECT_GE(alike, tried * 99 / 100);
    // And no more than that, but for plinths low enough to stand on: no roofs.
    uint32_t more = 0;
    for (uint32_t n = 0; n < k_places; ++n) {
        Vec3 p = place_on(*back, n);
        more += !ground_at(city.ground, p, 0.02f, 0.3f);
    }
    EXPECT_LE(more, k_places / 1000);
}

TEST(CityModel, IsTheSameWhenItIsWrittenAgain) {
    City city = generate_district({1, 1});
    Result<City> once = read_back(city);
    ASSERT_TRUE(once) << once.error().message;
    Result<City> twice = read_back(*once);
    ASSERT_TRUE(twice) << twice.error().message;
    EXPECT_EQ(once->scenery.pictures.size(), twice->scenery.pictures.size());
    EXPECT_EQ(once->destinations.size(), twice->destinations.size());
}

}  // namespace
}  // namespace flaneur
