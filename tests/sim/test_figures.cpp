// Figures: people of key poses, and pairs that walk in step.
#include <gtest/gtest.h>

#include <cstring>

#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/base/tick.h"
#include "sim/figures/figures.h"
#include "tests/sim/allocations.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

const Body k_body = standard_body(1.75f);

std::shared_ptr<const Ground> plain() {
    auto ground = std::make_shared<Ground>();
    add_floor(*ground, {-20, -20}, {20, 20}, 0, Surface::plaza);
    index_ground(*ground);
    return ground;
}

FigurePlan round_walk(FigurePlan::By by, float radius = 4) {
    FigurePlan plan;
    plan.by = by;
    plan.varies = true;
    plan.speed = 1.3f;
    for (int i = 0; i < 40; ++i) {
        const SinCos at = sin_cos(2 * k_pi * static_cast<float>(i) / 40);
        plan.way.push_back(Vec2{radius * at.sine, radius * at.cosine});
    }
    return plan;
}

// A lane of the tree, evaluated.
std::vector<Quat> rotations(const BlendTree& tree, const KeyInputs& in, float* height = nullptr) {
    LaneRow rows[k_key_inputs], local[local_rows(k_joint_count)];
    for (size_t i = 0; i < k_key_inputs; ++i) std::fill_n(rows[i].lanes, k_block, in.rows[i]);
    evaluate_blends(tree, rows, 0, 1, local);
    std::vector<Quat> out;
    for (size_t j = 0; j < k_joint_count; ++j)
        out.push_back({local[4 * j].lanes[0], local[4 * j + 1].lanes[0], local[4 * j + 2].lanes[0],
                       local[4 * j + 3].lanes[0]});
    if (height) *height = local[4 * k_joint_count + 1].lanes[0];
    return out;
}

float angle_between(Quat a, Quat b) {
    const float cosine = std::min(std::fabs(dot(a, b)), 1.0f);
    return 2 * std::sqrt(std::max(2 * (1 - cosine), 0.0f)) / std::sqrt(2.0f);
}

KeyInputs upright() {
    KeyInputs in{};
    in.rows[key_lean] = 0.5f;
    in.rows[key_whole] = 1;
    return in;
}

// Where each key stands in the tree: what is put there, and which pose that is.
struct KeyPlace {
    KeyPose pose;
    bool is_mirrored;
    float speed, crouch, phase, breath, leap, flight;
};
constexpr KeyPlace k_places[] = {
    {KeyPose::stand, false, 0, 0, 0, 0, 0, 0},
    {KeyPose::rest, false, 0, 0, 0, 0.5f, 0, 0},
    {KeyPose::walk_contact, false, 0.5f, 0, 0, 0, 0, 0},
    {KeyPose::walk_passing, false, 0.5f, 0, 0.25f, 0, 0, 0},
    {KeyPose::walk_contact, true, 0.5f, 0, 0.5f, 0, 0, 0},
    {KeyPose::walk_passing, true, 0.5f, 0, 0.75f, 0, 0, 0},
    {KeyPose::run_contact, false, 1, 0, 0, 0, 0, 0},
    {KeyPose::run_off, false, 1, 0, 0.25f, 0, 0, 0},
    {KeyPose::run_contact, true, 1, 0, 0.5f, 0, 0, 0},
    {KeyPose::run_off, true, 1, 0, 0.75f, 0, 0, 0},
    {KeyPose::crouch, false, 0, 1, 0, 0, 0, 0},
    {KeyPose::crouch, true, 0, 1, 0, 0.5f, 0, 0},
    {KeyPose::sneak_contact, false, 0.5f, 1, 0, 0, 0, 0},
    {KeyPose::sneak_passing, false, 0.5f, 1, 0.25f, 0, 0, 0},
    {KeyPose::land, false, 0.5f, 0, 0.3f, 0, 1, 0},
    {KeyPose::rise, false, 0.5f, 0, 0.3f, 0, 1, 1 / 3.0f},
    {KeyPose::fall, false, 1, 0, 0.3f, 0, 1, 2 / 3.0f},
    {KeyPose::land, false, 1, 0, 0.3f, 0, 1, 1},
};

