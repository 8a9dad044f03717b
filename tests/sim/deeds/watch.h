// What is seen of people who do things, tick by tick.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "sim/base/math.h"
#include "sim/base/tick.h"
#include "sim/deeds/carry.h"
#include "sim/deeds/climb.h"
#include "sim/deeds/deeds.h"
#include "sim/deeds/doorway.h"
#include "sim/pose/joint_limits.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {

inline std::shared_ptr<const Ground> level_ground() {
    auto ground = std::make_shared<Ground>();
    add_floor(*ground, {-20, -20}, {20, 20}, 0, Surface::plaza);
    index_ground(*ground);
    return ground;
}

// The worst of something, and of whom and when.
struct DeedWorst {
    float value = -1e9f;
    uint32_t tick = 0;
    std::string what;
    void see(float v, uint32_t at, std::string_view of = "") {
        if (v > value) value = v, tick = at, what = of;
    }
};

// Degrees by which a joint is beyond its range; less than 0: within.
inline float beyond_range(const Quat& turn, const JointLimits& limits, float outward, bool stands,
                          bool points, bool is_hinge) {
    Vec3 along = rotate(turn, stands ? Vec3{0, 1, 0} : points ? Vec3{0, 0, 1} : Vec3{0, -1, 0});
    if (is_hinge) {
        const float bend = arccos(-along.y) / k_radians * (along.z < 0 ? -1.0f : 1.0f);
        return std::max(limits.bend.low - bend, bend - limits.bend.high);
    }
    float bend, twist;
    if (stands)
        bend = arctan2(along.z, along.y);
    else if (points)
        bend = arctan2(along.y, along.z);
    else
        bend = arctan2(along.z, -along.y);
    twist = wrap_angle(2 * (points ? arctan2(turn.z, turn.w) : arctan2(turn.y, turn.w)));
    const float side = outward * (0.5f * k_pi - arccos(clamp(along.x, -1, 1)));
    auto off = [](float angle, DegreeSpan span) {
        return std::max(span.low - angle / k_radians, angle / k_radians - span.high);
    };
    return std::max({off(bend, limits.bend), off(side, limits.side), off(twist, limits.twist)});
}

struct DeedWatch {
    DeedWorst fastest;    // rad/s of a joint against its parent
    DeedWorst fast_hand;  // m/s of a hand against the shoulder
    DeedWorst beyond;     // degrees
    DeedWorst slides;     // metres a tick, of a foot that stands
    DeedWorst palms;      // metres that a palm is off what it holds
    DeedWorst into;       // metres that something is in something
    DeedWorst crossed;    // the same of arms and legs
    std::vector<PoseBlock> before;
    ClimbHolds held;
    Vec3 stood[2];
    bool did_stand[2] = {};
    bool could_compare = false;
};

inline Quat against_parent(const std::vector<PoseBlock>& poses, size_t i, size_t joint) {
    const auto parent = static_cast<Joint>(k_joint_parents[joint]);
    return conjugate(joint_pose(poses, i, parent).rotation) *
           joint_pose(poses, i, static_cast<Joint>(joint)).rotation;
}
inline float turn_between(Quat a, Quat b) {
    const Quat d = conjugate(a) * b;
    return 2 * std::asin(std::fmin(1.0f, std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z)));
}

