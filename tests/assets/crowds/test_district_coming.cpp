// Ten minutes of 500 people on the district, who come and go.
#include <gtest/gtest.h>

#include "assets/cities.h"
#include "sim/coming/coming.h"

namespace flaneur {
namespace {

TEST(DistrictComing, KeepsItsNumberForTenMinutes) {
    constexpr uint32_t k_people = 500, k_ticks = 10 * 60 * 60;
    const City city = generate_district({1, 4});
    const Surroundings around = surroundings_of(city.ground);
    const Result<NavmeshPtr> mesh = build_navmesh(city.ground, {}, 2);
    ASSERT_TRUE(mesh);
    prepare_queries(**mesh, 2);
    const WorkersPtr workers = make_workers(2);
    const Folk folk;
    Result<Crowd> made = populate(city.ground, around, city.destinations, **mesh, *workers, k_people,
                                  {&folk, 1}, 1, 17.5f, 0, k_usual_leaving);
    ASSERT_TRUE(made);
    Crowd& c = *made;
    Coming coming;
    coming.home = find_neighbourhood(city.ground, **mesh, k_people);
    make_room(coming, c);
    uint32_t most_waiting = 0;
    float deepest = -1, nearest_comer = 100;
    for (uint32_t tick = 0; tick < k_ticks; ++tick) {
        come_and_go(coming, c, around, **mesh, *workers, {&folk, 1}, tick, 1);
        for (const uint32_t i : coming.arrivals)
            for (const WalkerId other : c.slots.living)
                if (other.index != i &&
                    std::fabs(c.motion.position[other.index].y - c.motion.position[i].y) < 1.8f)
                    nearest_comer =
                        std::min(nearest_comer,
                                 length(on_ground(c.motion.position[other.index] - c.motion.position[i])));
        step_crowd(c, around, **mesh, *workers, tick, 1);
        ASSERT_EQ(c.slots.living.size() + waiting(coming), k_people);
        most_waiting = std::max(most_waiting, waiting(coming));
        if (tick % 10 == 0) deepest = std::max(deepest, deepest_overlap(c));
    }
    std::printf("%u left, %u came in, %u waited at most; deepest overlap %.3f m, nearest comer %.3f m\n",
                coming.left, coming.came, most_waiting, static_cast<double>(deepest),
                static_cast<double>(nearest_comer));
    EXPECT_GT(coming.left, k_people / 2);
    EXPECT_LE(most_waiting, k_people / 50);
    EXPECT_LT(deepest, 0.05f);
    EXPECT_GE(nearest_comer, 0.5f);
}

}  // namespace
}  // namespace flaneur
