#include "sim/deeds/doorway.h"

#include <algorithm>

#include "sim/base/math.h"
#include "sim/base/planar.h"
#include "sim/base/tick.h"
#include "sim/deeds/shape.h"
#include "sim/gait/footing.h"

namespace flaneur {

namespace {

constexpr float k_grown = 1.75f;
constexpr float k_half_shoulders = 0.18f, k_arm_ahead = 0.45f;  // metres, of a grown person
constexpr float k_longest = 0.975f;                             // of the arm that holds
constexpr float k_clear = 0.02f;                                // metres that a leaf keeps from bodies
constexpr float k_opens = 1.6f, k_quickens = 4;                 // rad/s, and a second more, of one who pulls
constexpr float k_fastest = 2.2f, k_pushes = 6;                 // the same of one who pushes
constexpr float k_wide = 1.6f, k_open = 1.45f;                  // radians: at most, and for who goes through
constexpr float k_ajar = 0.3f;                                  // radians to which one pushes as one stands
constexpr float k_steps_in = 0.8f;                              // radians from which on one who pulls goes
constexpr float k_leans = 0.25f;                                // radians that the trunk follows the hand
constexpr float k_turned = 0.22f;                               // seconds that the lever takes
constexpr float k_to_face = 0.5f;                               // seconds from lever to face

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

// The least angle of a leaf with such a ball, in the door's axes, behind it: on the side to which it closes.
float angle_behind(const SwingDoor& door, Vec2 own, float radius) {
    const float off = radius + 0.5f * door.thick, far = length(own);
    if (far < 0.01f || far * far >= door.width * door.width + off * off) return -k_pi;
    return arctan2(own.z, own.x) + 0.5f * k_pi - arccos(std::min(off / far, 1.0f));
}

constexpr Side k_no_side = static_cast<Side>(2);

// Calls each(place in the door's axes, radius) for all of one's body that is to keep off the leaf, not for
// the arm that holds it.
template <class Each>
void for_each_ball(const Deeds& d, size_t i, const Frame& f, Side holds, const Each& each) {
    const BodyPose last = body_pose_of(d.poses, i);
    const Someone who = someone(d, i);
    const Vec2 by = d.doers[i].motion.velocity * k_tick;
    auto see = [&](const BodyBall& ball) { each(f.own(on_ground(ball.at) + by), ball.radius); };
    for (const Side side : {k_left, k_right}) {
        for (const BodyBall& ball : leg_balls(last, who, side)) see(ball);
        if (side == holds) continue;
        for (const BodyBall& ball : arm_balls(last, who, side)) see(ball);
    }
    for (const BodyBall& ball : trunk_balls(last, who)) see(ball);
}

// The angle that lets a body by which is on the side to which the leaf closes, the foot in the air where it
// will land, by then.
float angle_to_pass(const Deeds& d, size_t i, const SwingDoor& door, float now, Side holds) {
    const Frame f = frame_of(door);
    float least = 0;
    for_each_ball(d, i, f, holds, [&](Vec2 own, float radius) {
        least = std::max(least, angle_behind(door, own, radius + k_clear));
    });
    const GaitBlock& g = d.gait.blocks[i / k_block];
    const Someone who = someone(d, i);
    const FootSize size = foot_size(who.person, who.lane);
    const float thick = 0.033f * scale_of(d, i);
    for (const FootBlock& foot : g.feet) {
        if (foot.swinging[who.lane] == 0) continue;
        const FootPlace to = get_place(foot.to, who.lane);
        const float left = (1 - foot.phase[who.lane]) / std::max(foot.rate[who.lane], 0.2f);
        for (const float along : {thick - size.heel, size.ball, size.tip - thick}) {
            const Vec2 at = on_ground(to.position) + heading_direction(to.yaw) * along;
            const float then = angle_behind(door, f.own(at), thick + k_clear);
            least = std::max(least, std::min(then, now + (then - now) * k_tick / std::max(left, k_tick)));
        }
    }
    return std::min(least, k_wide);
}

// Whether a leaf that comes towards a body is clear of it.
bool is_clear(const Deeds& d, size_t i, const SwingDoor& door, float angle, Side holds) {
    const Frame f = frame_of(door);
    const SinCos turn = sin_cos(angle);
    const Vec2 leaf{turn.cosine, turn.sine};
    bool clear = true;
    for_each_ball(d, i, f, holds, [&](Vec2 own, float radius) {
        const float along = clamp(dot(own, leaf), 0, door.width);
        clear = clear && length(own - leaf * along) >= radius + 0.5f * door.thick + k_clear;
    });
    return clear;
}

void set_hold(Doer& doer, LeafHold to) { doer.from = {0, to.share, to.far}; }

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

// The trunk turns to what the hand holds, and bends to it a little.
void turn_to_hold(const Deeds& d, size_t i, Vec3 place, float share, BodyPose& pose) {
    constexpr float k_part = 0.6f, k_most = 0.7f, k_bend = 0.1f, k_tall = 1.45f;
    const Doer& doer = d.doers[i];
    const float on_lever = 1 - smoothstep(0, 1, hold_of(doer).share);
    const float bend = k_bend + 0.7f * std::max(own_place(someone(d, i), left_upper_arm).y - k_tall, 0.0f);
    const Vec2 way = on_ground(place) - on_ground(pose.hips);
    const float aside = wrap_angle(heading_of(way) - doer.motion.heading);
    const float turned = clamp(k_part * aside, -k_most, k_most);
    turn_trunk(pose, share * bend * on_lever, share * turned * lerp(0.4f, 1, on_lever));
}

// A palm on a lever, which lies below the fingers: they point between the way to the leaf and that of the
// forearm, and down.
Palm on_lever(const BodyPose& pose, Someone who, Side side, Vec3 handle, float yaw) {
    constexpr float k_down = 0.4f, k_below_fingers = 0.045f;  // radians; metres from the palm's middle
    const size_t upper = side == k_left ? left_upper_arm : right_upper_arm;
    const Vec3 shoulder = places_of(pose, who.person, who.lane)[upper];
    const Vec2 reach = normalize_or(on_ground(handle - shoulder), heading_direction(yaw));
    const Vec3 ahead = at_height(normalize_or(heading_direction(yaw) * 0.4f + reach * 0.6f, reach), 0);
    const SinCos down = sin_cos(k_down);
    Palm palm;
    palm.fingers = ahead * down.cosine + Vec3{0, -down.sine, 0};
    palm.faces = ahead * -down.sine + Vec3{0, -down.cosine, 0};
    const float k = who.person.height[who.lane] / k_grown;
    palm.place = handle - palm.faces * k_lever_thick - palm.fingers * (k_below_fingers * k);
    return palm;
}

// A palm on the face of a leaf that it pushes, `far` from the hinge, fingers up.
Palm on_face(Someone who, const SwingDoor& door, const LeafNow& now, float far) {
    constexpr float k_below = 0.16f;  // metres below the shoulder, of a grown person
    const float k = who.person.height[who.lane] / k_grown;
    const Vec3 out = at_height(heading_direction(leaf_yaw(door, now.angle)), 0);
    const Vec3 along = normalize_or(on_leaf(door, now.angle, {1, 0, 0}) - on_leaf(door, now.angle, {}), out);
    Palm palm;
    palm.place =
        on_leaf(door, now.angle, {far, own_place(who, left_upper_arm).y - k_below * k, -0.5f * door.thick});
    palm.faces = out;
    palm.fingers = normalize_or(along * 0.35f + Vec3{0, 1, 0}, out);
    return palm;
}

// Where the hand is: on the lever, on its way to the face, there.
Palm hold_of(const Deeds& d, size_t i, const BodyPose& pose, const SwingDoor& door, const LeafNow& now,
             bool pushes) {
    const Someone who = someone(d, i);
    const LeafHold at = hold_of(d.doers[i]);
    const float yaw = leaf_yaw(door, now.angle) + (pushes ? 0 : k_pi);
    const Palm lever = on_lever(pose, who, hand_at(door, pushes), handle_of(door, now, pushes), yaw);
    // Who has let go takes it off the leaf first.
    const Vec3 off = at_height(heading_direction(leaf_yaw(door, now.angle)), 0) * (pushes ? -1.0f : 1.0f);
    auto off_leaf = [&](Palm palm) {
        constexpr float k_off = 0.35f;  // metres
        const Doer& doer = d.doers[i];
        if (doer.stage == DoerStage::go || doer.has != 0) return palm;
        const float gone = 1 - doer.arms * doer.arms * doer.arms;
        if (pushes) {
            palm.place += off * (k_off * gone);
            return palm;
        }
        const auto places = places_of(pose, who.person, who.lane);
        const Side side = hand_at(door, false);
        const Vec3 shoulder = places[side == k_left ? left_upper_arm : right_upper_arm];
        const Vec3 own = rotate(pose.rotation[hips], {side == k_left ? -0.05f : 0.05f, -0.28f, 0.05f});
        palm.place =
            lerp(palm.place, shoulder + own * scale_of(d, i), gone) + off * (k_off * gone * (1 - gone));
        return palm;
    };
    if (at.share <= 0) return off_leaf(lever);
    const Palm face = on_face(who, door, now, at.far);
    const float t = smoothstep(0, 1, at.share);
    // On a cubic curve, off the leaf.
    const Vec3 from = lever.place + off * 0.17f, to = face.place + off * 0.17f;
    const float u = 1 - t;
    Palm palm;
    palm.place =
        lever.place * (u * u * u) + from * (3 * u * u * t) + to * (3 * u * t * t) + face.place * (t * t * t);
    palm.fingers = normalize_or(lerp(lever.fingers, face.fingers, t), face.fingers);
    const Vec3 faces = lerp(lever.faces, face.faces, t);
    palm.faces = normalize_or(faces - palm.fingers * dot(faces, palm.fingers), face.faces);
    return off_leaf(palm);
}

// Whether the hand reaches what it holds of a leaf that stands so, before the shoulder, and how far the
// shoulder is from it aside.
struct Reached {
    bool is_within, is_before;
    float aside;
    Vec3 shoulder;
};
Reached reaches(const Deeds& d, size_t i, const BodyPose& stands, const SwingDoor& door, const LeafNow& now,
                bool pushes) {
    BodyPose pose = stands;
    const Someone who = someone(d, i);
    const Side side = hand_at(door, pushes);
    turn_to_hold(d, i, hold_of(d, i, pose, door, now, pushes).place, 1, pose);
    const Palm palm = hold_of(d, i, pose, door, now, pushes);
    const JointPose wrist = wrist_of(palm, who, side);
    lean_to(pose, who, side, wrist.position, 1, k_leans);
    const Vec3 shoulder =
        places_of(pose, who.person, who.lane)[side == k_left ? left_upper_arm : right_upper_arm];
    const Vec2 to = on_ground(palm.place - shoulder);
    return {length(wrist.position - shoulder) < k_longest * arm_of(who),
            dot(to, heading_direction(d.doers[i].motion.heading)) > 0.12f * scale_of(d, i), length(to),
            shoulder};
}

// Lets go of the lever for the face, where an arm that is not stretched comes to.
void leave_lever(Doer& doer, Someone who, const SwingDoor& door, const LeafNow& now, Vec3 shoulder) {
    constexpr float k_stretched = 0.8f, k_down = 0.16f, k_edge = 0.1f, k_hinge = 0.25f;
    const Vec2 own = frame_of(door).own(on_ground(shoulder));
    const SinCos turn = sin_cos(now.angle);
    const float along = own.x * turn.cosine + own.z * turn.sine,
                off = own.x * turn.sine - own.z * turn.cosine;
    const float arm = k_stretched * arm_of(who);
    const float far = std::sqrt(std::max(arm * arm - k_down * k_down - off * off, 0.0f));
    set_hold(doer, {1e-3f, clamp(along + far, k_hinge, door.width - k_edge)});
}

void let_go(Doer& doer, LeafNow& now, float waits) {
    doer.has = 0;
    now.waits = waits;
}

}  // namespace

LeafHold hold_of(const Doer& doer) {
    return doer.stage == DoerStage::go ? LeafHold{0, 0} : LeafHold{doer.from.y, doer.from.z};
}

Side hand_at(const SwingDoor& door, bool pushes) { return door.hinge_left == pushes ? k_left : k_right; }

Spot before_door(const Deeds& d, size_t i, const SwingDoor& door, bool pushes) {
    const Frame f = frame_of(door);
    const float k = scale_of(d, i), handle = door.width - k_handle_from_edge - k_lever,
                shoulder = k_half_shoulders * k;
    if (!pushes)
        return {f.world({std::max(handle + shoulder + 0.12f,
                                  door.width + std::max(0.19f * k, 0.17f) + 0.6f * std::max(k - 1.03f, 0.0f)),
                         0.1f + arm_ahead(d, i)}),
                door.heading + k_pi};
    const float u = 0.72f, aside = handle - (u - shoulder), reach = arm_ahead(d, i);
    return {f.world({u, -0.12f - std::sqrt(std::max(reach * reach - aside * aside, 0.02f))}), door.heading};
}

namespace {

// The way through, of who pulls: aside first, off the jamb, and then in.
Vec2 way_in(const Deeds& d, size_t i, const SwingDoor& door, Vec2 own) {
    constexpr float k_half = 0.33f, k_ahead = 0.3f;
    const float k = scale_of(d, i), aside = door.width - k_half * k;
    const Frame f = frame_of(door);
    const Vec2 way[] = {
        f.own(before_door(d, i, door, false).at), {aside, 0.62f * k}, {0.56f * door.width, 0}};
    float left = k_ahead;
    // From the nearest place of it on.
    size_t nearest = 0;
    float share = 0, least = 1e9f;
    for (size_t n = 0; n < 2; ++n) {
        const float at = closest_on(way[n], way[n + 1], own);
        const float off = length(lerp(way[n], way[n + 1], at) - own);
        if (off <= least) least = off, nearest = n, share = at;
    }
    Vec2 aim = lerp(way[nearest], way[nearest + 1], share);
    for (size_t n = nearest; n < 2; ++n) {
        const float rest = length(way[n + 1] - aim);
        if (left <= rest) return aim + (way[n + 1] - aim) * (left / std::max(rest, 1e-3f));
        left -= rest, aim = way[n + 1];
    }
    return aim + Vec2{0, -left};
}

}  // namespace

DoerWish pass_door(Deeds& d, size_t i) {
    constexpr float k_near = 0.4f, k_reach = 1.9f, k_gone = 1.15f, k_back = 0.24f, k_before = 0.4f;
    constexpr float k_at = 0.09f, k_slow = 0.25f, k_turned_to = 0.2f;  // metres, m/s, radians: it is there
    Doer& doer = d.doers[i];
    const Deed& deed = deed_of(d, i);
    const SwingDoor& door = d.things.doors[deed.thing];
    const LeafNow& leaf = d.leaves[deed.thing];
    const bool pushes = deed.what == Deed::What::push;
    const Frame f = frame_of(door);
    const float onward = pushes ? 1.0f : -1.0f, k = scale_of(d, i);
    const Vec2 at = f.own(on_ground(doer.position));
    const float past = onward * at.z;  // metres
    const Spot spot = before_door(d, i, door, pushes);
    auto along = [&](float speed) {
        const float aside = f.own(spot.at).x, begins = onward * f.own(spot.at).z, middle = 0.56f * door.width;
        Vec2 aim{lerp(aside, middle, smoothstep(begins, 0.1f, past + 0.35f)), onward * (past + 0.5f)};
        if (!pushes && past < 0) aim = way_in(d, i, door, at);
        return DoerWish{normalize_or(f.world(aim) - on_ground(doer.position), f.out * onward) * speed,
                        f.out * onward};
    };
    switch (doer.stage) {
        case DoerStage::go: {
            const float off = length(spot.at - on_ground(doer.position));
            const float turned = std::fabs(wrap_angle(spot.heading - doer.motion.heading));
            const bool is_near = off < k_near && leaf.angle <= 0 && turned < 0.4f;
            doer.arms = clamp(doer.arms + (is_near ? k_reach : -k_reach) * k_tick, 0, 1);
            const bool is_there = off < k_at && length(doer.motion.velocity) < k_slow && turned < k_turned_to;
            if (doer.arms >= 1 && is_there) {
                const LeafNow& now = d.leaves[deed.thing];
                if (!reaches(d, i, body_pose_of(d.whole, i), door, now, pushes).is_within)
                    return wish_to(doer, spot, d.plans[i].speed);
                doer.has = 1;
                doer.from = {};
                next_stage_of(doer, DoerStage::act);
            }
            return wish_to(doer, spot, d.plans[i].speed);
        }
        case DoerStage::act: {
            if (doer.has == 0 && past > 0.1f) next_stage_of(doer, DoerStage::leave);
            if (pushes ? leaf.angle < 0.1f : leaf.angle < k_steps_in && past < -k_before) {
                // Back, if the leaf comes against one; and again, if it has not come far enough.
                const bool stands = leaf.angle > 0.05f && leaf.speed <= 0;
                if (stands && doer.has == 0) next_stage_of(doer, DoerStage::go);
                return {f.out * (stands && !pushes ? k_back : 0), f.out * onward};
            }
            return along((pushes ? 0.75f : 0.62f) * k);
        }
        default:
            if (past > k_gone && doer.arms <= 0) next_deed(d, doer, i);
            return along(d.plans[i].speed);
    }
}

void move_leaf(Deeds& d, size_t i) {
    constexpr float k_gone = 3;  // a second
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
    const Frame f = frame_of(door);
    const Side side = hand_at(door, pushes);
    const LeafHold hold = hold_of(doer);
    const float before = now.angle;
    auto with = [&](float angle) {
        LeafNow then = now;
        then.angle = angle;
        return reaches(d, i, stands, door, then, pushes);
    };
    if (!pushes) {
        // Towards the body, until the arm would have to go through it; then it swings on.
        constexpr float k_by = 0.16f;  // metres that the shoulder is before the leaf, at least
        const float speed = std::min(now.speed + k_quickens * k_tick, k_opens);
        now.angle = before + speed * k_tick;
        if (!is_clear(d, i, door, now.angle, side)) now.angle = before;
        now.speed = (now.angle - before) / k_tick;
        const Reached then = with(now.angle);
        const Vec2 shoulder = f.own(on_ground(then.shoulder));
        const SinCos turn = sin_cos(now.angle);
        const float off = shoulder.z * turn.cosine - shoulder.x * turn.sine;
        if (off < k_by || (now.angle > k_ajar && !then.is_within)) let_go(doer, now, 2.4f);
        return;
    }
    // Away from the body: as far as that needs who goes through, and the faster the farther that is off.
    const float past = f.own(on_ground(doer.position)).z, begins = f.own(before_door(d, i, door, true).at).z;
    constexpr float k_nears = 6, k_past = 0.65f, k_swings = 0.4f;  // 1/s; metres, where one lets go; rad/s
    const float wanted = std::max(k_ajar, k_open * smoothstep(begins - 0.05f, 0.1f, past));
    float speed = std::min(now.speed + k_pushes * k_tick, k_fastest);
    speed = std::min(speed, k_nears * std::max(wanted - before, 0.0f));
    const float least = angle_to_pass(d, i, door, before, side);
    now.angle = std::max(std::min(before + speed * k_tick, k_wide), least);
    if (before <= 0) now.angle = std::max(now.angle, 0.004f);  // the latch is free
    if (hold.share > 0 && hold.share < 1)
        set_hold(doer, {std::min(hold.share + k_tick / k_to_face, 1.0f), hold.far});
    const Reached then = with(now.angle);
    if (hold.share <= 0 && !then.is_within) leave_lever(doer, someone(d, i), door, now, then.shoulder);
    if (hold.share >= 1) {
        // No farther than the arm, if the body lets it.
        const bool can_stay = now.speed < k_swings && with(std::max(before, least)).is_within;
        if (!then.is_within && can_stay) now.angle = std::max(before, least);
        if (!then.is_within && !can_stay) let_go(doer, now, 1.6f);
    }
    now.speed = (now.angle - before) / k_tick;
    if (doer.has != 0 && (past > k_past * scale_of(d, i) || (past > 0 && !then.is_before)))
        let_go(doer, now, 1.2f);
}

void let_by(Deeds& d, uint32_t number) {
    constexpr float k_fast = 3;  // rad/s, at most, of a leaf that bodies open
    const SwingDoor& door = d.things.doors[number];
    LeafNow& now = d.leaves[number];
    if (now.angle <= 0) return;
    const float before = d.previous_leaves[number].angle;
    for (size_t i = 0; i < d.doers.size(); ++i) {
        if (length(on_ground(d.doers[i].position) - door.hinge) > 2 * door.width) continue;
        const Deed& deed = deed_of(d, i);
        const bool goes_by = d.doers[i].stage != DoerStage::go && deed.thing == number &&
                             (deed.what == Deed::What::push || deed.what == Deed::What::pull);
        // The arm that held it is taken off it.
        const Side holds =
            goes_by && d.doers[i].arms > 0 ? hand_at(door, deed.what == Deed::What::push) : k_no_side;
        const Vec2 own = frame_of(door).own(on_ground(d.doers[i].position));
        const SinCos turn = sin_cos(now.angle);
        const bool is_behind = own.x * turn.sine - own.z * turn.cosine > 0;
        if (goes_by && is_behind) {
            const float least = angle_to_pass(d, i, door, now.angle, holds);
            if (least <= now.angle) continue;
            now.angle = std::min(least, std::max(now.angle, before) + k_fast * k_tick);
            now.speed = std::max(now.speed, 0.0f);
        } else if (!is_clear(d, i, door, now.angle, holds)) {
            now.angle = before, now.speed = 0;
        }
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
    turn_to_hold(d, i, hold_of(d, i, pose, door, now, pushes).place, share, pose);
    const float looks = doer.stage == DoerStage::go ? share : share * (1 - smoothstep(0.1f, 0.6f, now.angle));
    look_at(pose, who, handle, looks);
    lean_to(pose, who, side, wrist_of(hold_of(d, i, pose, door, now, pushes), who, side).position, share,
            k_leans);
    // The elbow down and back, or off the face.
    const float out = side == k_left ? 1.0f : -1.0f;
    const Vec3 off = at_height(heading_direction(leaf_yaw(door, now.angle)), 0) * -0.9f + Vec3{0, -0.7f, 0};
    Vec3 elbow = rotate(conjugate(pose.rotation[upper_chest]), off);
    elbow = lerp(Vec3{0.4f, -0.8f, -0.6f}, {out * elbow.x, elbow.y, elbow.z},
                 smoothstep(0, 1, hold_of(doer).share));
    reach_for(pose, who, side, hold_of(d, i, pose, door, now, pushes), elbow, share);
}

}  // namespace flaneur
