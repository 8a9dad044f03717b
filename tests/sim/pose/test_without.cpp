// Bodies without some techniques: each changes somebody, nothing else, and never how people walk.
#include <gtest/gtest.h>

#include <cstring>
#include <set>
#include <string>

#include "sim/pose/bare.h"
#include "sim/without.h"
#include "tests/sim/pose/every_target.h"
#include "tests/sim/random_poses.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

struct Part {
    int first, last;
};
constexpr Part k_pelvis{hips, hips}, k_trunk{spine, head}, k_arms{left_shoulder, right_hand},
    k_legs{left_upper_leg, right_toes};

// With canes and prams, and something to do for who stands.
std::unique_ptr<World> people_on(Ground ground, uint32_t walkers = 48) {
    WorldOptions options;
    options.walkers = walkers;
    options.threads = 1;
    const Body body = standard_body(1.7f);
    options.kinds = {{body}, {standard_body(1.8f)}, {standard_body(1.6f), 1, 78, true}, {body, 1, 30, true}};
    options.kinds[2].body.cane = standard_cane(1.6f);
    options.kinds[3].body.pram = standard_pram(body);
    const auto keys = random_poses(RandomKey{1}, k_joint_count, 0.3f, 5);
    options.idles = {*make_additive_clip(humanoid(body), keys, keys[0], 2, true, Curve::cubic)};
    index_ground(ground);
    auto world = make_world(std::make_shared<Ground>(std::move(ground)), options);
    EXPECT_TRUE(world) << (world ? "" : world.error().message);
    return std::move(*world);
}

bool are_same(const std::vector<PoseBlock>& a, const std::vector<PoseBlock>& b, Part part, bool turned_only) {
    for (size_t n = 0; n < a.size(); ++n)
        for (int j = part.first; j <= part.last; ++j) {
            if (std::memcmp(a[n].rotation[j], b[n].rotation[j], sizeof a[n].rotation[j]) != 0) return false;
            const bool is_there =
                std::memcmp(a[n].position[j], b[n].position[j], sizeof a[n].position[j]) == 0;
            if (!turned_only && !is_there) return false;
        }
    return true;
}

std::vector<Part> kept_by(const std::string& name) {
    if (name == "feet" || name == "soles" || name == "heels" || name == "limits")
        return {k_pelvis, k_trunk, k_arms};
    if (name == "pelvis" || name == "gait") return {};
    if (name == "trunk" || name == "look" || name == "idles") return {k_pelvis, k_legs};
    return {k_pelvis, k_legs, k_trunk};
}

std::unique_ptr<World> narrow() { return people_on(corridor(30, 1.6f), 16); }
std::unique_ptr<World> hilly() { return people_on(steps()); }
std::unique_ptr<World> sloping() { return people_on(bridge()); }

TEST(Without, AllOnIsWhatTheWorldShows) {
    auto world = hilly();
    std::vector<PoseBlock> poses;
    for (int t = 0; t < 120; ++t) step(*world);
    pose_without(*world, {}, poses);
    EXPECT_EQ(0, std::memcmp(poses.data(), world->poses.data(), poses.size() * sizeof(PoseBlock)));
}

TEST(Without, EachChangesSomebodyAndNothingElse) {
    std::set<std::string> seen;
    for (auto make : {narrow, hilly, sloping}) {
        auto world = make(), alone = make();
        for (int t = 0; t < 900; ++t) {
            step(*world);
            step(*alone);
            if (t % 7 != 0) continue;
            for (const TechniqueInfo& technique : k_techniques) {
                Techniques on;
                on.*technique.is_on = false;
                std::vector<PoseBlock> poses;
                pose_without(*world, on, poses);
                const std::string name(technique.name);
                for (const Part part : kept_by(name))
                    ASSERT_TRUE(are_same(poses, world->poses, part, false)) << name << ", tick " << t;
                const bool turns_it = name == "gait";
                ASSERT_TRUE(turns_it || are_same(poses, world->poses, k_pelvis, true))
                    << name << ", tick " << t;
                if (std::memcmp(poses.data(), world->poses.data(), poses.size() * sizeof(PoseBlock)) != 0)
                    seen.insert(name);
            }
        }
        EXPECT_EQ(hash_world(*world), hash_world(*alone));
    }
    for (const TechniqueInfo& technique : k_techniques)
        EXPECT_TRUE(seen.contains(std::string(technique.name))) << technique.name;
}

