// One chunk of walkers, from gait to joints: feet first, then the pelvis over them, then everything above.
#if defined(FLANEUR_SIM_POSE_WALK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLANEUR_SIM_POSE_WALK_INL_H
#undef FLANEUR_SIM_POSE_WALK_INL_H
#else
#define FLANEUR_SIM_POSE_WALK_INL_H
#endif

#include "sim/ik/two_bone-inl.h"
#include "sim/pose/foot-inl.h"
#include "sim/pose/trunk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

// The pelvis and the legs that carry it.
template <class T>
struct Pelvis {
    V3<T> place;
    Q4<T> rotation;
    Axes<T> axes;
    V3<T> to_hip[2];  // from its centre to the hip joints, in the world
};

// What raises and lowers the pelvis besides the legs, metres.
template <class T>
struct Height {
    T load;    // share of the body on the left leg
    T bob;     // added as it passes over a leg
    T bounce;  // of a run: up in flight, down in stance
    T crouch;
};

// Where the pelvis goes: along the way of the walker, swaying over the leg that carries it, at the height at
// which that leg has the knee of the normal walk. A runner's bounces instead.
template <class T>
HWY_INLINE void raise_pelvis(Pelvis<T>& pelvis, Foot<T> (&feet)[2], const FootSizes<T>& foot_size,
                             const LimbSizes<T>& leg, const Stride<T>& stride, const Height<T>& height) {
    T one = T(1.0f);
    T squares = leg.upper * leg.upper + leg.lower * leg.lower, product = T(2.0f) * leg.upper * leg.lower;
    T least = leg.upper * leg.upper * T(0.8f);
    T full = (leg.upper + leg.lower) * T(k_straightest), full2 = full * full;
    T wanted = height.bob, limits[2];
    for (int side = 0; side < 2; ++side) {
        const Foot<T>& foot = feet[side];
        T hip_up = pelvis.to_hip[side].y;
        V3<T> ankle = ankle_of(foot);
        T x = pelvis.place.x + pelvis.to_hip[side].x - ankle.x,
          z = pelvis.place.z + pelvis.to_hip[side].z - ankle.z;
        T flat2 = x * x + z * z;
        T above = root(larger(squares + product * foot.knee - flat2, least)) - hip_up;
        wanted =
            wanted + (above + ankle.y - foot.place.y) * (side == k_left ? height.load : one - height.load);
        limits[side] = root(larger(full2 - flat2, least)) + ankle.y - hip_up;
    }
    if (any(stride.running > T(0.0f))) {
        T run = root(squares + product * T(k_run_knee_cosine)) - pelvis.to_hip[k_left].y + foot_size.ankle;
        wanted = mixed(wanted, run + height.bounce, stride.running);
    }
    // Never so high that a planted leg would be stretched, rounded so that the knee does not snap straight;
    // but a leg about to leave may be: its heel gives.
    T y = wanted - height.crouch;
    for (int side = 0; side < 2; ++side)
        y = soft_smaller(y, smaller(limits[side] - stride.lift + feet[side].slack, y + T(0.3f)),
                         T(k_straight));
    pelvis.place.y = y + stride.lift;
    for (int side = 0; side < 2; ++side) {
        V3<T> hip = pelvis.place + pelvis.to_hip[side];
        raise_heel(feet[side], foot_size, hip, full);
        raise_heel(feet[side], foot_size, hip, full);
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
    T distance = root(distance2), excess = clamped(distance - near, T(0.0f), give + give);
    T d = smaller(distance, reach + give) - excess * excess * T(0.25f) / larger(give, T(1e-6f));
    T scale = select(far, d / distance, T(1.0f));
    return to_ankle * scale;
}

template <class T>
HWY_INLINE void pose_chunk(const GaitBlock& g, const PersonBlock& p, PoseBlock& out, size_t lane) {
    T zero = T(0.0f), one = T(1.0f);
    T phase = at<T>(g.phase + lane), amplitude = at<T>(g.amplitude + lane);
    V3<T> hips_place = joint_place<T>(p, hips, lane), hip_place = joint_place<T>(p, left_upper_leg, lane);
    T ankle_height = at<T>(p.joints[left_foot][1] + lane);
    T knee_height = at<T>(p.joints[left_lower_leg][1] + lane);
    LimbSizes<T> leg = limb_sizes(hip_place.y - knee_height, knee_height - ankle_height);
    FootSizes<T> foot_size{ankle_height,
                           at<T>(p.joints[left_toes][2] + lane) - at<T>(p.joints[left_foot][2] + lane),
                           at<T>(p.joints[left_toes][1] + lane), at<T>(p.heel + lane), at<T>(p.toe + lane)};

    Stride<T> stride;
    stride.duty = at<T>(g.duty + lane);
    stride.over_duty = T(k_norm_toe_off) / stride.duty;
    stride.over_swing = one / (one - stride.duty);
    stride.amplitude = amplitude;
    stride.ahead = amplitude * larger(at<T>(g.course + lane), zero);
    stride.running = at<T>(g.running + lane);
    stride.lift = at<T>(g.lift + lane);
    // The ground on which the pelvis rides, below the root.
    V3<T> origin{at<T>(g.x + lane), at<T>(g.base + lane), at<T>(g.z + lane)};
    store_place(origin, out.origin, lane);
    Foot<T> feet[2] = {pose_foot(g.feet[k_left], g.feet[k_right], lane, stride, foot_size, origin),
                       pose_foot(g.feet[k_right], g.feet[k_left], lane, stride, foot_size, origin)};

    // Pelvis: list, rotation and sway from the curves.
    Harmonics<T, 3> cycle = harmonics<3>(phase);
    T style = at<T>(p.sway + lane), walk = amplitude * style;
    // One who stands leans over the leg that carries most.
    T load = at<T>(g.load + lane), idle = (load - T(0.5f)) * (one - amplitude);
    T list = curve_at(k_norm_pelvic_list, cycle) * walk + idle * T(0.08f);
    T turn = curve_at(k_norm_pelvic_rotation, cycle) * walk;
    T slow = stride.duty - T(k_norm_duty);
    T sway = cycle.sine[0] * style * amplitude * larger(T(k_sway) + T(k_sway_slow) * slow, T(0.008f)) +
             idle * T(0.06f);
    SineCosine<T> half = sine_cosine(at<T>(g.heading + lane) * T(0.5f));
    Heading<T> heading{half, doubled(half)};
    T lean = at<T>(p.lean + lane) + clamped(at<T>(g.rise + lane), T(-0.3f), T(0.6f)) * T(0.3f) +
             stride.running * T(k_run_lean);

    Pelvis<T> pelvis;
    pelvis.rotation =
        turned_yzx(plus(heading.half, half_turn(zero - turn)), half_turn(list), half_turn(lean * T(0.3f)));
    pelvis.axes = axes_of(pelvis.rotation);
    T surge = (cycle.cosine[1] * T(k_surge_cosine) + cycle.sine[1] * T(k_surge_sine)) * amplitude;
    pelvis.place = along(heading, V3<T>{sway, zero, surge});
    V3<T> aside = pelvis.axes.x * hip_place.x;
    V3<T> middle =
        pelvis.axes.y * (hip_place.y - hips_place.y) + pelvis.axes.z * (hip_place.z - hips_place.z);
    pelvis.to_hip[k_left] = middle + aside;
    pelvis.to_hip[k_right] = middle - aside;
    Height<T> height;
    height.load = load;
    height.crouch = at<T>(g.crouch + lane) + at<T>(p.crouch + lane);
    // cos of twice (phase - k_high).
    T over_foot = cycle.cosine[1] * T(k_high_cosine) + cycle.sine[1] * T(k_high_sine);
    height.bob = (one + over_foot) * larger(T(k_bob) + T(k_bob_slow) * slow, zero) * amplitude;
    // Lowest when half the time on the ground is over.
    SineCosine<T> middle_of_stance = doubled(doubled(half_turn(stride.duty * T(k_pi))));
    height.bounce = (cycle.cosine[1] * middle_of_stance.cosine + cycle.sine[1] * middle_of_stance.sine) *
                    T(0.0f - k_bounce);
    raise_pelvis(pelvis, feet, foot_size, leg, stride, height);
    set_joint(out, hips, lane, pelvis.place, pelvis.rotation);

    for (int side = 0; side < 2; ++side) {
        int joint = side == k_left ? left_upper_leg : right_upper_leg;
        Foot<T>& foot = feet[side];
        V3<T> hip = pelvis.place + pelvis.to_hip[side];
        // The knee looks where pelvis and foot do; never backwards in the frame of the body.
        V3<T> front = against(heading, pelvis.axes.z + foot.ahead);
        SineCosine<T> half_front = plus(heading.half, half_yaw_to(front.x, front.z));
        // Where the shin tilts too far, the heel of a foot on the ground comes up, which bends the knee anew;
        // in the air the toes hang.
        auto stands = (foot.swings <= zero) & (foot.half.sine >= zero);
        Limb<T> limb;
        for (int pass = 0;; ++pass) {
            limb = two_bone(within_reach(ankle_of(foot) - hip, leg, foot.give), half_front, leg, 1.0f, 0.0f);
            auto tilted = stands;
            SineCosine<T> over =
                over_tilt(foot, (limb.middle - limb.end) * (leg.over_lower * T(4.0f)), tilted);
            if (!any(tilted)) break;
            if (pass < 2 && any(tilted & stands)) {
                turn_over_ball(tilted & stands, foot, foot_size, over);
                continue;
            }
            auto hangs = tilted & (foot.swings > zero);
            turn_if(hangs, foot.half, over);
            turn_if(hangs, foot.toe_half, over);
            break;
        }
        V3<T> reached = hip + limb.end;
        Q4<T> rotation = turned_x(foot.flat, foot.half);
        set_joint(out, joint, lane, hip, limb.upper_rot);
        set_joint(out, joint + 1, lane, hip + limb.middle, limb.lower_rot);
        set_joint(out, joint + 2, lane, reached, rotation);
        set_joint(out, joint + 3, lane, ball_of(foot, foot_size, reached),
                  turned_x(foot.flat, foot.toe_half));
    }

    Trunk<T> trunk{pelvis.place, pelvis.rotation, pelvis.axes,    hips_place, heading, turn, list,
                   lean,         amplitude,       stride.running, slow};
    pose_trunk(g, p, out, lane, trunk, cycle, origin);
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
