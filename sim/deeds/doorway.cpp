#include "sim/deeds/doorway.h"

#include <algorithm>

#include "sim/base/math.h"
#include "sim/base/tick.h"

namespace flaneur {

namespace {

constexpr float k_grown = 1.75f;
constexpr float k_half_shoulders = 0.18f, k_arm_ahead = 0.45f;  // metres, of a grown person
constexpr float k_chest = 0.16f;                                // and from the chest,
constexpr float k_foot = 0.07f;                                 // metres that a leaf keeps from feet
constexpr float k_longest = 0.975f;                             // of the arm that holds
constexpr float k_body = 0.25f;                                 // metres that a leaf keeps from its middle
constexpr float k_opens = 1.15f, k_quickens = 2.6f;             // rad/s, and a second more, of one who pulls
constexpr float k_fastest = 2.0f;                               // rad/s, of one who pushes
constexpr float k_wide = 1.6f;                                  // radians, open
constexpr float k_steps_in = 0.55f;                             // radians from which on one who pulls goes
constexpr float k_ajar = 0.5f;                                  // and from which on one who pushes goes
constexpr float k_leans = 0.25f;                                // radians that the trunk follows the hand
constexpr float k_turned = 0.22f;                               // seconds that the lever takes

Vec3 own_place(Someone who, size_t joint) {
    const auto& at = who.person.joints[joint];
    return {at[0][who.lane], at[1][who.lane], at[2][who.lane]};
}

float scale_of(const Deeds& d, size_t i) { return d.bodies[i].height / k_grown; }

// The door's own axes: along the closed leaf from the hinge, and along its heading.
struct Frame {
    Vec2 along, out, hinge;
    Vec2 own(Vec2 world) const { return {dot(world - hinge, along), dot(world - hinge, out)}; }
    Vec2 world(Vec2 own) const { return hinge + along * own.x + out * own.z; }
};
Frame frame_of(const SwingDoor& door) {
    const Vec2 out = heading_direction(door.heading), left{out.z, -out.x};
    return {door.hinge_left ? -left : left, out, door.hinge};
}

// Metres from the leaf, as a line on the ground.
float from_leaf(const SwingDoor& door, Vec2 own, float angle) {
    const SinCos turn = sin_cos(angle);
    const Vec2 leaf{turn.cosine, turn.sine};
    const float along = clamp(dot(own, leaf), 0, door.width);
    return length(own - leaf * along);
}

float arm_of(Someone who) {
    const Vec3 elbow = own_place(who, left_lower_arm);
    return length(own_place(who, left_upper_arm) - elbow) + length(elbow - own_place(who, left_hand));
}

// Metres before the shoulder at which a handle is well in hand.
float arm_ahead(const Deeds& d, size_t i) {
    constexpr float k_part = 0.9f, k_palm = 0.05f;
    const Someone who = someone(d, i);
    const float arm = arm_of(who), down = own_place(who, left_upper_arm).y - k_handle_high - 0.03f;
    return std::min(k_arm_ahead * scale_of(d, i),
                    k_part * std::sqrt(std::max(arm * arm - down * down, 0.01f)) + k_palm);
}

// The trunk turns to the handle, and bends to it a little.
void turn_to_handle(const Deeds& d, size_t i, Vec3 handle, float share, BodyPose& pose) {
    constexpr float k_part = 0.6f, k_most = 0.7f, k_bend = 0.1f, k_tall = 1.45f;
    const Doer& doer = d.doers[i];
    const float bend = k_bend + 0.7f * std::max(own_place(someone(d, i), left_upper_arm).y - k_tall, 0.0f);
    const Vec2 way = on_ground(handle) - on_ground(pose.hips);
    const float aside = wrap_angle(heading_of(way) - doer.motion.heading);
    turn_trunk(pose, share * bend, share * clamp(k_part * aside, -k_most, k_most));
}

// A palm on a lever, fingers between the way to the leaf and that of the forearm.
Palm on_lever(const BodyPose& pose, Someone who, Side side, Vec3 handle, float yaw) {
    const size_t upper = side == k_left ? left_upper_arm : right_upper_arm;
    const Vec3 shoulder = places_of(pose, who.person, who.lane)[upper];
    const Vec2 reach = normalize_or(on_ground(handle - shoulder), heading_direction(yaw));
    const Vec2 fingers = normalize_or(heading_direction(yaw) * 0.4f + reach * 0.6f, reach);
    Palm palm;
    palm.faces = {0, -1, 0};
    palm.fingers = at_height(fingers, 0);
    palm.place = handle + Vec3{0, k_lever_thick, 0};
    return palm;
}

Palm hold_of(const Deeds& d, size_t i, const BodyPose& pose, const SwingDoor& door, const LeafNow& now,
             bool pushes) {
    const float yaw = leaf_yaw(door, now.angle) + (pushes ? 0 : k_pi);
    return on_lever(pose, someone(d, i), hand_at(door, pushes), handle_of(door, now, pushes), yaw);
}

// Whether the hand reaches the handle of a leaf that stands so, before the shoulder, and how far the shoulder
// is from it aside.
struct Reached {
    bool is_within;
    float aside;
};
Reached reaches(const Deeds& d, size_t i, const BodyPose& stands, const SwingDoor& door, const LeafNow& now,
                bool pushes) {
    BodyPose pose = stands;
    const Someone who = someone(d, i);
    const Side side = hand_at(door, pushes);
    const Vec3 handle = handle_of(door, now, pushes);
    turn_to_handle(d, i, handle, 1, pose);
    const JointPose wrist = wrist_of(hold_of(d, i, pose, door, now, pushes), who, side);
    lean_to(pose, who, side, wrist.position, 1, k_leans);
    const Vec3 shoulder =
        places_of(pose, who.person, who.lane)[side == k_left ? left_upper_arm : right_upper_arm];
    const Vec2 to = on_ground(handle - shoulder);
    const bool is_before = dot(to, heading_direction(d.doers[i].motion.heading)) > 0;
    return {is_before && length(wrist.position - shoulder) < k_longest * arm_of(who), length(to)};
}

void let_go(Doer& doer, LeafNow& now, float waits) {
    doer.has = 0;
    now.waits = waits;
}

}  // namespace

Side hand_at(const SwingDoor& door, bool pushes) { return door.hinge_left == pushes ? k_left : k_right; }

Spot before_door(const Deeds& d, size_t i, const SwingDoor& door, bool pushes) {
    const Frame f = frame_of(door);
    const float k = scale_of(d, i), handle = door.width - k_handle_from_edge - k_lever,
                shoulder = k_half_shoulders * k;
    if (!pushes) return {f.world({handle + shoulder + 0.19f, 0.08f + arm_ahead(d, i)}), door.heading + k_pi};
    const float u = 0.72f, aside = handle - (u - shoulder), reach = arm_ahead(d, i);
    return {f.world({u, -0.09f - std::sqrt(std::max(reach * reach - aside * aside, 0.02f))}), door.heading};
}

DoerWish pass_door(Deeds& d, size_t i) {
    constexpr float k_near = 0.3f, k_reach = 1.7f, k_behind = 0.7f, k_gone = 1.15f;
    Doer& doer = d.doers[i];
    const Deed& deed = deed_of(d, i);
    const SwingDoor& door = d.things.doors[deed.thing];
    LeafNow& leaf = d.leaves[deed.thing];
    const bool pushes = deed.what == Deed::What::push;
    const Frame f = frame_of(door);
    const float onward = pushes ? 1.0f : -1.0f, k = scale_of(d, i);
    const Vec2 at = f.own(on_ground(doer.position));
    const float past = onward * at.z;  // metres
    const Spot spot = before_door(d, i, door, pushes);
    const float middle = 0.52f * door.width;
    auto along = [&](float speed) {
        const float aside = f.own(spot.at).x, begins = onward * f.own(spot.at).z;
        const float ahead = past + 0.4f;
        const float u = lerp(aside, middle, smoothstep(begins, pushes ? 0.2f : -0.05f, ahead));
        const Vec2 aim = f.world({u, onward * (past + 0.5f)});
        return DoerWish{normalize_or(aim - on_ground(doer.position), f.out * onward) * speed, f.out * onward};
    };
    switch (doer.stage) {
        case DoerStage::go: {
            const float off = length(spot.at - on_ground(doer.position));
            const bool is_near = off < k_near && leaf.angle <= 0 &&
                                 std::fabs(wrap_angle(spot.heading - doer.motion.heading)) < 0.4f;
            doer.arms = clamp(doer.arms + (is_near ? k_reach : -k_reach) * k_tick, 0, 1);
            if (doer.arms >= 1 && is_at(d, i, spot)) {
                doer.has = 1;
                next_stage_of(doer, DoerStage::act);
            }
            return wish_to(doer, spot, d.plans[i].speed);
        }
        case DoerStage::act: {
            // As far as the arm reaches, and then on and on.
            if (doer.since <= 1) doer.from = {};
            if (leaf.angle >= k_ajar || (leaf.angle > 0.05f && leaf.speed < 0.1f)) doer.from.x = 1;
            if (pushes ? doer.from.x == 0 && doer.has != 0
                       : doer.has != 0 && leaf.angle < k_steps_in && past < 0)
                return {{}, f.out * onward};
            if (pushes && doer.has != 0 && past > k_behind * k) let_go(doer, leaf, 0.9f);
            if (doer.has == 0 && past > 0.1f) next_stage_of(doer, DoerStage::leave);
            return along((pushes ? 0.45f : 0.75f) * k);
        }
        default:
            if (past > k_gone) next_deed(d, doer, i);
            return along(d.plans[i].speed);
    }
}

void move_leaf(Deeds& d, size_t i) {
    constexpr float k_gone = 2.4f;  // a second
    Doer& doer = d.doers[i];
    const Deed& deed = deed_of(d, i);
    const bool pushes = deed.what == Deed::What::push, at_door = pushes || deed.what == Deed::What::pull;
    if (!at_door || doer.stage != DoerStage::go) {
        if (doer.has == 0) doer.arms = std::max(doer.arms - k_gone * k_tick, 0.0f);
    }
    if (!at_door || doer.has == 0) return;
    const SwingDoor& door = d.things.doors[deed.thing];
    LeafNow& now = d.leaves[deed.thing];
    const float down = k_lever_down / k_turned;
    if (now.angle < 0.12f && now.lever < k_lever_down) {
        now.lever = std::min(now.lever + down * k_tick, k_lever_down);
        if (now.angle <= 0) return;
    } else if (now.angle > 0.2f) {
        now.lever = std::max(now.lever - 0.5f * down * k_tick, 0.0f);
    }
    const BodyPose stands = body_pose_of(d.whole, i);
    const Frame frame = frame_of(door);
    const Someone who = someone(d, i);
    const Vec2 own = frame.own(on_ground(doer.position));
    const float before = now.angle;
    auto could_be = [&](float angle) {
        LeafNow then = now;
        then.angle = angle;
        return reaches(d, i, stands, door, then, pushes);
    };
    // Of the middle of the body, of its chest and of the toes of both feet, as they were a tick ago.
    const BodyPose last = body_pose_of(d.poses, i);
    const float scale = scale_of(d, i);
    const auto places = places_of(last, who.person, who.lane);
    auto is_clear = [&](float angle) {
        bool clear = from_leaf(door, own, angle) >= k_body * scale &&
                     from_leaf(door, frame.own(on_ground(places[upper_chest])), angle) >= k_chest * scale;
        for (const Joint toes : {left_toes, right_toes}) {
            const Vec2 ahead = on_ground(rotate(last.rotation[toes], {0, 0, d.bodies[i].toe}));
            const Vec2 tip = frame.own(on_ground(places[toes]) + ahead);
            clear = clear && from_leaf(door, tip, angle) >= k_foot;
        }
        return clear;
    };
    if (pushes) {
        // Away from the body, no farther than that needs: the arm stays as long as it was, the leaf off the
        // body.
        const float arm = 0.95f * arm_ahead(d, i);
        const float most = std::min(now.speed + k_quickens * k_tick, k_fastest) * k_tick;
        float least = 0;
        const int parts = 8;
        for (int n = 0; n <= parts; ++n) {
            least = most * static_cast<float>(n) / parts;
            if (before < k_ajar) continue;  // the arm alone
            if (could_be(before + least).aside >= arm && is_clear(before + least)) break;
        }
        const float slow = std::max(now.speed - 4 * k_tick, 0.0f) * k_tick;  // it has a weight
        now.angle = std::min(before + std::max(least, slow), k_wide);
        if (before <= 0) now.angle = std::max(now.angle, 0.004f);  // the latch is free
    } else {
        const float most = std::min(now.speed + k_quickens * k_tick, k_opens);
        now.angle = std::min(before + most * k_tick, k_wide);
        if (!is_clear(now.angle)) now.angle = before;
    }
    now.speed = (now.angle - before) / k_tick;
    if (could_be(now.angle).is_within) return;
    // Out of reach: it goes on by itself, or waits.
    if (before > (pushes ? 1.1f : 0.3f)) {
        let_go(doer, now, pushes ? 1.2f : 1.5f);
    } else {
        now.angle = before, now.speed = 0;
    }
}

void pose_at_door(const Deeds& d, size_t i, BodyPose& pose) {
    const Doer& doer = d.doers[i];
    const Deed& deed = deed_of(d, i);
    const bool pushes = deed.what == Deed::What::push;
    if (doer.arms <= 0 || (!pushes && deed.what != Deed::What::pull)) return;
    const Someone who = someone(d, i);
    const SwingDoor& door = d.things.doors[deed.thing];
    const LeafNow& now = d.leaves[deed.thing];
    const Side side = hand_at(door, pushes);
    const Vec3 handle = handle_of(door, now, pushes);
    const float share = smoothstep(0, 1, doer.arms);
    turn_to_handle(d, i, handle, share, pose);
    const float looks = doer.stage == DoerStage::go ? share : share * (1 - smoothstep(0.1f, 0.6f, now.angle));
    look_at(pose, who, handle, looks);
    lean_to(pose, who, side, wrist_of(hold_of(d, i, pose, door, now, pushes), who, side).position, share,
            k_leans);
    reach_for(pose, who, side, hold_of(d, i, pose, door, now, pushes), {0.4f, -0.8f, -0.6f}, share);
}

}  // namespace flaneur
