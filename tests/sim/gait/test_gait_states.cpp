// One walker through all that feet do: pushes, steps aside, moving and rough ground, stairs, runs and jumps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/crowd/crowd.h"
#include "sim/gait/curves/norms.h"
#include "tests/sim/gait/tried.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

TEST(GaitStates, StepsAreEvenFromTheThird) {
    Tried t = make_tried(wide_floor());
    std::vector<float> lengths;
    Vec2 last{};
    for_seconds(t, 8, {0, 1.3f}, [&] {
        EXPECT_LT(t.drift, 5e-4f);
        for (int side : {0, 1}) {
            if (!t.landed[side]) continue;
            lengths.push_back(length(t.foot_place(side) - last));
            last = t.foot_place(side);
        }
    });
    ASSERT_GT(lengths.size(), 8u);
    float steady = lengths.back();
    for (size_t k = 2; k < lengths.size(); ++k) EXPECT_NEAR(lengths[k], steady, 0.12f * steady) << k;
}

TEST(GaitStates, StopsWithTheFeetSideBySide) {
    for (float speed : {0.6f, 0.95f, 1.3f, 1.6f}) {
        Tried t = make_tried(wide_floor());
        for_seconds(t, 4, {0, speed});
        int steps = 0;
        float foremost = t.position.z;
        for_seconds(t, 2.5f, {0, 0}, [&] {
            steps += t.landed[0] + t.landed[1];
            for (int side : {0, 1})
                if (t.landed[side]) foremost = std::max(foremost, t.foot_place(side).z);
        });
        EXPECT_TRUE(t.block().standing[0]);
        EXPECT_LE(steps, 3);
        EXPECT_NEAR(t.position.z, foremost, 0.12f) << speed << ": over the foot that it stops on";
        EXPECT_LT(std::fabs(t.foot_place(0).z - t.foot_place(1).z), 0.1f) << speed;
    }
}

TEST(GaitStates, NoJointJumps) {
    Tried t = make_tried(wide_floor());
    auto check = [&] {
        EXPECT_LT(t.fastest, 900) << t.tick;
        EXPECT_LT(t.acceleration, 90) << t.tick;
        EXPECT_LT(t.drift, 5e-4f) << t.tick;
    };
    for (Vec2 wish : {Vec2{0, 1.3f},
                      {0, 0},
                      {0, 0.9f},
                      {0.3f, 1.3f},
                      {0.01f, -1.2f},
                      {-1.0f, 0.3f},
                      {0, 0},
                      {0.2f, 0},
                      {0, 0.2f},
                      {0, 1.6f},
                      {0, 0.4f},
                      {0, 0}}) {
        for_seconds(t, 3, wish, check);
    }
}

TEST(GaitStates, FeetKeepTheirSidesInStepsAsideAndBack) {
    for (Vec2 wish : {Vec2{0.24f, 0}, {-0.24f, 0}, {0, -0.24f}, {0.16f, -0.16f}}) {
        Tried t = make_tried(wide_floor());
        for_seconds(t, 6, wish, [&] { EXPECT_GT(leftward(t), 0.03f) << t.tick; });
        for_seconds(t, 2, {0, 0}, [&] { EXPECT_GT(leftward(t), 0.03f); });
        EXPECT_EQ(t.motion.heading, 0);
        EXPECT_GT(length(on_ground(t.position)), 1.0f);
    }
}

