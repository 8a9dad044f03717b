#include "sim/deeds/climb.h"

#include <algorithm>

#include "sim/base/math.h"
#include "sim/base/tick.h"
#include "sim/deeds/climb_keys.h"
#include "sim/deeds/shape.h"
#include "sim/pose/arm.h"

namespace flaneur {

namespace {

ClimbSizes sizes_of(const Deeds& d, size_t i, const LowWall& wall) {
    const Body& b = d.bodies[i];
    const float k = b.height / 1.75f;
    return {k, leg_length(b), 0.115f * k, 0.5f * wall.thick, wall.height, b.joints[left_foot].y};
}

// The wall's frame, as the way goes over it.
struct Over {
    Vec3 foot;  // of its middle
    float yaw;  // of the way
    Vec3 world(Vec3 own) const { return foot + rotate(rotation_y(yaw), own); }
    Vec3 own(Vec3 world) const { return rotate(rotation_y(-yaw), world - foot); }
};
// Along the wall where `from` is.
Over over_of(const LowWall& wall, Vec2 from, bool onward) {
    const Vec2 along = heading_direction(wall.heading + 0.5f * k_pi);
    const float far = clamp(dot(from - wall.at, along), -wall.half_long, wall.half_long);
    return {at_height(wall.at + along * far, wall.floor), onward ? wall.heading : wall.heading + k_pi};
}

bool is_onward(const LowWall& wall, Vec2 from) {
    return dot(from - wall.at, heading_direction(wall.heading)) < 0;
}

float behind(const Deeds& d, size_t i, const LowWall& wall) {
    const bool steps = wall.height < k_steps_over * leg_length(d.bodies[i]);
    return 0.5f * wall.thick + d.bodies[i].heel + (steps ? 0.22f : 0.13f) * d.bodies[i].height / 1.75f;
}
float before(const Deeds& d, size_t i, const LowWall& wall) {
    return 0.5f * wall.thick + toes_ahead(d, i) + 0.1f;
}

// How one stands, by the gait's pose on this side or on the other one.
ClimbStances stances_of(const Over& over, const BodyPose& stands, Someone who, float far, bool has_crossed) {
    ClimbStances st;
    const auto places = places_of(stands, who.person, who.lane);
    const Vec3 by{0, 0, far}, here = has_crossed ? -by : Vec3{}, there = has_crossed ? Vec3{} : by;
    const Vec3 hips_own = over.own(stands.hips);
    st.hips[0] = hips_own + here, st.hips[1] = hips_own + there;
    for (const Side side : {k_left, k_right}) {
        const Vec3 ankle = over.own(places[side == k_left ? left_foot : right_foot]);
        st.ankles[0][side] = ankle + here, st.ankles[1][side] = ankle + there;
    }
    return st;
}

ClimbKeys keys_of(const Deeds& d, size_t i, const LowWall& wall, const ClimbStances& st) {
    const ClimbSizes s = sizes_of(d, i, wall);
    return s.height < k_steps_over * s.leg ? keys_to_step(s, st) : keys_to_sit(s, st);
}

// A leg to its ankle, its knee towards `pole`.
void leg_to(BodyPose& pose, Someone who, Side side, Vec3 ankle, Vec3 pole) {
    const size_t thigh = side == k_left ? left_upper_leg : right_upper_leg;
    const auto places = places_of(pose, who.person, who.lane);
    const Vec3 hip = places[thigh];
    const float a = length(places[thigh + 1] - hip), b = length(places[thigh + 2] - places[thigh + 1]);
    const Vec3 way = normalize_or(ankle - hip, {0, -1, 0});
    const float reach = clamp(length(ankle - hip), std::fabs(a - b) + 0.12f * (a + b), 0.9985f * (a + b));
    const Vec3 bow = normalize_or(pole - way * dot(pole, way), pole);
    const float ahead = (a * a - b * b + reach * reach) / (2 * reach);
    const Vec3 knee = way * ahead + bow * std::sqrt(std::max(a * a - ahead * ahead, 0.0f)), end = way * reach;
    pose.rotation[thigh] = bone_rotation(normalize_or(knee, way), bow);
    pose.rotation[thigh + 1] = bone_rotation(normalize_or(end - knee, way), bow);
}

Quat tilted(float yaw, float pitch, float tilt) {
    return normalize(rotation_y(yaw) * rotation_z(-tilt) * rotation_x(pitch));
}

struct Climbing {
    const LowWall* wall = nullptr;
    Over over;
    ClimbKeys keys;
    ClimbKey now;
};
Climbing climbing_of(const Deeds& d, size_t i, const BodyPose& stands) {
    const Doer& doer = d.doers[i];
    Climbing c;
    c.wall = &d.things.walls[deed_of(d, i).thing];
    const bool onward = doer.side.x > 0, has_crossed = doer.has != 0;
    c.over = over_of(*c.wall, deed_of(d, i).at, onward);
    c.keys = keys_of(d, i, *c.wall, stances_of(c.over, stands, someone(d, i), doer.side.z, has_crossed));
    c.now = at_time(c.keys, seconds_in(doer));
    return c;
}

// A foot that hangs, level where it comes near what is below it.
Quat hanging_foot(const Climbing& c, Vec3 ankle_own, float ankle, Quat hangs) {
    constexpr float k_near = 0.08f, k_far = 0.3f;  // metres over it
    const float over_wall =
        1 - smoothstep(k_near, k_far, std::fabs(ankle_own.z) - 0.5f * c.wall->thick - k_near);
    const float high = ankle_own.y - ankle;
    const float near_ground = 1 - smoothstep(k_near, k_far, high),
                near_top = over_wall * (1 - smoothstep(k_near, k_far, std::fabs(high - c.wall->height)));
    const Vec2 ahead = normalize_or(on_ground(rotate(hangs, {0, 0, 1})), heading_direction(c.over.yaw));
    return nlerp(hangs, rotation_y(heading_of(ahead)), std::max(near_ground, near_top));
}

// Metres that hips are too high for legs that stand.
float above_feet(const Climbing& c, const BodyPose& pose, Someone who) {
    constexpr float k_straightest = 0.995f;
    float most = 0;
    for (const Side side : {k_left, k_right}) {
        const auto n = static_cast<size_t>(side);
        const size_t thigh = side == k_left ? left_upper_leg : right_upper_leg;
        const auto places = places_of(pose, who.person, who.lane);
        const float leg =
            length(places[thigh + 1] - places[thigh]) + length(places[thigh + 2] - places[thigh + 1]);
        const Vec3 way = places[thigh] - c.over.world(get(c.now, c_foot + 3 * n));
        const float flat = length(on_ground(way)), reach = k_straightest * leg;
        const float high = std::sqrt(std::max(reach * reach - flat * flat, 0.0f));
        most = std::max(most, (way.y - high) * (1 - smoothstep(0, 0.25f, c.now[c_free + n])));
    }
    return most;
}

// A hand on its way to a place on the wall, or from there: over its edge.
void reach_over(BodyPose& pose, Someone who, Side side, const Climbing& c, const Palm& wanted, Vec3 elbow,
                float hold) {
    if (hold <= 0) return;
    // Where the wrist does not bend so far it lies as flat as it can, on its fingers.
    constexpr float k_soft = 0.012f;  // metres
    BodyPose leans = pose;
    reach_for(leans, who, side, wanted, elbow, 1);
    float deep = 0;
    for (const BodyBall& ball : arm_balls(leans, who, side))
        if (ball.of == left_hand || ball.of == right_hand)
            deep = std::max(deep, c.over.foot.y + c.wall->height - ball.at.y + ball.radius - k_soft);
    Palm palm = wanted;
    palm.place.y += std::min(deep, 0.05f);
    if (hold >= 1) return reach_for(pose, who, side, palm, elbow, 1);
    const float k = who.person.height[who.lane] / 1.75f, t = smoothstep(0, 1, hold);
    const Vec3 from = c.over.own(palm_of(pose, who, side).place), to = c.over.own(palm.place);
    const float up = std::max(std::max(from.y, to.y) + 0.1f * k, c.wall->height + 0.25f * k);
    const Vec3 by{lerp(from.x, to.x, 0.5f), up, lerp(from.z, to.z, 0.4f)};
    const Vec3 at = c.over.world(lerp(lerp(from, by, t), lerp(by, to, t), t));
    BodyPose turned = pose;
    reach_with_arm(turned, who, side, wrist_of(palm, who, side), elbow, t);
    const auto hand = static_cast<size_t>(side == k_left ? left_hand : right_hand);
    Palm now = palm_of(turned, who, side);
    now.place = at;
    JointPose wrist = wrist_of(now, who, side);
    wrist.rotation = turned.rotation[hand];
    pose = turned;
    reach_with_arm(pose, who, side, wrist, elbow, smoothstep(0, 0.35f, hold));
}

}  // namespace

Spot before_wall(const Deeds& d, size_t i, const LowWall& wall, bool onward) {
    const Over over = over_of(wall, deed_of(d, i).at, onward);
    return {on_ground(over.world({0, 0, -before(d, i, wall)})), over.yaw};
}

float climb_seconds(const Deeds& d, size_t i, const LowWall& wall) {
    const ClimbKeys keys = keys_of(d, i, wall, {});
    return keys.all[keys.count - 1][c_time];
}

DoerWish climb(Deeds& d, size_t i) {
    Doer& doer = d.doers[i];
    const LowWall& wall = d.things.walls[deed_of(d, i).thing];
    switch (doer.stage) {
        case DoerStage::go: {
            const bool onward = is_onward(wall, on_ground(doer.position));
            const Spot spot = before_wall(d, i, wall, onward);
            if (is_at(d, i, spot)) {
                next_stage_of(doer, DoerStage::act);
                const Vec2 way = heading_direction(spot.heading);
                const float from = dot(on_ground(doer.position) - wall.at, way);
                doer.side = {onward ? 1.0f : -1.0f, behind(d, i, wall) - from};
                doer.has = 0;
                return {{}, way};
            }
            return wish_to(doer, spot, d.plans[i].speed);
        }
        case DoerStage::act: {
            const float all = climb_seconds(d, i, wall),
                        yaw = doer.side.x > 0 ? wall.heading : wall.heading + k_pi;
            const Vec2 way = heading_direction(yaw);
            if (doer.has == 0 && seconds_in(doer) > 0.5f * all) {
                // The gait stands on the other side from now on; the body follows.
                const Vec3 by = at_height(way * doer.side.z, 0);
                carry_feet(d.gait, i, doer.position, 0, by);
                doer.position += by;
                doer.has = 1;
            }
            if (seconds_in(doer) < all) return {{}, way};
            doer.has = 0;
            next_deed(d, doer, i);
            return {{}, way};
        }
        default:
            return {};
    }
}

void pose_climbing(const Deeds& d, size_t i, BodyPose& pose) {
    const Doer& doer = d.doers[i];
    if (deed_of(d, i).what != Deed::What::climb || doer.stage != DoerStage::act) return;
    const Someone who = someone(d, i);
    const BodyPose stands = pose;
    const Climbing c = climbing_of(d, i, stands);
    const ClimbKey& now = c.now;
    const float seconds = seconds_in(doer), all = c.keys.all[c.keys.count - 1][c_time];
    pose.hips = c.over.world(get(now, c_hips));
    const Quat root = normalize(tilted(c.over.yaw + now[c_yaw], now[c_pitch], now[c_tilt]));
    pose.rotation.fill(root);
    pose.hips.y -= above_feet(c, pose, who);
    turn_trunk(pose, now[c_bow], 0);
    // As the gait has it, from and to its hold.
    constexpr float k_blend = 0.4f;
    const float share = smoothstep(0, k_blend, seconds) * (1 - smoothstep(all - k_blend, all, seconds));
    const Vec3 hips_at = pose.hips;
    // Arms hang straight down, however the trunk leans.
    const Quat turned =
        rotation_y(c.over.yaw + now[c_yaw] - heading_of(on_ground(rotate(stands.rotation[hips], {0, 0, 1}))));
    for (const Side side : {k_left, k_right}) {
        const size_t first = side == k_left ? left_upper_arm : right_upper_arm;
        pose.rotation[first - 1] =
            normalize(pose.rotation[upper_chest] * conjugate(stands.rotation[upper_chest]) *
                      stands.rotation[first - 1]);
        for (size_t j = first; j < first + 3; ++j) pose.rotation[j] = normalize(turned * stands.rotation[j]);
    }
    for (const Side side : {k_left, k_right}) {
        const size_t thigh = side == k_left ? left_upper_leg : right_upper_leg;
        const auto n = static_cast<size_t>(side);
        const float out = side == k_left ? 1.0f : -1.0f, splay = now[c_splay + n], is_free = now[c_free + n];
        const Vec3 pole = rotate(root, {out * (0.1f + splay), 0.6f, 1 - 0.85f * splay});
        leg_to(pose, who, side, c.over.world(get(now, c_foot + 3 * n)), normalize_or(pole, {0, 0, 1}));
        keep_hip_within(pose, side, smoothstep(0, 1, is_free));
        const Quat hanging = hanging_foot(c, get(now, c_foot + 3 * n), sizes_of(d, i, *c.wall).ankle,
                                          normalize(pose.rotation[thigh + 1] * rotation_x(0.35f)));
        pose.rotation[thigh + 2] = nlerp(stands.rotation[thigh + 2], hanging, smoothstep(0, 1, is_free));
        pose.rotation[thigh + 3] = nlerp(stands.rotation[thigh + 3], hanging, smoothstep(0, 1, is_free));
    }
    if (share < 1) {
        pose = mixed(stands, pose, share);
        pose.hips = hips_at;
        for (const Side side : {k_left, k_right}) {
            const size_t thigh = side == k_left ? left_upper_leg : right_upper_leg;
            const auto n = static_cast<size_t>(side);
            const Vec3 front = rotate(pose.rotation[thigh], {0, 0, 1});
            leg_to(pose, who, side, c.over.world(get(now, c_foot + 3 * n)), front);
            if (now[c_free + n] <= 0) {
                pose.rotation[thigh + 2] = stands.rotation[thigh + 2];
                pose.rotation[thigh + 3] = stands.rotation[thigh + 3];
            }
        }
    }
    const Vec3 ahead = c.over.world({now[c_hips], 0.35f * c.wall->height, now[c_hips + 2] + 0.9f});
    look_at(pose, who, ahead, 0.75f * share);
    auto palm_on = [&](size_t n) {
        Palm palm;
        palm.place = c.over.world(get(now, c_hand + 3 * n));
        palm.faces = {0, -1, 0};
        palm.fingers = at_height(heading_direction(c.over.yaw + now[c_point + n]), 0);
        return palm;
    };
    for (const Side side : {k_left, k_right}) {
        const auto n = static_cast<size_t>(side);
        const float holds = now[c_hold + n];
        lean_to(pose, who, side, wrist_of(palm_on(n), who, side).position, smoothstep(0, 1, holds), 0.75f);
    }
    for (const Side side : {k_left, k_right}) {
        const auto n = static_cast<size_t>(side);
        const Palm palm = palm_on(n);
        // Elbows go back and out of where the hips face, however the trunk bends.
        const float out = side == k_left ? 1.0f : -1.0f;
        Vec3 elbow = rotate(conjugate(pose.rotation[upper_chest]) * rotation_y(c.over.yaw + now[c_yaw]),
                            {0.6f * out, 0, -1});
        elbow.x *= out;
        reach_over(pose, who, side, c, palm, elbow, now[c_hold + n]);
    }
}

ClimbHolds climb_holds(const Deeds& d, size_t i) {
    ClimbHolds holds;
    const Doer& doer = d.doers[i];
    if (deed_of(d, i).what != Deed::What::climb || doer.stage != DoerStage::act) return holds;
    const Climbing c = climbing_of(d, i, body_pose_of(d.whole, i));
    for (size_t n = 0; n < 2; ++n) {
        holds.palms[n] = c.over.world(get(c.now, c_hand + 3 * n));
        holds.hands[n] = c.now[c_hold + n] >= 0.999f && c.now[c_hand + 3 * n + 1] <= c.wall->height + 0.001f;
        holds.feet[n] = c.now[c_free + n] <= 0.001f;
    }
    return holds;
}

}  // namespace flaneur
