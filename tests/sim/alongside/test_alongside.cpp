// Hands on rims, handles and strings; who listens.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "sim/alongside/alongside.h"
#include "sim/base/math.h"
#include "sim/base/spans.h"
#include "sim/world.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

std::unique_ptr<World> with(AlongShares shares, uint64_t seed, uint32_t walkers, Ground ground = square(30)) {
    index_ground(ground);
    WorldOptions options{.walkers = walkers, .seed = seed, .threads = 1};
    options.kinds = {{standard_body(1.72f)}, {standard_body(1.60f), 1, 40, true}, {standard_body(1.86f)}};
    for (Kind& kind : options.kinds) kind.body.wear.pockets = true;
    for (const float x : {-8.0f, 8.0f})
        for (const float z : {-8.0f, 0.0f, 8.0f})
            options.destinations.push_back({DestinationKind::square, {x, 0, z}, {0, 1}, 1});
    options.along = shares;
    auto world = make_world(std::make_shared<const Ground>(std::move(ground)), options);
    EXPECT_TRUE(world) << world.error().message;
    return std::move(*world);
}

float turn_between(Quat a, Quat b) { return 2 * arccos(std::min(std::fabs(dot(a, b)), 1.0f)); }

// How far joints move and arms turn in a tick, at most.
struct Jumps {
    float moved = 0, turned = 0;
    void look(const World& w, uint32_t i) {
        for (int j = 0; j < k_joint_count; ++j) {
            const JointPose a = joint_between(w, i, static_cast<Joint>(j), 0),
                            b = joint_between(w, i, static_cast<Joint>(j), 1);
            moved = std::max(moved, length(a.position - b.position));
            turned = std::max(turned, turn_between(a.rotation, b.rotation));
        }
    }
};

TEST(Wheelchairs, ArePushedByTheRimsAndRollByTheWayDone) {
    auto w = with({.wheelchairs = 0.5f}, 3, 14);
    ASSERT_GE(w->alongside->chairs.size(), 3u);
    float off = 0, slips = 0;
    double went = 0;
    Jumps jumps;
    for (int tick = 0; tick < 1200; ++tick) {
        step(*w);
        for (size_t k = 0; k < w->alongside->chairs.size(); ++k) {
            const Chair& c = w->alongside->chairs[k];
            const Placement at = chair_between(*w, k, 1);
            const float size = w->gait.people[c.walker / k_block].height[c.walker % k_block] / 1.72f;
            jumps.look(*w, c.walker);
            went += static_cast<double>(length(w->crowd.motion.velocity[c.walker]) * k_tick);
            EXPECT_LT(length(w->crowd.motion.velocity[c.walker]), 1.25f);
            const Chair* before = own_of(w->alongside->previous_chairs, c.walker);
            const float way = dot(w->crowd.motion.velocity[c.walker],
                                  heading_direction(w->crowd.motion.heading[c.walker])) *
                              k_tick;
            const float rolled = 0.5f * (wrap_angle(c.wheels[0] - before->wheels[0]) +
                                         wrap_angle(c.wheels[1] - before->wheels[1]));
            slips = std::max(slips, std::fabs(rolled * k_chair_wheel * size - way));
            if (c.push >= k_pushes) continue;
            for (const Side side : {k_left, k_right}) {
                const Vec3 own = to_own(at, palm_between(*w, c.walker, side, 1)) / size;
                const float from_axle = std::hypot(own.y - k_chair_wheel, own.z);
                off = std::max(off, std::fabs(from_axle - k_chair_rim));
                off = std::max(off, std::fabs(std::fabs(own.x) - 0.5f * k_chair_track - 0.018f));
            }
        }
    }
    std::printf(
        "palms %.1f mm off the rims, wheels slip %.2f mm a tick; %.0f m; joints %.3f m, %.2f rad a tick\n",
        wide(1000 * off), wide(1000 * slips), went, wide(jumps.moved), wide(jumps.turned));
    EXPECT_LT(off, 0.010f);
    EXPECT_LT(slips, 0.0005f);
    EXPECT_GT(went, 30);
    EXPECT_LT(jumps.moved, 0.08f);
    EXPECT_LT(jumps.turned, 0.45f);
}

