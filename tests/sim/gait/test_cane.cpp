// Canes in a crowd. How one person walks with a cane is tested with the gait laboratory's instruments.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "sim/base/math.h"
#include "sim/gait/hands.h"
#include "sim/pose/cane.h"
#include "sim/world.h"
#include "tests/sim/allocations.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

// Every third has a cane, if any has.
std::unique_ptr<World> people_on(Ground ground, bool with_canes, int threads = 1) {
    WorldOptions options;
    options.walkers = 40;
    options.capacity = 48;
    options.threads = threads;
    options.kinds = {{standard_body(1.72f)}, {standard_body(1.8f)}, {standard_body(1.6f), 1, 78, true}};
    if (with_canes) options.kinds[2].body.cane = standard_cane(1.6f);
    auto made = make_world(std::make_shared<Ground>(std::move(ground)), options);
    EXPECT_TRUE(made) << (made ? "" : made.error().message);
    return std::move(*made);
}

bool same(const JointPose& a, const JointPose& b) {
    return a.position == b.position && a.rotation.x == b.rotation.x && a.rotation.y == b.rotation.y &&
           a.rotation.z == b.rotation.z && a.rotation.w == b.rotation.w;
}

// Who has a cane lets the other hand hang; so does everybody here.
void let_hang(World& world) {
    for (PersonBlock& people : world.gait.people)
        for (auto& likes : people.postures) std::fill(std::begin(likes), std::end(likes), 0.0f);
}

TEST(CanesInACrowd, MoveNothingButTheArmThatHoldsOne) {
    auto with = people_on(steps(), true), without = people_on(steps(), false);
    let_hang(*with);
    let_hang(*without);
    ASSERT_GT(with->gait.canes.size(), 5u);
    ASSERT_TRUE(without->gait.canes.empty());
    int moved = 0;
    for (int t = 0; t < 900; ++t) {
        step(*with);
        step(*without);
        for (size_t i = 0; i < with->gait.count; ++i) {
            Span own = canes_of(with->gait, i, i + 1);
            for (int j = 0; j < k_joint_count; ++j) {
                bool holds = j >= right_upper_arm && j <= right_hand && own.begin < own.end;
                bool is_same = same(joint_pose(with->poses, i, static_cast<Joint>(j)),
                                    joint_pose(without->poses, i, static_cast<Joint>(j)));
                if (holds) moved += !is_same;
                if (!holds) {
                    ASSERT_TRUE(is_same)
                        << k_joint_names[static_cast<size_t>(j)] << " of " << i << " at " << t;
                }
            }
        }
    }
    EXPECT_GT(moved, 5000);
}

TEST(CanesInACrowd, AreTheSameOnAnyNumberOfThreads) {
    auto one = people_on(street(), true, 1), three = people_on(street(), true, 3);
    for (int t = 0; t < 300; ++t) {
        step(*one);
        step(*three);
        ASSERT_EQ(hash_world(*one), hash_world(*three)) << t;
    }
}

// Over kerbs and flights of steps, round others. On stairs an arm may be too slow for its plan now and then,
// and on a steep bridge as the body leaves a foot behind.
TEST(CanesInACrowd, StandOnTheGround) {
    const struct {
        Ground ground;
        int late;  // ticks in a hundred thousand
    } places[] = {{street(), 0}, {bridge(), 20}, {square(20), 0}, {steps(), 30}};
    for (const auto& place : places) {
        auto w = people_on(place.ground, true);
        int stands = 0, ticks = 0, off = 0;
        for (int t = 0; t < 3600; ++t) {
            step(*w);
            for (const Cane& cane : w->gait.canes) {
                ++ticks;
                if (!is_planted(cane)) continue;
                ++stands;
                Vec3 tip = posed_tip(w->poses, cane);
                auto hit = ground_at(*w->ground, tip, 0.1f, 1);
                off += !hit || std::fabs(tip.y - hit->height) > 0.005f;
            }
        }
        std::printf("%d ticks off the ground of %d\n", off, stands);
        EXPECT_LE(off * 100'000.0, place.late * static_cast<double>(stands));
        EXPECT_GT(stands, 2 * ticks / 5);
    }
}

// Who comes gets one, who is gone has none, and neither that nor a tick needs memory.
TEST(CanesInACrowd, ComeAndGoWithTheirBearers) {
    auto w = people_on(square(30), true);
    size_t before = w->gait.canes.size();
    auto id = add_walker(*w, {.kind = 2});
    ASSERT_TRUE(id) << (id ? "" : id.error().message);
    EXPECT_EQ(w->gait.canes.size(), before + 1);
    Span own = canes_of(w->gait, id->index, id->index + 1);
    ASSERT_EQ(own.end, own.begin + 1);
    EXPECT_LT(length(posed_tip(w->poses, w->gait.canes[own.begin]) - w->gait.canes[own.begin].to), 0.005f);
    for (int t = 0; t < 60; ++t) step(*w);
    size_t used = allocations();
    for (int t = 0; t < 60; ++t) step(*w);
    ASSERT_TRUE(remove_walker(*w, *id));
    EXPECT_EQ(allocations(), used);
    EXPECT_EQ(w->gait.canes.size(), before);
    for (size_t i = 1; i < before; ++i) EXPECT_LT(w->gait.canes[i - 1].walker, w->gait.canes[i].walker);
}

}  // namespace
}  // namespace flaneur