TEST(GaitStates, CatchesAnyPush) {
#ifdef FLANEUR_SANITIZED  // a tenth of the speed, and the same code
    constexpr uint32_t k_trials = 40;
#else
    constexpr uint32_t k_trials = 200;
#endif
    for (uint32_t trial = 0; trial < k_trials; ++trial) {
        RandomKey key{9, trial, 0, Purpose::spawn};
        Tried t = make_tried(wide_floor(), random_between(key, 1.2f, 1.95f, 0));
        for_seconds(t, 0.5f, {0, 0});
        float speed = random_between(key, 0.2f, 1.2f, 1);
        Vec2 push = heading_direction(random_between(key, -k_pi, k_pi, 2)) * speed;
        t.motion.velocity += push;
        int steps = 0;
        float leg = k_leg_share * t.height;
        for_seconds(t, 3, {0, 0}, [&] {
            steps += t.landed[0] + t.landed[1];
            EXPECT_LT(t.drift, 5e-4f) << trial;
            // Never so far from both feet that one would fall.
            float nearest = 9;
            for (int side : {0, 1}) {
                nearest = std::min(nearest, length(t.foot_place(side) - on_ground(t.position)));
            }
            EXPECT_LT(nearest, 0.6f * leg) << trial;
        });
        EXPECT_LE(steps, 4) << trial;
        EXPECT_TRUE(t.block().standing[0]) << trial;
        // As far from the body as a foot of the widest stance, and a little.
        const float farthest = std::min(0.09f * t.height + 0.07f, 0.215f);
        for (int side : {0, 1})
            EXPECT_LT(length(t.foot_place(side) - on_ground(t.position)), farthest) << trial;
    }
}

TEST(GaitStates, APushAlongTheWayIsCaughtAhead) {
    Tried t = make_tried(wide_floor());
    for_seconds(t, 0.5f, {0, 0});
    t.motion.velocity = {0, 0.9f};
    float foremost = 0;
    bool landed = false;
    for_seconds(t, 1, {0, 0}, [&] {
        for (int side : {0, 1}) {
            if (!t.landed[side] || landed) continue;
            landed = true;
            foremost = t.foot_place(side).z - t.position.z;
        }
    });
    EXPECT_TRUE(landed);
    EXPECT_GT(foremost, -0.02f);
}

TEST(GaitStates, StandsFastOnAMovingTurningPlatform) {
    Tried t = make_tried(wide_floor());
    for_seconds(t, 1, {0, 0});
    Vec3 pivot{0.7f, 0, -0.4f};
    Vec3 centre = pivot;  // of the platform, as it moves
    float yaw = 0;
    auto in_platform = [&](Vec3 p) {
        SinCos turn = sin_cos(-yaw);
        Vec3 d = p - centre;
        return Vec3{d.x * turn.cosine + d.z * turn.sine, d.y, d.z * turn.cosine - d.x * turn.sine};
    };
    Vec3 stood[2] = {in_platform(t.soles[0].ball), in_platform(t.soles[1].ball)};
    for (int k = 0; k < 240; ++k) {
        float by = 0.006f, turn = 0.012f;
        Vec3 move{by, 0, 0.5f * by};
        carry_feet(t.gait, 0, centre, turn, move);
        Vec3 d = t.position - centre;
        SinCos sc = sin_cos(turn);
        t.position =
            centre + Vec3{d.x * sc.cosine + d.z * sc.sine, d.y, d.z * sc.cosine - d.x * sc.sine} + move;
        t.motion.heading = wrap_angle(t.motion.heading + turn);
        centre += move;
        yaw += turn;
        advance(t, {0, 0});
        for (Side side : {k_left, k_right}) {
            EXPECT_FALSE(t.in_air(side)) << k;
            EXPECT_LT(length(in_platform(t.soles[side].ball) - stood[side]), 1e-3f) << k;
        }
    }
}

TEST(GaitStates, WhoseGroundIsPulledAwayStepsAfterIt) {
    Tried t = make_tried(wide_floor());
    for_seconds(t, 0.5f, {0, 0});
    int steps = 0;
    for (int k = 0; k < 300; ++k) {
        carry_feet(t.gait, 0, {}, 0, {0, 0, -0.3f * k_tick});
        advance(t, {0, 0});
        steps += t.landed[0] + t.landed[1];
        for (int side : {0, 1}) EXPECT_LT(length(t.foot_place(side) - on_ground(t.position)), 0.5f);
    }
    EXPECT_GT(steps, 5);
}