inline void see_joints(const Deeds& d, size_t i, uint32_t tick, DeedWatch& w) {
    using namespace joint_limits;
    for (size_t j = 1; j < k_joint_count; ++j) {
        const Quat now = against_parent(d.poses, i, j);
        if (tick > 0)
            w.fastest.see(turn_between(against_parent(d.previous_poses, i, j), now) / k_tick, tick,
                          k_joint_names[j]);
        const bool left =
            j >= left_shoulder && (j < right_shoulder || (j >= left_upper_leg && j < right_upper_leg));
        const float outward = left ? 1.0f : -1.0f;
        float off = -1;
        switch (j) {
            case spine:
            case chest:
            case upper_chest:
                off = beyond_range(now, k_trunk, 1, true, false, false);
                break;
            case neck:
            case head:
                off = beyond_range(now, k_neck, 1, true, false, false);
                break;
            case left_upper_arm:
            case right_upper_arm:
                off = beyond_range(now, k_shoulder, outward, false, false, false);
                break;
            case left_lower_arm:
            case right_lower_arm:
                off = beyond_range(now, k_elbow, outward, false, false, true);
                break;
            case left_hand:
            case right_hand:
                off = beyond_range(now, k_wrist, outward, false, false, false);
                break;
            case left_upper_leg:
            case right_upper_leg:
                off = beyond_range(now, k_hip, outward, false, false, false);
                break;
            case left_lower_leg:
            case right_lower_leg:
                off = beyond_range(now, k_knee, outward, false, false, true);
                break;
            case left_foot:
            case right_foot:
                off = beyond_range(now, k_ankle, outward, false, true, false);
                break;
            default:
                break;
        }
        w.beyond.see(off, tick, k_joint_names[j]);
    }
}

inline Vec3 joint_at(const Deeds& d, size_t i, Joint j) { return joint_pose(d.poses, i, j).position; }

// Metres from a place to a box, less than 0 in it.
inline float from_box(Vec3 own, Vec3 half) {
    const Vec3 q{std::fabs(own.x) - half.x, std::fabs(own.y) - half.y, std::fabs(own.z) - half.z};
    const Vec3 out{std::max(q.x, 0.0f), std::max(q.y, 0.0f), std::max(q.z, 0.0f)};
    return length(out) + std::min(std::max({q.x, q.y, q.z}), 0.0f);
}

// Calls each(place, radius, name) along legs, shoes, trunk and head, as thick as people are.
template <class Each>
void for_each_part(const Deeds& d, size_t i, const Each& each) {
    const Body& body = d.bodies[i];
    const float k = body.height / 1.75f, sole = 0.033f * k;
    for (const Joint upper : {left_upper_leg, right_upper_leg}) {
        const Vec3 hip = joint_at(d, i, upper), knee = joint_at(d, i, static_cast<Joint>(upper + 1));
        const JointPose foot = joint_pose(d.poses, i, static_cast<Joint>(upper + 2)),
                        toes = joint_pose(d.poses, i, static_cast<Joint>(upper + 3));
        const float high = body.joints[left_foot].y, low = body.joints[left_toes].y;
        const Vec3 heel = foot.position + rotate(foot.rotation, {0, sole - high, sole - body.heel}),
                   ball = toes.position + rotate(toes.rotation, {0, sole - low, 0}),
                   tip = toes.position + rotate(toes.rotation, {0, sole - low, body.toe - sole});
        for (int n = 0; n <= 8; ++n) {
            const float t = static_cast<float>(n) / 8;
            each(lerp(hip, knee, 0.12f + 0.88f * t), (0.072f - 0.02f * t) * k, "thigh");
            each(lerp(knee, foot.position, t), (0.05f - 0.015f * t) * k, "shank");
            each(lerp(heel, ball, t), sole, "shoe");
            each(lerp(ball, tip, t), sole, "shoe");
        }
    }
    const Joint up[] = {hips, spine, chest, upper_chest};
    for (int n = 0; n < 3; ++n)
        for (int m = 0; m < 4; ++m)
            each(lerp(joint_at(d, i, up[n]), joint_at(d, i, up[n + 1]), 0.25f * static_cast<float>(m)),
                 0.095f * k, "trunk");
    const JointPose top = joint_pose(d.poses, i, head);
    each(top.position + rotate(top.rotation, {0, 0.1f * k, 0.01f * k}), 0.09f * k, "head");
}

