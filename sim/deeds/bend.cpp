#include "sim/deeds/bend.h"

#include <algorithm>

#include "sim/base/math.h"
#include "sim/fall/limbs.h"
#include "sim/pose/arm.h"
#include "sim/pose/joint_limits.h"

namespace flaneur {

namespace {

constexpr float k_palm = 0.36f;    // forearms, from the wrist to the middle of the palm
constexpr float k_thick = 0.021f;  // metres, of half a grown person's hand
constexpr float k_grown = 1.75f;
constexpr float k_straightest = 0.985f;  // of an arm's length

Vec3 own_place(Someone who, int joint) {
    const auto& at = who.person.joints[joint];
    return {at[0][who.lane], at[1][who.lane], at[2][who.lane]};
}
float bone_of(Someone who, int joint) {
    return length(own_place(who, joint) - own_place(who, k_joint_parents[static_cast<size_t>(joint)]));
}

int shoulder_of(Side side) { return side == k_left ? left_upper_arm : right_upper_arm; }

// A joint and all that hangs on it.
void turn_from(BodyPose& pose, int joint, Quat turn) {
    bool goes[k_joint_count] = {};
    for (int j = joint; j < k_joint_count; ++j) {
        const int parent = k_joint_parents[static_cast<size_t>(j)];
        goes[j] = j == joint || (parent >= 0 && goes[parent]);
        if (goes[j])
            pose.rotation[static_cast<size_t>(j)] = normalize(turn * pose.rotation[static_cast<size_t>(j)]);
    }
}

Vec3 front_of(const BodyPose& pose) {
    const Vec2 front = on_ground(rotate(pose.rotation[hips], {0, 0, 1}));
    return at_height(normalize_or(front, {0, 1}), 0);
}

// Turned about its own length by no more than that, either way; less and less where it would go round.
Quat held_twist(Quat turn, float most) {
    const float twist = wrap_angle(2 * arctan2(turn.y, turn.w));
    const float excess = std::max(std::fabs(twist) - most, 0.0f);
    const float left = std::max(most - 2 * excess, 0.0f);
    return excess > 0 ? normalize(turn * rotation_y((twist < 0 ? -left : left) - twist)) : turn;
}

}  // namespace

float leg_of(Someone who) { return own_place(who, left_upper_leg).y; }
float forearm_of(Someone who) { return bone_of(who, left_hand); }

float bell(float time) {
    const float t = clamp(time, 0, 1);
    return t * t * t * (10 + t * (6 * t - 15));
}

void bend_down(BodyPose& pose, Someone who, Bend bend) {
    constexpr float k_pitch = 70 * k_radians, k_of_hips = 0.3f, k_down = 0.52f, k_back = 0.165f;
    const float s = clamp(bend.depth, 0, 1);
    if (s <= 0 && bend.back == 0) return;
    const auto stands = places_of(pose, who.person, who.lane);
    const Vec3 front = front_of(pose), left = cross({0, 1, 0}, front);
    const float pitch = k_pitch * s * (1.6f - 0.6f * s), down = k_down * leg_of(who) * s * (0.2f + 0.8f * s);
    const SinCos bow = sin_cos(pitch);
    const float back = k_back * who.person.height[who.lane] * bow.sine + bend.back;
    const Quat kept[2] = {pose.rotation[left_upper_leg], pose.rotation[right_upper_leg]};
    const Quat shanks[2] = {pose.rotation[left_lower_leg], pose.rotation[right_lower_leg]};
    const Quat feet[4] = {pose.rotation[left_foot], pose.rotation[left_toes], pose.rotation[right_foot],
                          pose.rotation[right_toes]};
    turn_from(pose, hips, rotation_about(left, k_of_hips * pitch));
    for (const Side side : {k_left, k_right}) {
        const size_t thigh = side == k_left ? left_upper_leg : right_upper_leg;
        pose.rotation[thigh] = kept[side], pose.rotation[thigh + 1] = shanks[side];
        pose.rotation[thigh + 2] = feet[2 * side], pose.rotation[thigh + 3] = feet[2 * side + 1];
    }
    turn_trunk(pose, (1 - k_of_hips) * pitch, 0);
    pose.hips += Vec3{0, -down, 0} - front * back;
    for (const Side side : {k_left, k_right})
        reach_with_leg(pose, who.person, who.lane, side, stands[side == k_left ? left_foot : right_foot]);
}

void turn_trunk(BodyPose& pose, float ahead, float left) {
    for (const int j : {spine, chest, upper_chest}) {
        const Vec3 side = rotate(pose.rotation[static_cast<size_t>(j)], {1, 0, 0});
        turn_from(pose, j, rotation_y(left / 3) * rotation_about(side, ahead / 3));
    }
}

void look_at(BodyPose& pose, Someone who, Vec3 place, float share) {
    if (share <= 0) return;
    constexpr float k_eyes = 0.045f;  // of the height, above the head's joint
    constexpr float k_most_yaw = 65 * k_radians, k_most_down = 58 * k_radians, k_most_up = 40 * k_radians;
    constexpr float k_of_neck = 0.42f;
    const Vec3 eyes =
        place_of(pose, who.person, who.lane, head) + Vec3{0, k_eyes * who.person.height[who.lane], 0};
    const Vec3 way = rotate(conjugate(pose.rotation[upper_chest]), place - eyes);
    const float flat = std::sqrt(way.x * way.x + way.z * way.z);
    const float yaw = clamp(arctan2(way.x, std::max(way.z, 0.05f)), -k_most_yaw, k_most_yaw),
                down = clamp(arctan2(-way.y, std::max(flat, 0.05f)), -k_most_up, k_most_down);
    const Quat own_neck = conjugate(pose.rotation[upper_chest]) * pose.rotation[neck],
               own_head = conjugate(pose.rotation[neck]) * pose.rotation[head];
    auto part = [&](float of) { return normalize(rotation_y(of * yaw) * rotation_x(of * down)); };
    pose.rotation[neck] = normalize(pose.rotation[upper_chest] * nlerp(own_neck, part(k_of_neck), share));
    pose.rotation[head] = normalize(pose.rotation[neck] * nlerp(own_head, part(1 - k_of_neck), share));
}

JointPose wrist_of(const Palm& palm, Someone who, Side side) {
    const float scale = who.person.height[who.lane] / k_grown;
    // A left palm faces -x, a right one +x, fingers are along -y.
    const Vec3 x = side == k_left ? -palm.faces : palm.faces, z = cross(x, -palm.fingers);
    const Vec3 at = palm.place - palm.faces * (k_thick * scale) - palm.fingers * (k_palm * forearm_of(who));
    return {at, bone_rotation(palm.fingers, z)};
}

static Palm palm_at(const BodyPose& pose, Someone who, Side side, Vec3 wrist) {
    const size_t hand = side == k_left ? left_hand : right_hand;
    const float scale = who.person.height[who.lane] / k_grown;
    Palm palm;
    palm.faces = rotate(pose.rotation[hand], {side == k_left ? -1.0f : 1.0f, 0, 0});
    palm.fingers = rotate(pose.rotation[hand], {0, -1, 0});
    palm.place = wrist + palm.faces * (k_thick * scale) + palm.fingers * (k_palm * forearm_of(who));
    return palm;
}

Palm palm_of(const BodyPose& pose, Someone who, Side side) {
    const int hand = side == k_left ? left_hand : right_hand;
    return palm_at(pose, who, side, place_of(pose, who.person, who.lane, hand));
}

float beyond_reach(const BodyPose& pose, Someone who, Side side, Vec3 wrist, float part) {
    const int first = shoulder_of(side);
    const Vec3 shoulder = place_of(pose, who.person, who.lane, first);
    return length(wrist - shoulder) - part * (bone_of(who, first + 1) + bone_of(who, first + 2));
}

// From where its shoulder is.
static void reach_from(Vec3 shoulder, BodyPose& pose, Someone who, Side side, const JointPose& wrist,
                       Vec3 elbow_to, float share) {
    const int joint = shoulder_of(side);
    const auto first = static_cast<size_t>(joint);
    const float outward = side == k_left ? 1.0f : -1.0f;
    Quat was_ps[3], above = pose.rotation[first - 1];
    for (size_t j = 0; j < 3; ++j)
        was_ps[j] = conjugate(above) * pose.rotation[first + j], above = pose.rotation[first + j];
    const Vec3 to = wrist.position - shoulder;
    const float a = bone_of(who, joint + 1), b = bone_of(who, joint + 2);
    const float reach = clamp(length(to), std::fabs(a - b) + 0.04f, k_straightest * (a + b));
    const Vec3 way = normalize_or(to, {0, -1, 0});
    const Vec3 pole = rotate(pose.rotation[upper_chest], Vec3{outward * elbow_to.x, elbow_to.y, elbow_to.z});
    const Vec3 aside = normalize_or(pole - way * dot(pole, way), {0, -1, 0});
    const float along = (a * a - b * b + reach * reach) / (2 * reach);
    const Vec3 elbow = way * along + aside * std::sqrt(std::max(a * a - along * along, 0.0f));
    const Vec3 upper = normalize_or(elbow, {0, -1, 0}), lower = normalize_or(way * reach - elbow, {0, -1, 0});
    // The elbow is a hinge: both bones keep their fronts in the plane that it bends in.
    const Quat upper_ws = bone_rotation(upper, lower);
    Quat lower_ws = bone_rotation(lower, -upper);
    // The forearm takes most of what the hand twists against it; under a hand that is bent far it turns so
    // that this is a bend ahead or back, which wrists can.
    constexpr float k_takes = 0.6f, k_most = 95 * k_radians, k_bent = 0.3f, k_far = 0.75f;
    const Quat twist = conjugate(lower_ws) * wrist.rotation;
    // Little by little none where either is about to go round the other way.
    const float whole = wrap_angle(2 * arctan2(twist.y, twist.w));
    const float turns = k_takes * whole * (1 - smoothstep(1.9f, 3.0f, std::fabs(whole)));
    const Vec3 points = rotate(twist, {0, -1, 0});
    float under = arctan2(points.x, points.z);
    if (std::fabs(under) > 0.5f * k_pi) under = wrap_angle(under + k_pi);
    const float bent = smoothstep(k_bent, k_far, points.x * points.x + points.z * points.z) *
                       (1 - smoothstep(1.0f, 1.5f, std::fabs(under)));
    lower_ws = normalize(lower_ws * rotation_y(clamp(lerp(turns, under, bent), -k_most, k_most)));
    const Quat hand_ps = within_wrist(held_twist(conjugate(lower_ws) * wrist.rotation, k_most));
    const Quat now_ps[3] = {conjugate(pose.rotation[first - 1]) * upper_ws, conjugate(upper_ws) * lower_ws,
                            hand_ps};
    above = pose.rotation[first - 1];
    for (size_t j = 0; j < 3; ++j) {
        above = normalize(above * (share >= 1 ? now_ps[j] : nlerp(was_ps[j], now_ps[j], share)));
        pose.rotation[first + j] = above;
    }
}

void reach_with_arm(BodyPose& pose, Someone who, Side side, const JointPose& wrist, Vec3 elbow_to,
                    float share) {
    if (share <= 0) return;
    reach_from(place_of(pose, who.person, who.lane, shoulder_of(side)), pose, who, side, wrist, elbow_to,
               share);
}

void reach_for(BodyPose& pose, Someone who, Side side, const Palm& palm, Vec3 elbow, float share) {
    JointPose wrist = wrist_of(palm, who, side);
    const int joint = shoulder_of(side);
    const auto first = static_cast<size_t>(joint);
    const Vec3 shoulder = place_of(pose, who.person, who.lane, joint);
    const Vec3 upper = own_place(who, joint + 1) - own_place(who, joint),
               lower = own_place(who, joint + 2) - own_place(who, joint + 1);
    const Quat stands[3] = {pose.rotation[first], pose.rotation[first + 1], pose.rotation[first + 2]};
    auto stand = [&] { std::copy(stands, stands + 3, &pose.rotation[first]); };
    for (int n = 0; n < 4; ++n) {
        stand();
        reach_from(shoulder, pose, who, side, wrist, elbow, 1);
        const Vec3 hand =
            shoulder + rotate(pose.rotation[first], upper) + rotate(pose.rotation[first + 1], lower);
        const Vec3 off = palm.place - palm_at(pose, who, side, hand).place;
        if (length(off) < 0.0005f) break;
        wrist.position += off;
    }
    if (share >= 1) return;
    stand();
    reach_from(shoulder, pose, who, side, wrist, elbow, share);
}

void lean_to(BodyPose& pose, Someone who, Side side, Vec3 wrist, float share, float most) {
    constexpr float k_part = 0.97f;
    const auto shoulder = static_cast<size_t>(shoulder_of(side));
    float left = most * share;
    for (int n = 0; n < 8 && left > 0; ++n) {
        const float lacks = share * beyond_reach(pose, who, side, wrist, k_part);
        if (lacks <= 0) return;
        const auto places = places_of(pose, who.person, who.lane);
        const Vec3 up = places[shoulder] - places[spine], to = wrist - places[spine];
        const Vec3 axis = normalize_or(cross(up, to), {1, 0, 0});
        const float angle = std::min(lacks / length(up), left);
        left -= angle;
        for (const int j : {spine, chest, upper_chest}) turn_from(pose, j, rotation_about(axis, angle / 3));
    }
}

void keep_hip_within(BodyPose& pose, Side side, float share) {
    constexpr float k_inside = 1;  // degree
    constexpr JointLimits k_range = joint_limits::k_hip;
    const size_t thigh = side == k_left ? left_upper_leg : right_upper_leg;
    const float outward = side == k_left ? 1.0f : -1.0f;
    const Quat was = pose.rotation[thigh], turn = conjugate(pose.rotation[hips]) * was;
    const float twist = wrap_angle(2 * arctan2(turn.y, turn.w));
    const Quat swing = normalize(turn * rotation_y(-twist));
    const Vec3 along = rotate(swing, {0, -1, 0});
    auto held = [](float angle, DegreeSpan span) {
        return clamp(angle, (span.low + k_inside) * k_radians, (span.high - k_inside) * k_radians);
    };
    const float bend = held(arctan2(along.z, -along.y), k_range.bend);
    const float aside = outward * held(outward * (0.5f * k_pi - arccos(clamp(along.x, -1, 1))), k_range.side);
    const SinCos b = sin_cos(bend), a = sin_cos(aside);
    const Vec3 to{a.sine, -a.cosine * b.cosine, a.cosine * b.sine};
    const Quat now =
        rotation_between(along, normalize_or(to, along)) * swing * rotation_y(held(twist, k_range.twist));
    turn_from(pose, static_cast<int>(thigh),
              nlerp(was, normalize(pose.rotation[hips] * now), share) * conjugate(was));
}

float depth_to_reach(const BodyPose& stands, Someone who, const Vec3 wrists[2], float back, float part) {
    auto reaches = [&](float depth) {
        BodyPose pose = stands;
        bend_down(pose, who, {depth, back});
        return beyond_reach(pose, who, k_left, wrists[0], part) <= 0 &&
               beyond_reach(pose, who, k_right, wrists[1], part) <= 0;
    };
    if (reaches(0)) return 0;
    float low = 0, high = 1;
    for (int n = 0; n < 14; ++n) (reaches(0.5f * (low + high)) ? high : low) = 0.5f * (low + high);
    return high;
}

}  // namespace flaneur
