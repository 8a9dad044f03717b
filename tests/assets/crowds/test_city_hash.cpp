// One state from every compiler, sanitized or not, of crowds in cities that are made and that are read.
#include <gtest/gtest.h>

#include "assets/cities.h"
#include "sim/sim.h"
#include "sim/world.h"

namespace flaneur {
namespace {

// Of forty people after ten seconds.
uint64_t hash_in(City city) {
    const auto kept = std::make_shared<const City>(std::move(city));
    WorldOptions options;
    options.destinations = kept->destinations;
    options.walkers = 40;
    options.threads = 2;
    auto made = make_world(std::shared_ptr<const Ground>(kept, &kept->ground), options);
    if (!made) return 0;
    for (int tick = 0; tick < 600; ++tick) step(**made);
    return hash_world(**made);
}

// A change that is meant to move people otherwise writes these down anew, as it does those of
// tests/program/golden.
TEST(CityHash, IsOneWhereACityIsMade) { EXPECT_EQ(hash_in(generate_district({1, 1})), 0xadd6543531588d2u); }

TEST(CityHash, IsOneWhereAMapIsRead) {
    Result<City> map = load_osm(FLANEUR_SOURCE_DIR "/tests/program/small.osm");
    ASSERT_TRUE(map) << map.error().message;
    EXPECT_EQ(hash_in(std::move(*map)), 0x69278b4cbd8ba7fdu);
}

}  // namespace
}  // namespace flaneur
