// One chunk of walkers, from gait to joints: feet first, then the pelvis over them, then everything above.
// Ends of names say spaces: see foot-inl.h.
#if defined(FLANEUR_SIM_POSE_WALK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLANEUR_SIM_POSE_WALK_INL_H
#undef FLANEUR_SIM_POSE_WALK_INL_H
#else
#define FLANEUR_SIM_POSE_WALK_INL_H
#endif

#include "sim/gait/curves/rise-inl.h"
#include "sim/ik/two_bone-inl.h"
#include "sim/pose/foot-inl.h"
#include "sim/pose/trunk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

// How a body moves up and down, m/s2 and m/s. It falls a little less hard than by gravity, for what rounding
// adds, and no faster than on level ground, or down steps; legs catch who falls harder than they lift who
// stands, and gravity alone slows who rises. The flight of a run and its landing are planned.
inline constexpr float k_falls = 9.7f, k_run_falls = 19;
inline constexpr float k_fastest_fall = 0.95f, k_fastest_down = 1.4f;
inline constexpr float k_lifts = 6, k_catches = 20, k_run_catches = 45, k_falls_hard = 0.3f,
                       k_run_fastest = 4;
inline constexpr float k_slows = 5;

// The pelvis and the legs that carry it.
template <class T>
struct Pelvis {
    V3<T> place_os;
    T wanted;  // height, metres: it may still fall to there, or have sunk below
    Q4<T> rotation_ws;
    Axes<T> axes_ws;
    V3<T> to_hip_ws[2];  // from its centre to the hip joints
};

// How high the pelvis wants to be, metres.
template <class T>
struct Height {
    T walk;  // of one who walks or stands
    T drop;  // of a run, see swing-inl.h
    T crouch;
};

// Metres of the hip over the ground as a runner's foot comes down on its heel ahead of it.
//
// With thigh u, shank l and a knee flexed by k, hip and ankle are d = sqrt(u^2 + l^2 + 2 u l cos k) apart,
// and the hip stands sqrt(d^2 - flat^2) above the ankle, where flat is what lies between them along the
// ground.
template <class T>
HWY_INLINE T contact_height(const FootSizes<T>& foot, const LimbSizes<T>& leg, const WalkNow<T>& walk) {
    T flat = walk.reach * walk.leg * T(k_run_lead) - foot.ankle * T(k_run_contact_sine);
    T knee = T(k_run_knee_cosine) - T(k_run_knee_pace) * abs(walk.pace - T(1.15f));
    T d2 = leg.upper * leg.upper + leg.lower * leg.lower + T(2.0f) * leg.upper * leg.lower * knee;
    return sqrt(max(d2 - flat * flat, d2 * T(0.5f))) + foot.ankle * T(k_run_contact_cosine) +
           foot.heel * T(k_run_contact_sine);
}

// How high the hips were a tick ago and how far they had sunk below where they should have been, and what
// gravity and legs let them be now. Metres, heights from `origin_ws`.
template <class T>
struct Fall {
    T was, sunk, least, most;
    T fastest;  // way up or down in the tick
    T over_dt;  // 1/s; 0 of one who comes from nowhere, and is at rest
};

template <class T>
HWY_INLINE Fall<T> no_fall() {
    T zero = T(0.0f), any = T(1e9f);
    return {zero, zero, zero - any, any, any, zero};
}

// `fastest` it goes up and down, m/s. One who leaps may be anywhere, and so may one who has been carried off.
template <class T>
HWY_INLINE Fall<T> fall_since(const PoseBlock& before, float dt, const GaitBlock& g, size_t lane, T origin_y,
                              T upright, T fastest) {
    T zero = T(0.0f), running = at<T>(g.running + lane), rising = at<T>(before.rising + lane);
    T was = at<T>(before.position[hips][1] + lane) + (at<T>(before.origin[1] + lane) - origin_y);
    T even = was + rising * T(dt);
    auto comes_along = abs(even - upright) < upright;
    auto bound = (at<T>(g.flight + lane) <= zero) & (at<T>(g.crouch + lane) <= zero) & comes_along;
    T falls = lerp(T(k_falls), T(k_run_falls), running) * T(dt * dt);
    T catches = lerp(T(k_lifts), T(k_catches), smoothstep(zero, T(k_falls_hard), zero - rising));
    catches = lerp(catches, T(k_run_catches), running) * T(dt * dt);
    fastest = (fastest + running * T(k_run_fastest)) * T(dt);
    Fall<T> fall = no_fall<T>();
    fall.was = was;
    fall.sunk = select(comes_along, max(at<T>(before.sunk + lane), zero), zero);
    fall.least = select(bound, max(even - falls, min(was - fastest, even + catches)), fall.least);
    fall.most = select(bound, max(min(even + catches, was + fastest), even - falls), fall.most);
    fall.fastest = fastest;
    fall.over_dt = select(comes_along, T(1 / dt), zero);
    return fall;
}

