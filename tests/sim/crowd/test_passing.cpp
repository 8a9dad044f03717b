// Two who meet head-on pass each other, on the side where people do so.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/math.h"
#include "sim/crowd/crowd.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

constexpr float k_length = 40, k_width = 6;

struct Pass {
    int changes = 0;    // of the side on which they are of each other
    float apart = 0;    // metres that the one who goes along +x is to the right of the other at the end
    float nearest = 9;  // metres between their bodies
    bool is_past = false;
};

// One goes along +x, the other along -x, a little beside the first one's line.
Pass meet(PassOn side, float beside, float speed, float other_speed) {
    const Ground ground = corridor(k_length, k_width);
    NavmeshPtr mesh = std::move(build_navmesh(ground, {}, 1)).value();
    WorkersPtr workers = make_workers(1);
    prepare_queries(*mesh, 1);
    Crowd c = make_crowd(2);
    c.traffic = make_traffic(*mesh);
    c.pass_on = side;
    auto add = [&](float x, float z, float heading, float goal_x, float pace) {
        Walker walker;
        walker.place = *nearest(*mesh, 0, {x, 0, z});
        walker.heading = heading;
        walker.preferred_speed = pace;
        walker.errand = Errand::arrive;
        const uint32_t i = add_walker(c, surroundings_of(ground), walker);
        send_to(c, i, *nearest(*mesh, 0, {goal_x, 0, z}));
    };
    add(2, 0, k_pi / 2, k_length - 2, speed);
    add(k_length - 2, beside, -k_pi / 2, 2, other_speed);
    Pass pass;
    float side_was = 0;
    for (uint32_t tick = 0; tick < 60 * 60 && !pass.is_past; ++tick) {
        step_crowd(c, surroundings_of(ground), *mesh, *workers, tick, 1);
        const Vec2 off = on_ground(c.motion.position[0] - c.motion.position[1]);
        pass.nearest = std::min(pass.nearest, length(off) - 0.5f);
        // Only while they mind each other, and by more than walking sways.
        if (std::fabs(off.x) < 8 && std::fabs(off.z) > 0.06f) {
            const float now = off.z > 0 ? 1.0f : -1.0f;
            if (side_was != 0 && now != side_was) ++pass.changes;
            side_was = now;
        }
        pass.is_past = off.x > 1;
        if (pass.is_past) pass.apart = off.z;
    }
    return pass;
}

TEST(Passing, HeadOnPairsChangeSidesOnceAtMost) {
    int on_right = 0, count = 0;
    for (int k = -6; k <= 6; ++k)
        for (const float speed : {0.9f, 1.34f, 1.8f})
            for (const float other : {1.1f, 1.34f}) {
                const float beside = 0.1f * static_cast<float>(k);
                const Pass pass = meet(PassOn::right, beside, speed, other);
                EXPECT_TRUE(pass.is_past) << beside << " " << speed << " " << other;
                EXPECT_LE(pass.changes, 1) << beside << " " << speed << " " << other;
                EXPECT_GT(pass.nearest, -0.05f) << beside << " " << speed << " " << other;
                on_right += pass.apart > 0;
                ++count;
            }
    EXPECT_GT(on_right, count / 2);
}

// Who comes straight at each other has no better side than the usual one.
TEST(Passing, IsOnTheLocalSide) {
    for (const float speed : {1.0f, 1.34f, 1.7f}) {
        EXPECT_GT(meet(PassOn::right, 0, speed, 1.34f).apart, 0.3f) << speed;
        EXPECT_LT(meet(PassOn::left, 0, speed, 1.34f).apart, -0.3f) << speed;
    }
}

}  // namespace
}  // namespace flaneur
