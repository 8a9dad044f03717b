// Limbs by curves: the report's figures, and what its walk promises.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "sim/base/rng.h"
#include "sim/pose/curves.h"
#include "sim/state.h"
#include "sim/without.h"
#include "tests/sim/pose/every_target.h"
#include "tests/sim/random_poses.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

Ground field(float size) {
    Ground ground;
    add_floor(ground, {-size / 2, -size / 2}, {size / 2, size / 2}, 0, Surface::plaza);
    index_ground(ground);
    return ground;
}

std::unique_ptr<World> marchers(Ground ground, uint64_t seed, uint32_t walkers,
                                LimbLead limbs = LimbLead::curves) {
    WorldOptions options;
    options.walkers = walkers;
    options.threads = 1;
    options.seed = seed;
    options.habit = Habit::ramble;
    options.limbs = limbs;
    options.kinds = {{standard_body(1.72f)}, {standard_body(1.86f)}, {standard_body(1.2f), 1, 8}};
    const Body body = options.kinds[0].body;
    const auto keys = random_poses(RandomKey{seed}, k_joint_count, 0.1f, 5);
    options.idles = {*make_additive_clip(humanoid(body), keys, keys[0], 2, true, Curve::cubic)};
    auto world = make_world(std::make_shared<Ground>(std::move(ground)), options);
    EXPECT_TRUE(world) << (world ? "" : world.error().message);
    return std::move(*world);
}

// A world whose bodies are posed by curves, tick by tick.
struct Led {
    std::unique_ptr<World> world;
    Without without;

    explicit Led(std::unique_ptr<World> w) : world(std::move(w)) { without.on.gait = false; }
    void step() {
        keep_previous(without, *world);
        flaneur::step(*world);
        catch_up(without, *world);
    }
    const LimbClock& clock(uint32_t i) const { return without.clocks[i / k_block]; }
    float own_time(uint32_t i, int side) const {
        const float time = clock(i).time[i % k_block];
        return side == k_left ? time : std::fmod(time + 1, 2.0f);
    }
    float leg(uint32_t i) const {
        return world->gait.people[i / k_block].joints[left_upper_leg][1][i % k_block];
    }
};

TEST(LimbCurves, HaveTheReportsFigures) {
    const LimbCurves how;
    EXPECT_EQ(how, (LimbCurves{1.5f, 0.3f, 0.2f, 0.4f, 0.01f, 20, 3, 4, 5}));
    float low = 9, high = -9, highest = 0;
    for (int k = 0; k <= 4000; ++k) {
        const float time = static_cast<float>(k) / 1000;
        const LimbTargets now = targets_at(how, time), back = targets_at(how, -time),
                          later = targets_at(how, time + 1), whole = targets_at(how, time + 2);
        low = std::min(low, now.feet[k_left].ahead), high = std::max(high, now.feet[k_left].ahead);
        highest = std::max(highest, now.feet[k_left].up);
        EXPECT_NEAR(now.feet[k_left].ahead, back.feet[k_left].ahead, 1e-5f) << "ping-pong";
        EXPECT_NEAR(now.feet[k_left].ahead, whole.feet[k_left].ahead, 1e-5f);
        EXPECT_NEAR(now.feet[k_left].ahead, later.feet[k_right].ahead, 1e-5f) << "a unit later";
        EXPECT_NEAR(now.feet[k_left].up, later.feet[k_right].up, 1e-5f);
        EXPECT_NEAR(now.hands[k_right].ahead / how.arm_forward,
                    eased((now.feet[k_left].ahead / how.leg_forward + 1) / 1.5f), 1e-4f)
            << "arms go against legs";
        EXPECT_TRUE(now.feet[k_left].up == 0 || now.feet[k_right].up == 0) << "one is down";
        // Both goes back and is in the air: never.
        const LimbTargets next = targets_at(how, time + 1e-3f);
        for (int side = 0; side < 2; ++side)
            EXPECT_FALSE(now.feet[side].up > 1e-4f && next.feet[side].ahead < now.feet[side].ahead - 1e-6f);
    }
    EXPECT_NEAR(low, -0.3f, 1e-5f);
    EXPECT_NEAR(high, 0.15f, 1e-5f);
    EXPECT_NEAR(highest, 0.2f, 1e-5f);
    EXPECT_NEAR(targets_at(how, 0.5f).feet[k_left].up, 0.2f, 1e-5f) << "half a unit after it sets off";
    EXPECT_NEAR(pace_of(how, k_curves_leg), 0.6f, 1e-5f);
}

