// One walker driven along given roads, its feet and joints watched.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "sim/base/math.h"
#include "sim/crowd/crowd.h"
#include "sim/gait/curves/norms.h"
#include "sim/gait/gait.h"
#include "sim/pose/pose.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

Ground profile_city(const std::function<float(float)>& height, const std::vector<float>& edges,
                    bool stepped) {
    Ground ground;
    for (size_t i = 0; i + 1 < edges.size(); ++i) {
        float a = edges[i], b = edges[i + 1];
        float ya = stepped ? height((a + b) / 2) : height(a), yb = stepped ? ya : height(b);
        auto n = static_cast<uint32_t>(ground.vertices.size());
        for (Vec3 v : {Vec3{-30, ya, a}, Vec3{-30, yb, b}, Vec3{30, yb, b}, Vec3{30, ya, a}}) {
            ground.vertices.push_back(v);
        }
        for (uint32_t k : {0, 1, 2, 0, 2, 3}) ground.indices.push_back(n + k);
        ground.kinds.insert(ground.kinds.end(), 2, Surface::sidewalk);
    }
    index_ground(ground);
    return ground;
}

Ground flat_city() {
    return profile_city([](float) { return 0.0f; }, {-40, 60}, false);
}

struct Watched {
    float drift = 0;         // most that the resting point of a planted foot moves in a tick, metres
    float below = 0;         // deepest that a sole is under the ground, metres
    float above = 0;         // highest that the lowest point of a planted sole is above it
    float overreach = 0;     // most that a hip-ankle distance exceeds the leg, metres
    float acceleration = 0;  // largest of the pelvis, m/s2
    float bone_error = 0;    // largest deviation of a bone's length, metres
    int steps = 0;
    bool finite = true;
};

struct Drive {
    float speed = 0, turn_rate = 0;
};

// Walks for `seconds`; `drive` gives the wanted speed and turn rate at a time.
Watched watch(const Ground& ground, float seconds, const std::function<Drive(float)>& drive,
              float height = 1.72f) {
    std::vector<Body> bodies{standard_body(height)};
    uint32_t body = 0;
    float scale = 1, heading = 0, turn_rate = 0, speed = 0;
    Vec3 position;
    if (auto hit = ground_at(ground, {0, 1, 0}, 2, 3)) position.y = hit->height;
    Vec2 velocity, wish;
    RootMotion root{&position, &velocity, &heading, &turn_rate, &wish};
    Gait gait;
    Manner middle;
    start_gait(gait, 1, bodies, &body, &scale, root, surroundings_of(ground), 11, &middle);
    std::vector<PoseBlock> poses(1);
    pose_blocks(gait, 0, 1, poses);

    Watched seen;
    Sole soles[2], last_soles[2];
    Vec3 pelvis[3];
    bool was_swinging[2] = {false, false};
    int ticks = static_cast<int>(seconds * 60);
    for (int t = 0; t < ticks; ++t) {
        Drive d = drive(static_cast<float>(t) * k_tick);
        speed += clamp(d.speed - speed, -2.2f * k_tick, 1.6f * k_tick);
        turn_rate += clamp(d.turn_rate - turn_rate, -8 * k_tick, 8 * k_tick);
        heading += turn_rate * k_tick;
        velocity = heading_direction(heading) * speed;
        wish = heading_direction(heading) * d.speed;
        position += at_height(velocity * k_tick, 0);
        if (auto hit = ground_at(ground, position)) position.y = hit->height;
        advance_gait(gait, 0, 1, root, surroundings_of(ground), 11, static_cast<uint32_t>(t), k_tick);
        pose_blocks(gait, 0, 1, k_tick, poses, poses);

        for (int j = 0; j < k_joint_count; ++j) {
            JointPose p = joint_pose(poses, 0, static_cast<Joint>(j));
            float n = dot(p.rotation, p.rotation);
            if (!std::isfinite(p.position.x + p.position.y + p.position.z) || std::fabs(n - 1) > 1e-4f)
                seen.finite = false;
            int parent = k_joint_parents[static_cast<size_t>(j)];
            if (parent == k_no_parent) continue;
            float rest = length(bodies[0].joints[static_cast<size_t>(j)] -
                                bodies[0].joints[static_cast<size_t>(parent)]);
            float now = length(p.position - joint_pose(poses, 0, static_cast<Joint>(parent)).position);
            seen.bone_error = std::max(seen.bone_error, std::fabs(now - rest));
        }
        for (Side side : {k_left, k_right}) {
            const FootBlock& foot = gait.blocks[0].feet[side];
            soles[side] = sole(poses, gait, 0, side);
            bool swinging = foot.swinging[0] != 0;
            const Sole &now = soles[side], &last = last_soles[side];
            if (t > 0 && !swinging && !was_swinging[side]) {
                float moved = std::min({length(now.heel - last.heel), length(now.ball - last.ball)});
                seen.drift = std::max(seen.drift, moved);
            }
            float lowest = std::numeric_limits<float>::max();
            for (Vec3 p : {now.heel, now.ball, now.tip}) {
                auto hit = ground_at(ground, p, 0.5f, 1);
                if (!hit) continue;
                seen.below = std::max(seen.below, swinging ? 0 : hit->height - p.y);
                lowest = std::min(lowest, p.y - hit->height);
            }
            if (!swinging) seen.above = std::max(seen.above, lowest);
            if (was_swinging[side] && !swinging) ++seen.steps;
            was_swinging[side] = swinging;
            last_soles[side] = soles[side];

            Joint hip = side == k_left ? left_upper_leg : right_upper_leg;
            Joint ankle = side == k_left ? left_foot : right_foot;
            float leg = thigh_length(bodies[0]) + shank_length(bodies[0]);
            float reach = length(joint_pose(poses, 0, hip).position - joint_pose(poses, 0, ankle).position);
            seen.overreach = std::max(seen.overreach, reach - leg);
        }
        pelvis[t % 3] = joint_pose(poses, 0, hips).position;
        if (t > 2) {
            Vec3 second = pelvis[t % 3] - pelvis[(t + 2) % 3] * 2 + pelvis[(t + 1) % 3];
            seen.acceleration = std::max(seen.acceleration, length(second) / (k_tick * k_tick));
        }
    }
    return seen;
}