TEST(GaitStates, StandsAndWalksOnRoughGround) {
    // Slabs of random heights, one a foot or so.
    Ground ground;
    RandomKey key{21, 0, 0, Purpose::city};
    constexpr float k_slab = 0.45f;
    for (int i = -4; i <= 4; ++i) {
        for (int j = -4; j <= 40; ++j) {
            float x = static_cast<float>(i) * k_slab, z = static_cast<float>(j) * k_slab;
            float y = random_between(key, 0, 0.12f, static_cast<uint32_t>((i + 4) * 64 + j + 4));
            add_floor(ground, {x - k_slab / 2, z - k_slab / 2}, {x + k_slab / 2, z + k_slab / 2}, y,
                      Surface::path);
        }
    }
    index_ground(ground);
    Tried t = make_tried(ground);
    int sunk = 0, planted = 0;
    auto check = [&] {
        EXPECT_LT(t.drift, 1e-3f) << t.tick;
        for (Side side : {k_left, k_right}) {
            if (t.in_air(side)) continue;
            ++planted;
            auto hit = ground_at(t.ground, t.soles[side].ball, 0.3f, 0.5f);
            sunk += hit && hit->height - t.soles[side].ball.y > 5e-3f;
        }
    };
    for_seconds(t, 1, {0, 0}, check);
    for_seconds(t, 12, {0, 0.9f}, check);
    for_seconds(t, 2, {0, 0}, check);
    EXPECT_GT(t.position.z, 8);
    EXPECT_LT(sunk, planted / 100);
}

// From z = 3 on, risers of 0.16 and treads of 0.32 m: up, or down where `sign` is -1.
Ground flight_of_14(float sign) {
    Ground ground;
    add_floor(ground, {-5, -10}, {5, 3}, 0, Surface::plaza);
    for (int i = 0; i < 14; ++i) {
        float z = 3 + static_cast<float>(i) * 0.32f, y = sign * 0.16f * static_cast<float>(i + 1);
        add_floor(ground, {-5, z}, {5, i < 13 ? z + 0.32f : 30}, y, Surface::steps);
    }
    index_ground(ground);
    return ground;
}

TEST(GaitStates, ClimbsOneTreadAStep) {
    for (float sign : {1.0f, -1.0f}) {
        Tried t = make_tried(flight_of_14(sign));
        int on_treads = 0;
        for_seconds(t, 13, {0, 1.3f}, [&] {
            // A body that falls no faster than gravity may lift a foot a little, but slides none.
            EXPECT_LT(t.slide, 5e-4f) << t.tick;
            EXPECT_LT(t.drift, 2e-3f) << t.tick;
            if (t.position.z > 3.7f) {
                EXPECT_LT(t.fastest, 900) << t.tick;
            }
            for (int side : {0, 1}) {
                float z = t.foot_place(side).z;
                if (!t.landed[side] || z < 3.4f || z > 6.8f) continue;
                ++on_treads;
                EXPECT_GT(t.foot(side).forefoot[0], 0.6f);
                EXPECT_NEAR(std::fabs(t.foot(0).to.y[0] - t.foot(1).to.y[0]), 0.16f, 0.165f);
            }
        });
        EXPECT_GE(on_treads, 8);
        EXPECT_LE(on_treads, 14);
        EXPECT_GT(t.position.z, 7);
    }
}

TEST(GaitStates, WhoStopsOnStairsGathersTheFeet) {
    for (float sign : {1.0f, -1.0f}) {
        int on_stairs = 0;
        for (int stop = 0; stop < 24; ++stop) {
            Tried t = make_tried(flight_of_14(sign), stop % 2 == 0 ? 1.75f : 1.6f);
            for_seconds(t, 4.5f + 0.07f * static_cast<float>(stop), {0, 1.0f});
            float farthest = -9;
            for_seconds(t, 3, {0, 0}, [&] {
                for (int side : {0, 1})
                    if (t.landed[side]) farthest = std::max(farthest, sign * t.foot(side).to.y[0]);
            });
            on_stairs += t.position.z > 3.4f && t.position.z < 7;
            EXPECT_LT(farthest, sign * t.foot(0).to.y[0] + 0.02f) << sign << " " << stop << ": on and back";
            EXPECT_TRUE(t.block().standing[0]) << stop;
            EXPECT_NEAR(t.foot(0).to.y[0], t.foot(1).to.y[0], 0.02f) << sign << " " << stop;
        }
        EXPECT_GE(on_stairs, 12);
    }
}