TEST(LimbCurves, TurnsTakeTwentyDegreesASecondAndThreeSecondsAtLeast) {
    for (const float degrees : {-130.0f, -90.0f, -45.0f, 10.0f, 60.0f, 61.0f, 130.0f}) {
        SlowTurn turn = begin_turn({}, 1, degrees);
        EXPECT_FLOAT_EQ(turn.seconds, std::max(std::fabs(degrees) / 20, 3.0f));
        float before = 1, heading = 1;
        int ticks = 0;
        for (; is_turning(turn); ++ticks, before = heading) {
            heading = turn_on(turn, k_tick);
            const float even = degrees * k_radians * k_tick / turn.seconds;
            const float is = wrap_angle(heading - before);
            ASSERT_NEAR(is, is_turning(turn) ? even : is, 1e-5f);
        }
        EXPECT_NEAR(wrap_angle(heading - 1 - degrees * k_radians), 0, 1e-5f);
        EXPECT_NEAR(ticks, turn.seconds * 60, 1.1f);
    }
}

// The foot on the ground is where the curve has it, and stays there in the world: the body goes as far as it
// goes back.
TEST(LimbCurves, TheBodyGoesAsFarAsTheFootOnTheGroundGoesBack) {
    for (uint64_t seed = 1; seed <= 12; ++seed) {
        Led led(marchers(field(60), seed, 1));
        float off = 0, slid = 0, went = 0;
        int ticks = 0;
        bool was_down[2] = {};
        Vec3 was[2];
        int straight = 0;
        for (int t = 0; t < 1500; ++t) {
            led.step();
            const World& w = *led.world;
            const bool is_even = !is_turning(w.crowd.march.turns[0]) &&
                                 std::fabs(w.crowd.motion.turn_rate[0]) < 0.002f &&
                                 length(w.crowd.motion.velocity[0]) > 0.2f;
            straight = is_even ? straight + 1 : 0;
            // Where both feet have stepped since.
            if (straight < 120) {
                was_down[0] = was_down[1] = false;
                continue;
            }
            went += length(w.crowd.motion.velocity[0]) * k_tick, ++ticks;
            for (Side side : {k_left, k_right}) {
                const LimbClock::Foot& foot = led.clock(0).feet[side];
                const bool is_down = led.own_time(0, side) >= 1;
                const Vec3 now = sole(led.without.poses, w.gait, 0, side).ball;
                if (is_down)
                    off = std::max(off, std::hypot(foot.x[0] - foot.aim_x[0], foot.z[0] - foot.aim_z[0]));
                if (is_down && was_down[side]) slid = std::max(slid, length(now - was[side]));
                was_down[side] = is_down, was[side] = now;
            }
        }
        ASSERT_GT(ticks, 100) << "seed " << seed;
        const float scale = led.leg(0) / k_curves_leg;
        EXPECT_LT(off, 0.01f) << "seed " << seed << ": metres from its curve";
        EXPECT_LT(slid, 0.0002f) << "seed " << seed << ": metres in a tick";
        EXPECT_NEAR(went / static_cast<float>(ticks) * 60, 0.6f * scale, 0.03f) << "seed " << seed;
    }
}

TEST(LimbCurves, FeetThatStandStayInTurnsAndAmongOthersToo) {
    Led led(marchers(square(16), 3, 24));
    float slid = 0, drops = 0;
    std::vector<std::array<Vec3, 2>> was(24);
    std::vector<std::array<bool, 2>> was_down(24);
    int seen = 0, dragged = 0;
    for (int t = 0; t < 1500; ++t) {
        led.step();
        for (uint32_t i = 0; i < 24; ++i)
            for (Side side : {k_left, k_right}) {
                const LimbClock::Foot& foot = led.clock(i).feet[side];
                const bool is_down = led.own_time(i, side) >= 1 && led.clock(i).still[i % k_block] == 0;
                const Vec3 now{foot.x[i % k_block], 0, foot.z[i % k_block]};
                if (is_down && was_down[i][side]) {
                    ++seen;
                    const float way = length(now - was[i][side]);
                    dragged += way > 0.0005f;
                    slid = std::max(slid, way);
                }
                const float height = sole(led.without.poses, led.world->gait, i, side).ball.y;
                if (is_down) drops = std::max(drops, std::fabs(height));
                was_down[i][side] = is_down, was[i][side] = now;
            }
    }
    std::printf("feet that stand: %.4f of their ticks dragged, by %.4f m at most; %.4f m off the ground\n",
                dragged / double(seen), double(slid), double(drops));
    EXPECT_LT(dragged, seen / 50);
    EXPECT_LT(slid, 0.03f);
    EXPECT_LT(drops, 0.01f);
}