void expect_sound(const Watched& seen) {
    EXPECT_TRUE(seen.finite);
    EXPECT_LT(seen.overreach, 1e-4f);
    EXPECT_LT(seen.bone_error, 1e-4f);
}

#ifdef FLANEUR_SANITIZED  // a tenth of the speed, and the same code
constexpr float k_heights[] = {1.72f};
#else
constexpr float k_heights[] = {1.15f, 1.72f, 1.95f};
#endif

TEST(Gait, FeetDoNotSlideOrSinkOnFlatGround) {
    Ground ground = flat_city();
    for (float speed : {0.4f, 0.8f, 1.3f, 1.7f}) {
        for (float height : k_heights) {
            Watched seen = watch(
                ground, 14,
                [&](float t) {
                    return Drive{t > 1 && t < 10 ? speed : 0, 0};
                },
                height);
            expect_sound(seen);
            EXPECT_LT(seen.drift, 5e-4f) << speed;
            EXPECT_LT(seen.below, 1e-3f) << speed;
            EXPECT_LT(seen.above, 1e-3f) << speed;
            EXPECT_GT(seen.steps, static_cast<int>(9 * speed / 1.3f));
            EXPECT_LT(seen.acceleration, 90.0f) << speed;
        }
    }
}

TEST(Gait, FeetStayPlantedThroughTurns) {
    Ground ground = flat_city();
    Watched arc = watch(ground, 12, [](float t) { return Drive{1.2f, t > 3 ? 0.8f : 0}; });
    expect_sound(arc);
    EXPECT_LT(arc.drift, 1e-4f);
    Watched spot = watch(ground, 6, [](float t) { return Drive{0, t > 1 && t < 2.6f ? 2.0f : 0}; });
    expect_sound(spot);
    EXPECT_LT(spot.drift, 1e-4f);
    EXPECT_GE(spot.steps, 3);
}

TEST(Gait, StandsOnKerbSlopeAndSteps) {
    auto walk = [](float t) { return Drive{t > 1 ? 1.1f : 0, 0}; };
    auto climb = [](float t) { return Drive{t > 1 ? 0.6f : 0, 0}; };
    Ground kerb = profile_city([](float z) { return z > 5 && z < 9 ? 0.12f : 0.0f; }, {-40, 5, 9, 60}, true);
    Ground slope = profile_city([](float z) { return z > 5 ? (z - 5) * 0.08f : 0.0f; }, {-40, 5, 60}, false);
    std::vector<float> edges{-40};
    for (int i = 0; i <= 12; ++i) edges.push_back(3 + static_cast<float>(i) * 0.34f);
    edges.push_back(60);
    Ground steps = profile_city(
        [](float z) { return z < 3 ? 0.0f : std::min(std::floor((z - 3) / 0.34f) + 1, 13.0f) * 0.15f; },
        edges, true);
    for (const Watched& seen : {watch(kerb, 14, walk), watch(slope, 14, walk), watch(steps, 16, climb)}) {
        expect_sound(seen);
        EXPECT_LT(seen.drift, 5e-4f);
        EXPECT_LT(seen.above, 0.03f);
        EXPECT_GT(seen.steps, 12);
    }
}

TEST(Gait, TimingFollowsTheNorms) {
    float leg = 0.53f * 1.72f;
    for (auto [speed, stance] : {std::pair{0.94f, 0.625f}, {1.24f, 0.603f}, {1.50f, 0.591f}}) {
        EXPECT_NEAR(duty_factor(speed), stance, 0.025f);
        float step = stride_length(speed, leg) / 2;
        float norm = 1.16f * leg * std::sqrt(speed / std::sqrt(k_gravity * leg));
        EXPECT_NEAR(step, norm, 0.05f * norm);
        float cadence = speed / step * 60;
        EXPECT_GT(step / cadence, 0.0052f);
        EXPECT_LT(step / cadence, 0.0073f);
    }
}

}  // namespace
}  // namespace flaneur