TEST(GaitStates, SmallChildrenSetBothFeetOnEachTread) {
    for (float sign : {1.0f, -1.0f}) {
        Tried t = make_tried(flight_of_14(sign), 1.03f);
        int landings[14] = {};
        for_seconds(t, 25, {0, 0.9f}, [&] {
            // A body that falls no faster than gravity may lift a foot a little, but slides none.
            EXPECT_LT(t.slide, 5e-4f) << t.tick;
            EXPECT_LT(t.drift, 2e-3f) << t.tick;
            for (int side : {0, 1}) {
                auto tread = static_cast<int>(std::lround(sign * t.foot(side).to.y[0] / 0.16f)) - 1;
                if (t.landed[side] && tread >= 0 && tread < 14) ++landings[tread];
            }
        });
        for (int tread = 1; tread < 13; ++tread) EXPECT_EQ(landings[tread], 2) << sign << " " << tread;
    }
}

TEST(GaitStates, ClimbsTreadsShorterThanTheFoot) {
    for (float depth : {0.24f, 0.26f}) {
        Ground ground;
        add_floor(ground, {-5, -10}, {5, 3}, 0, Surface::plaza);
        for (int i = 0; i < 16; ++i) {
            float z = 3 + static_cast<float>(i) * depth;
            add_floor(ground, {-5, z}, {5, i < 15 ? z + depth : 30}, 0.18f * static_cast<float>(i + 1),
                      Surface::steps);
        }
        index_ground(ground);
        Tried t = make_tried(ground);
        float last = 0;
        for_seconds(t, 14, {0, 1.3f}, [&] {
            for (Side side : {k_left, k_right}) {
                float z = t.foot_place(side).z;
                if (!t.landed[side] || z < 3.5f || z > 6) continue;
                auto hit = ground_at(t.ground, t.soles[side].ball, 0.3f, 0.3f);
                ASSERT_TRUE(hit);
                EXPECT_NEAR(hit->height, t.soles[side].ball.y, 0.03f) << depth << " m, tick " << t.tick;
                if (last > 0) {
                    EXPECT_NEAR(hit->height - last, 0.18f, 1e-3f) << depth << " m, tick " << t.tick;
                }
                last = hit->height;
            }
        });
        EXPECT_GT(t.position.z, 6);
    }
}

TEST(GaitStates, RunsFromFroudeOneHalf) {
    Tried t = make_tried(wide_floor());
    float leg = t.gait.people[0].joints[left_upper_leg][1][0];
    float limit = std::sqrt(0.5f * k_gravity * leg);
    for_seconds(t, 4, {0, limit - 0.1f});
    EXPECT_EQ(t.block().running[0], 0);
    for_seconds(t, 3, {0, limit + 0.1f});
    EXPECT_EQ(t.block().running[0], 1);
    for_seconds(t, 3, {0, limit - 0.05f});
    EXPECT_EQ(t.block().running[0], 1) << "no fluttering about the limit";
    for_seconds(t, 3, {0, limit - 0.4f});
    EXPECT_EQ(t.block().running[0], 0);

    for_seconds(t, 3, {0, 3.1f});
    int steps = 0, flight = 0, stance = 0, ticks = 600;
    for_seconds(t, static_cast<float>(ticks) * k_tick, {0, 3.1f}, [&] {
        steps += t.landed[0] + t.landed[1];
        flight += t.in_air(0) && t.in_air(1);
        stance += !t.in_air(0);
        // A body that is caught no harder than legs can may lift a foot a little.
        EXPECT_LT(t.slide, 1e-3f);
        EXPECT_LT(t.drift, 3e-3f);
    });
    EXPECT_NEAR(static_cast<float>(steps) * 6, 155, 10);
    EXPECT_NEAR(static_cast<float>(stance) / static_cast<float>(ticks), 0.43f, 0.04f);
    EXPECT_GT(flight, ticks / 12);
}

