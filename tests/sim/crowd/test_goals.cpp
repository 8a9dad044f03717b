// Those who stand at a goal keep others from it.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/math.h"
#include "sim/world.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

// Whom they shove to and fro, nearer and farther off again, stops there: it comes no nearer to its goal.
TEST(Goals, WhoIsShovedToAndFroBesideItsGoalStops) {
    Ground ground = square(20);
    index_ground(ground);
    WorldOptions options;
    options.capacity = 1;
    options.threads = 1;
    options.kinds = {Kind{standard_body(1.7f)}};
    auto made = make_world_on(ground, options);
    ASSERT_TRUE(made) << made.error().message;
    World& w = **made;
    const auto id = add_walker(w, {.place = Vec3{1.4f, 0, 0}, .kind = 0});
    ASSERT_TRUE(id);
    ASSERT_TRUE(send_to(w, *id, {0, 0, 0}));
    constexpr float k_seconds = 5;  // to and fro
    int tick = 0;
    for (; tick < 60 * 60 && !has_arrived(w, *id); ++tick) {
        const float turn = static_cast<float>(tick) * (2 * k_pi / (60 * k_seconds));
        w.crowd.motion.position[id->index] = {1.4f + 0.5f * std::sin(turn), 0, 0};
        w.crowd.motion.velocity[id->index] = {0, 0};
        step(w);
    }
    EXPECT_TRUE(has_arrived(w, *id));
    EXPECT_GT(tick, 10 * 60) << "has no patience";
}

}  // namespace
}  // namespace flaneur