// How high they are where they should be at `y`. Who has sunk below that rises in time to stop there.
template <class T>
HWY_INLINE T height_after(const Fall<T>& fall, float dt, T y) {
    T rest = fall.sunk - min(sqrt(fall.sunk * T(2 * k_slows)) * T(dt), fall.fastest);
    return clamp(y - max(rest, T(0.0f)), fall.least, fall.most);
}

// How high the curves alone have the pelvis, metres, less what a jump lifts it.
template <class T>
HWY_INLINE T curve_height(const Pelvis<T>& pelvis, const FootSizes<T>& foot_size, const LimbSizes<T>& leg,
                          const WalkNow<T>& walk, const Height<T>& height) {
    T wanted = height.walk;
    if (any(walk.running > T(0.0f))) {
        T run = contact_height(foot_size, leg, walk) - pelvis.to_hip_ws[k_left].y - height.drop;
        wanted = lerp(wanted, run, walk.running);
    }
    return wanted - height.crouch;
}

// The pelvis goes its own smooth way, as far as legs reach and as it can fall.
template <class T>
HWY_INLINE void raise_pelvis(Pelvis<T>& pelvis, Foot<T> (&feet)[2], const FootSizes<T>& foot_size,
                             const LimbSizes<T>& leg, const WalkNow<T>& walk, const Height<T>& height,
                             const Fall<T>& fall, float dt) {
    T least = leg.upper * leg.upper * T(0.8f);
    T full = (leg.upper + leg.lower) * T(k_straightest), full2 = full * full;
    auto limit_of = [&](int side) {
        V3<T> ankle_os = ankle_of(feet[side]);
        T x = pelvis.place_os.x + pelvis.to_hip_ws[side].x - ankle_os.x,
          z = pelvis.place_os.z + pelvis.to_hip_ws[side].z - ankle_os.z;
        return sqrt(max(full2 - (x * x + z * z), least)) + ankle_os.y - pelvis.to_hip_ws[side].y;
    };
    const T limits[2] = {limit_of(k_left), limit_of(k_right)};
    // Never so high that a planted leg would be stretched, rounded so that the knee does not snap straight;
    // but a leg about to leave may be: its heel gives.
    T y = curve_height(pelvis, foot_size, leg, walk, height);
    for (int side = 0; side < 2; ++side)
        y = soft_min(y, min(limits[side] - walk.lift + feet[side].slack, y + T(0.3f)), T(k_straight));
    pelvis.wanted = y + walk.lift;
    pelvis.place_os.y = height_after(fall, dt, pelvis.wanted);
    for (int side = 0; side < 2; ++side) {
        V3<T> hip_os = pelvis.place_os + pelvis.to_hip_ws[side];
        auto gave = raise_heel(feet[side], foot_size, hip_os, full);
        if (!any(gave)) continue;
        raise_heel(feet[side], foot_size, hip_os, full);
        // What a heel cannot give the pelvis does.
        pelvis.wanted = select(gave, min(pelvis.wanted, limit_of(side)), pelvis.wanted);
        pelvis.place_os.y = height_after(fall, dt, pelvis.wanted);
    }
}

