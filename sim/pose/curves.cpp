#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/pose/curves.cpp"
#include "sim/pose/curves.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "sim/pose/begun-inl.h"

#ifndef FLANEUR_SIM_POSE_CURVES_LED
#define FLANEUR_SIM_POSE_CURVES_LED
namespace flaneur {

// A block as the curves lead it: bodies that stand, with hands that hold to their targets, and feet at
// theirs, by so many metres above the ground.
struct Led {
    GaitBlock gait;
    float lift[2][k_block];
    float hips_down[k_block];  // metres that the hips are lower than in the canonical pose
    // 0: led .. 1: posed as it stands; legs, and all else.
    float legs_stand[k_block], rests[k_block];
};

}  // namespace flaneur
#endif

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

inline constexpr float k_straight_give = 0.03f;  // metres short of its reach, from which on a leg gives way

// By the shorter way.
template <class T>
HWY_INLINE Q4<T> nlerp_to(Q4<T> from, Q4<T> to, T share) {
    T same = from.x * to.x + from.y * to.y + from.z * to.z + from.w * to.w;
    return nlerp(from, negated_if_negative(same, to), share);
}

// Hips keep their height where both feet are in reach of it, and come down where one is not.
template <class T>
HWY_INLINE T led_height(const Begun<T>& b, T down) {
    T full = (b.leg.upper + b.leg.lower) * T(k_straightest), least = full * full * T(0.3f);
    T y = b.hips_ms.y - down + b.walk.lift - b.height.crouch;
    for (int side = 0; side < 2; ++side) {
        V3<T> to_ankle = ankle_of(b.feet[side]) - b.pelvis.place_os - b.pelvis.to_hip_ws[side];
        T flat2 = to_ankle.x * to_ankle.x + to_ankle.z * to_ankle.z;
        T reach =
            ankle_of(b.feet[side]).y + sqrt(max(full * full - flat2, least)) - b.pelvis.to_hip_ws[side].y;
        y = min(y, reach);
    }
    return y;
}

// As far as it rests as it does in `whole`.
template <class T>
HWY_INLINE void rest_pelvis(Begun<T>& b, const PoseBlock& whole, size_t lane, T share) {
    auto rests = share > T(0.0f);
    if (!any(rests)) return;
    Pelvis<T>& pelvis = b.pelvis;
    Q4<T> there = load_rotation<T>(whole.rotation[hips], lane);
    pelvis.rotation_ws = select(rests, nlerp_to(pelvis.rotation_ws, there, share), pelvis.rotation_ws);
    V3<T> place = lerp(pelvis.place_os, load_place<T>(whole.position[hips], lane), share);
    pelvis.place_os = select(rests, place, pelvis.place_os);
    pelvis.axes_ws = axes_of(pelvis.rotation_ws);
    V3<T> aside = pelvis.axes_ws.x * b.hip_ms.x;
    V3<T> middle =
        pelvis.axes_ws.y * (b.hip_ms.y - b.hips_ms.y) + pelvis.axes_ws.z * (b.hip_ms.z - b.hips_ms.z);
    pelvis.to_hip_ws[k_left] = middle + aside;
    pelvis.to_hip_ws[k_right] = middle - aside;
}

// Bones keep their lengths.
template <class T>
HWY_INLINE void rest_trunk(const PersonBlock& p, const PoseBlock& whole, PoseBlock& out, size_t lane,
                           T share) {
    auto rests = share > T(0.0f);
    if (!any(rests)) return;
    for (int j = spine; j <= right_hand; ++j) {
        const int parent = k_joint_parents[j];
        Q4<T> turn = load_rotation<T>(out.rotation[j], lane);
        V3<T> place = load_place<T>(out.position[j], lane),
              bone_ms = joint_ms<T>(p, j, lane) - joint_ms<T>(p, parent, lane);
        V3<T> rested = load_place<T>(out.position[parent], lane) +
                       rotate(load_rotation<T>(out.rotation[parent], lane), bone_ms);
        Q4<T> there = load_rotation<T>(whole.rotation[j], lane);
        set_joint(out, j, lane, select(rests, rested, place),
                  select(rests, nlerp_to(turn, there, share), turn));
    }
}

