// One chunk of walkers, from gait to joints: feet first, then the pelvis over them, then everything above.
#if defined(FLANEUR_SIM_POSE_WALK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLANEUR_SIM_POSE_WALK_INL_H
#undef FLANEUR_SIM_POSE_WALK_INL_H
#else
#define FLANEUR_SIM_POSE_WALK_INL_H
#endif

#include "sim/ik/limb-inl.h"
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

// Where the pelvis goes: along the way of the walker, swaying over the leg that carries it, at the height at
// which that leg has the knee of the normal walk.
template <class T>
HWY_INLINE void raise_pelvis(Pelvis<T>& pelvis, Foot<T> (&feet)[2], const FootSizes<T>& foot_size,
                             const LimbSizes<T>& leg, T base, T load, T crouch, T lift) {
    T one = T(1.0f);
    T squares = leg.upper * leg.upper + leg.lower * leg.lower, product = T(2.0f) * leg.upper * leg.lower;
    T least = leg.upper * leg.upper * T(0.8f);
    T full = (leg.upper + leg.lower) * T(0.998f), full2 = full * full;
    T wanted = T(0.0f), limits[2];
    for (int side = 0; side < 2; ++side) {
        const Foot<T>& foot = feet[side];
        T hip_up = pelvis.to_hip[side].y;
        V3<T> ankle = ankle_of(foot);
        T x = pelvis.place.x + pelvis.to_hip[side].x - ankle.x,
          z = pelvis.place.z + pelvis.to_hip[side].z - ankle.z;
        T flat2 = x * x + z * z;
        T above = root(larger(squares + product * foot.knee - flat2, least)) - hip_up;
        wanted = wanted + (above + ankle.y - foot.place.y) * (side == k_left ? load : one - load);
        limits[side] = root(larger(full2 - flat2, least)) + ankle.y - hip_up;
    }
    // Never so high that a planted leg would be stretched, rounded so that the knee does not snap straight;
    // but a leg about to leave may be: its heel gives.
    T y = base + wanted - crouch;
    for (int side = 0; side < 2; ++side) {
        T limit = smaller(limits[side] + feet[side].slack, y + T(0.3f));
        y = soft_smaller(y, limit, T(k_straight));
    }
    pelvis.place.y = y + lift;
    for (int side = 0; side < 2; ++side) {
        V3<T> hip = pelvis.place + pelvis.to_hip[side];
        raise_heel(feet[side], foot_size, hip, full);
        raise_heel(feet[side], foot_size, hip, full);
    }
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
    Foot<T> feet[2] = {pose_foot(g.feet[k_left], lane, stride, foot_size),
                       pose_foot(g.feet[k_right], lane, stride, foot_size)};

    // Pelvis: list, rotation and sway from the curves.
    Harmonics<T, 3> cycle = harmonics<3>(phase);
    T style = at<T>(p.sway + lane), walk = amplitude * style;
    T list = curve_at(k_norm_pelvic_list, cycle) * walk;
    T turn = curve_at(k_norm_pelvic_rotation, cycle) * walk;
    T sway = cycle.sine[0] * mixed(T(0.004f), T(k_sway), amplitude) * style;
    SineCosine<T> half = sine_cosine(at<T>(g.heading + lane) * T(0.5f));
    Heading<T> heading{half, doubled(half)};
    T lean = at<T>(p.lean + lane);

    Pelvis<T> pelvis;
    pelvis.rotation =
        turned_yzx(plus(heading.half, half_turn(zero - turn)), half_turn(list), half_turn(lean * T(0.3f)));
    pelvis.axes = axes_of(pelvis.rotation);
    pelvis.place = {at<T>(g.x + lane) + heading.whole.cosine * sway, zero,
                    at<T>(g.z + lane) - heading.whole.sine * sway};
    V3<T> aside = pelvis.axes.x * hip_place.x;
    V3<T> middle =
        pelvis.axes.y * (hip_place.y - hips_place.y) + pelvis.axes.z * (hip_place.z - hips_place.z);
    pelvis.to_hip[k_left] = middle + aside;
    pelvis.to_hip[k_right] = middle - aside;
    raise_pelvis(pelvis, feet, foot_size, leg, at<T>(g.base + lane), at<T>(g.load + lane),
                 at<T>(g.crouch + lane), stride.lift);
    set_joint(out, hips, lane, pelvis.place, pelvis.rotation);

    for (int side = 0; side < 2; ++side) {
        int joint = side == k_left ? left_upper_leg : right_upper_leg;
        const Foot<T>& foot = feet[side];
        V3<T> hip = pelvis.place + pelvis.to_hip[side], ankle = ankle_of(foot);
        V3<T> front = pelvis.axes.z + foot.ahead;
        Limb<T> limb = solve_limb(against(heading, ankle - hip), against(heading, front), leg, 1.0f);
        V3<T> reached = hip + along(heading, limb.end);
        Q4<T> rotation = turned_x(foot.flat, foot.half);
        set_joint(out, joint, lane, hip, after_y(heading.half, limb.upper_rot));
        set_joint(out, joint + 1, lane, hip + along(heading, limb.middle),
                  after_y(heading.half, limb.lower_rot));
        set_joint(out, joint + 2, lane, reached, rotation);
        set_joint(out, joint + 3, lane, ball_of(foot, foot_size, reached),
                  turned_x(foot.flat, foot.toe_half));
    }

    Trunk<T> trunk{pelvis.place, pelvis.rotation, pelvis.axes, hips_place, heading, turn, list,
                   lean,         amplitude};
    pose_trunk(g, p, out, lane, trunk, cycle);
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