// A swinging foot that is planned beyond reach comes along: from `give` short of the reach to `give` beyond
// it the distance follows a parabola, so that the knee opens evenly.
template <class T>
HWY_INLINE V3<T> within_reach(V3<T> to_ankle, const LimbSizes<T>& leg, T give) {
    T reach = (leg.upper + leg.lower) * T(k_straightest), near = reach - give;
    T distance2 = dot(to_ankle, to_ankle);
    auto far = (give > T(0.0f)) & (distance2 > near * near);
    if (!any(far)) return to_ankle;
    T distance = sqrt(distance2), excess = clamp(distance - near, T(0.0f), give + give);
    T d = min(distance, reach + give) - excess * excess * T(0.25f) / max(give, T(1e-6f));
    T scale = select(far, d / distance, T(1.0f));
    return to_ankle * scale;
}

template <class T>
HWY_INLINE WalkNow<T> walk_now(const GaitBlock& g, const PersonBlock& p, size_t lane, T leg) {
    T one = T(1.0f);
    WalkNow<T> walk;
    walk.duty = at<T>(g.duty + lane);
    walk.over_duty = T(k_norm_toe_off) / walk.duty;
    walk.over_swing = one / (one - walk.duty);
    walk.amplitude = at<T>(g.amplitude + lane);
    walk.ahead = walk.amplitude * max(at<T>(g.course + lane), T(0.0f));
    walk.running = at<T>(g.running + lane);
    walk.over = over_natural(at<T>(g.pace + lane)) * (one - walk.running);
    walk.lift = at<T>(g.lift + lane);
    walk.pace = at<T>(g.pace + lane);
    walk.reach = T(2.0f) * walk.duty * at<T>(g.step + lane);
    walk.leg = leg;
    walk.climb = at<T>(g.rise + lane);
    walk.strike = at<T>(p.strike + lane);
    walk.clearance = at<T>(p.clearance + lane);
    return walk;
}

// List, turn and sway from the curves, `cycle` being at the phase of the pelvis. One who stands leans over
// the leg that carries most, the feet being `astride` metres apart.
template <class T>
HWY_INLINE PelvisCurves<T> pelvis_curves(const GaitBlock& g, const PersonBlock& p, size_t lane,
                                         const WalkNow<T>& walk, const Harmonics<T, 3>& cycle, T astride) {
    T style = at<T>(p.sway + lane), share = walk.amplitude * style;
    T stands = (T(1.0f) - walk.amplitude) * (T(1.0f) - walk.amplitude);
    T more = at<T>(g.load + lane) - T(0.5f), idle = more * stands;
    PelvisCurves<T> curves;
    curves.list = curve_at(k_norm_pelvic_list, cycle) * share *
                      (T(1.0f) + T(1.2f) * walk.over + T(0.25f) * walk.running) +
                  idle * (T(1.0f) + stands * (T(1.0f) - T(4.0f) * more * more)) * T(k_idle_list);
    T turn = curve_at(k_norm_pelvic_rotation, cycle) * share;
    curves.turn = turn * clamp(T(0.97f) + T(2.6f) * walk.over, T(0.6f), T(1.35f));
    curves.twist = turn * T(k_chest_turn);
    curves.slow = walk.duty - T(k_norm_duty);
    curves.sway =
        cycle.sine[0] * style * walk.amplitude * max(T(k_sway) + T(k_sway_slow) * curves.slow, T(0.008f)) +
        idle * T(k_idle_sway) * clamp(astride, T(0.0f), T(k_widest_sway));
    T reels = select(at<T>(p.reel + lane) > T(0.0f), T(1.0f), T(0.0f)), sways = max(stands, reels);
    curves.aside = at<T>(g.tilt_aside + lane) * sways;
    curves.reel = curves.aside * reels;
    // Who speeds up or slows down does so by these surges.
    T even = T(1.0f) - smoothstep(abs(at<T>(g.drive + lane)) * T(k_drive_evens));
    curves.surge = (cycle.cosine[1] * T(k_surge_cosine) + cycle.sine[1] * T(k_surge_sine)) * walk.amplitude *
                   (T(1.0f) - walk.running) * even;
    curves.nod = curves.surge * T(-k_nod);
    T tilt = at<T>(g.tilt_ahead + lane) * sways;
    curves.surge = curves.surge + tilt;
    curves.nod = curves.nod + tilt;
    curves.breath = at<T>(g.inhaled + lane) * stands;
    curves.lean = at<T>(p.lean + lane) + clamp(at<T>(g.rise + lane), T(-0.12f), T(0.6f)) * T(0.3f) +
                  at<T>(g.drive + lane) * T(k_drive_lean) + walk.running * T(k_run_lean);
    curves.climb = at<T>(g.climb + lane) *
                   select(walk.leg < T(k_both_feet_leg), T(k_child_climb_lean), T(k_climb_lean)) *
                   (T(1.0f) - walk.amplitude);
    return curves;
}

