#include "tools/flaneur/extract/strides.h"

#include <cmath>

#include "tools/flaneur/extract/extract.h"
#include "tools/flaneur/gait/walk.h"

namespace flaneur {

namespace {

constexpr float k_speed = 1.3f;               // m/s
constexpr double k_still = 1, k_seconds = 6;  // stands, and then walks

// The ticks at which the left foot comes down, the last two.
struct LastStride {
    size_t begin = 0, end = 0;
};
LastStride last_stride(const Walk& walk) {
    LastStride stride;
    for (size_t t = 1; t < walk.ticks.size(); ++t)
        if (walk.ticks[t - 1].feet[k_left].swinging && !walk.ticks[t].feet[k_left].swinging)
            stride = {stride.end, t};
    return stride;
}

void append_pose(const Character& character, const Instant& now, std::vector<JointTransform>& out) {
    std::array<JointPose, k_joint_count> joints = now.joints;
    for (JointPose& joint : joints) joint.position = joint.position - now.joints[hips].position;
    out.resize(out.size() + k_palette_joints);
    pose_character(character, 1, joints.data(), &out[out.size() - k_palette_joints]);
}

}  // namespace

std::vector<JointTransform> extract_strides(const Character& character) {
    const Ground ground = strip([](float) { return 0.0f; }, {-2, 12}, false);
    const Walk walked = walk(ground, {character.body, {}}, k_seconds, [](double time) {
        return Vec2{0, time < k_still ? 0.0f : k_speed};
    });
    const LastStride stride = last_stride(walked);
    std::vector<JointTransform> out;
    for (int i = 0; i < k_stride_phases; ++i) {
        const double phase = static_cast<double>(i) / k_stride_phases;
        const double tick =
            static_cast<double>(stride.begin) + phase * static_cast<double>(stride.end - stride.begin);
        append_pose(character, walked.ticks[static_cast<size_t>(std::lround(tick))], out);
    }
    append_pose(character, walked.ticks[static_cast<size_t>(k_still * walked.rate) - 1], out);
    return out;
}

}  // namespace flaneur