TEST(GaitStates, WhoStandsBreathesSwaysAndShiftsTheirWeight) {
    Tried t = make_tried(wide_floor());
    for_seconds(t, 3, {0, 0});
    float least_x = 1, most_x = -1, least_z = 1, most_z = -1, least_load = 1, most_load = 0, stillest = 1;
    Vec3 head_before = joint_pose(t.poses, 0, head).position;
    int breaths = 0, shifts = 0, ticks = 0;
    float inhaled = t.block().inhaled[0];
    bool on_left = t.block().load[0] > 0.5f;
    for_seconds(t, 180, {0, 0}, [&] {
        least_x = std::min(least_x, t.pelvis.x), most_x = std::max(most_x, t.pelvis.x);
        least_z = std::min(least_z, t.pelvis.z), most_z = std::max(most_z, t.pelvis.z);
        float load = t.block().load[0];
        least_load = std::min(least_load, load), most_load = std::max(most_load, load);
        shifts += on_left ? load < 0.35f : load > 0.65f;
        on_left = on_left ? load >= 0.35f : load > 0.65f;
        breaths += inhaled < 0 && t.block().inhaled[0] >= 0;
        inhaled = t.block().inhaled[0];
        if (++ticks % 120 == 0) {
            Vec3 now = joint_pose(t.poses, 0, head).position;
            stillest = std::min(stillest, length(now - head_before));
            head_before = now;
        }
        EXPECT_LT(t.drift, 5e-4f) << t.tick;
        EXPECT_LT(t.acceleration, 4) << t.tick;
        EXPECT_LT(t.fastest, 300) << t.tick;
    });
    EXPECT_TRUE(t.block().standing[0]);
    EXPECT_GT(most_z - least_z, 0.005f);
    EXPECT_LT(most_z - least_z, 0.02f);
    EXPECT_GT(most_x - least_x, 0.02f);
    EXPECT_LT(most_x - least_x, 0.09f);
    EXPECT_LT(least_load, 0.4f);
    EXPECT_GT(most_load, 0.6f);
    EXPECT_GE(breaths, 36);
    EXPECT_LE(breaths, 60);
    EXPECT_GE(shifts, 1);
    EXPECT_LE(shifts, 9) << "every twenty seconds at most";
    EXPECT_GT(stillest, 5e-5f) << "nobody is a statue for two seconds";
}

TEST(GaitStates, JumpsWhenAskedAndWhereItMust) {
    // Standing: both feet leave, both come down where they were.
    Tried hop = make_tried(wide_floor());
    for_seconds(hop, 0.5f, {0, 0});
    jump(hop.gait, 0);
    float highest = 0;
    for_seconds(hop, 2, {0, 0}, [&] {
        if (hop.in_air(0) && hop.in_air(1))
            highest = std::max(highest, std::min(hop.soles[0].ball.y, hop.soles[1].ball.y));
        EXPECT_LT(hop.drift, 5e-4f);
    });
    EXPECT_GT(highest, 0.1f);
    EXPECT_LT(highest, 0.4f);
    EXPECT_TRUE(hop.block().standing[0]);
    EXPECT_EQ(hop.block().jump[0], 0);
    EXPECT_EQ(hop.block().lift[0], 0);

    Ground gap, ledge;
    add_floor(gap, {-5, -10}, {5, 5}, 0, Surface::path);
    add_floor(gap, {-5, 5.9f}, {5, 20}, 0, Surface::path);
    add_floor(ledge, {-5, -10}, {5, 5}, 0, Surface::path);
    add_floor(ledge, {-5, 5}, {5, 20}, 0.6f, Surface::path);
    for (Ground* ground : {&gap, &ledge}) {
        index_ground(*ground);
        Tried t = make_tried(*ground);
        int flight = 0;
        for_seconds(t, 8, {0, 1.4f}, [&] {
            flight += t.block().lift[0] > 0;
            EXPECT_LT(t.drift, 5e-4f) << t.tick;
            for (Side side : {k_left, k_right}) {
                if (!t.landed[side]) continue;
                auto hit = ground_at(t.ground, t.soles[side].ball, 0.3f, 0.3f);
                EXPECT_TRUE(hit && std::fabs(hit->height - t.soles[side].ball.y) < 0.1f) << t.tick;
            }
        });
        EXPECT_GT(flight, 10);
        EXPECT_LT(flight, 60);
        EXPECT_GT(t.position.z, 8);
    }
}

