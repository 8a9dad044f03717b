#include "sim/deeds/carry.h"

#include <algorithm>

#include "sim/base/math.h"
#include "sim/base/tick.h"

namespace flaneur {

namespace {

constexpr float k_before_edge = 0.05f, k_before_box = 0.075f;  // metres, of toes
constexpr float k_on_ground = 0.1f;  // metres, lower shelves than which have no edge
constexpr float k_part = 0.9f;       // of an arm's length, to which one reaches
constexpr Vec3 k_elbow{0.5f, -0.8f, -0.25f};

// How long stages take, seconds.
float reach_seconds(float depth) { return 0.8f + 0.45f * depth; }
float lift_seconds(const Parcel& parcel, float depth) { return 0.9f + 0.03f * parcel.mass + 0.5f * depth; }
constexpr float k_let_go = 0.7f;

float share_of(const Doer& doer, float seconds) { return clamp(seconds_in(doer) / seconds, 0, 1); }

float grip_height(const Parcel& p) {
    return -p.half.y + std::max(0.7f * p.half.y, std::min(0.06f, p.half.y));
}

// Where one has it who carries it, by the gait's pose.
ParcelNow carried(const Deeds& d, size_t i, const BodyPose& stands, uint32_t parcel) {
    constexpr float k_clear = 0.025f, k_grip_high = 0.065f;  // metres; of the height, over the hips
    const Parcel& p = d.things.parcels[parcel];
    const Doer& doer = d.doers[i];
    const Vec2 ahead = heading_direction(doer.motion.heading);
    const float height = d.bodies[i].height, belly = girth_of(d.bodies[i]).belly;
    const Vec2 at = on_ground(stands.hips) + ahead * (belly + k_clear + p.half.z);
    ParcelNow now = d.parcels[parcel];
    now.place = at_height(at, stands.hips.y + k_grip_high * height - grip_height(p));
    now.turn = rotation_y(doer.motion.heading);
    // Over the shelf that it comes from or goes to.
    constexpr float k_over = 0.035f, k_near = 0.36f, k_far = 0.85f;
    const Deed& deed = deed_of(d, i);
    const bool at_shelf = deed.what == Deed::What::take || deed.what == Deed::What::put;
    if (!at_shelf) return now;
    const Shelf& shelf = d.things.shelves[deed.thing];
    if (shelf.top < k_on_ground) return now;
    const float off = length(before_shelf(d, i, shelf).at - on_ground(doer.position));
    const float least = shelf.top + p.half.y + k_over;
    const float more = std::max(least - now.place.y, 0.0f);
    now.place.y += more * (1 - smoothstep(k_near, k_far, off));
    return now;
}

// From a to b: up before aside, and aside before down.
ParcelNow on_its_way(const ParcelNow& a, const ParcelNow& b, float time) {
    const bool up = b.place.y > a.place.y;
    const float high = bell(up ? time / 0.85f : (time - 0.15f) / 0.85f),
                flat = bell(up ? (time - 0.2f) / 0.8f : time / 0.8f);
    ParcelNow now = b;
    now.place =
        at_height(lerp(on_ground(a.place), on_ground(b.place), flat), lerp(a.place.y, b.place.y, high));
    now.turn = nlerp(a.turn, b.turn, flat);
    return now;
}

// The bend from which both hands reach a parcel.
float depth_for(const BodyPose& stands, Someone who, const Parcel& parcel, const ParcelNow& now) {
    Vec3 wrists[2];
    for (const Side side : {k_left, k_right})
        wrists[side] = wrist_of(grip_of(parcel, now, side, 1.0f), who, side).position;
    return depth_to_reach(stands, who, wrists, 0, k_part);
}

// Radians that fingers point ahead of down, so that hands go on as forearms do.
float finger_pitch(const BodyPose& pose, Someone who, const Parcel& parcel, const ParcelNow& now, Side side) {
    const size_t upper = side == k_left ? left_upper_arm : right_upper_arm;
    const auto places = places_of(pose, who.person, who.lane);
    const Vec3 way = rotate(conjugate(now.turn), grip_of(parcel, now, side, 1).place - places[upper]);
    const float a = length(places[upper + 1] - places[upper]),
                b = 1.3f * length(places[upper + 2] - places[upper + 1]);
    const float far = clamp(length(way), std::fabs(a - b) + 0.02f, a + b - 0.001f);
    const float bent = arccos((b * b + far * far - a * a) / (2 * b * far));
    return clamp(arctan2(way.z, -way.y) + bent, 0.1f, 1.9f);
}

struct Grips {
    JointPose wrists[2];
};
Grips grips_of(const BodyPose& pose, Someone who, const Parcel& parcel, const ParcelNow& now) {
    Grips grips;
    for (const Side side : {k_left, k_right})
        grips.wrists[side] =
            wrist_of(grip_of(parcel, now, side, finger_pitch(pose, who, parcel, now, side)), who, side);
    return grips;
}

// Where its next deed is.
Vec2 next_place(const Deeds& d, size_t i) {
    const DoerPlan& plan = d.plans[i];
    const Deed& next = plan.round[(d.doers[i].deed + 1) % plan.round.size()];
    const bool at_shelf = next.what == Deed::What::take || next.what == Deed::What::put;
    return at_shelf ? before_shelf(d, i, d.things.shelves[next.thing]).at : next.at;
}

// Arms on their way from where they hang to their grips, by `time`, 0..1.
void reach_out(BodyPose& pose, Someone who, const Grips& grips, Quat turn, float time) {
    constexpr float k_wide = 0.11f, k_over = 0.07f, k_back = 0.12f;  // metres, of what they go round by
    const float t = bell(time);
    const auto places = places_of(pose, who.person, who.lane);
    for (const Side side : {k_left, k_right}) {
        const size_t hand = side == k_left ? left_hand : right_hand;
        const JointPose& to = grips.wrists[side];
        const Vec3 from = places[hand];
        const float out = side == k_left ? k_wide : -k_wide;
        const Vec3 round = to.position + rotate(turn, {out, k_over, -k_back});
        const Vec3 at = lerp(lerp(from, round, t), lerp(round, to.position, t), t);
        // Joints go from one to the other; then the hand is led round what is before it.
        reach_with_arm(pose, who, side, to, k_elbow, t);
        reach_with_arm(pose, who, side, {at, pose.rotation[hand]}, k_elbow, smoothstep(0, 0.5f, time));
    }
}

}  // namespace

ParcelNow at_rest(const Parcel& p, const Shelf& shelf, uint32_t number) {
    const Vec2 ahead = heading_direction(shelf.heading), at = shelf.at + ahead * (shelf.inset + p.half.z);
    return {at_height(at, shelf.top + p.half.y), rotation_y(shelf.heading), number};
}

Spot before_shelf(const Deeds& d, size_t i, const Shelf& shelf) {
    const Vec2 ahead = heading_direction(shelf.heading);
    const float off = shelf.top < k_on_ground ? k_before_box : k_before_edge;
    return {shelf.at - ahead * (toes_ahead(d, i) + off), shelf.heading};
}

Palm grip_of(const Parcel& p, const ParcelNow& now, Side side, float pitch) {
    const float out = side == k_left ? 1.0f : -1.0f;
    const SinCos down = sin_cos(pitch);
    return {now.place + rotate(now.turn, {out * p.half.x, grip_height(p), -0.1f * p.half.z}),
            rotate(now.turn, {-out, 0, 0}), rotate(now.turn, {0, -down.cosine, down.sine})};
}

DoerWish carry(Deeds& d, size_t i) {
    Doer& doer = d.doers[i];
    const Deed& deed = deed_of(d, i);
    const Shelf& shelf = d.things.shelves[deed.thing];
    const Spot goal = before_shelf(d, i, shelf);
    const Vec2 ahead = heading_direction(goal.heading);
    const bool takes = deed.what == Deed::What::take;
    const DoerWish stays{{}, ahead};
    auto turn_to = [&](DoerStage stage) { next_stage_of(doer, stage); };
    const Parcel* parcel = doer.parcel == k_no_parcel ? nullptr : &d.things.parcels[doer.parcel];
    const float depth = doer.from.x;  // of the bend, of who stands here
    switch (doer.stage) {
        case DoerStage::go: {
            if (is_at(d, i, goal)) {
                turn_to(DoerStage::stand);
                return stays;
            }
            const float load = doer.has != 0 ? parcel->mass : 0;
            return wish_to(doer, goal, laden_speed(d.plans[i].speed, d.masses[i], load));
        }
        case DoerStage::stand: {
            if (doer.since < 6) return stays;
            if (takes)
                for (uint32_t n = 0; n < d.parcels.size(); ++n)
                    if (d.parcels[n].shelf == deed.thing) doer.parcel = n;
            const Parcel& p = d.things.parcels[doer.parcel];
            doer.from = {depth_for(body_pose_of(d.whole, i), someone(d, i), p, at_rest(p, shelf, deed.thing)),
                         0, 0};
            turn_to(takes ? DoerStage::reach : DoerStage::act);
            return stays;
        }
        case DoerStage::reach:  // or lets go
            if (seconds_in(doer) < (takes ? reach_seconds(depth) : k_let_go + 0.4f * depth)) return stays;
            if (takes) doer.has = 1;
            if (!takes) doer.parcel = k_no_parcel;
            turn_to(takes ? DoerStage::act : DoerStage::leave);
            return stays;
        case DoerStage::act:
            if (seconds_in(doer) < lift_seconds(*parcel, depth)) return stays;
            if (!takes) {
                doer.has = 0;
                d.parcels[doer.parcel] = at_rest(*parcel, shelf, deed.thing);
            }
            turn_to(takes ? DoerStage::leave : DoerStage::reach);
            return stays;
        case DoerStage::leave: {
            // Backward, and turning to where it goes next.
            constexpr float k_turns = 0.06f, k_takes = 0.26f, k_puts = 0.16f;
            const float far = length(goal.at - on_ground(doer.position));
            DoerWish back = wish_back(goal);
            if (far > k_turns) back.look = normalize_or(next_place(d, i) - on_ground(doer.position), ahead);
            if (far > (takes ? k_takes : k_puts)) next_deed(d, doer, i);
            return back;
        }
    }
    return stays;
}

void move_parcel(Deeds& d, size_t i) {
    Doer& doer = d.doers[i];
    constexpr float k_load_rate = 2.2f;  // a second
    const Deed& deed = deed_of(d, i);
    const bool acts = doer.stage == DoerStage::act;
    const bool puts = deed.what == Deed::What::put;
    if (doer.has == 0 || doer.parcel == k_no_parcel) {
        doer.laden = std::max(doer.laden - k_load_rate * k_tick, 0.0f);
        return;
    }
    const Parcel& p = d.things.parcels[doer.parcel];
    ParcelNow& now = d.parcels[doer.parcel];
    const ParcelNow own = carried(d, i, body_pose_of(d.whole, i), doer.parcel);
    const float time = acts ? share_of(doer, lift_seconds(p, doer.from.x)) : 1;
    doer.laden = std::min(doer.laden + k_load_rate * k_tick, 1.0f);
    if (!acts) {
        now = own;
        now.shelf = k_no_parcel;
        return;
    }
    const ParcelNow rests = at_rest(p, d.things.shelves[deed.thing], deed.thing);
    now = puts ? on_its_way(own, rests, time) : on_its_way(rests, own, time);
    now.shelf = k_no_parcel;
    if (puts) doer.laden = std::min(doer.laden, 1 - smoothstep(0.8f, 1, time));
}

void pose_carrying(const Deeds& d, size_t i, BodyPose& pose) {
    const Doer& doer = d.doers[i];
    if (doer.parcel == k_no_parcel) return;
    const Someone who = someone(d, i);
    const Deed& deed = deed_of(d, i);
    const Parcel& p = d.things.parcels[doer.parcel];
    const ParcelNow& now = d.parcels[doer.parcel];
    const bool puts = deed.what == Deed::What::put, takes = deed.what == Deed::What::take;
    const float deepest = doer.from.x;
    float depth = 0, look = 0, reach = 1;
    if (doer.stage == DoerStage::reach) {
        const float time = share_of(doer, takes ? reach_seconds(deepest) : k_let_go + 0.4f * deepest);
        reach = takes ? time : 1 - time;
        depth = bell(reach) * deepest;
        look = takes ? smoothstep(0, 0.4f, time) : 1 - smoothstep(0.2f, 0.9f, time);
    } else if (doer.stage == DoerStage::act) {
        const float time = share_of(doer, lift_seconds(p, deepest));
        depth = std::max((takes ? 1 - bell(time) : bell(time)) * deepest, depth_for(pose, who, p, now));
        look = takes ? 1 - smoothstep(0.6f, 1, time) : 1;
    } else if (puts && doer.stage == DoerStage::go) {
        const float off =
            length(before_shelf(d, i, d.things.shelves[deed.thing]).at - on_ground(doer.position));
        look = 1 - smoothstep(0.4f, 1.6f, off);
    } else if (puts && doer.stage == DoerStage::stand) {
        look = 1;
    }
    bend_down(pose, who, {depth, 0});
    const float ahead = girth_of(d.bodies[i]).belly + p.half.z;
    turn_trunk(pose, -doer.laden * (1 - depth) * laden_lean(d.masses[i], d.bodies[i].height, p.mass, ahead),
               0);
    const bool to_shelf = puts && doer.stage == DoerStage::go;
    look_at(pose, who, to_shelf ? at_rest(p, d.things.shelves[deed.thing], 0).place : now.place, look);
    const Grips grips = grips_of(pose, who, p, now);
    if (doer.stage == DoerStage::reach) return reach_out(pose, who, grips, now.turn, reach);
    if (doer.has == 0) return;
    for (const Side side : {k_left, k_right})
        reach_for(pose, who, side, grip_of(p, now, side, finger_pitch(pose, who, p, now, side)), k_elbow, 1);
}

}  // namespace flaneur
