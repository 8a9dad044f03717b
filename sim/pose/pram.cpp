#include "sim/pose/pram.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/pose/arm.h"
#include "sim/pose/joint_limits.h"

namespace flaneur {

namespace {

constexpr float k_straightest = 0.99f;  // of the arm's length
constexpr float k_palm = 0.36f;         // forearms, from the wrist to the middle of the palm
constexpr float k_thick = 0.026f;       // metres, from the middle of the hand to that of the bar
constexpr float k_down_sine = 0.50f, k_down_cosine = 0.866f;  // of 30 degrees that hands point down
constexpr float k_elbow_back = 0.35f, k_elbow_out = 0.45f;    // of an elbow that is 1 down

void hold(const Pram& pram, Posed pose, Side side) {
    const int first = side == k_left ? left_upper_arm : right_upper_arm;
    const float out = side == k_left ? 1.0f : -1.0f;
    Vec3 shoulder = pose.place_os(first);
    float a = length(pose.place_os(first + 1) - shoulder);
    float b = length(pose.place_os(first + 2) - pose.place_os(first + 1));
    JointPose wrist = wrist_on_handle(pram, side, b);
    Vec3 to = wrist.position - pose.origin() - shoulder;
    float far = length(to), reach = clamp(far, std::fabs(a - b) + 0.01f, k_straightest * (a + b));
    Vec3 way = normalize_or(to, {0, -1, 0});
    Quat chest = pose.rotation(upper_chest);
    Vec3 pole = rotate(chest, Vec3{out * k_elbow_out, -1, -k_elbow_back});
    Vec3 aside = normalize_or(pole - way * dot(pole, way), {0, -1, 0});
    float along = (a * a - b * b + reach * reach) / (2 * reach);
    Vec3 elbow = way * along + aside * std::sqrt(std::max(a * a - along * along, 0.0f));
    Vec3 end = way * reach;
    Vec3 upper = elbow / a, lower = (end - elbow) / b;
    // The elbow is a hinge: both bones keep their fronts in the plane that it bends in.
    Quat upper_ws = bone_rotation(upper, lower), lower_ws = bone_rotation(lower, upper * -1);
    // The forearm takes half of what the hand twists against it.
    Quat twist = conjugate(lower_ws) * wrist.rotation;
    lower_ws = normalize(lower_ws * rotation_y(0.5f * wrap_angle(2 * arctan2(twist.y, twist.w))));
    pose.set(first, shoulder, upper_ws);
    pose.set(first + 1, shoulder + elbow, lower_ws);
    Quat hand_ps = within_wrist(conjugate(lower_ws) * wrist.rotation);
    pose.set(first + 2, shoulder + end, normalize(lower_ws * hand_ps));
}

// As far as the arm can: on steep ways a handle may be where none goes.
void hold_soundly(const Pram& pram, Posed pose, Side side) {
    const KeptArm swung = keep_arm(pose, side);
    hold(pram, pose, side);
    if (is_sound(pose, side)) return;
    const KeptArm held = keep_arm(pose, side);
    for (float part : {0.75f, 0.5f, 0.25f, 0.0f}) {
        set_arm(pose, side, held);
        part_arm(swung, pose, side, part);
        if (is_sound(pose, side)) return;
    }
}

}  // namespace

JointPose wrist_on_handle(const Pram& pram, Side side, float forearm) {
    const float out = side == k_left ? 1.0f : -1.0f;
    Quat pram_ws = pram_rotation(pram.now);
    Vec3 fingers = rotate(pram_ws, Vec3{0, -k_down_sine, k_down_cosine});
    Vec3 palm = rotate(pram_ws, Vec3{0, -k_down_cosine, -k_down_sine});  // what it faces
    Vec3 at = pram_handle(pram, pram.now, out) - palm * (k_thick * pram.scale) - fingers * (k_palm * forearm);
    return {at, bone_rotation(fingers, rotate(pram_ws, Vec3{-out, 0, 0}))};
}

void hold_prams(const Gait& gait, size_t begin, size_t end, std::vector<PoseBlock>& poses) {
    for (size_t i = begin; i < end; ++i) {
        const Pram& pram = gait.prams[i];
        for (Side side : {k_left, k_right})
            hold_soundly(pram, {poses[pram.walker / k_block], pram.walker % k_block}, side);
    }
}

void hold_prams(const Gait& gait, size_t begin, size_t end, float dt, const std::vector<PoseBlock>& before,
                std::vector<PoseBlock>& poses) {
    hold_prams(gait, begin, end, poses);
    // A hand that is then held within its wrist's range turns a little farther.
    const float most = 0.7f * k_fastest_walking * dt;
    for (size_t i = begin; i < end; ++i) {
        size_t block = gait.prams[i].walker / k_block, lane = gait.prams[i].walker % k_block;
        for (Side side : {k_left, k_right}) slow_arm({before[block], lane}, {poses[block], lane}, side, most);
    }
}

}  // namespace flaneur