template <class T>
HWY_INLINE void stand_on_legs(const PoseBlock& whole, PoseBlock& out, size_t lane, T share) {
    auto stands = share > T(0.0f);
    if (!any(stands)) return;
    for (int j = left_upper_leg; j <= right_toes; ++j) {
        V3<T> place = load_place<T>(out.position[j], lane);
        Q4<T> turn = load_rotation<T>(out.rotation[j], lane);
        V3<T> there = lerp(place, load_place<T>(whole.position[j], lane), share);
        Q4<T> turned = nlerp_to(turn, load_rotation<T>(whole.rotation[j], lane), share);
        set_joint(out, j, lane, select(stands, there, place), select(stands, turned, turn));
    }
}

template <class T>
HWY_INLINE void pose_led_chunk(const Led& led, const PersonBlock& p, const PoseBlock& whole, PoseBlock& out,
                               size_t lane) {
    const GaitBlock& g = led.gait;
    Begun<T> b = begin_body<T>(g, p, lane);
    store_place(b.origin_ws, out.origin, lane);
    store(at<T>(whole.rising + lane), out.rising + lane);
    store(at<T>(whole.sunk + lane), out.sunk + lane);
    T rests = at<T>(led.rests + lane);
    for (int side = 0; side < 2; ++side) {
        Foot<T>& foot = b.feet[side];
        foot.place_os.y = foot.place_os.y + at<T>(led.lift[side] + lane);
        foot.leaving = foot.rolls = foot.swings = T(0.0f);
        // Knees of one who stood straight bend evenly.
        foot.give = rests * T(k_straight_give);
    }
    b.pelvis.place_os.y = led_height(b, at<T>(led.hips_down + lane));
    rest_pelvis(b, whole, lane, rests);
    set_joint(out, hips, lane, b.pelvis.place_os, b.pelvis.rotation_ws);
    for (int side = 0; side < 2; ++side)
        pose_leg(out, lane, side, b.pelvis, b.heading, b.leg, b.foot_size, b.feet[side]);
    Trunk<T> trunk{b.pelvis.place_os, b.hips_ms,        b.pelvis.rotation_ws, b.pelvis.axes_ws, b.heading,
                   b.curves,          b.walk.amplitude, b.walk.running,       b.walk.over};
    pose_trunk(g, p, out, lane, trunk, b.cycle, b.origin_ws);
    rest_trunk(p, whole, out, lane, rests);
    stand_on_legs(whole, out, lane, at<T>(led.legs_stand + lane));
}

