#include "tools/extract/followers.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"

namespace flaneur {

namespace {

// How fast a joint moves, m/s along the axes of the pelvis, and turns about the upright, radians/s.
struct Rate {
    Vec3 moving;
    float turning = 0;
};

struct Pelvis {
    Quat rotation, back;  // to the world, and from there
    const Trail* trail;

    Vec3 moving(size_t joint) const {
        const auto at = std::ranges::find(k_trailed, static_cast<Joint>(joint));
        if (!trail || at == k_trailed.end()) return {};
        return rotate(back, trail->moving[static_cast<size_t>(at - k_trailed.begin())]);
    }
    Rate rate(size_t joint) const {
        const auto at =
            static_cast<size_t>(std::ranges::find(k_trailed, static_cast<Joint>(joint)) - k_trailed.begin());
        return {moving(joint), trail && at < k_turning ? trail->turning[at] : 0};
    }
};

// Turned about the upright, then aside, then ahead: what hangs down goes to +x by `aside`, to +z by `ahead`.
Quat hanging(float yaw, float aside, float ahead) {
    return rotation_y(yaw) * rotation_z(aside) * rotation_x(-ahead);
}

// The larger of both, rounded where they are within `round` of each other.
float soft_max(float a, float b, float round) {
    const float near = std::max(round - std::abs(a - b), 0.0f);
    return std::max(a, b) + near * near / (4 * round);
}

// How far ahead of its hip a leg is at a height of the bind pose, seen along the pelvis; and how fast the
// thigh swings ahead.
struct LegAngle {
    float angle, rate;
};

LegAngle leg_angle(const Character& c, const JointPose* joints, size_t hip, float height,
                   const Pelvis& pelvis) {
    const float knee = c.bind_joints[hip + 1].y, ankle = c.bind_joints[hip + 2].y;
    const float below = clamp((knee - height) / (knee - ankle), 0, 1);
    const Vec3 at = lerp(joints[hip + 1].position, joints[hip + 2].position, below) - joints[hip].position;
    const Vec3 own = rotate(pelvis.back, at);
    const Vec3 thigh = rotate(pelvis.back, joints[hip + 1].position - joints[hip].position);
    const Vec3 v = pelvis.moving(hip + 1) - pelvis.moving(hips);
    return {arctan2(own.z, -own.y), (thigh.z * v.y - thigh.y * v.z) / dot(thigh, thigh)};
}

struct RobeAngles {
    float front, back, twist;
};

RobeAngles robe_angles(const Character& c, const JointPose* joints, const Pelvis& pelvis) {
    constexpr float k_falls = 0.07f;   // seconds that cloth falls back after a leg
    constexpr float k_lags = 0.07f;    // seconds that it is behind a turn
    constexpr float k_trails = 0.03f;  // radians for each m/s
    constexpr float k_flares = 0.12f;  // the same, where it falls
    constexpr float k_round = 0.12f;   // where legs pass each other
    constexpr float k_most = 0.35f;
    constexpr float k_walks = 0.5f, k_lies = 1.2f,
                    k_flat = 0.16f;  // radians of lean; that cloth sinks onto legs
    float ahead[2], behind[2];
    for (int side = 0; side < 2; ++side) {
        const size_t hip = side == k_left ? left_upper_leg : right_upper_leg;
        const LegAngle leg = leg_angle(c, joints, hip, c.robe_hem, pelvis);
        ahead[side] = leg.angle + clamp(-leg.rate * k_falls, 0, k_most);
        behind[side] = -leg.angle + clamp(leg.rate * k_falls, 0, k_most);
    }
    const Rate rate = pelvis.rate(hips);
    const float flare = clamp(-rate.moving.y * k_flares, 0, k_most);
    const float trail = clamp(rate.moving.z * k_trails, 0, k_most);
    // Without a leg to hold them they hang straight; of who lies, or is on hands and knees, the upper side
    // falls onto the legs, and the lower one is held by the ground or the thighs.
    // Round a compound, where nobody has trails, down is anywhere, and nobody lies.
    const Vec3 down = pelvis.trail ? rotate(pelvis.back, Vec3{0, -1, 0}) : Vec3{0, -1, 0};
    const float leans = arctan2(down.z, std::max(-down.y, 0.0f)) * length(Vec3{0, down.y, down.z});
    const float falls_back = std::max(-leans - k_walks, 0.0f), falls_ahead = std::max(leans - k_walks, 0.0f);
    RobeAngles robe;
    robe.front = soft_max(soft_max(ahead[0], ahead[1], k_round), -falls_back, k_round) + flare -
                 k_flat * smoothstep(k_walks, k_lies, -leans);
    robe.back = -soft_max(soft_max(behind[0], behind[1], k_round), trail - falls_ahead, k_round) - flare +
                k_flat * smoothstep(k_walks, k_lies, leans);
    robe.twist = clamp(-rate.turning * k_lags, -k_most, k_most);
    return robe;
}

Quat bag_turn(const Character& c, const Pelvis& pelvis, const JointPose* joints, Vec3& shift) {
    const Hung& hung = c.followers[carried_bag - k_joint_count];
    const Rate trunk = pelvis.rate(hips);
    const float yaw = clamp(-trunk.turning * 0.06f, -0.25f, 0.25f);
    const float bounce = clamp(-trunk.moving.y * 0.022f, -0.03f, 0.03f);
    switch (c.person.bag) {
        case Bag::none:
            break;
        case Bag::backpack:
            shift.y = 0.4f * bounce;
            return joints[hung.joint].rotation *
                   hanging(0.5f * yaw, 0, clamp(trunk.moving.y * 0.05f, -0.06f, 0.06f));
        case Bag::shoulder_bag: {
            // The thigh under it pushes it out.
            const float leg =
                leg_angle(c, joints, right_upper_leg, c.bind_joints[right_lower_leg].y, pelvis).angle;
            shift.y = bounce;
            return pelvis.rotation * hanging(yaw, clamp(-trunk.moving.x * 0.35f, -0.12f, 0.12f) - 0.04f,
                                             clamp(0.30f * leg, -0.20f, 0.08f) - 2 * std::abs(bounce));
        }
        case Bag::handbag: {
            constexpr float k_made = 0.4f;  // for a forearm that is raised so far
            const Vec3 swung = pelvis.moving(hung.joint) - trunk.moving;
            return pelvis.rotation * hanging(yaw, clamp(-swung.x * 0.15f, -0.2f, 0.2f),
                                             k_made + clamp(-swung.z * 0.22f, -0.5f, 0.5f));
        }
    }
    return joints[hung.joint].rotation;
}

// The pram in the place of a bag, its rear wheels in that of a scarf.
void push(const Character& c, float scale, const JointPose& pelvis, const PramPlace* pram,
          std::array<JointPose, k_follower_count>& out) {
    PramPlace at;
    if (pram) {
        at = *pram;
    } else {
        const Vec3 ahead = rotate(pelvis.rotation, Vec3{0, 0, 1});
        const Vec2 way = normalize_or(Vec2{ahead.x, ahead.z}, {0, 1});
        at.yaw = heading_of(way);
        at.place = pelvis.position +
                   at_height(way * ((c.body.pram.z + k_pram_behind) * scale), -c.body.joints[hips].y * scale);
    }
    const Quat turn = pram_rotation(at);
    out[carried_bag - k_joint_count] = {at.place, turn};
    out[scarf_end - k_joint_count] = {at.place + rotate(turn, Vec3{0, k_pram_rear * scale, 0}),
                                      turn * rotation_x(at.wheel)};
}

bool is_loose(Hair hair) {
    return hair == Hair::ponytail || hair == Hair::long_hair || hair == Hair::shoulder_length;
}

}  // namespace

bool has_followers(const Character& c) {
    return c.person.pram || c.person.stick || c.robe_hem > 0 || c.person.bag != Bag::none ||
           is_loose(c.person.hair) || c.person.scarf;
}

std::array<JointPose, k_follower_count> followers(const Character& c, float scale, const JointPose* joints,
                                                  const Trail* trail, const PramPlace* pram,
                                                  const JointPose* stick) {
    const Pelvis pelvis{joints[hips].rotation, conjugate(joints[hips].rotation), trail};
    Quat turns[k_follower_count];
    Vec3 shifts[k_follower_count];
    auto turn = [&](int follower) -> Quat& { return turns[follower - k_joint_count]; };

    if (c.robe_hem > 0) {
        const RobeAngles robe = robe_angles(c, joints, pelvis);
        turn(skirt_front) = pelvis.rotation * hanging(robe.twist, 0, robe.front);
        turn(skirt_back) = pelvis.rotation * hanging(robe.twist, 0, robe.back);
    }
    turn(carried_bag) = bag_turn(c, pelvis, joints, shifts[carried_bag - k_joint_count]);

    const Rate skull = pelvis.rate(head), trunk = pelvis.rate(hips);
    const float lift = clamp(-skull.moving.y * 0.35f, -0.10f, 0.45f);
    const float sway = clamp(-skull.moving.x * 0.9f - skull.turning * 0.05f, -0.35f, 0.35f);
    if (c.person.hair == Hair::ponytail) {
        turn(loose_hair) = joints[head].rotation * hanging(0, sway, -lift - 0.04f);
    } else {
        // It lies on the back, which keeps it in and holds it when the head turns.
        const Quat nape = nlerp(joints[upper_chest].rotation, joints[head].rotation, 0.4f);
        const float yaw = clamp(-skull.turning * 0.06f, -0.2f, 0.2f);
        turn(loose_hair) = nape * hanging(yaw, 0.4f * sway, -0.6f * std::max(lift, 0.0f));
    }
    turn(scarf_end) = joints[upper_chest].rotation *
                      hanging(0, clamp(-skull.moving.x * 0.7f - trunk.turning * 0.10f, -0.3f, 0.3f),
                              clamp(-skull.moving.y * 0.30f, 0, 0.4f));

    turn(walking_stick) = joints[right_hand].rotation;

    std::array<JointPose, k_follower_count> out;
    for (size_t f = 0; f < out.size(); ++f) {
        const Hung& hung = c.followers[f];
        const JointPose& joint = joints[hung.joint];
        const Vec3 arm = rotate(c.bind_to_canonical[hung.joint], hung.place - c.bind_joints[hung.joint]);
        out[f] = {
            joint.position + rotate(joint.rotation, arm * scale) + rotate(pelvis.rotation, shifts[f] * scale),
            turns[f]};
    }
    if (stick) out[walking_stick - k_joint_count] = *stick;
    if (c.person.pram) push(c, scale, joints[hips], pram, out);
    return out;
}

}  // namespace flaneur
