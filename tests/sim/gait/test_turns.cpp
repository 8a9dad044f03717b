// Turns on the spot and under way, and the shoes in them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/base/planar.h"
#include "sim/gait/shoes.h"
#include "tests/sim/gait/tried.h"

namespace flaneur {
namespace {

TEST(Turns, HeadLeadsAHalfTurn) {
    constexpr int k_trials = 12;  // over a stride
    float leads = 0;
    for (int trial = 0; trial < k_trials; ++trial) {
        Tried t = make_tried(wide_floor());
        for_seconds(t, 4 + 0.09f * static_cast<float>(trial), {0, 1.3f});
        float head_at = 0, body_at = 0, seconds = 0;
        for_seconds(t, 3, {0.001f, -1.3f}, [&] {
            seconds += k_tick;
            Vec3 ahead = rotate(joint_pose(t.poses, 0, head).rotation, {0, 0, 1});
            float head_yaw = std::fabs(heading_of(on_ground(ahead)));
            if (head_at == 0 && head_yaw > 0.5f) head_at = seconds;
            if (body_at == 0 && std::fabs(t.motion.heading) > 0.5f) body_at = seconds;
        });
        EXPECT_GT(body_at - head_at, 0.1f) << trial;
        EXPECT_LT(body_at - head_at, 0.5f) << trial << "; the body may wait for a step";
        leads += (body_at - head_at) / k_trials;
    }
    EXPECT_GT(leads, 0.15f);
    EXPECT_LT(leads, 0.35f);
}

TEST(Turns, WhoTurnsOnTheSpotGathersTheFeet) {
    Tried t = make_tried(wide_floor());
    float apart = 0, toes = 9;
    int turning = 0;
    for (int turn = 0; turn < 40; ++turn) {
        t.look = {};
        for_seconds(t, 2.5f + 0.01f * static_cast<float>(turn), {0, 0});
        t.look = heading_direction(t.motion.heading + 2.8f);
        for_seconds(t, 0.7f, {0, 0});
        for_seconds(t, 1.8f, {0, 0}, [&] {
            if (std::fabs(t.motion.turn_rate) < 1 || t.in_air(k_left) || t.in_air(k_right)) return;
            apart += length(t.foot_place(k_left) - t.foot_place(k_right));
            ++turning;
            const Vec2 left = heading_direction(t.motion.heading);
            toes =
                std::min(toes, dot(on_ground(t.soles[k_left].tip - t.soles[k_right].tip), {left.z, -left.x}));
        });
    }
    EXPECT_GT(turning, 150);
    EXPECT_LT(apart, 0.14f * static_cast<float>(turning));
    EXPECT_GT(toes, 0.05f) << "metres; shoes do not go through each other";
}

// Metres between the middle lines of two soles, on the ground.
float apart(const Sole& a, const Sole& b) {
    float least = 9;
    for (int i = 0; i <= 12; ++i) {
        const Vec2 at = on_ground(lerp(a.heel, a.tip, static_cast<float>(i) / 12)), heel = on_ground(b.heel),
                   tip = on_ground(b.tip);
        least = std::min(least, length(lerp(heel, tip, closest_on(heel, tip, at)) - at));
    }
    return least;
}

bool is_low(const Sole& s) { return std::min({s.heel.y, s.ball.y, s.tip.y}) < 0.03f; }

TEST(Turns, ShoesDoNotGoThroughEachOther) {
    double through = 0, turns = 0;
    for (float height : {1.2f, 1.72f}) {
        for (float speed : {0.7f, 0.9f, 1.1f, 1.3f}) {
            for (float turn : {0.8f, 1.57f, 2.4f, 3.0f, -0.8f, -1.57f, -2.4f, -3.0f}) {
                for (float begins : {2.0f, 2.15f, 2.3f, 2.45f}) {
                    Tried t = make_tried(wide_floor(), height);
                    for_seconds(t, begins, {0, speed});
                    const float wide = 0.36f * length(t.soles[k_left].tip - t.soles[k_left].heel);
                    for_seconds(t, 3, heading_direction(turn) * speed, [&] {
                        if (!is_low(t.soles[k_left]) || !is_low(t.soles[k_right])) return;
                        const float in = wide - apart(t.soles[k_left], t.soles[k_right]);
                        // Half of one may graze the other for a moment, but not stand there.
                        if (in > 0.5f * wide) ++through;
                        if (t.in_air(k_left) || t.in_air(k_right)) return;
                        EXPECT_LT(in, 0.6f * wide) << height << " m, " << speed << " m/s, " << turn;
                    });
                    ++turns;
                }
            }
        }
    }
    EXPECT_LT(through / turns, 0.5) << "ticks a turn";
}

constexpr FootSize k_foot{0.06f, 0.14f, 0.2f};

TEST(Shoes, ALandingIsMovedOffTheOtherOneToItsOwnSide) {
    const FootPlace there{{0, 0, 0}, 0};
    for (float yaw : {-1.2f, -0.6f, 0.0f, 0.6f, 1.2f}) {
        for (float x = -0.04f; x < 0.2f; x += 0.04f) {
            for (float z = -0.3f; z < 0.3f; z += 0.05f) {
                const FootPlace before{{x, 0, z}, yaw};
                FootPlace landing = before;
                keep_shoes_apart(landing, there, k_foot, {1, 0});
                EXPECT_GE(landing.position.x, x - 1e-5f);
                const float moved = length(landing.position - before.position);
                EXPECT_LE(moved, 0.301f);
                EXPECT_EQ(landing.yaw, yaw);
                auto sole = [](const FootPlace& p) {
                    const Vec3 ahead = at_height(heading_direction(p.yaw), 0);
                    return Sole{p.position - ahead * k_foot.heel, p.position + ahead * k_foot.ball,
                                p.position + ahead * k_foot.tip};
                };
                if (moved > 0.29f) continue;
                EXPECT_GT(apart(sole(landing), sole(there)), 0.05f) << yaw << ", " << x << ", " << z;
            }
        }
    }
    FootPlace far{{0.1f, 0, 0}, 0};
    keep_shoes_apart(far, there, k_foot, {1, 0});
    EXPECT_EQ(far.position.x, 0.1f) << "beside it, where there is room";
}

TEST(Shoes, ASwingGoesRoundTheOtherOneWithItsLeg) {
    const FootPlace there{{0, 0, 0}, 0};
    auto round = [&](float from_x, float to_x, float outward) {
        return way_round({{from_x, 0, -0.6f}, 0}, {{to_x, 0, 0.6f}, 0}, there, k_foot, outward);
    };
    EXPECT_EQ(round(0.1f, 0.1f, 1), 0);
    EXPECT_NEAR(round(0.04f, 0.04f, 1), 0.032f, 0.005f);
    EXPECT_NEAR(round(-0.03f, -0.03f, 1), 0.12f, 0.02f) << "from the other side";
    EXPECT_NEAR(round(-0.1f, -0.1f, -1), 0, 1e-6f);
    EXPECT_NEAR(round(0.12f, 0.12f, -1), 0.205f, 0.015f) << "beyond its leg";
}

TEST(Shoes, APlantedFootDoesNotTurnOntoTheOtherOne) {
    const FootPlace there{{0.1f, 0, 0}, 0};
    auto turned = [](float yaw) { return FootPlace{{0, 0, 0}, yaw}; };
    EXPECT_FALSE(turns_onto(turned(0), turned(-0.3f), there, k_foot)) << "away";
    EXPECT_FALSE(turns_onto(turned(0), turned(0.05f), there, k_foot)) << "with room";
    EXPECT_TRUE(turns_onto(turned(0.3f), turned(0.4f), there, k_foot));
    EXPECT_FALSE(turns_onto(turned(0.4f), turned(0.3f), there, k_foot)) << "off it";
}

}  // namespace
}  // namespace flaneur