void pose_led_here(const Led& led, const PersonBlock& person, const PoseBlock& whole, PoseBlock& out) {
    for (size_t lane = 0; lane < k_block; lane += lane_count())
        pose_led_chunk<Lanes>(led, person, whole, out, lane);
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flaneur {

HWY_EXPORT(pose_led_here);

namespace {

constexpr float k_comes_to_stand = 0.8f, k_sets_off = 0.5f;  // seconds, of feet
constexpr float k_comes_to_rest = 0.6f;                      // and of the body above, both ways
constexpr float k_gathered = 0.8f;    // of the way to standing, when both feet are there,
constexpr float k_legs_from = 0.8f;   // and from where on legs are posed as they stand
constexpr float k_gathering = 0.05f;  // metres that a foot rises then
constexpr float k_off_curve = 0.2f;   // metres that a foot on the ground may be
constexpr float k_elsewhere = 1;      // metres off it: has come from there by no step
constexpr float k_ray_up = 1, k_ray_down = 9;
constexpr float k_hangs = 0.96f, k_hangs_out = 0.02f;  // of the arm's length, where a hand rests
constexpr float k_elbow_out = 0.17f;                   // tangent of half the yaw of the elbow's plane

struct One {
    const GaitBlock& g;
    const PersonBlock& p;
    size_t lane;

    float leg() const { return p.joints[left_upper_leg][1][lane]; }
    float scale() const { return leg() / k_curves_leg; }
    Vec2 root() const { return {g.x[lane], g.z[lane]}; }
    bool stands() const { return g.standing[lane] != 0; }
};

One one_of(const Gait& gait, size_t walker) {
    return {gait.blocks[walker / k_block], gait.people[walker / k_block], walker % k_block};
}

// Units since this side's leg began to go ahead: it swings below 1, and goes back on the ground above.
float time_of(float time, int side) {
    const float own = side == k_left ? time : time - 1;
    return own < 0 ? own + 2 : own;
}

Vec2 aim_of(const One& o, const LimbCurves& how, float time, int side) {
    const float outward = (side == k_left ? 1.0f : -1.0f) * o.p.joints[left_foot][0][o.lane];
    const float ahead = o.p.joints[left_foot][2][o.lane] + targets_at(how, time).feet[side].ahead * o.scale();
    const Vec2 front = heading_direction(o.g.heading[o.lane]), left{front.z, -front.x};
    return o.root() + front * ahead + left * outward;
}

struct Stand {
    Vec2 place;
    float yaw;
};
Stand stand_of(const One& o, int side) {
    const FootPlaces& to = o.g.feet[side].to;
    return {{to.x[o.lane], to.z[o.lane]}, to.yaw[o.lane]};
}

void set_foot(LimbClock::Foot& f, size_t lane, Vec2 place, float yaw) {
    f.x[lane] = place.x, f.z[lane] = place.z, f.yaw[lane] = yaw;
}

void start(const One& o, const LimbCurves& how, LimbClock& clock) {
    const size_t lane = o.lane;
    const float phase = o.g.feet[k_left].phase[lane], duty = o.g.duty[lane];
    const bool stands = o.stands();
    float time = 0.5f;
    if (!stands) time = phase < duty ? 1 + phase / duty : (phase - duty) / std::max(1 - duty, 1e-3f);
    clock.time[lane] = std::clamp(time, 0.0f, 1.999f);
    clock.still[lane] = clock.rest[lane] = stands ? 1.0f : 0.0f;
    clock.first[lane] = clock.time[lane] < 1 ? k_left : k_right;
    for (int side = 0; side < 2; ++side) {
        const Vec2 aim = aim_of(o, how, clock.time[lane], side);
        const Stand stand = stands ? stand_of(o, side) : Stand{aim, o.g.heading[lane]};
        set_foot(clock.feet[side], lane, stand.place, stand.yaw);
        clock.feet[side].aim_x[lane] = aim.x, clock.feet[side].aim_z[lane] = aim.z;
    }
}

// How far a foot has come to where it will stand, 0..1: first the one that was in the air.
float gathered(const LimbClock& clock, size_t lane, int side, float still) {
    const float own = side == clock.first[lane] ? 0 : 0.5f;
    return std::clamp(2 * (still / k_gathered - own), 0.0f, 1.0f);
}

void come_to_stand(const One& o, LimbClock& clock, float before) {
    for (int side = 0; side < 2; ++side) {
        const float was = gathered(clock, o.lane, side, before),
                    is = gathered(clock, o.lane, side, clock.still[o.lane]);
        if (is <= was && is < 1) continue;
        LimbClock::Foot& f = clock.feet[side];
        const float share = is < 1 ? (is - was) / (1 - was) : 1;
        const Stand there = stand_of(o, side);
        const Vec2 from{f.x[o.lane], f.z[o.lane]};
        const float yaw = f.yaw[o.lane] + share * wrap_angle(there.yaw - f.yaw[o.lane]);
        set_foot(f, o.lane, from + (there.place - from) * share, yaw);
    }
}

// A foot in the air comes onto its curve before it lands; one on the ground stays.
void step_foot(const One& o, const LimbCurves& how, LimbClock& clock, int side, float units) {
    LimbClock::Foot& f = clock.feet[side];
    const size_t lane = o.lane;
    const Vec2 aim = aim_of(o, how, clock.time[lane], side);
    const float own = time_of(clock.time[lane], side), left = units >= 0 ? 1 - own : own;
    const bool swings = own < 1, lands = !swings && (own - units < 1 || own - units >= 2);
    float keeps = 1;
    if (swings) keeps = 1 - std::min(2 * std::fabs(units) / std::max(left, 1e-3f), 1.0f);
    if (lands) keeps = 0;
    const Vec2 was_aim{f.aim_x[lane], f.aim_z[lane]}, was{f.x[lane], f.z[lane]};
    Vec2 off = swings || lands ? (was - was_aim) * keeps : was - aim;
    const float far = length(off), most = k_off_curve * o.scale();
    if (far > most) off = off * (most / far);
    const float turned = wrap_angle(f.yaw[lane] - o.g.heading[lane]) * keeps;
    set_foot(f, lane, aim + off, wrap_angle(o.g.heading[lane] + turned));
}

void advance(const One& o, const LimbCurves& how, float dt, LimbClock& clock) {
    const size_t lane = o.lane;
    for (int side = 0; side < 2; ++side) {
        const LimbClock::Foot& f = clock.feet[side];
        const Vec2 far = Vec2{f.x[lane], f.z[lane]} - aim_of(o, how, clock.time[lane], side);
        if (length(far) > k_elsewhere * std::max(o.scale(), 0.5f)) return start(o, how, clock);
    }
    const float before = clock.still[lane];
    // Who sets off does so with the foot that the gait lifts.
    if (before >= 1 && !o.stands()) {
        const bool is_left = o.g.feet[k_left].swinging[lane] != 0;
        clock.time[lane] = is_left ? 0.5f : 1.5f;
        clock.first[lane] = is_left ? k_right : k_left;
    }
    if (before <= 0) clock.first[lane] = clock.time[lane] < 1 ? k_left : k_right;
    const float units = o.g.forward[lane] * dt / std::max(metres_a_unit(how, o.leg()), 1e-3f);
    const float time = clock.time[lane] + units;
    clock.time[lane] = std::clamp(time - 2 * std::floor(time * 0.5f), 0.0f, 1.9999999f);
    clock.still[lane] =
        std::clamp(before + (o.stands() ? dt / k_comes_to_stand : -dt / k_sets_off), 0.0f, 1.0f);
    const float rests = o.stands() ? dt / k_comes_to_rest : -dt / k_comes_to_rest;
    clock.rest[lane] = std::clamp(clock.rest[lane] + rests, 0.0f, 1.0f);
    if (o.stands())
        come_to_stand(o, clock, before);
    else
        for (int side = 0; side < 2; ++side) step_foot(o, how, clock, side, units);
    for (int side = 0; side < 2; ++side) {
        const Vec2 aim = aim_of(o, how, clock.time[lane], side);
        clock.feet[side].aim_x[lane] = aim.x, clock.feet[side].aim_z[lane] = aim.z;
    }
}

// Metres that a foot is over the ground.
float lift_of(const One& o, const LimbCurves& how, const LimbClock& clock, int side) {
    const float there = gathered(clock, o.lane, side, clock.still[o.lane]);
    const float raised = targets_at(how, clock.time[o.lane]).feet[side].up * o.scale();
    const float gathers = side == clock.first[o.lane] ? 0 : k_gathering * 4 * there * (1 - there);
    return raised * (1 - eased(there)) + gathers * o.scale();
}

// What a ray down from above the foot meets, or level ground below the body where it meets nothing.
GroundHit under_foot(const One& o, const LimbClock& clock, int side, const Surroundings& around) {
    const LimbClock::Foot& f = clock.feet[side];
    const Vec3 place{f.x[o.lane], o.g.base[o.lane], f.z[o.lane]};
    if (const auto hit = ground_at(around, place, k_ray_up, k_ray_down)) return *hit;
    GroundHit none{};
    none.height = place.y;
    none.normal = {0, 1, 0};
    return none;
}

// Of a wrist, from the shoulder in the chest's axes.
Vec3 hand_of(const One& o, const LimbCurves& how, const LimbClock& clock, int side) {
    const auto& joints = o.p.joints;
    const float arm = joints[left_upper_arm][1][o.lane] - joints[left_hand][1][o.lane];
    const LimbTarget at = targets_at(how, clock.time[o.lane]).hands[side];
    const float mirror = side == k_left ? 1.0f : -1.0f;
    return {mirror * (k_hangs_out + 0.03f) * arm, -k_hangs * arm + at.up * o.scale(), at.ahead * o.scale()};
}

void lead_feet(const One& o, const LimbCurves& how, const LimbClock& clock, const Surroundings& around,
               Led& led) {
    const size_t lane = o.lane;
    for (int side = 0; side < 2; ++side) {
        const LimbClock::Foot& from = clock.feet[side];
        const GroundHit hit = under_foot(o, clock, side, around);
        FootBlock& foot = led.gait.feet[side];
        for (FootPlaces* places : {&foot.from, &foot.to}) {
            places->x[lane] = from.x[lane], places->y[lane] = hit.height, places->z[lane] = from.z[lane];
            places->yaw[lane] = from.yaw[lane];
            places->normal_x[lane] = hit.normal.x, places->normal_z[lane] = hit.normal.z;
        }
        foot.phase[lane] = 0.2f * o.g.duty[lane];
        for (float* row : {foot.obstacle, foot.round, foot.edge, foot.pivots, foot.forefoot}) row[lane] = 0;
        led.lift[side][lane] = lift_of(o, how, clock, side);
    }
}

void lead_hands(const One& o, const LimbCurves& how, const LimbClock& clock, Led& led) {
    const size_t lane = o.lane;
    for (int side = 0; side < 2; ++side) {
        const Vec3 hand = hand_of(o, how, clock, side);
        HoldBlock& hold = led.gait.holds[side];
        hold.x[lane] = hand.x, hold.y[lane] = hand.y, hold.z[lane] = hand.z;
        hold.anchor[lane] = static_cast<float>(HoldAnchor::chest);
        hold.elbow[lane] = side == k_left ? -k_elbow_out : k_elbow_out;
        hold.twist[lane] = hold.bend[lane] = hold.side[lane] = 0;
        hold.weight[lane] = 1;
        led.gait.hands[side].reach[lane] = 0;
    }
}

void lead(const One& o, const LimbCurves& how, const LimbClock& clock, const Surroundings& around, Led& led) {
    const size_t lane = o.lane;
    GaitBlock& g = led.gait;
    for (float* row :
         {g.amplitude, g.running, g.drive, g.bank, g.rise, g.climb, g.sink, g.tilt_ahead, g.tilt_aside})
        row[lane] = 0;
    g.load[lane] = 0.5f;
    lead_feet(o, how, clock, around, led);
    lead_hands(o, how, clock, led);
    const float ankle = o.p.joints[left_foot][1][lane], straight = o.leg() - ankle;
    const float farthest = how.leg_forward * o.scale() * std::max(-k_leg_back, k_leg_front);
    const float reach = straight * k_straightest;
    led.hips_down[lane] =
        straight - std::sqrt(std::max(reach * reach - farthest * farthest, 0.3f * reach * reach));
    const float legs = (clock.still[lane] - k_legs_from) / (1 - k_legs_from);
    led.legs_stand[lane] = eased(std::clamp(legs, 0.0f, 1.0f));
    led.rests[lane] = eased(clock.rest[lane]);
}

}  // namespace

void start_clocks(const Gait& gait, const LimbCurves& how, std::vector<LimbClock>& clocks) {
    clocks.assign(gait.blocks.size(), {});
    for (size_t i = 0; i < clocks.size() * k_block; ++i) start(one_of(gait, i), how, clocks[i / k_block]);
}

void advance_clocks(const Gait& gait, size_t begin, size_t end, const LimbCurves& how, float dt,
                    std::vector<LimbClock>& clocks) {
    for (size_t i = begin * k_block; i < end * k_block; ++i)
        advance(one_of(gait, i), how, dt, clocks[i / k_block]);
}

void pose_by_curves(const Gait& gait, size_t begin, size_t end, const LimbCurves& how,
                    const std::vector<LimbClock>& clocks, const Surroundings& around,
                    const std::vector<PoseBlock>& whole, std::vector<PoseBlock>& poses) {
    Led led;
    for (size_t n = begin; n < end; ++n) {
        led.gait = gait.blocks[n];
        for (size_t lane = 0; lane < k_block; ++lane)
            lead(one_of(gait, n * k_block + lane), how, clocks[n], around, led);
        HWY_DYNAMIC_DISPATCH(pose_led_here)(led, gait.people[n], whole[n], poses[n]);
    }
}

PlacedTargets targets_of(const Gait& gait, size_t walker, const LimbCurves& how,
                         const std::vector<LimbClock>& clocks, const Surroundings& around,
                         const std::vector<PoseBlock>& poses) {
    const One o = one_of(gait, walker);
    const LimbClock& clock = clocks[walker / k_block];
    PlacedTargets out;
    const JointPose chest = joint_pose(poses, walker, upper_chest);
    for (int side = 0; side < 2; ++side) {
        const LimbClock::Foot& f = clock.feet[side];
        const float height = under_foot(o, clock, side, around).height + lift_of(o, how, clock, side);
        out.feet[side] = {f.x[o.lane], height + o.g.lift[o.lane], f.z[o.lane]};
        const JointPose shoulder =
            joint_pose(poses, walker, side == k_left ? left_upper_arm : right_upper_arm);
        out.hands[side] = shoulder.position + rotate(chest.rotation, hand_of(o, how, clock, side));
    }
    return out;
}

}  // namespace flaneur
#endif