TEST(WhiteCanes, SweepBeforeTheFootThatComesAndTouchTheGround) {
    auto w = with({.white_canes = 0.5f}, 4, 12);
    float above = 0, below = 0;
    uint32_t opposite = 0, contacts = 0;
    Jumps jumps;
    for (int tick = 0; tick < 1200; ++tick) {
        step(*w);
        for (const Companion& c : w->alongside->companions) {
            const Placement at = held_between(*w, c, 1);
            const float size = w->gait.people[c.walker / k_block].height[c.walker % k_block] / 1.72f;
            const Vec3 tip = to_world(at, {0, -k_white_cane * size, 0});
            above = std::max(above, tip.y), below = std::max(below, -tip.y);
            jumps.look(*w, c.walker);
            const GaitBlock& g = w->gait.blocks[c.walker / k_block];
            const size_t lane = c.walker % k_block;
            // As a foot comes down the tip is on the other side.
            const bool lands = g.phase[lane] < 0.03f || g.phase[lane] > 0.97f;
            if (!lands || g.amplitude[lane] < 0.9f) continue;
            const Vec2 way = heading_direction(w->crowd.motion.heading[c.walker]), left{way.z, -way.x};
            ++contacts;
            opposite += dot(on_ground(tip - w->crowd.motion.position[c.walker]), left) < -0.1f;
        }
    }
    std::printf(
        "tips %.0f mm above and %.0f mm below the ground; %u of %u opposite; joints %.3f m, %.2f rad a "
        "tick\n",
        wide(1000 * above), wide(1000 * below), opposite, contacts, wide(jumps.moved), wide(jumps.turned));
    EXPECT_LT(above, 0.06f);
    EXPECT_LT(below, 0.005f);
    EXPECT_GT(contacts, 50u);
    EXPECT_GE(opposite, contacts * 95 / 100);
}

TEST(Umbrellas, AreOverHeadsAndNotThroughThem) {
    auto w = with({.umbrellas = 0.6f}, 5, 12);
    float nearest = 9, aside = 0;
    for (int tick = 0; tick < 600; ++tick) {
        step(*w);
        for (const Companion& c : w->alongside->companions) {
            const Placement at = held_between(*w, c, 1);
            const float size = w->gait.people[c.walker / k_block].height[c.walker % k_block] / 1.72f;
            const Vec3 skull = joint_between(*w, c.walker, head, 1).position + Vec3{0, 0.09f * size, 0};
            const Vec3 own = to_own(at, skull) / size;
            // Off the shaft by more than half of a head, and below the cloth.
            nearest = std::min(nearest, std::hypot(own.x, own.z));
            EXPECT_LT(own.y + 0.12f, k_umbrella - 0.06f);
            aside = std::max(aside, std::hypot(own.x, own.z));
        }
    }
    std::printf("heads %.3f to %.3f m from shafts\n", wide(nearest), wide(aside));
    EXPECT_GT(nearest, 0.085f);
    EXPECT_LT(aside, 0.30f);
}

TEST(Musicians, HaveTheirHandsOnInstrumentsAndSomeListenAndGo) {
    auto w = with({.musicians = 3}, 6, 60, square(44));
    ASSERT_EQ(w->alongside->players.size(), 3u);
    size_t most = 0;
    uint32_t came = 0, gone = 0;
    float off = 0;
    std::vector<uint32_t> listens;
    for (int tick = 0; tick < 5400; ++tick) {
        step(*w);
        for (const Companion& c : w->alongside->companions) {
            if (c.what != Along::violin && c.what != Along::guitar) continue;
            const Placement at = held_between(*w, c, 1);
            const float size = w->gait.people[c.walker / k_block].height[c.walker % k_block] / 1.72f;
            const Vec3 own = to_own(at, palm_between(*w, c.walker, k_left, 1)) / size;
            // The left hand is at the neck, along x.
            off = std::max(off, c.what == Along::violin ? std::hypot(own.y, own.z + 0.035f)
                                                        : std::hypot(own.y + 0.03f, own.z - 0.005f));
        }
        std::vector<uint32_t> now;
        for (const Listener& l : w->alongside->listeners) now.push_back(l.walker);
        for (const uint32_t i : now) came += !std::ranges::binary_search(listens, i);
        for (const uint32_t i : listens) gone += !std::ranges::binary_search(now, i);
        listens = now;
        most = std::max(most, now.size());
    }
    std::printf("left palms %.1f mm off necks; %u came to listen, %u went, %zu at once\n", wide(1000 * off),
                came, gone, most);
    EXPECT_LT(off, 0.010f);
    EXPECT_GT(came, 8u);
    EXPECT_GT(gone, 4u);
    EXPECT_GE(most, 3u);
}

}  // namespace
}  // namespace flaneur