// The same along an arm and its hand.
template <class Each>
void for_each_part_of_arm(const Deeds& d, size_t i, Side side, const Each& each) {
    const float k = d.bodies[i].height / 1.75f;
    const Joint upper = side == k_left ? left_upper_arm : right_upper_arm;
    const Vec3 shoulder = joint_at(d, i, upper), elbow = joint_at(d, i, static_cast<Joint>(upper + 1));
    const JointPose wrist = joint_pose(d.poses, i, static_cast<Joint>(upper + 2));
    for (int n = 1; n <= 6; ++n) {
        const float t = static_cast<float>(n) / 6;
        each(lerp(shoulder, elbow, t), 0.042f * k, "upper arm");
        each(lerp(elbow, wrist.position, 0.9f * t), 0.033f * k, "forearm");
    }
    for (int n = 1; n <= 4; ++n)
        each(wrist.position + rotate(wrist.rotation, {0, -0.045f * k * static_cast<float>(n), 0}), 0.012f * k,
             "hand");
}

// How deep arms are in legs.
inline void see_arms_in_legs(const Deeds& d, size_t i, uint32_t tick, DeedWorst& worst) {
    for (const Side side : {k_left, k_right})
        for_each_part_of_arm(d, i, side, [&](Vec3 a, float thick, std::string_view arm) {
            if (arm == "upper arm") return;
            for_each_part(d, i, [&](Vec3 b, float radius, std::string_view leg) {
                if (leg == "trunk" || leg == "head") return;
                worst.see(thick + radius - length(a - b), tick, std::string(arm) + " in " + std::string(leg));
            });
        });
}

// A foot that stands does not move: as the gait has it, but over a wall.
inline void see_feet(const Deeds& d, size_t i, uint32_t tick, DeedWatch& w) {
    const Doer& doer = d.doers[i];
    const bool climbs = deed_of(d, i).what == Deed::What::climb && doer.stage == DoerStage::act;
    const ClimbHolds holds = climb_holds(d, i);
    for (const Side side : {k_left, k_right}) {
        const Joint foot = side == k_left ? left_foot : right_foot;
        const Vec3 at = joint_at(d, i, foot);
        const bool stands = climbs && holds.feet[side];
        if (stands && w.did_stand[side]) w.slides.see(length(at - w.stood[side]), tick, "over a wall");
        w.did_stand[side] = stands, w.stood[side] = at;
        if (!climbs) w.slides.see(length(at - joint_pose(d.whole, i, foot).position), tick, "by the gait");
    }
}

