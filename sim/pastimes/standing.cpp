#include "sim/pastimes/standing.h"

#include <algorithm>

#include "sim/base/math.h"
#include "sim/fall/limbs.h"

namespace flaneur {

BodyPose leaning_back(const BodyPose& standing, const FootAt (&stands)[2], Someone who,
                      const WallBehind& wall, uint32_t foot, float share) {
    constexpr float k_straightest = 0.99f, k_leans = 0.05f;
    constexpr float k_before_wall = 0.33f, k_lift = 0.04f;  // metres: of feet, which step there
    const float u = bell(share);
    const auto& joints = who.person.joints;
    const int lane = who.lane;
    BodyPose pose = standing;
    const Vec3 out = at_height(wall.out, 0);
    const float back = who.person.girth[2][lane];
    // Upright, with the back along the wall.
    const Quat yaw = rotation_y(heading_of(wall.out));
    const Quat turn = normalize(nlerp(Quat{}, yaw * conjugate(standing.rotation[hips]), u));
    for (Quat& joint : pose.rotation) joint = normalize(turn * joint);
    const float off = dot(standing.hips - wall.at, out), along = off - (back + 0.004f);
    pose.hips = standing.hips - out * (along * u);
    lean_trunk(pose, -k_leans * u);
    // As low as legs have it.
    const float leg = joints[left_upper_leg][1][lane] - joints[left_foot][1][lane];
    const float hip_drop = joints[hips][1][lane] - joints[left_upper_leg][1][lane];
    FootAt feet[2];
    for (const Side side : {k_left, k_right}) {
        feet[side] = stands[side];
        const float nearer = std::max(dot(feet[side].ankle - wall.at, out) - k_before_wall, 0.0f);
        const float t = bell(clamp(2 * share - (side == k_left ? 0 : 0.5f), 0, 1));
        feet[side].ankle -= out * (nearer * t);
        feet[side].ankle.y += std::min(k_lift, nearer) * 4 * t * (1 - t);
    }
    for (const Side side : {k_left, k_right}) {
        if (foot == static_cast<uint32_t>(side)) continue;
        const Vec3 ankle = feet[side].ankle;
        const float away = dot(ankle - pose.hips, out);
        const float most =
            ankle.y + hip_drop +
            std::sqrt(std::max(k_straightest * k_straightest * leg * leg - away * away, 0.04f));
        pose.hips.y = lerp(pose.hips.y, std::min(pose.hips.y, most), u);
    }
    for (const Side side : {k_left, k_right}) {
        FootAt to = feet[side];
        if (foot == static_cast<uint32_t>(side)) {
            const float sole = joints[left_foot][1][lane];
            const Vec3 hip =
                places_of(pose, who.person, lane)[side == k_left ? left_upper_leg : right_upper_leg];
            FootAt set{hip, heading_of(wall.out), 1.42f};
            set.ankle.y = stands[side].ankle.y + 0.3f * leg;
            set.ankle += out * (dot(wall.at - hip, out) + sole + 0.012f);
            const float t = bell(clamp(1.5f * share - 0.5f, 0, 1));
            to.ankle = lerp(to.ankle, set.ankle, t) + out * (0.1f * t * (1 - t));
            to.yaw += wrap_angle(set.yaw - to.yaw) * t;
            to.down = lerp(to.down, set.down, t);
        }
        const Vec3 pole = lerp(knee_of(standing, who, side), out, u);
        set_leg(pose, who, side, to, normalize_or(pole, out));
    }
    return pose;
}

BodyPose leaning_out(const BodyPose& standing, const FootAt (&stands)[2], Someone who, const RailBefore& rail,
                     uint32_t posture, float share) {
    // Of a leg; metres from the edge, and that hips come nearer at most.
    constexpr float k_straightest = 0.993f, k_hips_off = 0.4f, k_hips_most = 0.08f;
    constexpr float k_leans = 0.2f, k_leans_most = 0.5f;  // radians: at least, and more as arms are long
    constexpr float k_in = 0.07f, k_lift = 0.16f;         // metres: of palms beyond the edge, on their way
    const float u = bell(share), height = who.person.height[who.lane];
    const Vec3 ahead = at_height(rail.facing, 0), left{ahead.z, 0, -ahead.x};
    BodyPose pose = standing;
    const Quat turn = normalize(
        nlerp(Quat{},
              rotation_y(heading_of(rail.facing)) *
                  conjugate(rotation_y(heading_of(on_ground(rotate(standing.rotation[hips], {0, 0, 1}))))),
              u));
    for (Quat& joint : pose.rotation) joint = normalize(turn * joint);
    const float off = dot(rail.at - standing.hips, ahead);
    pose.hips += ahead * (clamp(off - k_hips_off, 0, k_hips_most) * u);
    keep_knees_bent(pose, who, stands, k_straightest, u);
    lean_trunk(pose, k_leans * u);
    const float apart = (posture % 2 == 0 ? 0.13f : 0.05f) * height;
    Palm palms[2];
    for (const Side side : {k_left, k_right}) {
        const float out = side == k_left ? 1.0f : -1.0f;
        palms[side] = {rail.at + ahead * k_in + left * (out * apart) + Vec3{0, 4 * k_lift * u * (1 - u), 0},
                       {0, -1, 0},
                       normalize_or(ahead - left * (0.55f * out), ahead)};
        lean_to(pose, who, side, wrist_of(palms[side], who, side).position, u, k_leans_most);
    }
    for (const Side side : {k_left, k_right}) {
        reach_for(pose, who, side, palms[side], {0.6f, -0.7f, -0.4f}, u);
        set_leg(pose, who, side, stands[side], knee_of(standing, who, side));
    }
    return pose;
}

}  // namespace flaneur