// The pelvis before it is raised.
template <class T>
HWY_INLINE Pelvis<T> turned_pelvis(const PelvisCurves<T>& curves, const Heading<T>& heading, V3<T> hips_ms,
                                   V3<T> left_hip_ms) {
    T leg = left_hip_ms.y, zero = T(0.0f);
    Pelvis<T> pelvis;
    pelvis.rotation_ws =
        turned_yzx(plus(heading.half, sin_cos_half(zero - curves.turn)), sin_cos_half(curves.list),
                   sin_cos_half((curves.lean + curves.climb) * T(0.6f) + curves.nod));
    pelvis.axes_ws = axes_of(pelvis.rotation_ws);
    pelvis.place_os = os_of_bs(heading, V3<T>{curves.sway + curves.aside * leg, zero, curves.surge * leg});
    V3<T> aside_ws = pelvis.axes_ws.x * left_hip_ms.x;
    V3<T> middle_ws =
        pelvis.axes_ws.y * (left_hip_ms.y - hips_ms.y) + pelvis.axes_ws.z * (left_hip_ms.z - hips_ms.z);
    pelvis.to_hip_ws[k_left] = middle_ws + aside_ws;
    pelvis.to_hip_ws[k_right] = middle_ws - aside_ws;
    return pelvis;
}

template <class T>
HWY_INLINE Height<T> pelvis_height(const GaitBlock& g, const PersonBlock& p, size_t lane,
                                   const WalkNow<T>& walk, const Harmonics<T, 3>& cycle, T upright, T leg) {
    Height<T> height;
    height.walk = upright + leg * pelvis_rise(at<T>(g.step + lane), walk.over, walk.amplitude,
                                              clamp(at<T>(g.rise + lane), T(0.0f), T(k_steepest)),
                                              SinCosOf<T>{cycle.sine[1], cycle.cosine[1]});
    height.crouch = at<T>(g.crouch + lane) +
                    at<T>(p.crouch + lane) * smoothstep(walk.amplitude * T(k_crouches)) +
                    at<T>(g.sink + lane) * (T(1.0f) - walk.running);
    height.drop = T(0.0f);
    if (any(walk.running > T(0.0f))) {
        T half = at<T>(g.phase + lane) * T(2.0f), step = T(0.5f) / at<T>(g.frequency + lane);
        height.drop = run_drop(select(half < T(1.0f), half, half - T(1.0f)), step, walk.duty);
    }
    return height;
}

// One leg from the pelvis to its foot. The knee looks where pelvis and foot do; never backwards in the frame
// of the body. Where the shin tilts too far, the heel of a foot on the ground comes up, which bends the knee
// anew; in the air it hangs, and the toes point on.
template <class T>
HWY_INLINE void pose_leg(PoseBlock& out, size_t lane, int side, const Pelvis<T>& pelvis,
                         const Heading<T>& heading, const LimbSizes<T>& leg, const FootSizes<T>& foot_size,
                         Foot<T>& foot) {
    T zero = T(0.0f);
    int joint = side == k_left ? left_upper_leg : right_upper_leg;
    V3<T> hip_os = pelvis.place_os + pelvis.to_hip_ws[side];
    V3<T> front_bs = bs_of_os(heading, pelvis.axes_ws.z + foot.ahead_ws);
    SinCosOf<T> half_front = plus(heading.half, half_yaw_to(front_bs.x, front_bs.z));
    auto stands = foot.rolls > zero;
    PosedLimb<T> limb;
    for (int pass = 0;; ++pass) {
        limb = two_bone(within_reach(ankle_of(foot) - hip_os, leg, foot.give), half_front, leg, 1.0f, 0.0f);
        auto tilted = stands;
        SinCosOf<T> over = over_tilt(foot, (limb.middle - limb.end) * (leg.over_lower * T(4.0f)), tilted);
        if (!any(tilted)) break;
        if (pass < 2 && any(tilted & stands)) {
            turn_over_ball(tilted & stands, foot, foot_size, over);
            continue;
        }
        auto hangs = tilted & (foot.swings > zero);
        turn_if(hangs, foot.half, over);
        break;
    }
    V3<T> ankle_os = hip_os + limb.end;
    set_joint(out, joint, lane, hip_os, limb.upper_rot);
    set_joint(out, joint + 1, lane, hip_os + limb.middle, limb.lower_rot);
    set_joint(out, joint + 2, lane, ankle_os, turned_x(foot.flat_ws, foot.half));
    set_joint(out, joint + 3, lane, ball_of(foot, foot_size, ankle_os),
              turned_x(foot.flat_ws, foot.toe_half));
}

