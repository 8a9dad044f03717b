// How many walk before a yard.
#include <gtest/gtest.h>

#include <memory>

#include "assets/scene.h"
#include "assets/stages/yard.h"
#include "sim/world.h"

namespace flaneur {
namespace {

TEST(Yard, HasRoomForAsManyAsAreThereWhereNobodySaysHowMany) {
    for (const uint64_t seed : {1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u}) {
        const auto city = std::make_shared<const City>(build_yard(seed));
        WorldOptions options;
        options.seed = seed;
        options.walkers = k_yard_walkers;
        const auto world = make_world(std::shared_ptr<const Ground>(city, &city->ground), options);
        EXPECT_TRUE(world) << seed;
    }
}

}  // namespace
}  // namespace flaneur
