#include "sim/pose/cane.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/pose/arm.h"
#include "sim/pose/joint_limits.h"

namespace flaneur {

namespace {

constexpr float k_straightest = 0.99f;  // of the arm's length
constexpr float k_most_bent = 0.69f;
constexpr float k_most_outward = 0.8f;                         // radians that a bent arm turns its elbow out,
constexpr float k_outward_from = -0.35f, k_outward_to = 0.4f;  // by the bend, less its cosine
constexpr float k_ahead = 0.25f, k_down = 0.4f;                // arms, of the wrist from the shoulder
constexpr float k_farthest = 0.6f;                             // arms that the wrist is moved

// On the sphere of `cane` round the tip, as near to `wanted` as the shoulder's distance from it may be within
// [least, most]: on the circle where both spheres meet. Where they do not, on the line to the shoulder.
Vec3 wrist_on_cane(Vec3 tip, float cane, Vec3 wanted, Vec3 shoulder, float least, float most) {
    Vec3 wrist = tip + normalize_or(wanted - tip, {0, 1, 0}) * cane;
    float away = length(wrist - shoulder), distance = length(shoulder - tip);
    float reach = clamp(away, least, most);
    if (reach == away || distance < 1e-3f) return wrist;
    Vec3 up = (shoulder - tip) / distance;
    float along = clamp((cane * cane - reach * reach + distance * distance) / (2 * distance), -cane, cane);
    Vec3 aside = normalize_or(wrist - tip - up * dot(wrist - tip, up), {0, 0, 0});
    return tip + up * along + aside * std::sqrt(cane * cane - along * along);
}

// Where the wrist of an arm that holds a cane would like to be: always ahead, on whichever side of the cane
// it is, as far out as it is.
Vec3 wrist_of(const Posed& pose, float reach) {
    Vec3 ahead = rotate(pose.rotation(upper_chest), Vec3{0, 0, 1});
    Vec3 way = normalize_or({ahead.x, 0, ahead.z}, {0, 0, 1}), right{-way.z, 0, way.x};
    Vec3 shoulder = pose.place_os(right_upper_arm);
    float out = dot(pose.place_os(right_hand) - shoulder, right);
    return shoulder + way * (k_ahead * reach) + right * out - Vec3{0, k_down * reach, 0};
}

// Moves the wrist: the elbow bends about its own axis, then the arm turns about the shoulder by the shortest
// way; one much bent has its elbow outward, not behind. The hand is held against the forearm as it was.
void move_wrist(Posed& pose, Vec3 to, float held) {
    Vec3 shoulder = pose.place_os(right_upper_arm), elbow = pose.place_os(right_lower_arm),
         wrist = pose.place_os(right_hand);
    Quat upper = pose.rotation(right_upper_arm), lower = pose.rotation(right_lower_arm),
         hand = pose.rotation(right_hand);
    float a = length(elbow - shoulder), b = length(wrist - elbow);
    float reach = clamp(length(to - shoulder), std::fabs(a - b) + 1e-3f, a + b);
    Vec3 along = (elbow - shoulder) / a, was = (wrist - elbow) / b;
    Vec3 axis = rotate(lower, Vec3{1, 0, 0});
    Vec3 front = normalize_or(cross(along, axis), {0, 0, 1});
    float cosine = clamp((reach * reach - a * a - b * b) / (2 * a * b), -1, 1);
    Vec3 forearm = along * cosine + front * std::sqrt(1 - cosine * cosine);
    Quat bend = rotation_between(was, forearm);
    Quat turn = rotation_between(normalize_or(along * a + forearm * b, {0, -1, 0}),
                                 normalize_or(to - shoulder, {0, -1, 0}));
    SinCos out = sin_cos(-0.5f * k_most_outward * held * smoothstep(k_outward_from, k_outward_to, -cosine));
    Vec3 axle = normalize_or(to - shoulder, {0, -1, 0}) * out.sine;
    turn = Quat{axle.x, axle.y, axle.z, out.cosine} * turn;
    Quat new_lower = turn * bend * lower;
    Vec3 new_elbow = shoulder + rotate(turn, along) * a;
    pose.set(right_upper_arm, shoulder, normalize(turn * upper));
    pose.set(right_lower_arm, new_elbow, normalize(new_lower));
    pose.set(right_hand, new_elbow + rotate(turn, forearm) * b, normalize(turn * bend * hand));
}

void hold(const Cane& cane, Posed pose, float part) {
    float held = part * smoothstep(0, 1, cane.held);
    Vec3 wrist = pose.place_os(right_hand), shoulder = pose.place_os(right_upper_arm),
         elbow = pose.place_os(right_lower_arm);
    Vec3 hangs = wrist + rotate(pose.rotation(right_hand), cane.tip_hs);
    Vec3 tip = lerp(hangs, cane.tip - pose.origin(), held);
    float reach = length(elbow - shoulder) + length(wrist - elbow), long_way = length(cane.tip_hs);
    float away = length(wrist - shoulder);
    float least = std::min(k_most_bent * reach, away), most = std::max(k_straightest * reach, away);
    Vec3 to = wrist_on_cane(tip, long_way, lerp(wrist, wrist_of(pose, reach), held), shoulder,
                            lerp(least, k_most_bent * reach, held), lerp(most, k_straightest * reach, held));
    Vec3 by = to - wrist;
    float farthest = k_farthest * reach, far = length(by);
    move_wrist(pose, far > farthest ? wrist + by * (farthest / far) : to, held);

    Quat lower = pose.rotation(right_lower_arm), hand = pose.rotation(right_hand);
    Vec3 end = pose.place_os(right_hand);
    Quat turn = rotation_between(rotate(hand, cane.tip_hs) / long_way, normalize_or(tip - end, {0, -1, 0}));
    pose.set(right_hand, end, normalize(lower * within_wrist(conjugate(lower) * turn * hand)));
}

// As far as the arm can.
void hold(const Cane& cane, Posed pose) {
    if (cane.held == 0) return;
    const KeptArm swung = keep_arm(pose, k_right);
    for (float part : {1.0f, 0.75f, 0.5f, 0.25f}) {
        hold(cane, pose, part);
        if (is_sound(pose, k_right)) return;
        set_arm(pose, k_right, swung);
    }
}

}  // namespace

void hold_canes(const Gait& gait, size_t begin, size_t end, std::vector<PoseBlock>& poses) {
    for (size_t i = begin; i < end; ++i) {
        const Cane& cane = gait.canes[i];
        hold(cane, {poses[cane.walker / k_block], cane.walker % k_block});
    }
}

void hold_canes(const Gait& gait, size_t begin, size_t end, float dt, const std::vector<PoseBlock>& before,
                std::vector<PoseBlock>& poses) {
    hold_canes(gait, begin, end, poses);
    // A hand that is then held within its wrist's range turns a little farther.
    const float most = 0.9f * k_fastest_walking * dt;
    for (size_t i = begin; i < end; ++i) {
        size_t walker = gait.canes[i].walker;
        slow_arm({before[walker / k_block], walker % k_block}, {poses[walker / k_block], walker % k_block},
                 k_right, most);
    }
}

Vec3 posed_tip(const std::vector<PoseBlock>& poses, const Cane& cane) {
    JointPose hand = joint_pose(poses, cane.walker, right_hand);
    return hand.position + rotate(hand.rotation, cane.tip_hs);
}

}  // namespace flaneur