TEST(LimbCurves, LimbsEndAtTheirTargets) {
    for (uint64_t seed = 1; seed <= 6; ++seed) {
        Led led(marchers(seed % 2 ? square(16) : bridge(), seed, 16));
        float feet = 0, hands = 0;
        int reached = 0, stretched = 0;
        for (int t = 0; t < 600; ++t) {
            led.step();
            if (t % 7 != 0 || t < 60) continue;
            const World& w = *led.world;
            for (uint32_t i = 0; i < 16; ++i) {
                if (led.clock(i).still[i % k_block] > 0) continue;
                const PlacedTargets at =
                    targets_of(w.gait, i, w.crowd.march.how, led.without.clocks, w.around, led.without.poses);
                const PersonBlock& p = w.gait.people[i / k_block];
                for (Side side : {k_left, k_right}) {
                    const JointPose foot =
                        joint_pose(led.without.poses, i, side == k_left ? left_foot : right_foot);
                    const Vec3 below =
                        foot.position - rotate(foot.rotation, {0, p.joints[left_foot][1][i % k_block], 0});
                    feet = std::max(feet, length(below - at.feet[side]));
                    const JointPose wrist =
                        joint_pose(led.without.poses, i, side == k_left ? left_hand : right_hand);
                    const JointPose shoulder =
                        joint_pose(led.without.poses, i, side == k_left ? left_upper_arm : right_upper_arm);
                    const float arm =
                        p.joints[left_upper_arm][1][i % k_block] - p.joints[left_hand][1][i % k_block];
                    const float far = length(at.hands[side] - shoulder.position);
                    if (far < 0.99f * arm) {
                        hands = std::max(hands, length(wrist.position - at.hands[side])), ++reached;
                    } else if (far > 1.01f * arm) {
                        EXPECT_GT(length(wrist.position - shoulder.position), 0.985f * arm);
                        const Vec3 to = at.hands[side] - shoulder.position,
                                   is = wrist.position - shoulder.position;
                        EXPECT_GT(dot(to, is) / (length(to) * length(is)), 0.9999f) << "it points there";
                        ++stretched;
                    }
                }
            }
        }
        EXPECT_LT(feet, 0.004f) << seed;
        EXPECT_LT(hands, 0.002f) << seed;
        EXPECT_GT(reached, 100);
        EXPECT_GT(stretched, 100);
    }
}

// On the field nobody turns faster than the report's turns, and never anew before one is over.
TEST(March, OneTurnAtATimeEachOfWhichTakesItsTime) {
    for (uint64_t seed = 1; seed <= 4; ++seed) {
        auto world = marchers(square(16), seed, 8);
        std::vector<SlowTurn> was(8);
        std::vector<float> bearing(8);
        int turns = 0;
        for (int t = 0; t < 1800; ++t) {
            step(*world);
            for (const Wayfarer& way : world->crowd.wayfarers) {
                const uint32_t i = way.walker;
                const SlowTurn& now = world->crowd.march.turns[i];
                const bool is_new = now.from != was[i].from || now.by != was[i].by;
                if (is_new) {
                    ASSERT_FALSE(is_turning(was[i])) << "tick " << t;
                    EXPECT_FLOAT_EQ(now.seconds, std::max(std::fabs(now.by) / k_radians / 20, 3.0f));
                    ++turns;
                }
                if (t > 0) {
                    const float most = 20 * k_radians * 4 * k_tick + 1e-4f;
                    ASSERT_LE(std::fabs(wrap_angle(way.bearing - bearing[i])), most) << "tick " << t;
                }
                was[i] = now, bearing[i] = way.bearing;
            }
        }
        EXPECT_GT(turns, 10);
    }
}

TEST(March, IsPartOfTheStateAndTheHash) {
    auto world = marchers(square(16), 5, 8), twin = marchers(square(16), 5, 8);
    auto other = marchers(square(16), 5, 8, LimbLead::gait);
    for (int t = 0; t < 400; ++t) step(*world), step(*twin), step(*other);
    EXPECT_EQ(hash_world(*world), hash_world(*twin));
    EXPECT_NE(hash_world(*world), hash_world(*other));
    std::vector<std::byte> bytes;
    save_state(*world, bytes);
    const uint64_t then = hash_world(*world);
    for (int t = 0; t < 300; ++t) step(*world);
    go_by_curves(*world, LimbLead::gait, {.ray_ahead = 3});
    ASSERT_TRUE(load_state(*world, bytes));
    EXPECT_EQ(hash_world(*world), then);
    for (int t = 0; t < 300; ++t) step(*world), step(*twin);
    EXPECT_EQ(hash_world(*world), hash_world(*twin));
    LimbCurves longer;
    longer.period = 3;
    go_by_curves(*twin, LimbLead::curves, longer);
    EXPECT_NE(hash_world(*world), hash_world(*twin));
}