template <class T>
HWY_INLINE void pose_chunk(const GaitBlock& g, const PersonBlock& p, float dt, const PoseBlock* before,
                           PoseBlock& out, size_t lane) {
    V3<T> hips_ms = joint_ms<T>(p, hips, lane), hip_ms = joint_ms<T>(p, left_upper_leg, lane);
    T ankle_height = at<T>(p.joints[left_foot][1] + lane);
    T knee_height = at<T>(p.joints[left_lower_leg][1] + lane);
    LimbSizes<T> leg = limb_sizes(hip_ms.y - knee_height, knee_height - ankle_height);
    FootSizes<T> foot_size{ankle_height,
                           at<T>(p.joints[left_toes][2] + lane) - at<T>(p.joints[left_foot][2] + lane),
                           at<T>(p.joints[left_toes][1] + lane), at<T>(p.heel + lane), at<T>(p.toe + lane)};

    WalkNow<T> walk = walk_now<T>(g, p, lane, hip_ms.y);
    // The ground on which the pelvis rides, below the root.
    V3<T> origin_ws{at<T>(g.x + lane), at<T>(g.base + lane), at<T>(g.z + lane)};
    Foot<T> feet[2] = {pose_foot(g.feet[k_left], g.feet[k_right], lane, walk, foot_size, origin_ws),
                       pose_foot(g.feet[k_right], g.feet[k_left], lane, walk, foot_size, origin_ws)};

    T apart = max(abs(feet[k_left].drop), abs(feet[k_right].drop));
    T fastest = lerp(T(k_fastest_fall), T(k_fastest_down), smoothstep(T(k_step_0), T(k_step_1), apart));
    const Fall<T> fall =
        before ? fall_since(*before, dt, g, lane, origin_ws.y, hips_ms.y, fastest) : no_fall<T>();
    store_place(origin_ws, out.origin, lane);

    Harmonics<T, 3> cycle = harmonics<3>(at<T>(g.phase + lane));
    SinCosOf<T> half = sin_cos(at<T>(g.heading + lane) * T(0.5f));
    Heading<T> heading{half, doubled(half)};
    T astride = bs_of_os(heading, feet[k_left].place_os - feet[k_right].place_os).x;
    PelvisCurves<T> curves = pelvis_curves(g, p, lane, walk, cycle, astride);
    Pelvis<T> pelvis = turned_pelvis(curves, heading, hips_ms, hip_ms);
    raise_pelvis(pelvis, feet, foot_size, leg, walk,
                 pelvis_height(g, p, lane, walk, cycle, hips_ms.y, hip_ms.y), fall, dt);
    store((pelvis.place_os.y - fall.was) * fall.over_dt, out.rising + lane);
    store(pelvis.wanted - pelvis.place_os.y, out.sunk + lane);
    set_joint(out, hips, lane, pelvis.place_os, pelvis.rotation_ws);
    for (int side = 0; side < 2; ++side)
        pose_leg(out, lane, side, pelvis, heading, leg, foot_size, feet[side]);

    Trunk<T> trunk{pelvis.place_os, hips_ms,        pelvis.rotation_ws, pelvis.axes_ws, heading,
                   curves,          walk.amplitude, walk.running,       walk.over};
    pose_trunk(g, p, out, lane, trunk, cycle, origin_ws);
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
