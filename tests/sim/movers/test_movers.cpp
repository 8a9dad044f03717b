// Rigid things that move, and what bears feet on them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/movers/movers.h"

namespace flaneur {
namespace {

// A thing of one solid by chance that goes by itself about `where`.
Mover by_chance(uint32_t number, Vec3 where) {
    const RandomKey key{3, number, 0, Purpose::city};
    Mover mover;
    MoverSolid solid;
    solid.form = number % 2 == 0 ? MoverSolid::Form::box : MoverSolid::Form::cylinder;
    solid.middle = {random_between(key, -0.5f, 0.5f, 0), random_between(key, -0.5f, 0.5f, 1), 0};
    const float across = random_between(key, 0.3f, 1.0f, 2);
    solid.half = {across, random_between(key, 0.05f, 0.5f, 3), across};
    solid.turn = rotation_y(random_between(key, 0, 3, 4));
    mover.solids = {solid};
    mover.place.middle = where;
    mover.place.reach = {0.4f, 0.2f, 0.1f};
    mover.angles.reach = {0.2f, 0.4f, 0.2f};
    for (int axis = 0; axis < 3; ++axis)
        mover.place.period[axis] = mover.angles.period[axis] =
            200 + static_cast<uint32_t>(40 * axis) + number;
    return mover;
}

// Whether a point lies in a thing's solid, but for `slack` metres.
bool holds(const Mover& mover, const Placement& at, Vec3 point, float slack) {
    const MoverSolid& solid = mover.solids[0];
    const Vec3 own = rotate(conjugate(solid.turn), to_own(at, point) - solid.middle);
    if (std::fabs(own.y) > solid.half.y + slack) return false;
    if (solid.form == MoverSolid::Form::cylinder) return length(on_ground(own)) <= solid.half.x + slack;
    return std::fabs(own.x) <= solid.half.x + slack && std::fabs(own.z) <= solid.half.z + slack;
}

TEST(Movers, BearWhereTheirTopIs) {
    std::vector<Mover> all;
    for (uint32_t n = 0; n < 12; ++n) all.push_back(by_chance(n, {0, static_cast<float>(n % 3), 0}));
    Movers movers = make_movers(all);
    int found = 0, empty = 0;
    for (uint32_t tick = 0; tick < 300; ++tick) {
        step_movers(movers, tick);
        for (uint32_t k = 0; k < 20; ++k) {
            const RandomKey key{9, k, tick, Purpose::city};
            const Vec3 point{random_between(key, -2, 2, 0), random_between(key, 0, 3, 1),
                             random_between(key, -2, 2, 2)};
            constexpr float k_up = 2, k_down = 4;
            const auto hit = mover_below(movers, point, k_up, k_down);
            if (!hit) {
                ++empty;
                continue;
            }
            ++found;
            EXPECT_NEAR(length(hit->normal), 1, 1e-4f);
            EXPECT_GE(hit->normal.y, 0.5f);
            EXPECT_TRUE(holds(movers.all[hit->mover], movers.places[hit->mover], hit->point, 2e-3f));
            EXPECT_FALSE(holds(movers.all[hit->mover], movers.places[hit->mover],
                               hit->point + Vec3{0, 0.01f, 0}, -1e-4f));
        }
    }
    EXPECT_GT(found, 1000);
    EXPECT_GT(empty, 100);
}

TEST(Movers, TheHighestBears) {
    std::vector<Mover> all;
    for (uint32_t n = 0; n < 12; ++n) {
        all.push_back(by_chance(n, {0, static_cast<float>(n % 3), 0}));
        all.back().angles.reach = {0, 0.4f, 0};
    }
    Movers movers = make_movers(all);
    for (uint32_t tick = 0; tick < 300; ++tick) {
        step_movers(movers, tick);
        for (uint32_t k = 0; k < 20; ++k) {
            const RandomKey key{9, k, tick, Purpose::city};
            const Vec3 point{random_between(key, -2, 2, 0), 10, random_between(key, -2, 2, 2)};
            float highest = -100;
            for (size_t i = 0; i < movers.all.size(); ++i) {
                const MoverSolid& solid = movers.all[i].solids[0];
                const float middle = to_world(movers.places[i], solid.middle).y;
                if (holds(movers.all[i], movers.places[i], {point.x, middle, point.z}, 0))
                    highest = std::max(highest, middle + solid.half.y);
            }
            const auto hit = mover_below(movers, point, 1, 20);
            ASSERT_EQ(hit.has_value(), highest > -100) << tick << " " << k;
            if (hit) {
                EXPECT_NEAR(hit->point.y, highest, 1e-4f);
            }
        }
    }
}

TEST(Movers, GoAsTheTickSaysAndStayWhereTheyAreLed) {
    Mover led = by_chance(1, {});
    led.kind = Mover::Kind::led;
    led.at_first = {{1, 2, 3}, rotation_y(1)};
    Movers movers = make_movers({by_chance(0, {0, 1, 0}), led});
    for (uint32_t tick = 0; tick < 100; ++tick) {
        const Placement before[] = {movers.places[0], movers.places[1]};
        step_movers(movers, tick);
        const Placement is = placement_at(movers.all[0], tick + 1);
        EXPECT_EQ(movers.places[0].position, is.position);
        EXPECT_EQ(movers.previous_places[0].position, before[0].position);
        EXPECT_EQ(movers.places[1].position, before[1].position);
        // What stands on it comes back to the same place of it.
        const Vec3 own{0.3f, 0.1f, -0.2f};
        EXPECT_LT(length(to_own(is, to_world(is, own)) - own), 1e-6f);
        movers.places[1].position.x += 0.01f;
    }
    EXPECT_NEAR(movers.places[1].position.x, 2, 1e-4f);
    EXPECT_NEAR(length(placement_between(movers.previous_places[1], movers.places[1], 0.5f).position -
                       movers.places[1].position),
                0.005f, 1e-5f);
}

TEST(Movers, AreGroundForWhoAsks) {
    Ground ground;
    ground.vertices = {{-5, 0, -5}, {-5, 0, 5}, {5, 0, 5}, {5, 0, -5}};
    ground.indices = {0, 1, 2, 0, 2, 3};
    ground.kinds.assign(2, Surface::plaza);
    index_ground(ground);
    Mover slab;
    slab.solids = {{.middle = {}, .half = {1, 0.1f, 1}}};
    slab.place.middle = {0, 0.4f, 0};
    Movers movers = make_movers({slab});
    const MovingGround both{&ground, &movers};
    const Surroundings around = surroundings_of(both);
    EXPECT_NEAR(ground_at(around, {0.5f, 1, 0.5f}, 1, 3)->height, 0.5f, 1e-6f);
    EXPECT_NEAR(ground_at(around, {2, 1, 0}, 1, 3)->height, 0, 1e-6f);
    EXPECT_NEAR(ground_at(around, {0, 0.1f, 0}, 0.1f, 3)->height, 0, 1e-6f) << "below it";
    EXPECT_FALSE(ground_at(around, {7, 1, 0}, 1, 3));
}

}  // namespace
}  // namespace flaneur
