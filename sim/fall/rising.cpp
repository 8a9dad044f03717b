#include "sim/fall/rising.h"

#include <algorithm>

#include "sim/base/math.h"

namespace flaneur {

namespace {

// Degrees, of each joint against its parent; positive as JointLimits has it, knees as they bend.
struct LimbKey {
    float bend = 0, out = 0, second = 0, third = 0, twist = 0;  // second: elbow, knee; third: hand, foot
};
struct Key {
    float trunk = 0, neck = 0;
    LimbKey left_arm, right_arm, left_leg, right_leg;
};

Quat degrees_x(float angle) { return rotation_x(angle * k_radians); }
Quat degrees_y(float angle) { return rotation_y(angle * k_radians); }
Quat degrees_z(float angle) { return rotation_z(angle * k_radians); }

// All joints, with the hips turned as `root`.
BodyPose posed(const Key& key, Quat root, Vec3 hips_at) {
    std::array<Quat, k_joint_count> own{};
    for (Joint j : {spine, chest, upper_chest}) own[j] = degrees_x(key.trunk / 3);
    for (Joint j : {neck, head}) own[j] = degrees_x(key.neck / 2);
    auto arm = [&](const LimbKey& k, Joint upper, float side) {
        own[upper] = degrees_z(side * k.out) * degrees_x(-k.bend);
        own[upper + 1] = degrees_x(-k.second) * degrees_y(-side * k.twist);
        own[upper + 2] = degrees_y(side * k.twist) * degrees_x(-k.third) * degrees_y(-side * k.twist);
    };
    arm(key.left_arm, left_upper_arm, 1), arm(key.right_arm, right_upper_arm, -1);
    auto leg = [&](const LimbKey& k, Joint upper, float side) {
        own[upper] = degrees_z(side * k.out) * degrees_x(-k.bend);
        own[upper + 1] = degrees_x(k.second);
        own[upper + 2] = degrees_x(k.third);
    };
    leg(key.left_leg, left_upper_leg, 1), leg(key.right_leg, right_upper_leg, -1);
    BodyPose pose{hips_at, {}};
    pose.rotation[hips] = root;
    for (int j = 1; j < k_joint_count; ++j)
        pose.rotation[j] = normalize(pose.rotation[k_joint_parents[j]] * own[j]);
    return pose;
}

// Knees drawn up, the lower arm under the head, the upper hand before the chest.
constexpr LimbKey k_lower_arm = {75, 10, 95, 0, 0}, k_upper_arm = {45, 8, 75, 40, 40};
constexpr Key k_on_left = {12, 8, k_lower_arm, k_upper_arm, {55, 2, 75, 20}, {70, 2, 80, 20}};
constexpr Key k_on_right = {12, 8, k_upper_arm, k_lower_arm, {70, 2, 80, 20}, {55, 2, 75, 20}};
// Arms and thighs upright, shanks along the ground. Arms are longer than thighs: the trunk rises to the head.
constexpr float k_fours_pitch = 74;
constexpr LimbKey k_prop = {72, 6, 4, 78, 80}, k_prop_leg = {74, 5, 88, 48};
constexpr Key k_on_fours = {4, -28, k_prop, k_prop, k_prop_leg, k_prop_leg};
// The left foot is set down before the hips; both hands lie on that knee.
constexpr float k_kneel_pitch = 14;
constexpr Key k_kneels = {
    14, -6, {42, -6, 38, 10, 30}, {46, -14, 42, 10, 30}, {106, 3, 92, 0}, {14, 4, 84, 36}};

// The turn that takes x, y and z to orthonormal axes of which the trunk lies level, y along the heading.
Quat lying(float heading, Vec3 left) {
    // Faces down, then rolls until the left side is where it is to be.
    const Quat prone = rotation_y(heading) * rotation_x(0.5f * k_pi);
    const Quat to_left_down = normalize(rotation_between(rotate(prone, {1, 0, 0}), left));
    return normalize(to_left_down * prone);
}

}  // namespace

Lie lie_of(const BodyPose& pose, const PersonBlock& person, int lane, Vec2 slope) {
    constexpr float k_steepest = 0.5f;
    const auto places = places_of(pose, person, lane);
    const Vec3 along = places[neck] - places[hips], face = rotate(pose.rotation[hips], {0, 0, 1});
    const Vec2 way = on_ground(along);
    Lie lie;
    const bool sits = along.y > 0.8f * length(along);
    lie.heading = heading_of(sits || length(way) < 0.05f ? on_ground(face) : way);
    lie.on_back = !sits && face.y > 0.25f;
    lie.on_left = rotate(pose.rotation[hips], {1, 0, 0}).y < 0;
    lie.climbs = clamp(dot(slope, heading_direction(lie.heading)), -k_steepest, k_steepest);
    return lie;
}

RiseStage first_stage(const Lie& lie) { return lie.on_back ? RiseStage::side : RiseStage::fours; }
RiseStage next_stage(RiseStage stage) { return static_cast<RiseStage>(static_cast<uint32_t>(stage) + 1); }
float seconds_of(RiseStage stage) {
    constexpr float k_seconds[] = {0.9f, 1.0f, 0.8f, 0.95f, 0};
    return k_seconds[static_cast<int>(stage)];
}

BodyPose end_of(RiseStage stage, const Lie& lie, const PersonBlock& person, int lane, Vec2 hips_at) {
    const float height = person.joints[hips][1][lane];
    const Vec3 at = at_height(hips_at, height);
    const Quat facing = rotation_y(lie.heading);
    switch (stage) {
        case RiseStage::side:
            return posed(lie.on_left ? k_on_left : k_on_right,
                         lying(lie.heading, {0, lie.on_left ? -1.0f : 1.0f, 0}), at);
        case RiseStage::fours: {
            // Arms and thighs stay upright.
            const float climbs = arctan2(lie.climbs, 1) / k_radians;
            Key key = k_on_fours;
            for (LimbKey* limb : {&key.left_arm, &key.right_arm, &key.left_leg, &key.right_leg})
                limb->bend -= climbs;
            for (LimbKey* leg : {&key.left_leg, &key.right_leg}) leg->second -= climbs;
            return posed(key, facing * degrees_x(k_fours_pitch - climbs), at);
        }
        default:
            return posed(k_kneels, facing * degrees_x(k_kneel_pitch), at);
    }
}

}  // namespace flaneur
