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

namespace {

// The joints of one limb, from its root on.
struct Limb {
    Joint root, middle, end;
};

// A limb whose root is set: its end at `to` or as near as it gets, bent towards `pole`.
void reach(const Body& body, Limb limb, Vec3 to, Vec3 pole, JointPose* joints) {
    constexpr Vec3 k_down{0, -1, 0};
    const auto& rest = body.joints;
    const Vec3 upper = rest[limb.middle] - rest[limb.root], lower = rest[limb.end] - rest[limb.middle];
    const Vec3 at = joints[limb.root].position;
    const Vec3 bend = bent(at, to, length(upper), length(lower), pole);
    const Vec3 tip = bend + normalize_or(to - bend, k_down) * length(lower);
    auto turned = [](Vec3 from, Vec3 way) {
        return rotation_between(normalize_or(from, {0, -1, 0}), normalize_or(way, {0, -1, 0}));
    };
    joints[limb.root].rotation = turned(upper, bend - at);
    joints[limb.middle] = {bend, turned(lower, tip - bend)};
    joints[limb.end] = {tip, joints[limb.middle].rotation};
}

// From the saddle up to the head.
void sit(const Body& body, float stands, JointPose* joints) {
    constexpr float k_lean = 0.34f, k_pelvis = 0.16f, k_head = 0.12f;  // radians
    constexpr float k_over_saddle = 0.1f, k_slides = 0.06f;            // metres from the saddle to the hips
    const auto& rest = body.joints;
    const Quat pelvis = rotation_x(k_pelvis), trunk = rotation_x(k_lean);
    const float slides = stands * k_slides;
    joints[hips] = {RiderHolds{}.saddle + Vec3{0, k_over_saddle - slides, slides}, pelvis};
    auto hang_on = [&](Joint j, Quat turn) {
        const auto up = static_cast<size_t>(k_joint_parents[j]);
        joints[j].position = joints[up].position + rotate(joints[up].rotation, rest[j] - rest[up]);
        joints[j].rotation = turn;
    };
    for (const Joint j : {spine, chest, upper_chest}) hang_on(j, trunk);
    hang_on(neck, rotation_x((k_lean + k_head) / 2));
    hang_on(head, rotation_x(k_head));
    for (const Joint j : {left_shoulder, right_shoulder}) hang_on(j, trunk);
    for (const Joint j : {left_upper_arm, right_upper_arm, left_upper_leg, right_upper_leg})
        hang_on(j, trunk);
}

}  // namespace

void ride(const Body& body, const Ride& how, JointPose* joints) {
    const RiderHolds holds;
    const auto& rest = body.joints;
    sit(body, how.stands, joints);
    for (const float side : {1.0f, -1.0f}) {
        const bool is_left = side > 0;
        const Limb arm = is_left ? Limb{left_upper_arm, left_lower_arm, left_hand}
                                 : Limb{right_upper_arm, right_lower_arm, right_hand},
                   leg = is_left ? Limb{left_upper_leg, left_lower_leg, left_foot}
                                 : Limb{right_upper_leg, right_lower_leg, right_foot};
        const Joint ball = is_left ? left_toes : right_toes;
        // The wrist is behind and over what the hand holds.
        const Vec3 grip{side * holds.grip.x, holds.grip.y + 0.03f, holds.grip.z - 0.12f};
        reach(body, arm, grip, {side * 0.5f, -1, -0.3f}, joints);
        const SinCos turn = sin_cos(how.crank + (is_left ? 0 : k_pi));
        const Vec3 pedal = holds.crank + Vec3{side * holds.pedal_aside, -holds.crank_length * turn.sine,
                                              holds.crank_length * turn.cosine};
        const Vec3 sole = rest[ball] - rest[leg.end];
        Vec3 ankle = pedal + Vec3{0, 0.035f, 0} - Vec3{0, sole.y, sole.z};
        const Vec3 down{side * 0.3f, rest[leg.end].y, -0.02f};
        if (is_left == how.on_left) ankle = lerp(ankle, down, how.stands);
        reach(body, leg, ankle, {side * 0.12f, 0.2f, 1}, joints);
        joints[leg.end].rotation = {};
        joints[ball] = {joints[leg.end].position + sole, {}};
    }
    for (int j = 0; j < k_joint_count; ++j) {
        joints[j].position = how.at + rotate(how.turn, joints[j].position);
        joints[j].rotation = how.turn * joints[j].rotation;
    }
}

}  // namespace flaneur