TEST(KeyPoses, AreReachedExactlyAtTheirPlaces) {
    for (const Curve along : {Curve::linear, Curve::cubic})
        for (const Curve across : {Curve::linear, Curve::cubic}) {
            const BlendTree tree = key_tree(k_body, {along, across});
            ASSERT_TRUE(check_tree(tree));
            for (const KeyPlace& place : k_places) {
                KeyInputs in = upright();
                in.rows[key_speed] = place.speed, in.rows[key_crouch] = place.crouch;
                in.rows[key_phase] = place.phase, in.rows[key_breath] = place.breath;
                in.rows[key_leap] = place.leap, in.rows[key_flight] = place.flight;
                const LocalPose key = key_pose(k_body, place.pose, place.is_mirrored);
                float height = 0;
                const auto got = rotations(tree, in, &height);
                for (size_t j = 0; j < k_joint_count; ++j)
                    EXPECT_LT(angle_between(got[j], key.rotations[j]), 0.002f)
                        << k_key_pose_names[static_cast<size_t>(place.pose)] << ", " << k_joint_names[j];
                EXPECT_NEAR(height, key.offset.y, 0.001f);
            }
            // The lean is added to what is below.
            KeyInputs in = upright();
            in.rows[key_lean] = 1;
            const auto leans = rotations(tree, in);
            const LocalPose key = key_pose(k_body, KeyPose::lean);
            for (size_t j = 0; j < k_joint_count; ++j)
                EXPECT_LT(angle_between(leans[j], key.rotations[j]), 0.004f) << k_joint_names[j];
        }
}

TEST(KeyPoses, StandOnTheGroundAndBendAsJointsDo) {
    for (const float height : {1.5f, 1.75f, 1.95f})
        for (int n = 0; n < k_key_pose_count; ++n)
            for (const bool is_mirrored : {false, true}) {
                const auto pose = static_cast<KeyPose>(n);
                const LocalPose key = key_pose(standard_body(height), pose, is_mirrored);
                EXPECT_GT(key.offset.y, -0.62f * height) << k_key_pose_names[static_cast<size_t>(n)];
                EXPECT_LT(key.offset.y, 0.25f);
                for (const size_t knee :
                     {static_cast<size_t>(left_lower_leg), static_cast<size_t>(right_lower_leg)})
                    EXPECT_GE(key.rotations[knee].x, 0) << "knees bend back";
                for (const size_t elbow :
                     {static_cast<size_t>(left_lower_arm), static_cast<size_t>(right_lower_arm)})
                    EXPECT_LE(key.rotations[elbow].x, 0) << "and elbows ahead";
            }
}

// However its parameters move, no joint jumps; and a cycle on it is where it was.
TEST(KeyPoses, NoJointJumpsAsParametersMove) {
    constexpr float k_step = 0.002f;  // of each parameter at a time
    for (const Curve along : {Curve::linear, Curve::cubic}) {
        const BlendTree tree = key_tree(k_body, {along, Curve::linear});
        float worst = 0;
        for (uint32_t seed = 0; seed < 4000; ++seed) {
            KeyInputs in = upright();
            for (uint32_t i = 0; i < k_key_inputs; ++i) in.rows[i] = random_unit({seed}, i);
            in.rows[key_whole] = 1;
            const auto before = rotations(tree, in);
            in.rows[seed % key_whole] += k_step;
            const auto after = rotations(tree, in);
            for (size_t j = 0; j < k_joint_count; ++j)
                worst = std::max(worst, angle_between(before[j], after[j]));
            for (const size_t cycles : {static_cast<size_t>(key_phase), static_cast<size_t>(key_breath)}) {
                KeyInputs on = in;
                on.rows[cycles] += 1;
                const auto again = rotations(tree, on);
                for (size_t j = 0; j < k_joint_count; ++j)
                    ASSERT_LT(angle_between(after[j], again[j]), 0.002f) << k_joint_names[j];
            }
        }
        EXPECT_LT(worst, 0.035f) << "radians: some 17 from one end of a parameter to the other";
    }
}

