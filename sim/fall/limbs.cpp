#include "sim/fall/limbs.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"

namespace flaneur {

namespace {

constexpr float k_palm = 0.06f;  // of the height, from the wrist to the middle of the palm
constexpr float k_straightest = 0.995f;

Quat turn_between(Vec3 from, Vec3 to) {
    return rotation_between(normalize_or(from, {0, -1, 0}), normalize_or(to, {0, -1, 0}));
}

// A limb of two bones, from its root.
struct Limb {
    Vec3 root, middle, end;
};
// How its bones turn for the end to come to `to`: the lower one in the plane of both, or of one that is
// straight towards cross(axis, bone) times `sense`, then both by the shortest way.
struct LimbTurns {
    Quat upper, lower;
    bool reaches = true;
};
LimbTurns turns_to(const Limb& limb, Vec3 axis, float sense, Vec3 to) {
    const Vec3 first = limb.middle - limb.root, second = limb.end - limb.middle;
    const float a = length(first), b = length(second), far = length(to - limb.root);
    const float most = k_straightest * (a + b);
    const float reach = clamp(far, std::fabs(a - b) + 0.01f, most);
    const Vec3 along = first / a;
    constexpr float k_straight = 0.08f;  // of the lower bone, aside of the upper one
    const Vec3 off = second - along * dot(second, along);
    const Vec3 usual = normalize_or(cross(axis, along) * sense, {0, 0, 1});
    const Vec3 front = normalize_or(off + usual * std::max(k_straight * b - length(off), 0.0f), usual);
    const float cosine = clamp((reach * reach - a * a - b * b) / (2 * a * b), -1, 1);
    const Vec3 bent = along * cosine + front * std::sqrt(1 - cosine * cosine);
    const Quat bend = turn_between(second, bent);
    const Quat turn = turn_between(along * a + bent * b, to - limb.root);
    return {turn, turn * bend, far <= most + 0.005f};
}

int upper_arm_of(Side side) { return side == k_left ? left_upper_arm : right_upper_arm; }
int thigh_of(Side side) { return side == k_left ? left_upper_leg : right_upper_leg; }

Vec3 palm_from(const BodyPose& pose, const PersonBlock& person, int lane, int hand, Vec3 wrist) {
    return wrist + rotate(pose.rotation[hand], Vec3{0, -k_palm * person.height[lane], 0});
}

// The turn that takes -y to `bone` and x to `axis`, unit and at right angles.
Quat bone_turn(Vec3 bone, Vec3 axis) {
    const Quat down = rotation_between({0, -1, 0}, bone);
    const Vec3 x = rotate(down, {1, 0, 0});
    return normalize(rotation_about(bone, arctan2(dot(cross(x, axis), bone), dot(x, axis))) * down);
}

// An arm whose palm is at `palm`, and where its elbow would be at no turn.
struct PlainArm {
    Vec3 shoulder, along, pole;  // the pole is at right angles to the way to the palm
    float first, second;         // metres, of upper arm, and from elbow to palm
};
PlainArm plain_arm(const BodyPose& pose, const PersonBlock& person, int lane, Side side, Vec3 palm) {
    const int upper = upper_arm_of(side);
    const Vec3 shoulder = place_of(pose, person, lane, upper),
               elbow = place_of(pose, person, lane, upper + 1);
    const Vec3 along = normalize_or(palm - shoulder, {0, -1, 0});
    // Carried over the sphere from a middle one, from which arms are never opposite.
    const float out = side == k_left ? 1.0f : -1.0f;
    const Vec3 middle = normalize_or({0.4f * out, -0.5f, 0.75f}, {0, 0, 1});
    const Quat chest = pose.rotation[upper_chest];
    const Quat carried = chest * rotation_between(middle, rotate(conjugate(chest), along));
    const Vec3 pole = rotate(carried, Vec3{out, 0, -0.5f});
    const Vec3 end = palm_of(pose, person, lane, side);
    return {shoulder, along, normalize_or(pole - along * dot(pole, along), {0, 1, 0}),
            length(elbow - shoulder), length(end - elbow)};
}

struct ArmTurns {
    Quat upper, lower;
};
ArmTurns turned_arm(const PlainArm& arm, float turn, Vec3 palm) {
    const float a = arm.first, b = arm.second;
    const float reach = clamp(length(palm - arm.shoulder), std::fabs(a - b) + 0.01f, k_straightest * (a + b));
    const Vec3 pole = rotate(rotation_about(arm.along, turn), arm.pole), axis = cross(arm.along, pole);
    const float on = (a * a - b * b + reach * reach) / (2 * reach);
    const Vec3 elbow = arm.along * on + pole * std::sqrt(std::max(a * a - on * on, 0.0f));
    return {bone_turn(elbow / a, axis), bone_turn(normalize_or(arm.along * reach - elbow, arm.along), axis)};
}

}  // namespace

void reach_with_leg(BodyPose& pose, const PersonBlock& person, int lane, Side side, Vec3 ankle) {
    const int thigh = thigh_of(side);
    const auto places = places_of(pose, person, lane);
    const LimbTurns turns = turns_to({places[thigh], places[thigh + 1], places[thigh + 2]},
                                     rotate(pose.rotation[thigh + 1], {1, 0, 0}), 1, ankle);
    pose.rotation[thigh] = normalize(turns.upper * pose.rotation[thigh]);
    pose.rotation[thigh + 1] = normalize(turns.lower * pose.rotation[thigh + 1]);
}

bool reach_with_arm(BodyPose& pose, const PersonBlock& person, int lane, Side side, Vec3 palm) {
    const int upper = upper_arm_of(side);
    const auto places = places_of(pose, person, lane);
    const Vec3 end = palm_from(pose, person, lane, upper + 2, places[upper + 2]);
    const LimbTurns turns = turns_to({places[upper], places[upper + 1], end},
                                     rotate(pose.rotation[upper + 1], {1, 0, 0}), -1, palm);
    pose.rotation[upper] = normalize(turns.upper * pose.rotation[upper]);
    pose.rotation[upper + 1] = normalize(turns.lower * pose.rotation[upper + 1]);
    pose.rotation[upper + 2] = normalize(turns.lower * pose.rotation[upper + 2]);
    return turns.reaches;
}

ArmWay arm_way(const BodyPose& pose, const PersonBlock& person, int lane, Side side) {
    const int upper = upper_arm_of(side);
    ArmWay way;
    way.palm = palm_of(pose, person, lane, side);
    const PlainArm arm = plain_arm(pose, person, lane, side, way.palm);
    const Vec3 elbow = place_of(pose, person, lane, upper + 1) - arm.shoulder;
    const Vec3 out = elbow - arm.along * dot(elbow, arm.along);
    way.turn = arctan2(dot(cross(arm.pole, out), arm.along), dot(arm.pole, out));
    const ArmTurns turns = turned_arm(arm, way.turn, way.palm);
    for (int k = 0; k < 3; ++k)
        way.against[static_cast<size_t>(k)] =
            conjugate(k == 0 ? turns.upper : turns.lower) * pose.rotation[upper + k];
    return way;
}

void set_arm(BodyPose& pose, const PersonBlock& person, int lane, Side side, const ArmWay& from,
             const ArmWay& to, float t, Vec3 palm) {
    const int upper = upper_arm_of(side);
    const float turn = from.turn + t * wrap_angle(to.turn - from.turn);
    const PlainArm arm = plain_arm(pose, person, lane, side, palm);
    const ArmTurns turns = turned_arm(arm, turn, palm);
    for (int k = 0; k < 3; ++k) {
        const auto i = static_cast<size_t>(k);
        pose.rotation[upper + k] =
            normalize((k == 0 ? turns.upper : turns.lower) * nlerp(from.against[i], to.against[i], t));
    }
}

void keep_elbow(BodyPose& pose, const BodyPose& before, const PersonBlock& person, int lane, Side side,
                float most) {
    ArmWay now = arm_way(pose, person, lane, side);
    const float had = arm_way(before, person, lane, side).turn, turns = wrap_angle(now.turn - had);
    if (std::fabs(turns) <= most) return;
    now.turn = had + clamp(turns, -most, most);
    set_arm(pose, person, lane, side, now, now, 0, now.palm);
}

ArmPlaces arm_places(const BodyPose& pose, const PersonBlock& person, int lane, Side side) {
    const int upper = upper_arm_of(side);
    return {place_of(pose, person, lane, upper), place_of(pose, person, lane, upper + 1),
            palm_of(pose, person, lane, side)};
}

void place_arm(BodyPose& pose, const PersonBlock& person, int lane, Side side, Vec3 palm, Vec3 elbow) {
    ArmWay way = arm_way(pose, person, lane, side);
    const PlainArm arm = plain_arm(pose, person, lane, side, palm);
    const Vec3 off = elbow - arm.shoulder, out = off - arm.along * dot(off, arm.along);
    way.turn = arctan2(dot(cross(arm.pole, out), arm.along), dot(arm.pole, out));
    set_arm(pose, person, lane, side, way, way, 0, palm);
}

void blend_arm(BodyPose& pose, const BodyPose& to, Side side, float part) {
    const int upper = upper_arm_of(side);
    Quat was_above = pose.rotation[upper - 1], above = was_above, to_above = to.rotation[upper - 1];
    for (int j = upper; j <= upper + 2; ++j) {
        const Quat was = pose.rotation[j];
        above =
            normalize(above * nlerp(conjugate(was_above) * was, conjugate(to_above) * to.rotation[j], part));
        was_above = was, to_above = to.rotation[j];
        pose.rotation[j] = above;
    }
}

Vec3 palm_of(const BodyPose& pose, const PersonBlock& person, int lane, Side side) {
    const int hand = upper_arm_of(side) + 2;
    return palm_from(pose, person, lane, hand, place_of(pose, person, lane, hand));
}

float reach_of_arm(const PersonBlock& person, int lane) {
    auto at = [&](Joint j) {
        return Vec3{person.joints[j][0][lane], person.joints[j][1][lane], person.joints[j][2][lane]};
    };
    return length(at(left_lower_arm) - at(left_upper_arm)) + length(at(left_hand) - at(left_lower_arm)) +
           k_palm * person.height[lane];
}

void fold_knee(BodyPose& pose, Side side, float angle) {
    const int shank = thigh_of(side) + 1;
    const Quat turn = rotation_about(rotate(pose.rotation[shank], {1, 0, 0}), angle);
    for (int j = shank; j <= shank + 2; ++j) pose.rotation[j] = normalize(turn * pose.rotation[j]);
}

void turn_foot(BodyPose& pose, Side side, float angle) {
    const int foot = thigh_of(side) + 2;
    const Quat turn = rotation_about(rotate(pose.rotation[foot], {1, 0, 0}), angle);
    for (int j = foot; j <= foot + 1; ++j) pose.rotation[j] = normalize(turn * pose.rotation[j]);
}

HeadTurn turn_to_look(const BodyPose& pose, const PersonBlock& person, int lane, Vec3 place) {
    constexpr float k_aside = 1.2f, k_up = 0.5f, k_down = 0.85f, k_behind = 2.2f;
    const Vec3 way =
        rotate(conjugate(pose.rotation[upper_chest]), place - place_of(pose, person, lane, head));
    const float yaw = arctan2(way.x, way.z), flat = std::sqrt(way.x * way.x + way.z * way.z);
    // What is behind one does not look at.
    if (std::fabs(yaw) > k_behind) return {};
    return {clamp(yaw, -k_aside, k_aside), clamp(arctan2(way.y, flat), -k_down, k_up)};
}

void turn_head(BodyPose& pose, HeadTurn gaze, float part) {
    const Quat chest = pose.rotation[upper_chest];
    for (const Joint j : {neck, head}) {
        const float share = j == neck ? 0.4f : 1;
        const Quat wanted = rotation_y(share * gaze.yaw) * rotation_x(-share * gaze.pitch);
        pose.rotation[j] = normalize(chest * nlerp(conjugate(chest) * pose.rotation[j], wanted, part));
    }
}

void lean_trunk(BodyPose& pose, float angle) {
    const Vec3 axis = rotate(pose.rotation[hips], {1, 0, 0});
    for (int j = spine; j <= right_hand; ++j) {
        const bool is_arm = (j >= left_upper_arm && j <= left_hand) || j >= right_upper_arm;
        const float share = j == spine   ? 0.45f
                            : j == chest ? 0.75f
                            : j == neck  ? 0.75f
                            : j == head  ? 0.5f
                            : is_arm     ? 0.3f
                                         : 1;
        pose.rotation[j] = normalize(rotation_about(axis, share * angle) * pose.rotation[j]);
    }
}

void breathe(BodyPose& pose, float seconds, float depth) {
    constexpr float k_rate = 2 * k_pi * 16 / 60, k_swells = 0.022f, k_turns = 0.05f;  // rad/s, radians
    const Quat swell = rotation_x(-k_swells * depth * 0.5f * (1 - sin_cos(k_rate * seconds).cosine));
    pose.rotation[chest] = normalize(pose.rotation[chest] * swell);
    const float turn = k_turns * depth * sin_cos(0.43f * k_rate * seconds).sine;
    pose.rotation[head] = normalize(pose.rotation[head] * rotation_y(turn));
}

void sway_pose(BodyPose& pose, const TrunkSway& sway, bool has_cane) {
    const float angle = length(sway.lean);
    if (angle > 1e-5f) {
        const Vec2 way = sway.lean / angle;
        const Vec3 axis{way.z, 0, -way.x};  // up turns towards the lean about it
        for (int j = spine; j <= right_hand; ++j) {
            if (has_cane && j >= right_upper_arm) continue;
            const float share = j == spine ? 0.4f : j == chest ? 0.7f : j == head ? 0.4f : 1.0f;
            pose.rotation[j] = normalize(rotation_about(axis, share * angle) * pose.rotation[j]);
        }
    }
    constexpr float k_ahead = 0.4f, k_elbow = 0.7f;  // of what they go outward
    const Quat body = pose.rotation[upper_chest];
    for (const Side side : {k_left, k_right}) {
        if (has_cane && side == k_right) continue;
        const int arm = upper_arm_of(side);
        const float outward = side == k_left ? sway.arms : -sway.arms;
        const Quat lifts = rotation_about(rotate(body, {0, 0, 1}), outward) *
                           rotation_about(rotate(body, {1, 0, 0}), -k_ahead * sway.arms);
        for (int j = arm; j <= arm + 2; ++j) pose.rotation[j] = normalize(lifts * pose.rotation[j]);
        const Quat bends = rotation_about(rotate(pose.rotation[arm], {1, 0, 0}), -k_elbow * sway.arms);
        for (int j = arm + 1; j <= arm + 2; ++j) pose.rotation[j] = normalize(bends * pose.rotation[j]);
    }
}

}  // namespace flaneur