// Planted feet slide, on stairs they sink, and on slopes soles stay level.
TEST(Without, LegsByCurvesAloneSlideAndSink) {
    auto world = hilly();
    Techniques on;
    on.feet = false;
    Without bare{};
    bare.on = on;
    float slid = 0, deepest = 0, slid_whole = 0, deepest_whole = 0;
    std::vector<PoseBlock> before;
    for (int t = 0; t < 600; ++t) {
        before = world->poses;
        keep_previous(bare, *world);
        step(*world);
        catch_up(bare, *world);
        for (uint32_t i = 0; i < world->crowd.count; ++i) {
            const GaitBlock& g = world->gait.blocks[i / k_block];
            for (Side side : {k_left, k_right}) {
                const bool is_planted = g.feet[side].phase[i % k_block] > 0.2f * g.duty[i % k_block] &&
                                        g.feet[side].phase[i % k_block] < 0.5f * g.duty[i % k_block];
                if (!is_planted || g.amplitude[i % k_block] < 0.9f) continue;
                auto measure = [&](const auto& was, const auto& is, float& slip, float& depth) {
                    const Vec3 a = sole(was, world->gait, i, side).ball,
                               b = sole(is, world->gait, i, side).ball;
                    slip = std::max(slip, length(b - a));
                    if (const auto hit = ground_at(*world->ground, b, 0.6f, 0.6f))
                        depth = std::max(depth, hit->height - b.y);
                };
                measure(bare.previous, bare.poses, slid, deepest);
                measure(before, world->poses, slid_whole, deepest_whole);
            }
        }
    }
    EXPECT_GT(slid, 3 * slid_whole);
    EXPECT_GT(slid, 0.005f);
    EXPECT_GT(deepest, 0.04f);
    EXPECT_LT(deepest_whole, 0.03f);
}

TEST(Without, LevelSolesDoNotKnowTheSlope) {
    auto world = sloping();
    Techniques on;
    on.soles = false;
    std::vector<PoseBlock> poses;
    int tilted = 0;
    for (int t = 0; t < 600; ++t) {
        step(*world);
        if (t % 10 != 0) continue;
        pose_without(*world, on, poses);
        for (uint32_t i = 0; i < world->crowd.count; ++i)
            for (Side side : {k_left, k_right}) {
                const FootBlock& f = world->gait.blocks[i / k_block].feet[side];
                if (std::fabs(f.to.normal_x[i % k_block]) < 0.1f || f.swinging[i % k_block]) continue;
                const Joint foot = side == k_left ? left_foot : right_foot;
                // Across the foot a level one is level, however it is pitched.
                const Vec3 across = rotate(joint_pose(poses, i, foot).rotation, {1, 0, 0});
                EXPECT_NEAR(across.y, 0, 1e-4f);
                tilted += std::fabs(rotate(joint_pose(world->poses, i, foot).rotation, {1, 0, 0}).y) > 0.01f;
            }
    }
    EXPECT_GT(tilted, 0);
}

TEST(Without, SameBitsOnEveryInstructionSet) {
    auto world = hilly();
    for (int i = 0; i < 150; ++i) step(*world);
    for (const bool has_feet : {true, false}) {
        Techniques on;
        on.feet = has_feet, on.pelvis = on.trunk = false;
        expect_same_on_every_target(world->poses.size(), [&](std::vector<PoseBlock>& poses) {
            pose_bare(world->gait, 0, poses.size(), on, world->poses, poses);
        });
    }
}

}  // namespace
}  // namespace flaneur