// Joints against the body's root, from one tick to the next.
struct Jolts {
    float fastest = 0, jump = 0, turn = 0;  // m/s, m/s from tick to tick, radians a tick
    int played = 0;                         // ticks of an idle
    std::vector<Vec3> place, velocity;
    std::vector<Quat> rotation;

    void see(const World& w, const std::vector<PoseBlock>& poses, uint32_t i) {
        const Vec3 root = w.crowd.motion.position[i];
        std::vector<Vec3> now(k_joint_count), going(k_joint_count);
        std::vector<Quat> turned(k_joint_count);
        for (int j = 0; j < k_joint_count; ++j) {
            const JointPose pose = joint_pose(poses, i, Joint(j));
            now[j] = pose.position - root, turned[j] = pose.rotation;
            if (place.empty()) continue;
            going[j] = (now[j] - place[j]) * 60;
            fastest = std::max(fastest, length(going[j]));
            turn = std::max(turn, angle_between(rotation[j], turned[j]));
            if (!velocity.empty()) jump = std::max(jump, length(going[j] - velocity[j]));
        }
        if (!place.empty()) velocity = going;
        place = now, rotation = turned;
    }
};

// One walks and stops, again and again, at odd moments; the idle clip comes and goes.
Jolts stop_and_go(uint64_t seed, bool by_curves, float fade) {
    Led led(marchers(field(60), seed, 1));
    World& w = *led.world;
    w.idles.fade_time = fade;
    led.without.on.gait = !by_curves;
    drive(w.crowd, 0);
    Jolts jolts;
    const RandomKey key{seed};
    int change = 0, played = 0;
    bool goes = false;
    for (int t = 0; t < 1500; ++t) {
        if (t == change) {
            goes = !goes;
            change += static_cast<int>(random_between(key, 40, 260, static_cast<uint32_t>(t)));
            w.crowd.driven.wish = goes ? heading_direction(w.crowd.motion.heading[0]) * 0.6f : Vec2{};
        }
        led.step();
        played += !w.idles.plays.empty();
        if (t > 10) jolts.see(w, by_curves ? led.without.poses : w.poses, 0);
    }
    jolts.played = played;
    return jolts;
}

TEST(LimbCurves, IdlesComeAndGoWithoutAJump) {
    for (const bool by_curves : {false, true}) {
        Jolts all, faults;
        for (uint64_t seed = 1; seed <= 8; ++seed) {
            auto add = [](Jolts& to, const Jolts& more) {
                to.fastest = std::max(to.fastest, more.fastest), to.jump = std::max(to.jump, more.jump);
                to.turn = std::max(to.turn, more.turn), to.played += more.played;
            };
            add(all, stop_and_go(seed, by_curves, 0.5f));
            add(faults, stop_and_go(seed, by_curves, 1e-3f));
        }
        std::printf(
            "stop and go %s: %.2f m/s, %.2f m/s in a tick, %.1f degrees; without a blend %.2f, %.2f, %.1f\n",
            by_curves ? "by curves" : "by the gait", double(all.fastest), double(all.jump),
            double(all.turn / k_radians), double(faults.fastest), double(faults.jump),
            double(faults.turn / k_radians));
        EXPECT_GT(all.played, 1000);
        EXPECT_LT(all.fastest, 4) << "m/s against the root";
        EXPECT_LT(all.jump, 4.2f) << "m/s from one tick to the next";
        EXPECT_LT(all.turn, 14 * k_radians) << "in a tick";
        EXPECT_GT(faults.fastest, 12) << "without a blend it jumps";
        EXPECT_GT(faults.jump, 12);
        EXPECT_GT(faults.turn, 30 * k_radians);
    }
}

TEST(LimbCurves, SameBitsOnEveryInstructionSet) {
    Led led(marchers(bridge(), 4, 40));
    for (int t = 0; t < 300; ++t) led.step();
    const World& w = *led.world;
    expect_same_on_every_target(w.poses.size(), [&](std::vector<PoseBlock>& poses) {
        pose_by_curves(w.gait, 0, poses.size(), w.crowd.march.how, led.without.clocks, w.around, w.poses,
                       poses);
    });
}

}  // namespace
}  // namespace flaneur