struct Seen {
    float fastest = 0;  // rad/s of any joint against its parent
    float astray = 0;   // metres of a foot that stands from where the gait has it
    float lowest = 1;   // metres of a sole over the ground
    float least_speed = 9, most_speed = 0, highest = 0, deepest = 9;  // of its body
};
Seen watch(FigurePlan plan, uint32_t ticks) {
    Troupe f = make_figures({std::move(plan)}, plain(), {k_body}, 5);
    Seen seen;
    std::vector<Quat> before(k_joint_count);
    for (uint32_t tick = 0; tick < ticks; ++tick) {
        step_figures(f, 5, tick);
        for (size_t j = 1; j < k_joint_count; ++j) {
            const auto parent = static_cast<Joint>(k_joint_parents[j]);
            const Quat up = joint_pose(f.poses, 0, parent).rotation;
            const Quat local =
                Quat{-up.x, -up.y, -up.z, up.w} * joint_pose(f.poses, 0, static_cast<Joint>(j)).rotation;
            if (tick > 0) seen.fastest = std::max(seen.fastest, angle_between(before[j], local) / k_tick);
            before[j] = local;
        }
        for (const Side side : {k_left, k_right}) {
            const FootBlock& foot = f.gait.blocks[0].feet[side];
            const Sole now = sole(f.poses, f.gait, 0, side);
            const Joint ankle = side == k_left ? left_foot : right_foot;
            if (foot.swinging[0] == 0)
                seen.astray = std::max(seen.astray, length(joint_pose(f.poses, 0, ankle).position -
                                                           joint_pose(f.whole, 0, ankle).position));
            seen.lowest = std::min({seen.lowest, now.heel.y, now.ball.y, now.tip.y});
        }
        const float speed = length(f.moves[0].motion.velocity),
                    high = joint_pose(f.poses, 0, hips).position.y;
        seen.least_speed = std::min(seen.least_speed, speed);
        seen.most_speed = std::max(seen.most_speed, speed);
        seen.highest = std::max(seen.highest, high);
        seen.deepest = std::min(seen.deepest, high);
    }
    return seen;
}

TEST(Figures, ABodyOfKeysGoesThroughAllOfItWithItsFeetOnTheGround) {
    for (const Curve along : {Curve::linear, Curve::cubic}) {
        FigurePlan plan = round_walk(FigurePlan::By::keys);
        plan.curves.along = along;
        const Seen seen = watch(plan, 2 * k_figure_round);
        EXPECT_EQ(seen.least_speed, 0);
        EXPECT_GT(seen.most_speed, 2.6f) << "runs";
        EXPECT_GT(seen.highest, 1.1f) << "leaps";
        EXPECT_LT(seen.deepest, 0.72f) << "creeps";
        EXPECT_LT(seen.fastest, 40) << "rad/s";
        EXPECT_LT(seen.astray, 0.01f) << "m";
        EXPECT_GT(seen.lowest, -0.03f) << "m";
    }
}

// Of a pair the whole one's feet are on the ground; without, they slide.
TEST(Figures, WithoutATechniqueAFigureGoesInStepWithItsTwin) {
    FigurePlan with = round_walk(FigurePlan::By::techniques, 2), without = with;
    with.varies = without.varies = false;
    without.twin_of = 0, without.aside = {0, 0, 3};
    without.on.feet = without.on.pelvis = without.on.soles = without.on.heels = without.on.limits = false;
    Troupe f = make_figures({with, without}, plain(), {k_body}, 3);
    float apart = 0;
    for (uint32_t tick = 0; tick < 600; ++tick) {
        step_figures(f, 3, tick);
        const Vec3 hip = joint_pose(f.poses, 0, head).position, other = joint_pose(f.poses, 1, head).position;
        ASSERT_LT(length(hip + without.aside - other), 0.1f);
        apart = std::max(apart, length(joint_pose(f.poses, 0, left_foot).position + without.aside -
                                       joint_pose(f.poses, 1, left_foot).position));
    }
    EXPECT_GT(apart, 0.03f);
}

