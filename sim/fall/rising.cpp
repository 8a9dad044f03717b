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

Lie lie_of(const BodyPose& pose, const PersonBlock& person, int lane) {
    const auto places = places_of(pose, person, lane);
    const Vec3 along = places[neck] - places[hips], face = rotate(pose.rotation[hips], {0, 0, 1});
    const Vec2 way = on_ground(along);
    Lie lie;
    const bool sits = along.y > 0.8f * length(along);
    lie.heading = heading_of(sits || length(way) < 0.05f ? on_ground(face) : way);
    lie.on_back = !sits && face.y > 0.25f;
    lie.on_left = rotate(pose.rotation[hips], {1, 0, 0}).y < 0;
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
        case RiseStage::fours:
            return posed(k_on_fours, facing * degrees_x(k_fours_pitch), at);
        default:
            return posed(k_kneels, facing * degrees_x(k_kneel_pitch), at);
    }
}

void rest_on_ground(BodyPose& pose, const Segments& segments, const PersonBlock& person, int lane,
                    const Surroundings& around, float floor, bool may_sink, std::array<float, 2>& lifts,
                    float dt) {
    constexpr float k_up = 1.2f, k_down = 3, k_step = 0.05f;
    // How far each ball is above the ground, or in it.
    const auto balls = balls_of(pose, segments, person, lane);
    std::array<std::optional<GroundHit>, k_ball_count> hits;
    ground_at(around, balls, k_up, k_down, hits.data());
    std::array<float, k_ball_count> clear;
    float lowest = 1e6f, highest = -1e6f;
    for (int k = 0; k < k_ball_count; ++k) {
        const float height = hits[k] ? hits[k]->height : floor;
        const float slope = hits[k] ? hits[k]->normal.y : 1;
        lowest = std::min(lowest, height), highest = std::max(highest, height);
        clear[k] = balls[k].y - height - segments.radius[k] / std::max(slope, 0.5f);
    }
    const bool has_steps = highest - lowest > k_step;
    auto is_sole = [](int k) {
        return k_segment_of_ball[k] == left_sole || k_segment_of_ball[k] == right_sole;
    };
    float least = 1e3f;
    for (int k = 0; k < k_ball_count; ++k)
        if (!is_sole(k)) least = std::min(least, clear[k]);
    if (!may_sink) least = std::min(least, 0.0f);
    pose.hips.y -= least;
    const auto places = places_of(pose, person, lane);
    for (const Side side : {k_left, k_right}) {
        const Segment own = side == k_left ? left_sole : right_sole;
        float deep = 0;
        for (int k = 0; k < k_ball_count; ++k)
            if (k_segment_of_ball[k] == own) deep = std::max(deep, least - clear[k]);
        // Out of a step no higher than a leg folds below its hip.
        constexpr float k_folds = 0.4f, k_anyway = 0.12f;  // of the leg; metres
        const int foot = k_segments[own].joint;
        const float leg = person.joints[left_upper_leg][1][lane];
        const float room = places[foot - 2].y - places[foot].y - k_folds * leg;
        if (has_steps) deep = std::min(deep, std::max(room, k_anyway));
        float& lift = lifts[side];
        // At once out of what it is hardly in, as on level ground.
        constexpr float k_little = 0.03f;
        lift = deep < k_little ? std::max(deep, lift - k_lifting * dt)
                               : lift + clamp(deep - lift, -k_lifting * dt, k_lifting * dt);
        if (lift > 0) reach_with_leg(pose, person, lane, side, places[foot] + Vec3{0, lift, 0});
    }
}

void keep_off_walls(BodyPose& pose, const Segments& segments, const PersonBlock& person, int lane,
                    const Surroundings& around) {
    constexpr float k_near = 1.4f;
    if (!closest_wall(around, pose.hips, k_near)) return;
    for (int pass = 0; pass < 2; ++pass) {  // a corner has two
        const auto balls = balls_of(pose, segments, person, lane);
        float deepest = 0;
        Vec3 out{};
        for (int k = 0; k < k_ball_count; ++k) {
            const auto wall = closest_wall(around, balls[k], k_near);
            if (!wall) continue;
            const float deep = segments.radius[k] - dot(balls[k] - wall->point, wall->normal);
            // What is behind a wall farther than that is on its other side, by itself.
            if (deep > deepest && deep < 0.6f) deepest = deep, out = wall->normal;
        }
        pose.hips += out * deepest;
    }
}

void reach_with_leg(BodyPose& pose, const PersonBlock& person, int lane, Side side, Vec3 ankle) {
    const int thigh = side == k_left ? left_upper_leg : right_upper_leg;
    const auto places = places_of(pose, person, lane);
    const Vec3 hip = places[thigh], knee = places[thigh + 1], foot = places[thigh + 2];
    const float a = length(knee - hip), b = length(foot - knee);
    const float d = clamp(length(ankle - hip), std::fabs(a - b) + 0.01f, a + b - 0.002f);
    const Vec3 along = normalize_or(ankle - hip, {0, -1, 0});
    const Vec3 front = rotate(pose.rotation[thigh], {0, 0, 1});
    const Vec3 bow = normalize_or(front - along * dot(front, along), front);
    const float ahead = (a * a - b * b + d * d) / (2 * d);
    const Vec3 new_knee = hip + along * ahead + bow * std::sqrt(std::max(a * a - ahead * ahead, 0.0f));
    const Vec3 new_foot = hip + along * d;
    auto turn = [&](int joint, Vec3 from, Vec3 to) {
        pose.rotation[joint] =
            normalize(rotation_between(normalize_or(from, {0, -1, 0}), normalize_or(to, {0, -1, 0})) *
                      pose.rotation[joint]);
    };
    turn(thigh, knee - hip, new_knee - hip);
    turn(thigh + 1, foot - knee, new_foot - new_knee);
}

}  // namespace flaneur
