#include "tools/extract/rider.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"

namespace flaneur {

// Where the joint between two bones comes to, which lead from `from` to near `to`, bent towards `pole`.
static Vec3 bent(Vec3 from, Vec3 to, float first, float second, Vec3 pole) {
    const Vec3 way = to - from;
    const float far = clamp(length(way), std::fabs(first - second) + 1e-3f, (first + second) * 0.999f);
    const Vec3 along = normalize_or(way, {0, -1, 0});
    const float on = (first * first - second * second + far * far) / (2 * far);
    const Vec3 out = normalize_or(pole - along * dot(pole, along), {0, 0, 1});
    return from + along * on + out * std::sqrt(std::max(first * first - on * on, 0.0f));
}

void ride(const Body& body, const Ride& how, JointPose* joints) {
    constexpr float k_lean = 0.34f, k_pelvis = 0.16f, k_head = 0.12f;  // radians
    constexpr float k_over_saddle = 0.1f;                              // metres from the saddle to the hips
    const RiderHolds holds;
    const auto& rest = body.joints;
    const Quat pelvis = rotation_x(k_pelvis), trunk = rotation_x(k_lean), looks = rotation_x(k_head);
    const float slides = how.stands * 0.06f;
    joints[hips] = {holds.saddle + Vec3{0, k_over_saddle - slides, slides}, pelvis};
    for (const Joint j : {spine, chest, upper_chest, neck, left_shoulder, right_shoulder}) {
        const int up = k_joint_parents[j];
        const Quat turn = up == hips ? pelvis : trunk;
        joints[j] = {joints[up].position + rotate(turn, rest[j] - rest[static_cast<size_t>(up)]), trunk};
    }
    joints[neck].rotation = rotation_x((k_lean + k_head) / 2);
    joints[head] = {joints[neck].position + rotate(joints[neck].rotation, rest[head] - rest[neck]), looks};
    auto limb = [&](Joint root, Joint middle, Joint end, Vec3 to, Vec3 pole) {
        const Vec3 upper = rest[middle] - rest[root], lower = rest[end] - rest[middle],
                   at = joints[root].position;
        const Vec3 bend = bent(at, to, length(upper), length(lower), pole);
        const Vec3 tip = bend + normalize_or(to - bend, {0, -1, 0}) * length(lower);
        joints[root].rotation =
            rotation_between(normalize_or(upper, {0, -1, 0}), normalize_or(bend - at, {0, -1, 0}));
        joints[middle] = {
            bend, rotation_between(normalize_or(lower, {0, -1, 0}), normalize_or(tip - bend, {0, -1, 0}))};
        joints[end] = {tip, joints[middle].rotation};
    };
    for (const float side : {1.0f, -1.0f}) {
        const bool is_left = side > 0;
        const Joint clavicle = is_left ? left_shoulder : right_shoulder,
                    arm = is_left ? left_upper_arm : right_upper_arm,
                    elbow = is_left ? left_lower_arm : right_lower_arm,
                    hand = is_left ? left_hand : right_hand,
                    thigh = is_left ? left_upper_leg : right_upper_leg,
                    knee = is_left ? left_lower_leg : right_lower_leg,
                    foot = is_left ? left_foot : right_foot, ball = is_left ? left_toes : right_toes;
        joints[arm].position = joints[clavicle].position + rotate(trunk, rest[arm] - rest[clavicle]);
        limb(arm, elbow, hand, {side * holds.grip.x, holds.grip.y + 0.03f, holds.grip.z - 0.12f},
             {side * 0.5f, -1, -0.3f});
        joints[thigh].position = joints[hips].position + rotate(pelvis, rest[thigh] - rest[hips]);
        const SinCos turn = sin_cos(how.crank + (is_left ? 0 : k_pi));
        const Vec3 pedal = holds.crank + Vec3{side * holds.pedal_aside, -holds.crank_length * turn.sine,
                                              holds.crank_length * turn.cosine};
        const Vec3 sole = rest[ball] - rest[foot];
        Vec3 ankle = pedal + Vec3{0, 0.035f, 0} - Vec3{0, sole.y, sole.z};
        const bool is_down = is_left == how.on_left;
        if (is_down) ankle = lerp(ankle, {side * 0.3f, rest[foot].y, -0.02f}, how.stands);
        limb(thigh, knee, foot, ankle, {side * 0.12f, 0.2f, 1});
        joints[foot].rotation = rotation_x(0);
        joints[ball] = {joints[foot].position + sole, joints[foot].rotation};
    }
    for (int j = 0; j < k_joint_count; ++j) {
        joints[j].position = how.at + rotate(how.turn, joints[j].position);
        joints[j].rotation = how.turn * joints[j].rotation;
    }
}

}  // namespace flaneur
