#include "sim/pose/arm.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/pose/joint_limits.h"

namespace flaneur {

Quat bone_rotation(Vec3 bone, Vec3 front) {
    Quat down = rotation_between({0, -1, 0}, bone);
    Vec3 z = rotate(down, Vec3{0, 0, 1}), wanted = normalize_or(front - bone * dot(front, bone), z);
    float cosine = clamp(dot(z, wanted), -1, 1), half = 0.5f * arccos(cosine);
    SinCos turn = sin_cos(dot(cross(z, wanted), bone) < 0 ? -half : half);
    return normalize(Quat{bone.x * turn.sine, bone.y * turn.sine, bone.z * turn.sine, turn.cosine} * down);
}

Quat within_wrist(Quat hand_ps) {
    static const float k_side = sin_cos((joint_limits::k_wrist.side.high - 1) * k_radians).sine;
    static const SinCos k_bend = sin_cos((joint_limits::k_wrist.bend.high - 1) * k_radians);
    Vec3 along = rotate(hand_ps, Vec3{0, -1, 0});
    float x = clamp(along.x, -k_side, k_side), rest = std::sqrt(1 - x * x);
    float most = k_bend.sine * rest;
    float z = along.y < -k_bend.cosine * rest ? clamp(along.z, -most, most) : (along.z < 0 ? -most : most);
    Vec3 to{x, -std::sqrt(std::max(rest * rest - z * z, 0.0f)), z};
    if (x == along.x && z == along.z) return hand_ps;
    return rotation_between(along, normalize_or(to, {0, -1, 0})) * hand_ps;
}

static Quat against_parent(const auto& pose, int j) {
    return conjugate(pose.rotation(k_joint_parents[static_cast<size_t>(j)])) * pose.rotation(j);
}

static bool is_within(DegreeSpan span, float angle) {
    return angle > (span.low + 0.5f) * k_radians && angle < (span.high - 0.5f) * k_radians;
}

static int upper_arm_of(Side side) { return side == k_left ? left_upper_arm : right_upper_arm; }

bool is_sound(const Posed& pose, Side side) {
    const JointLimits limits[] = {joint_limits::k_shoulder, joint_limits::k_elbow, joint_limits::k_wrist};
    const float mirror = side == k_left ? -1.0f : 1.0f;  // limits are a right arm's
    for (int i = 0; i < 3; ++i) {
        Quat turn = against_parent(pose, upper_arm_of(side) + i);
        Vec3 along = rotate(turn, Vec3{0, -1, 0});
        if (!is_within(limits[i].twist, mirror * wrap_angle(2 * arctan2(turn.y, turn.w)))) return false;
        if (!is_within(limits[i].bend, arctan2(along.z, -along.y))) return false;
        if (!is_within(limits[i].side, mirror * (arccos(along.x) - k_pi / 2))) return false;
    }
    return true;
}

KeptArm keep_arm(const Posed& pose, Side side) {
    KeptArm kept;
    const int first = upper_arm_of(side);
    for (int j = 0; j < 3; ++j) kept.joints[j] = {pose.place_os(first + j), pose.rotation(first + j)};
    return kept;
}

void set_arm(Posed pose, Side side, const KeptArm& kept) {
    const int first = upper_arm_of(side);
    for (int j = 0; j < 3; ++j) pose.set(first + j, kept.joints[j].position, kept.joints[j].rotation);
}

// From rotations against the parents.
static void part_arm(const Quat before_ps[3], Posed now, Side side, float part) {
    const int first = upper_arm_of(side), last = first + 2;
    Quat was_above = now.rotation(first - 1), above = was_above;
    Vec3 was_at = now.place_os(first), at = was_at;
    for (int j = first; j <= last; ++j) {
        Quat was = now.rotation(j);
        Vec3 bone = rotate(conjugate(was_above), now.place_os(j) - was_at);
        if (j > first) at += rotate(above, bone);
        was_at = now.place_os(j);
        Quat turn_ps = nlerp(before_ps[j - first], conjugate(was_above) * was, part);
        above = normalize(above * (j == last ? within_wrist(turn_ps) : turn_ps));
        was_above = was;
        now.set(j, at, above);
    }
}

void part_arm(const PosedBefore& before, Posed now, Side side, float part) {
    Quat before_ps[3];
    for (int j = 0; j < 3; ++j) before_ps[j] = against_parent(before, upper_arm_of(side) + j);
    part_arm(before_ps, now, side, part);
}

void part_arm(const KeptArm& before, Posed now, Side side, float part) {
    Quat before_ps[3], above = now.rotation(upper_arm_of(side) - 1);
    for (int j = 0; j < 3; ++j) {
        before_ps[j] = conjugate(above) * before.joints[j].rotation;
        above = before.joints[j].rotation;
    }
    part_arm(before_ps, now, side, part);
}

bool slow_arm(const PosedBefore& before, Posed now, Side side, float most) {
    float farthest = 0;
    for (int j = upper_arm_of(side); j <= upper_arm_of(side) + 2; ++j) {
        float same = std::min(std::fabs(dot(against_parent(before, j), against_parent(now, j))), 1.0f);
        farthest = std::max(farthest, 2 * arccos(same));
    }
    if (farthest <= most) return false;
    part_arm(before, now, side, most / farthest);
    return true;
}

}  // namespace flaneur