TEST(Figures, ATickAllocatesNothing) {
    FigurePlan statue = round_walk(FigurePlan::By::statue), bare = round_walk(FigurePlan::By::techniques);
    statue.way.resize(1);
    bare.on.feet = false;
    Troupe f = make_figures({round_walk(FigurePlan::By::keys), statue, bare}, plain(), {k_body}, 1);
    for (uint32_t tick = 0; tick < 10; ++tick) step_figures(f, 1, tick);
    const size_t before = allocations();
    for (uint32_t tick = 10; tick < 600; ++tick) step_figures(f, 1, tick);
    EXPECT_EQ(allocations() - before, 0u);
}

// It goes where it is told, creeps, leaps, stays on its ground and out of others, and comes back to its way.
TEST(Figures, OneIsLedAndThenGoesItsWayAgain) {
    FigurePlan statue = round_walk(FigurePlan::By::statue);
    statue.way = {{0, 0}};
    Troupe f = make_figures({round_walk(FigurePlan::By::keys), statue}, plain(), {k_body}, 5);
    for (uint32_t tick = 0; tick < 60; ++tick) step_figures(f, 5, tick);
    lead_figure(f, 0);
    float nearest = 9, deepest = 9, highest = 0;
    for (uint32_t tick = 60; tick < 1860; ++tick) {
        // To the statue, creeping; then away, until there is no more ground.
        const Vec2 to = on_ground(f.moves[1].position - f.moves[0].position);
        f.lead.wish = tick < 660 ? normalize_or(to, {0, 1}) * 1.2f : Vec2{-2.5f, -2.5f};
        f.lead.creeps = tick > 300 && tick < 660 ? 1 : 0;
        if (tick == 800) leap(f);
        step_figures(f, 5, tick);
        nearest = std::min(nearest, length(to));
        const float high = joint_pose(f.poses, 0, hips).position.y;
        if (f.lead.creeps) deepest = std::min(deepest, high);
        highest = std::max(highest, high);
        const Vec3 at = f.moves[0].position;
        ASSERT_TRUE(ground_at(*f.ground, at, 0.1f, 0.1f)) << at.x << " " << at.z;
    }
    EXPECT_GT(nearest, 0.45f);
    EXPECT_LT(nearest, 1.0f);
    EXPECT_LT(deepest, 0.75f);
    EXPECT_GT(highest, 1.05f);
    EXPECT_LT(length(f.moves[0].motion.velocity), 0.05f) << "at the edge";
    lead_figure(f, k_no_twin);
    float least = 9;
    for (uint32_t tick = 1860; tick < 1860 + 4 * k_figure_round; ++tick) {
        step_figures(f, 5, tick);
        for (const Vec2 corner : f.plans[0].way)
            least = std::min(least, length(on_ground(f.moves[0].position) - corner));
    }
    EXPECT_LT(least, 1.0f) << "back on its way";
}

// What is kept of a state is all that the next tick reads.
TEST(Figures, GoOnFromWhatAStateKeeps) {
    std::vector<FigurePlan> plans{round_walk(FigurePlan::By::keys),
                                  round_walk(FigurePlan::By::techniques, 3)};
    Troupe a = make_figures(plans, plain(), {k_body}, 1), b = make_figures(plans, plain(), {k_body}, 1);
    for (uint32_t tick = 0; tick < 700; ++tick) step_figures(a, 1, tick);
    b.moves = a.moves, b.gait.blocks = a.gait.blocks, b.whole = a.whole;
    pose_figures_anew(b);
    EXPECT_EQ(std::memcmp(a.poses.data(), b.poses.data(), sizeof(PoseBlock::position)), 0);
    for (uint32_t tick = 700; tick < 1000; ++tick) {
        step_figures(a, 1, tick), step_figures(b, 1, tick);
        for (size_t i = 0; i < 2; ++i)
            for (size_t j = 0; j < k_joint_count; ++j)
                ASSERT_EQ(joint_pose(a.poses, i, static_cast<Joint>(j)).position,
                          joint_pose(b.poses, i, static_cast<Joint>(j)).position);
    }
}

}  // namespace
}  // namespace flaneur
