// The old walk with canes, and what tips, hands and arms do is watched.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "sim/base/math.h"
#include "tools/flaneur/gait/cane.h"
#include "tools/flaneur/gait/measure/limits.h"
#include "tools/flaneur/gait/measure/walk.h"
#include "tools/flaneur/gait/trials.h"

namespace flaneur {
namespace {

constexpr float k_close = 0.005f;   // metres, to the ground and to where it was planted
constexpr double k_together = 0.1;  // seconds, of the tip and the other side's foot

// The worst of a walk.
struct Watched {
    float off_ground = 0, drift = 0;  // of a tip that stands, metres
    float below = 0;                  // of one in the air
    float beyond = 0, speed = 0;      // of the arm's joints, degrees and degrees a second
    int late = 0;                     // contacts of the foot without one of the tip
    int contacts = 0, stood = 0;
    std::string where;
};

void watch_arm(const Walk& w, size_t t, Watched& seen) {
    for (Joint joint : {right_upper_arm, right_lower_arm, right_hand}) {
        auto parent = static_cast<size_t>(k_joint_parents[joint]);
        auto against = [&](size_t tick) {
            return conjugate(w.ticks[tick].joints[parent].rotation) * w.ticks[tick].joints[joint].rotation;
        };
        const auto& now = w.ticks[t].joints;
        float beyond = beyond_limits(joint, joint_angles(joint, now[parent].rotation, now[joint].rotation));
        float same = std::min(std::fabs(dot(against(t), against(t - 1))), 1.0f);
        float speed = 2 * arccos(same) / k_radians * static_cast<float>(w.rate);
        if (speed > seen.speed)
            seen.where = std::string(k_joint_names[joint]) + " at " + std::to_string(t) + " of " +
                         std::to_string(w.ticks.size());
        seen.beyond = std::max(seen.beyond, beyond);
        seen.speed = std::max(seen.speed, speed);
    }
}

Watched watch(const Walk& w) {
    Watched seen;
    Vec3 planted = w.ticks[0].cane.tip;
    for (size_t t = 1; t < w.ticks.size(); ++t) {
        const CaneInstant &now = w.ticks[t].cane, &before = w.ticks[t - 1].cane;
        float over = now.tip.y - now.ground;
        if (now.stands) {
            if (!before.stands) planted = now.tip;
            seen.off_ground = std::max(seen.off_ground, std::fabs(over));
            seen.drift = std::max(seen.drift, length(now.tip - planted));
            ++seen.stood;
        } else {
            seen.below = std::max(seen.below, -over);
        }
        watch_arm(w, t, seen);
        if (!w.ticks[t - 1].feet[k_left].swinging || w.ticks[t].feet[k_left].swinging) continue;
        ++seen.contacts;
        // The nearest moment at which the tip comes down.
        double nearest = 1;
        for (size_t other = t > 60 ? t - 60 : 1; other < std::min(t + 60, w.ticks.size()); ++other) {
            if (w.ticks[other - 1].cane.stands || !w.ticks[other].cane.stands) continue;
            nearest =
                std::min(nearest, std::fabs(static_cast<double>(other) - static_cast<double>(t)) / w.rate);
        }
        seen.late += nearest >= k_together;
    }
    return seen;
}

Person old_person(float height, float age) {
    Person person{standard_body(height), manner_at_age(age)};
    person.body.cane = standard_cane(height);
    return person;
}

// Stands a second, walks, and stands for the last three.
Walk walk_on(const Course& course, const Person& person, float speed, float turn = 0, double seconds = 16) {
    Ground ground = ground_of(course);
    return walk(ground, person, seconds, [&](double t) {
        if (t < 1 || t >= seconds - 3) return Vec2{};
        return heading_direction(t < 6 ? 0 : turn) * speed;
    });
}

// `carried`: steps over which the cane may be carried.
void expect_planted(const Walk& w, const std::string& what, int carried = 0) {
    Watched seen = watch(w);
    EXPECT_LT(seen.off_ground, k_close) << what;
    EXPECT_LT(seen.drift, k_close) << what;
    EXPECT_LT(seen.below, k_close) << what;
    EXPECT_LE(seen.late, carried) << what;
    EXPECT_EQ(seen.beyond, 0) << what;
    EXPECT_LT(seen.speed, 900) << what << ", " << seen.where;
    EXPECT_GT(seen.contacts, 5) << what;
    EXPECT_GT(seen.stood, static_cast<int>(w.ticks.size()) / 2) << what;
}

TEST(Cane, StandsWithTheOtherFootOnTheLevel) {
    for (float height : {1.5f, 1.62f, 1.8f}) {
        for (float age : {68.0f, 85.0f}) {
            for (float speed : {0.5f, 0.8f, 1.1f})
                expect_planted(
                    walk_on(level_course(0), old_person(height, age), speed),
                    std::to_string(height).substr(0, 4) + " m, " + std::to_string(speed).substr(0, 3));
        }
    }
}

TEST(Cane, StandsOnSlopes) {
    for (float grade : {0.08f, -0.08f})
        for (float speed : {0.6f, 1.0f})
            expect_planted(walk_on(slope_course(2, grade), old_person(1.65f, 76), speed),
                           "slope " + std::to_string(grade));
}

// Down it, the foot may land where the tip cannot: the body is still above.
TEST(Cane, StandsUpAndDownAKerb) {
    for (int i = 0; i < 8; ++i)
        expect_planted(
            walk_on(kerb_course(2 + 0.15f * static_cast<float>(i), 0.12f), old_person(1.65f, 76), 0.8f),
            "kerb " + std::to_string(i), 1);
}

TEST(Cane, StandsWhileTheBodyTurns) {
    for (float turn : {-90.0f, 90.0f, 180.0f})
        expect_planted(walk_on(level_course(30), old_person(1.65f, 76), 0.9f, turn * k_radians),
                       "turn " + std::to_string(turn));
}

void expect_cane_bars(const Report& report, const std::string& who) {
    int bars = 0;
    for (const Verdict& v : report.verdicts) {
        if (std::string(v.bar.quantity).rfind("cane_", 0) != 0) continue;
        ++bars;
        EXPECT_TRUE(v.pass) << report.title << ", " << who << ": " << v.bar.quantity << " " << v.value;
    }
    EXPECT_GT(bars, 5);
}

TEST(Cane, MeetsItsBarsOnStairsAndKerbs) {
    for (float height : {1.55f, 1.75f}) {
        Person person = old_person(height, 80);
        std::string who = std::to_string(height).substr(0, 4) + " m";
        for (bool up : {true, false}) {
            expect_cane_bars(try_stairs(person, 1.1, up, 0.17, 0.29), who);
            expect_cane_bars(try_stairs(person, 1.1, up, 0.12, 0.35), who);
        }
        expect_cane_bars(try_kerb(person, 1.1, 0.12), who);
    }
}

TEST(Cane, MissesItsBarsWhereItHovers) {
    const Walk sound = walk_on(level_course(0), old_person(1.7f, 76), 0.8f);
    auto failing = [&](auto&& change) {
        Walk w = sound;
        for (size_t t = 0; t < w.ticks.size(); ++t) change(w.ticks[t].cane.tip, t);
        std::string names;
        for (const Verdict& v : judge(measure_cane(w, 60), cane_bars(true)))
            if (!v.pass) names += std::string(v.bar.quantity) + " ";
        return names;
    };
    EXPECT_EQ(failing([](Vec3&, size_t) {}), "");
    EXPECT_EQ(failing([](Vec3& tip, size_t) { tip.y += 0.1f; }), "cane_float.mm cane_carried.pct ");
    EXPECT_EQ(failing([](Vec3& tip, size_t) { tip.y -= 0.01f; }),
              "cane_float.mm cane_below.mm cane_carried.pct ");
    EXPECT_EQ(failing([](Vec3& tip, size_t t) { tip.x -= 0.0004f * static_cast<float>(t); }),
              "cane_drift.mm ");
    EXPECT_EQ(failing([](Vec3& tip, size_t t) { tip.x -= t == 400 ? 0.15f : 0; }), "cane_tip_speed.m_s ");
    EXPECT_EQ(failing([](Vec3& tip, size_t) { tip.x += 0.2f; }), "cane_leg.mm ");
}

}  // namespace
}  // namespace flaneur
