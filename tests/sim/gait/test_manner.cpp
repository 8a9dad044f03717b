#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/math.h"
#include "sim/base/tick.h"
#include "sim/body/manner.h"
#include "sim/gait/gait.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

TEST(Manner, PeopleSpreadAroundTheMiddle) {
    for (float years : {7.0f, 30.0f, 85.0f}) {
        Manner middle = manner_at_age(years);
        constexpr int k_people = 4000;
        double stride = 0, squares = 0, width = 0;
        for (uint32_t i = 0; i < k_people; ++i) {
            Manner m = draw_manner(middle, {3, i, 0, Purpose::style});
            double s = static_cast<double>(m.stride / middle.stride) - 1;
            stride += s / k_people;
            squares += s * s / k_people;
            width += static_cast<double>(m.step_width / middle.step_width) / k_people;
            EXPECT_GT(m.step_width, 0);
            EXPECT_GT(m.arm_swing[0], 0);
            EXPECT_GT(m.arm_swing[1], 0);
            EXPECT_GT(m.toe_out, 0);
        }
        EXPECT_NEAR(stride, 0, 0.005);
        EXPECT_NEAR(std::sqrt(squares), 0.047, 0.006);
        EXPECT_NEAR(width, 1, 0.01);
    }
}

TEST(Manner, NoTwoPeopleHoldOrSwingTheirArmsAlike) {
    Manner middle = manner_at_age(40);
    constexpr uint32_t k_people = 1000;
    double elbow = 0, favoured = 0;
    for (uint32_t i = 0; i < k_people; ++i) {
        Manner m = draw_manner(middle, {3, i, 0, Purpose::style});
        elbow += static_cast<double>(m.elbow * m.elbow / k_people);
        float left = m.arm_swing[0], right = m.arm_swing[1];
        favoured += static_cast<double>(std::fabs(left - right) / (0.5f * (left + right)) / k_people);
    }
    EXPECT_NEAR(std::sqrt(elbow) / static_cast<double>(k_radians), 3.2, 0.4);  // CMU motion capture
    EXPECT_GT(favoured, 0.2);
    EXPECT_LT(favoured, 0.46);
}

struct Steps {
    double mean_width = 0, width_sd = 0, time_sd = 0;  // metres, metres, share
};
Steps steps_of(const Manner& manner) {
    Ground ground;
    add_floor(ground, {-5, -5}, {5, 300}, 0, Surface::plaza);
    index_ground(ground);
    uint32_t body = 0;
    float scale = 1, heading = 0, turn_rate = 0;
    Vec3 position;
    Vec2 velocity{0, 1.3f};
    RootMotion root{&position, &velocity, &heading, &turn_rate, &velocity};
    Gait gait;
    start_gait(gait, 1, {standard_body(1.75f)}, &body, &scale, root, surroundings_of(ground), 11, &manner);
    std::vector<double> widths, times;
    int last_tick = 0;
    bool was_swinging[2] = {false, false};
    for (int t = 0; t < 150 * 60; ++t) {
        position += at_height(velocity * k_tick, 0);
        advance_gait(gait, 0, 1, root, surroundings_of(ground), 11, static_cast<uint32_t>(t), k_tick);
        for (Side side : {k_left, k_right}) {
            const GaitBlock& g = gait.blocks[0];
            bool swinging = g.feet[side].swinging[0] != 0;
            if (was_swinging[side] && !swinging && t > 600) {
                widths.push_back(static_cast<double>(g.feet[k_left].from.x[0] - g.feet[k_right].from.x[0]));
                if (last_tick > 0) times.push_back(t - last_tick);
                last_tick = t;
            }
            was_swinging[side] = swinging;
        }
    }
    auto spread = [](const std::vector<double>& values, double& mean) {
        double squares = 0;
        mean = 0;
        for (double v : values) mean += v / static_cast<double>(values.size());
        for (double v : values) squares += (v - mean) * (v - mean) / static_cast<double>(values.size());
        return std::sqrt(squares);
    };
    Steps steps;
    steps.width_sd = spread(widths, steps.mean_width);
    double time = 0;
    steps.time_sd = spread(times, time) / time;
    return steps;
}

TEST(Manner, StepsDifferAsPeoplesDo) {
    Manner even = manner_at_age(30), uneven = even;
    even.unevenness = 0;
    EXPECT_LT(steps_of(even).width_sd, 1e-3);
    Steps steps = steps_of(uneven);
    EXPECT_NEAR(steps.width_sd, 0.02, 0.008);
    EXPECT_NEAR(steps.mean_width, 0.055 * 1.75, 0.02);
    EXPECT_GT(steps.time_sd, 0.008);
    EXPECT_LT(steps.time_sd, 0.03);
}

TEST(Manner, ChangesSmoothlyWithAge) {
    Manner grown = manner_at_age(30), neutral;
    EXPECT_EQ(grown.stride, neutral.stride);
    EXPECT_EQ(grown.step_width, neutral.step_width);
    EXPECT_EQ(grown.arm_swing[0], neutral.arm_swing[0]);
    EXPECT_GT(manner_at_age(8).stride, grown.stride);
    EXPECT_GT(manner_at_age(8).step_width, grown.step_width);
    EXPECT_LT(manner_at_age(85).stride, grown.stride);
    EXPECT_LT(manner_at_age(85).arm_swing[0], grown.arm_swing[0]);
    EXPECT_GT(manner_at_age(85).stoop, grown.stoop);
    EXPECT_GT(manner_at_age(6).unevenness, grown.unevenness);
    EXPECT_GT(manner_at_age(85).step_width, manner_at_age(72).step_width);
    for (float years = 0; years < 120; years += 0.25f) {
        Manner a = manner_at_age(years), b = manner_at_age(years + 0.25f);
        EXPECT_LT(std::fabs(a.stride - b.stride), 0.01f) << years;
        EXPECT_LT(std::fabs(a.step_width - b.step_width), 0.002f) << years;
        EXPECT_LT(std::fabs(a.arm_swing[0] - b.arm_swing[0]), 0.01f) << years;
    }
}

}  // namespace
}  // namespace flaneur
