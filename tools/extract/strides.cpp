#include "tools/extract/strides.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/base/tick.h"
#include "sim/crowd/locomotion.h"
#include "sim/pose/cane.h"
#include "sim/pose/joint_limits.h"
#include "sim/pose/pram.h"
#include "tools/extract/extract.h"

namespace flaneur {

namespace {

constexpr float k_speed = 1.3f;                            // m/s
constexpr uint32_t k_stands_until = 60, k_walks_to = 360;  // ticks
constexpr uint64_t k_seed = 30;                            // of what it looks at

using Joints = std::array<JointPose, k_joint_count>;

struct Walked {
    std::vector<Joints> ticks;
    std::vector<Trail> trails;
    size_t begin = 0, end = 0;  // of the last stride: when the left foot comes down
};

// Level ground everywhere, and no walls.
Surroundings level_ground() {
    return {nullptr,
            [](const void*, std::span<const Vec3> points, float, float, std::optional<GroundHit>* hits) {
                std::fill_n(hits, points.size(), GroundHit{});
            },
            nullptr};
}

// The body stands, and then walks along +z in the neutral manner.
Walked walk_ahead(const Body& body) {
    const Surroundings around = level_ground();
    const uint32_t index = 0;
    const float scale = 1;
    const Manner manner;
    Vec3 position;
    Motion motion;
    Vec2 wish;
    const RootMotion root{&position,         &motion.velocity, &motion.heading,
                          &motion.turn_rate, &motion.aim,      &motion.brakes};
    Gait gait;
    start_gait(gait, 1, {body}, &index, &scale, root, around, k_seed, &manner);
    std::vector<PoseBlock> poses(1), before(1);
    std::vector<TrailBlock> trails(1);
    pose_blocks(gait, 0, 1, poses);
    hold_canes(gait, 0, gait.canes.size(), poses);
    hold_prams(gait, 0, gait.prams.size(), poses);
    const int32_t& swinging = gait.blocks[0].feet[k_left].swinging[0];
    Walked walked;
    for (uint32_t t = 0; t < k_walks_to; ++t) {
        if (t == k_stands_until) wish = {0, k_speed};
        motion = next_motion(motion, wish, k_tick);
        position += at_height(motion.velocity * k_tick, 0);
        const bool was_swinging = swinging;
        advance_gait(gait, 0, 1, root, around, k_seed, t, k_tick);
        motion.feet = footwork(gait, 0, position);
        poses.swap(before);
        pose_blocks(gait, 0, 1, k_tick, before, poses);
        restrain_legs(gait, 0, 1, k_tick, before, poses);
        hold_canes(gait, 0, gait.canes.size(), k_tick, before, poses);
        hold_prams(gait, 0, gait.prams.size(), poses);
        advance_trails(before, poses, 0, 1, k_tick, trails, trails);
        walked.trails.push_back(trail_of(trails, 0));
        if (was_swinging && !swinging) walked.begin = walked.end, walked.end = t;
        Joints& joints = walked.ticks.emplace_back();
        for (size_t j = 0; j < k_joint_count; ++j) joints[j] = joint_pose(poses, 0, static_cast<Joint>(j));
    }
    return walked;
}

// After that tick, about the body's middle.
void append_pose(const Character& character, const Walked& walked, size_t tick,
                 std::vector<JointTransform>& out) {
    Joints joints = walked.ticks[tick];
    const Vec3 middle = joints[hips].position;
    for (JointPose& joint : joints) joint.position -= middle;
    out.resize(out.size() + k_palette_joints);
    pose_character(character, 1, joints.data(), &out[out.size() - k_palette_joints], &walked.trails[tick]);
}

}  // namespace

std::vector<JointTransform> extract_strides(const Character& character) {
    const Walked walked = walk_ahead(character.body);
    std::vector<JointTransform> out;
    for (int i = 0; i < k_stride_phases; ++i) {
        const double phase = static_cast<double>(i) / k_stride_phases;
        const double tick =
            static_cast<double>(walked.begin) + phase * static_cast<double>(walked.end - walked.begin);
        append_pose(character, walked, static_cast<size_t>(std::lround(tick)), out);
    }
    append_pose(character, walked, k_stands_until - 1, out);
    return out;
}

}  // namespace flaneur
