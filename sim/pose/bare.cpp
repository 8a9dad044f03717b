#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/pose/bare.cpp"
#include "sim/pose/bare.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "sim/pose/begun-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

// Legs of the normal walk, from the same sources as norms.h. Thigh against the vertical, forward +; knee
// flexion +.
inline constexpr HarmonicCurve<6> k_norm_thigh = {6.2665f,
                                                  {{16.9229f, -3.4278f},
                                                   {-3.3217f, -0.9492f},
                                                   {-0.2649f, 1.6861f},
                                                   {-0.0433f, -0.2418f},
                                                   {-0.3092f, 0.2139f},
                                                   {0.0613f, 0.0615f}}};
inline constexpr HarmonicCurve<6> k_norm_knee = {22.9480f,
                                                 {{-2.9209f, -20.7971f},
                                                  {-15.6105f, 7.1439f},
                                                  {-1.3223f, 5.0758f},
                                                  {-1.0727f, 0.7181f},
                                                  {-0.6257f, 1.0024f},
                                                  {0.1778f, 0.3064f}}};
inline constexpr float k_norm_step = 0.74f;   // legs, of a step at that speed
inline constexpr float k_most_swings = 1.6f;  // of the curves, which grow with the steps

// A leg that knows nothing of the ground: hip, knee and foot turn by their curves, in the plane of the
// heading.
template <class T>
HWY_INLINE void swing_leg(const GaitBlock& g, PoseBlock& out, size_t lane, int side, const Begun<T>& b) {
    const Foot<T>& foot = b.feet[side];
    const FootTime<T> time = foot_time(at<T>(g.feet[side].phase + lane), b.walk);
    T grows = clamp(at<T>(g.step + lane) * T(1 / k_norm_step), T(0.0f), T(k_most_swings));
    T thigh = curve_at(k_norm_thigh, time.wave) * b.walk.ahead * grows;
    T knee = max(curve_at(k_norm_knee, time.wave), T(0.0f)) * b.walk.amplitude * grows;
    Q4<T> level_ws = flat_on_ground(T(0.0f), T(0.0f), b.heading.half);
    Q4<T> upper_ws = turned_x(level_ws, sin_cos_half(T(0.0f) - thigh));
    Q4<T> lower_ws = turned_x(level_ws, sin_cos_half(knee - thigh));
    V3<T> hip_os = b.pelvis.place_os + b.pelvis.to_hip_ws[side];
    V3<T> knee_os = hip_os - axes_of(upper_ws).y * b.leg.upper;
    V3<T> ankle_os = knee_os - axes_of(lower_ws).y * b.leg.lower;
    Foot<T> level = foot;
    Axes<T> axes_ws = axes_of(level_ws);
    level.up_ws = axes_ws.y, level.ahead_ws = axes_ws.z;
    int joint = side == k_left ? left_upper_leg : right_upper_leg;
    set_joint(out, joint, lane, hip_os, upper_ws);
    set_joint(out, joint + 1, lane, knee_os, lower_ws);
    set_joint(out, joint + 2, lane, ankle_os, turned_x(level_ws, foot.half));
    set_joint(out, joint + 3, lane, ball_of(level, b.foot_size, ankle_os), turned_x(level_ws, foot.toe_half));
}

template <class T>
HWY_INLINE void raise_heels(Begun<T>& b) {
    T full = (b.leg.upper + b.leg.lower) * T(k_straightest);
    for (int side = 0; side < 2; ++side)
        for (int pass = 0; pass < 2; ++pass)
            raise_heel(b.feet[side], b.foot_size, b.pelvis.place_os + b.pelvis.to_hip_ws[side], full);
}

template <class T>
HWY_INLINE void pose_bare_chunk(const GaitBlock& g, const PersonBlock& p, Techniques on,
                                const PoseBlock& whole, PoseBlock& out, size_t lane) {
    Begun<T> b = begin_body<T>(g, p, lane);
    store_place(b.origin_ws, out.origin, lane);
    store(at<T>(whole.rising + lane), out.rising + lane);
    store(at<T>(whole.sunk + lane), out.sunk + lane);
    if (on.pelvis)
        b.pelvis.place_os = load_place<T>(whole.position[hips], lane);
    else
        b.pelvis.place_os.y = curve_height(b.pelvis, b.foot_size, b.leg, b.walk, b.height) + b.walk.lift;
    set_joint(out, hips, lane, b.pelvis.place_os, b.pelvis.rotation_ws);
    if (on.heels) raise_heels(b);
    for (int side = 0; side < 2; ++side) {
        if (!on.heels) b.feet[side].leaving = b.feet[side].rolls = b.feet[side].swings = T(0.0f);
        if (on.feet)
            pose_leg(out, lane, side, b.pelvis, b.heading, b.leg, b.foot_size, b.feet[side]);
        else
            swing_leg(g, out, lane, side, b);
    }
    if (!on.trunk) {
        b.heading.half = plus(b.heading.half, sin_cos_half(T(0.0f) - b.curves.turn));
        b.heading.whole = doubled(b.heading.half);
        b.curves.list = b.curves.list * T(1 / k_chest_list);
        b.curves.twist = T(0.0f);
    }
    Trunk<T> trunk{b.pelvis.place_os, b.hips_ms,        b.pelvis.rotation_ws, b.pelvis.axes_ws, b.heading,
                   b.curves,          b.walk.amplitude, b.walk.running,       b.walk.over};
    pose_trunk(g, p, out, lane, trunk, b.cycle, b.origin_ws);
}

void pose_bare_here(const Gait& gait, size_t begin, size_t end, Techniques on, const PoseBlock* whole,
                    PoseBlock* poses) {
    for (size_t n = begin; n < end; ++n) {
        GaitBlock g = gait.blocks[n];
        auto clear = [](auto& row) { std::fill(std::begin(row), std::end(row), 0.0f); };
        if (!on.look) clear(g.look);
        for (int side = 0; side < 2; ++side) {
            if (!on.walls) clear(g.hands[side].reach);
            if (!on.holds) clear(g.holds[side].weight);
            if (on.soles) continue;
            for (FootPlaces* places : {&g.feet[side].from, &g.feet[side].to})
                clear(places->normal_x), clear(places->normal_z);
        }
        for (size_t lane = 0; lane < k_block; lane += lane_count())
            pose_bare_chunk<Lanes>(g, gait.people[n], on, whole[n], poses[n], lane);
    }
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flaneur {

HWY_EXPORT(pose_bare_here);

void pose_bare(const Gait& gait, size_t begin, size_t end, Techniques on, const std::vector<PoseBlock>& whole,
               std::vector<PoseBlock>& poses) {
    HWY_DYNAMIC_DISPATCH(pose_bare_here)(gait, begin, end, on, whole.data(), poses.data());
}

}  // namespace flaneur
#endif