inline void see_palms(const Deeds& d, size_t i, uint32_t tick, DeedWatch& w) {
    const Doer& doer = d.doers[i];
    const Deed& deed = deed_of(d, i);
    const BodyPose pose = body_pose_of(d.poses, i);
    if (doer.parcel != k_no_parcel && doer.has != 0) {
        const Parcel& p = d.things.parcels[doer.parcel];
        const ParcelNow& now = d.parcels[doer.parcel];
        for (const Side side : {k_left, k_right}) {
            const Palm palm = palm_of(pose, someone(d, i), side);
            const Vec3 own = rotate(conjugate(now.turn), palm.place - now.place);
            const float out = side == k_left ? 1.0f : -1.0f;
            const float aside = std::max({std::fabs(own.y) - p.half.y, std::fabs(own.z) - p.half.z, 0.0f});
            w.palms.see(std::max(std::fabs(own.x - out * p.half.x), aside), tick, "on a box");
        }
        for_each_part(d, i, [&](Vec3 at, float radius, std::string_view name) {
            w.into.see(radius - from_box(rotate(conjugate(now.turn), at - now.place), p.half), tick, name);
        });
        for (const Shelf& shelf : d.things.shelves) {
            if (shelf.top < 0.1f) continue;
            const Vec2 ahead = heading_direction(shelf.heading), left{ahead.z, -ahead.x};
            for (int corner = 0; corner < 8; ++corner) {
                const Vec3 at = now.place + rotate(now.turn, {(corner & 1 ? 1.0f : -1.0f) * p.half.x,
                                                              (corner & 2 ? 1.0f : -1.0f) * p.half.y,
                                                              (corner & 4 ? 1.0f : -1.0f) * p.half.z});
                const Vec2 off = on_ground(at) - shelf.at;
                const float deep = dot(off, ahead), side = std::fabs(dot(off, left));
                if (deep < 0 || deep > 0.6f || side > 0.45f) continue;
                w.into.see(std::min(shelf.top - at.y, std::min(deep, 0.45f - side)), tick, "a table");
            }
        }
    }
    if ((deed.what == Deed::What::push || deed.what == Deed::What::pull)) {
        const SwingDoor& door = d.things.doors[deed.thing];
        const LeafNow& leaf = d.leaves[deed.thing];
        const bool pushes = deed.what == Deed::What::push;
        const Side side = hand_at(door, pushes);
        const LeafHold hold = hold_of(doer);
        const Palm palm = palm_of(pose, someone(d, i), side);
        if (doer.has != 0 && hold.share <= 0) {
            // The lever is somewhere below the hand, from the palm to the fingers.
            const Vec3 off = handle_of(door, leaf, pushes) - palm.faces * k_lever_thick - palm.place;
            const float along = clamp(dot(off, palm.fingers), 0, 0.055f * d.bodies[i].height / 1.75f);
            w.palms.see(length(off - palm.fingers * along), tick, "on a handle");
        }
        if (doer.has != 0 && hold.share >= 1) {
            const Vec3 at =
                on_leaf(door, leaf.angle, {hold.far, palm.place.y - door.floor, -0.5f * door.thick});
            w.palms.see(length(palm.place - at), tick, "on a leaf");
        }
        const Quat turn = rotation_y(leaf_yaw(door, leaf.angle));
        const Vec3 middle = on_leaf(door, leaf.angle, {0.5f * door.width, 0.5f * door.height, 0});
        const Vec3 half{0.5f * door.width, 0.5f * door.height, 0.5f * door.thick};
        // The wall beside it is 0.3 m thick, and ends 15 mm from the leaf.
        auto see_door = [&](Vec3 at, float radius, std::string_view name) {
            w.into.see(radius - from_box(rotate(conjugate(turn), at - middle), half), tick,
                       std::string(name) + ", a leaf");
            const Quat shut = rotation_y(leaf_yaw(door, 0));
            for (const float end : {-0.015f - 0.5f, door.width + 0.015f + 0.5f}) {
                const Vec3 own = rotate(conjugate(shut), at - on_leaf(door, 0, {end, 1, 0}));
                w.into.see(radius - from_box(own, {0.5f, 1, 0.15f}), tick, std::string(name) + ", a jamb");
            }
        };
        for_each_part(d, i, see_door);
        for (const Side arm : {k_left, k_right}) for_each_part_of_arm(d, i, arm, see_door);
    }
    if (deed.what == Deed::What::climb && doer.stage == DoerStage::act) {
        const LowWall& wall = d.things.walls[deed.thing];
        const ClimbHolds holds = climb_holds(d, i);
        for (const Side side : {k_left, k_right})
            if (holds.hands[side])
                w.palms.see(length(palm_of(pose, someone(d, i), side).place - holds.palms[side]), tick,
                            "on a wall");
        const Quat turn = rotation_y(wall.heading);
        const Vec3 middle = at_height(wall.at, wall.floor + 0.5f * wall.height);
        const Vec3 half{wall.half_long, 0.5f * wall.height, 0.5f * wall.thick};
        auto see_wall = [&](Vec3 at, float radius, std::string_view name) {
            w.into.see(radius - from_box(rotate(conjugate(turn), at - middle), half), tick,
                       std::string(name) + ", a wall");
        };
        for_each_part(d, i, see_wall);
        for (const Side arm : {k_left, k_right}) for_each_part_of_arm(d, i, arm, see_wall);
        see_arms_in_legs(d, i, tick, w.crossed);
    }
}

inline void see(const Deeds& d, size_t i, uint32_t tick, DeedWatch& w) {
    see_joints(d, i, tick, w);
    see_feet(d, i, tick, w);
    see_palms(d, i, tick, w);
}

}  // namespace flaneur