TEST(GaitStates, LeapsFromARun) {
    for (float begins : {4.0f, 4.1f, 4.2f, 4.3f, 4.4f}) {
        Tried t = make_tried(wide_floor());
        for_seconds(t, begins, {0, 3.1f});
        jump(t.gait, 0);
        float highest = 0;
        for_seconds(t, 2, {0, 3.1f}, [&] {
            highest = std::max(highest, t.block().lift[0]);
            EXPECT_LT(t.fastest, 1600) << begins << " s, tick " << t.tick;
        });
        EXPECT_GT(highest, 0.1f);
    }
}

// Ground that rises by `grade` metres in one along +z.
Ground hillside(float grade) {
    Ground ground;
    for (Vec3 v : {Vec3{-20, -20 * grade, -20}, Vec3{-20, 60 * grade, 60}, Vec3{20, 60 * grade, 60},
                   Vec3{20, -20 * grade, -20}})
        ground.vertices.push_back(v);
    for (uint32_t k : {0, 1, 2, 0, 2, 3}) ground.indices.push_back(k);
    ground.kinds = {Surface::path, Surface::path};
    index_ground(ground);
    return ground;
}

TEST(GaitStates, PelvesNeitherSpringUpNorDropOnSteepWays) {
    for (float grade : {0.3f, 0.45f, -0.35f, -0.5f}) {
        for (float height : {1.4f, 1.72f}) {
            for (float wish : {1.3f, 2.0f}) {
                Tried t = make_tried(hillside(grade), height);
                for_seconds(t, 2, {0, wish});
                float before = t.pelvis.y, fastest = 0, lowest = 9;
                for_seconds(t, 10, {0, wish}, [&] {
                    fastest = std::max(fastest, std::fabs(t.pelvis.y - before) / k_tick);
                    before = t.pelvis.y;
                    lowest = std::min(lowest, t.pelvis.y - t.position.y);
                });
                EXPECT_LT(fastest, 1.3f) << grade << ", " << height << " m, " << wish << " m/s";
                EXPECT_GT(lowest, 0.38f * height) << grade << ", " << height << " m, " << wish << " m/s";
            }
        }
    }
}

TEST(GaitStates, FeetDoNotTurnIntoKerbs) {
    // Turns on the spot beside a kerb on its left.
    Ground ground;
    add_floor(ground, {-5, -10}, {0.2f, 10}, 0, Surface::road);
    add_floor(ground, {0.2f, -10}, {5, 10}, 0.12f, Surface::sidewalk);
    index_ground(ground);
    for (float pace = 0.3f; pace < 1.3f; pace += 0.05f) {
        Tried t = make_tried(ground);
        for_seconds(t, 1.5f, {0, pace});
        for (Vec2 way :
             {Vec2{0.26f, -0.1f}, Vec2{-0.3f, 0.1f}, Vec2{0, 0.3f}, Vec2{-0.1f, -0.3f}, Vec2{0.02f, 0.3f}})
            for_seconds(t, 0.9f, way, [&] {
                for (Side side : {k_left, k_right}) {
                    if (t.in_air(side)) continue;
                    for (Vec3 point : {t.soles[side].heel, t.soles[side].tip}) {
                        auto hit = ground_at(t.ground, point, 0.25f, 0.5f);
                        ASSERT_TRUE(hit);
                        EXPECT_GT(point.y - hit->height, -0.05f) << t.tick;
                    }
                }
            });
    }
}

TEST(GaitStates, WeightShiftsWhileStanding) {
    Tried t = make_tried(wide_floor());
    float least = 1, most = 0, before = t.block().load[0];
    for_seconds(t, 120, {0, 0}, [&] {
        float load = t.block().load[0];
        // A foot that has come to rest may take another place.
        if (t.block().standing[0]) {
            EXPECT_LT(std::fabs(load - before), 0.01f);
        }
        EXPECT_FALSE(t.in_air(0) && t.in_air(1));
        EXPECT_LT(t.drift, 5e-4f);
        least = std::min(least, load);
        most = std::max(most, load);
        before = load;
    });
    EXPECT_GT(most - least, 0.1f);
}

}  // namespace
}  // namespace flaneur
