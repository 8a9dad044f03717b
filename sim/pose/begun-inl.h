// A body between its gait and its pose, for those who pose bodies in other ways than walk-inl.h does.
#if defined(FLANEUR_SIM_POSE_BEGUN_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLANEUR_SIM_POSE_BEGUN_INL_H
#undef FLANEUR_SIM_POSE_BEGUN_INL_H
#else
#define FLANEUR_SIM_POSE_BEGUN_INL_H
#endif

#include "sim/pose/walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

// A body before its pelvis is raised, as pose_chunk() has it.
template <class T>
struct Begun {
    V3<T> hips_ms, hip_ms;
    LimbSizes<T> leg;
    FootSizes<T> foot_size;
    WalkNow<T> walk;
    V3<T> origin_ws;  // the ground on which the pelvis rides, below the root
    Foot<T> feet[2];
    Harmonics<T, 3> cycle;
    Heading<T> heading;
    PelvisCurves<T> curves;
    Pelvis<T> pelvis;
    Height<T> height;
};

template <class T>
HWY_INLINE Begun<T> begin_body(const GaitBlock& g, const PersonBlock& p, size_t lane) {
    Begun<T> b;
    b.hips_ms = joint_ms<T>(p, hips, lane);
    b.hip_ms = joint_ms<T>(p, left_upper_leg, lane);
    T ankle_height = at<T>(p.joints[left_foot][1] + lane);
    T knee_height = at<T>(p.joints[left_lower_leg][1] + lane);
    b.leg = limb_sizes(b.hip_ms.y - knee_height, knee_height - ankle_height);
    b.foot_size = {ankle_height, at<T>(p.joints[left_toes][2] + lane) - at<T>(p.joints[left_foot][2] + lane),
                   at<T>(p.joints[left_toes][1] + lane), at<T>(p.heel + lane), at<T>(p.toe + lane)};
    b.walk = walk_now<T>(g, p, lane, b.hip_ms.y);
    b.origin_ws = {at<T>(g.x + lane), at<T>(g.base + lane), at<T>(g.z + lane)};
    for (int side = 0; side < 2; ++side)
        b.feet[side] = pose_foot(g.feet[side], g.feet[1 - side], lane, b.walk, b.foot_size, b.origin_ws);
    b.cycle = harmonics<3>(at<T>(g.phase + lane));
    SinCosOf<T> half = sin_cos(at<T>(g.heading + lane) * T(0.5f));
    b.heading = {half, doubled(half)};
    T astride = bs_of_os(b.heading, b.feet[k_left].place_os - b.feet[k_right].place_os).x;
    b.curves = pelvis_curves(g, p, lane, b.walk, b.cycle, astride);
    b.pelvis = turned_pelvis(b.curves, b.heading, b.hips_ms, b.hip_ms);
    b.height = pelvis_height(g, p, lane, b.walk, b.cycle, b.hips_ms.y, b.hip_ms.y);
    return b;
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
