// One foot of a chunk of walkers: where it is, how it is pitched, over float or Lanes.
//
// Spaces, here, in trunk-inl.h and in walk-inl.h, by the ends of names:
//   _ws  the world's axes and, of places, the world's origin
//   _os  places from `origin_ws`, the ground below the walker, along the world's axes: as exact far out in a
//        city as at its middle. Directions and rotations are the world's.
//   _bs  the body's: from the same origin, turned with the heading, +z ahead
//   _cs  the chest's axes, from the shoulder
//   _ms  the model's: the canonical pose, see sim/body/body.h
// Names without an end are numbers that need none, or places in a plane that their struct describes.
#if defined(FLANEUR_SIM_POSE_FOOT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLANEUR_SIM_POSE_FOOT_INL_H
#undef FLANEUR_SIM_POSE_FOOT_INL_H
#else
#define FLANEUR_SIM_POSE_FOOT_INL_H
#endif

#include "sim/base/vec-inl.h"
#include "sim/gait/blocks.h"
#include "sim/gait/curves/curves-inl.h"
#include "sim/gait/curves/fits.h"
#include "sim/gait/curves/swing-inl.h"
#include "sim/ik/foot-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

template <class T>
HWY_INLINE T at(const float* values) {
    T v;
    load(v, values);
    return v;
}

// One who stands lifts a foot by so many metres, and more for steps up to so long; its toes hang by so many
// radians.
inline constexpr float k_small_lift = 0.015f, k_small_more = 0.035f, k_small_step = 0.25f,
                       k_small_droop = 0.2f, k_small_droop_level = 4;

// Radians by which the heel of a foot is up that turns on its ball.
inline constexpr float k_pivot_pitch = 0.1f;

// Metres that a foot swings higher up a step, and a small child's down one.
inline constexpr float k_lifts_up = 0.02f, k_child_lifts_down = 0.018f;

template <class T>
struct FootSizes {
    T ankle;        // height of the ankle over the sole
    T ball;         // from the ankle ahead to the ball
    T ball_height;  // of the toe joint over the sole
    T heel, toe;    // see Body
};

// What the gait wants of a walker now, shared by both feet.
template <class T>
struct WalkNow {
    T duty, over_duty, over_swing;  // duty; its norm's share over it; the same of the swing
    T amplitude, ahead, running, lift;
    T over;               // how much faster than a natural pace, see rise-inl.h
    T leg, pace, reach;   // of a run, see swing-inl.h
    T strike, clearance;  // see PersonBlock
    T climb;              // metres for each metre walked
};

// Where a foot is in its cycle and in its swing.
template <class T>
struct FootTime {
    decltype(T() < T()) planted;
    T norm;  // phase in the cycle of the norms, whose share of stance is its own
    Harmonics<T, 6> wave;
    SwingTime<T> swing;  // u is 0 on the ground
};
template <class T>
HWY_INLINE FootTime<T> foot_time(T phase, const WalkNow<T>& walk) {
    auto planted = phase < walk.duty;
    T u = select(planted, T(0.0f), (phase - walk.duty) * walk.over_swing);
    T norm = select(planted, phase * walk.over_duty, T(k_norm_toe_off) + u * T(1.0f - k_norm_toe_off));
    return {planted, norm, harmonics<6>(norm), swing_time(u)};
}

// The foot moves in the plane of its own `up` and `ahead`, in which places have two coordinates, metres from
// `place_os`.
template <class T>
struct Foot {
    Q4<T> flat_ws;          // of the foot if it stood flat
    V3<T> place_os;         // on the ground below the flat foot's ankle
    V3<T> up_ws, ahead_ws;  // axes of the flat foot
    T ankle_up, ankle_ahead;
    SinCosOf<T> half, toe_half;  // of the turns of foot and toes about x, toes down +
    T leaving;                   // 0 while the body rests on it .. 1 at toe-off
    T slack;   // metres that the leg may fall short: none as it lands and stands, some as it leaves
    T give;    // metres before its reach from which on a swinging leg gives way
    T rolls;   // 0 .. 1: how far a foot gives way over its ball, on the ground or leaving it, to a shin that
               // tilts
    T swings;  // 1 in the swing, 0 on the ground
    T drop;    // metres from the slope underfoot to the other foot
};

template <class T>
HWY_INLINE V3<T> from_place(const Foot<T>& foot, T up, T ahead) {
    return foot.place_os + foot.up_ws * up + foot.ahead_ws * ahead;
}
template <class T>
HWY_INLINE V3<T> ankle_of(const Foot<T>& foot) {
    return from_place(foot, foot.ankle_up, foot.ankle_ahead);
}
// The toe joint, for the ankle at `ankle_os`.
template <class T>
HWY_INLINE V3<T> ball_of(const Foot<T>& foot, const FootSizes<T>& size, V3<T> ankle_os) {
    SinCosOf<T> tilt = doubled(foot.half);
    T down = size.ball_height - size.ankle;
    return ankle_os + foot.up_ws * (down * tilt.cosine - size.ball * tilt.sine) +
           foot.ahead_ws * (size.ball * tilt.cosine + down * tilt.sine);
}

// How far a foot has gone over to landing on its ball, 0..1: one who does points the foot down before and
// sets the heel down after.
template <class T>
HWY_INLINE T landing_on_ball(const FootTime<T>& time, T forefoot) {
    return select(time.planted, heel_up_after(time.norm), smoothstep(T(0.45f), T(0.9f), time.swing.u)) *
           forefoot;
}

// The pitch of the foot against the flat one, toes up +, radians: the norm's, with what standing flat, steps
// down (`drop` metres from the slope underfoot to the other foot), a run, landing on the ball and turning on
// it make of it.
template <class T>
HWY_INLINE T foot_pitch(const FootTime<T>& time, const WalkNow<T>& walk, T drop, T landing, T pivots) {
    T zero = T(0.0f), one = T(1.0f), norm = time.norm;
    T pitch = curve_at(k_norm_foot_pitch, time.wave) * walk.ahead * (one + T(k_pitch_pace) * walk.over);
    T rolling = select(pitch > zero, one - smoothstep(T(0.06f), T(0.12f), norm),
                       smoothstep(T(k_heel_off_0), T(k_heel_off_1), norm));
    // The toes hang, but over steps.
    T level = one - smoothstep(abs(walk.climb) * T(k_small_droop_level));
    T droop = T(k_droop) * walk.ahead + T(k_small_droop) * (one - walk.amplitude) * level;
    pitch = select(time.planted, pitch * rolling, pitch - droop * time.swing.hop);
    pitch = select(pitch > zero, pitch * T(k_heel_strike) * walk.strike, pitch);
    T before_toe_off = one - smoothstep(T(0.5f), T(k_norm_toe_off), norm);
    T rises = smoothstep(T(0.36f), T(0.48f), norm) * before_toe_off;
    pitch = pitch - rises * T(k_heel_rise) * walk.ahead;
    T pushes = smoothstep(T(0.48f), T(k_norm_toe_off), norm) * (one - smoothstep(T(0.63f), T(0.8f), norm));
    pitch = pitch - pushes * T(k_push_pace) * max(walk.over, zero) * walk.ahead;
    // Who lets the body down onto a lower step stands on the ball meanwhile: shins tilt only so far.
    auto lets_down = time.planted & (drop > T(k_drop_0));
    if (any(lets_down)) {
        T down = smoothstep(T(0.32f), T(0.50f), norm) * T(k_tiptoe);
        T share = smoothstep(T(k_drop_0), T(k_drop_1), drop);
        pitch = select(lets_down, lerp(pitch, soft_min(pitch, zero - down, down * T(k_tiptoe_soft)), share),
                       pitch);
    }
    if (any(walk.running > zero)) {
        T stands = select(time.planted, norm * T(1 / k_norm_toe_off), one);
        T run = run_pitch(stands, time.swing.u, walk.pace, walk.reach) * walk.ahead;
        pitch = select(walk.running > zero, lerp(pitch, run, walk.running), pitch);
    }
    return lerp(pitch, T(k_forefoot_pitch), landing) - pivots * T(k_pivot_pitch);
}

// Metres between the lowest point of a swinging foot and the ground; `far2` is the square of its way.
template <class T>
HWY_INLINE T swing_clearance(const SwingTime<T>& swing, const WalkNow<T>& walk, T far2) {
    T u = swing.u, rest = swing.rest;
    T small = T(k_small_lift) + T(k_small_more) * smoothstep(far2 * T(1 / (k_small_step * k_small_step)));
    T clearance = lerp(
        swing.hop * small,
        T(k_clear_early) * (T(1.0f) + T(k_clear_pace) * walk.over) * swing.product2 * rest * rest * rest +
            (T(k_clear) + walk.clearance) * swing.hop + T(k_clear_late) * u * u * u * rest,
        walk.amplitude);
    if (!any(walk.running > T(0.0f))) return clearance;
    T run = run_clearance(u, rest, walk.pace) * walk.leg;
    return select(walk.running > T(0.0f), lerp(clearance, run, walk.running), clearance);
}

// Sets turns and ankle of a foot with this pitch whose lowest point, among heel, ball and tip of the toes, is
// `clearance` above the ground. Planted, it has its pivot where that stands on the ground: the heel while the
// toes point up, else the ball. In the swing the pivot wanders from ball back to heel.
//
// The ankle is `ankle` above the sole: turned by `pitch` about the heel it comes to stand ankle cos + heel
// sin above the ground. Over the ball the foot turns about the toe joint, below which the toes stay flat.
template <class T>
HWY_INLINE void pitch_foot(Foot<T>& out, const FootTime<T>& time, const FootSizes<T>& size, T pitch,
                           T landing, T clearance) {
    T zero = T(0.0f), one = T(1.0f), u = time.swing.u;
    auto toes_up = pitch > zero;
    T toe_pitch = select(toes_up, pitch, pitch * smoothstep(u * T(2.5f)) * (one - landing) * T(k_toes));
    out.half = sin_cos_half(zero - pitch);
    out.toe_half = sin_cos_half(zero - toe_pitch);
    SinCosOf<T> tilt = doubled(out.half);
    T cosine = tilt.cosine, sine = zero - tilt.sine;

    SinCosOf<T> toe_tilt = doubled(out.toe_half);
    T instep = size.ankle - size.ball_height;  // of the ankle over the toe joint
    T over_heel = size.ankle * cosine + size.heel * sine;
    T over_ball = instep * cosine - size.ball * sine + size.ball_height * toe_tilt.cosine;
    T over_tip = over_ball + size.toe * toe_tilt.sine;
    T soft = T(k_soft) * time.swing.hop;
    out.ankle_up = soft_max(over_heel, soft_max(over_ball, over_tip, soft), soft) + clearance;

    T from_heel = size.heel * cosine - size.ankle * sine - size.heel;
    T from_ball = size.ball - size.ball * cosine - instep * sine;
    out.ankle_ahead =
        lerp(from_ball, from_heel, select(time.planted, select(toes_up, one, zero), smoothstep(u)));
}

// The ends of a way between two places, from `origin_ws`.
template <class T>
HWY_INLINE SwingEnds<T> swing_ends(const FootPlaces& from, const FootPlaces& to, size_t lane,
                                   V3<T> origin_ws) {
    V3<T> from_ws{at<T>(from.x + lane), at<T>(from.y + lane), at<T>(from.z + lane)};
    V3<T> to_ws{at<T>(to.x + lane), at<T>(to.y + lane), at<T>(to.z + lane)};
    T from_nx = at<T>(from.normal_x + lane), from_nz = at<T>(from.normal_z + lane);
    return {from_ws - origin_ws,
            to_ws - from_ws,
            from_nx,
            from_nz,
            at<T>(to.normal_x + lane) - from_nx,
            at<T>(to.normal_z + lane) - from_nz};
}

// How far the leg of this foot may be from what its place asks for; see Foot.
template <class T>
HWY_INLINE void bind_leg(Foot<T>& out, const FootTime<T>& time, T forefoot, const WalkNow<T>& walk) {
    T zero = T(0.0f), one = T(1.0f), u = time.swing.u;
    out.swings = select(time.planted, zero, one);
    // A body that has left a foot far behind lifts its heel earlier, and more.
    T behind = smoothstep(T(k_behind_0), T(k_behind_1), (zero - dot(out.place_os, out.ahead_ws)) / walk.leg);
    T leaves = max(smoothstep(T(0.375f), T(0.55f), time.norm), behind);
    out.leaving = select(time.planted, leaves, zero);
    T gives = T(k_leaving_slack) + behind * T(k_behind_slack) + max(walk.climb, zero) * T(k_climb_slack);
    T since_flat = smoothstep(T(0.11f), T(0.2f), time.norm);
    T rolls = select(out.half.sine > T(-1e-3f), max(forefoot, since_flat), zero);
    out.rolls = select(time.planted, rolls, one - smoothstep(zero, T(k_let_go), u));
    out.give = select(time.planted, zero,
                      T(k_give) * smoothstep(zero, T(0.15f), u) * (one - smoothstep(T(0.7f), T(0.92f), u)));
    // Let go little by little, and bound again before it lands; in a run, as it lands.
    T free = T(k_landing_slack) * (one - smoothstep(T(k_landing), one, u)) +
             T(0.3f) * (one - smoothstep(T(0.5f), T(k_landing), u));
    out.slack = select(time.planted, out.leaving * gives,
                       lerp(gives, free, smoothstep(zero, T(0.35f), u)) + walk.running * T(0.3f));
}

// Heel, flat foot, ball: a planted foot rolls over the heel while its toes point up and over the ball when
// the heel has left, and neither point moves. In the swing the foot goes from one place to the next, its
// lowest point just above the ground.
template <class T>
HWY_INLINE Foot<T> pose_foot(const FootBlock& f, const FootBlock& other, size_t lane, const WalkNow<T>& walk,
                             const FootSizes<T>& size, V3<T> origin_ws) {
    FootTime<T> time = foot_time(at<T>(f.phase + lane), walk);
    T forefoot = at<T>(f.forefoot + lane), landing = landing_on_ball(time, forefoot);
    T drop = T(0.0f) - step_between(swing_ends(f.from, other.to, lane, origin_ws));
    T pitch = foot_pitch(time, walk, drop, landing, at<T>(f.pivots + lane));
    SwingEnds<T> ends = swing_ends(f.from, f.to, lane, origin_ws);
    T clearance = swing_clearance(time.swing, walk, ends.far.x * ends.far.x + ends.far.z * ends.far.z);

    Foot<T> out;
    out.drop = drop;
    pitch_foot(out, time, size, pitch, landing, clearance);
    ends.edge = at<T>(f.edge + lane);
    SwingPath<T> path = swing_path(ends, time.swing, walk.running, walk.pace);
    // Up a step, knees rise high; down, the way itself is clear of the ground left, but for short legs.
    if (any(path.steep > T(0.0f))) {
        T zero = T(0.0f), lifts = time.swing.hop * path.steep;
        T small = select(walk.leg < T(k_both_feet_leg), lifts * T(k_child_lifts_down), zero);
        out.ankle_up =
            out.ankle_up + select(path.step > zero, lifts * T(k_lifts_up), small - clearance * path.steep);
    }
    out.place_os = path.place;
    out.place_os.y = path.place.y + at<T>(f.obstacle + lane) * time.swing.hop + walk.lift;

    T yaw = lerp(at<T>(f.from.yaw + lane), at<T>(f.to.yaw + lane), path.progress);
    T nx = ends.from_nx + ends.far_nx * path.progress, nz = ends.from_nz + ends.far_nz * path.progress;
    out.flat_ws = flat_on_ground(nx, nz, sin_cos(yaw * T(0.5f)));
    Axes<T> axes_ws = axes_of(out.flat_ws);
    out.up_ws = axes_ws.y;
    out.ahead_ws = axes_ws.z;
    out.place_os = out.place_os + axes_ws.x * (at<T>(f.round + lane) * round_at(time.swing.hop));
    bind_leg(out, time, forefoot, walk);
    return out;
}

// Shins tilt over a foot only so far: beyond the first angle ever less, to the second at most (sines of 26
// and 36 degrees). Half the turn, toes down, by which `shin_ws`, a unit vector up along it, is tilted
// farther, in the lanes that become `tilted`; a foot that has just come flat begins to give way gently.
inline constexpr float k_tilt_free = 0.438f, k_tilt_gives = 0.15f;
template <class T, class M>
HWY_INLINE SinCosOf<T> over_tilt(const Foot<T>& foot, V3<T> shin_ws, M& tilted) {
    SinCosOf<T> tilt = doubled(foot.half);
    T up = dot(foot.up_ws, shin_ws), ahead = dot(foot.ahead_ws, shin_ws);
    T sine = ahead * tilt.cosine - up * tilt.sine, cosine = up * tilt.cosine + ahead * tilt.sine;
    T excess = sine - T(k_tilt_free);
    tilted = excess > T(0.0f);
    if (!any(tilted)) return {};
    T over = T(1.0f) / (sine * sine + cosine * cosine);
    excess = min(select(cosine > T(0.0f), excess, T(1.0f)), T(2 * k_tilt_gives));
    T allowed = T(k_tilt_free) + excess - excess * excess * T(0.25f / k_tilt_gives);
    T rest = sqrt(max(sine * sine + cosine * cosine - allowed * allowed, T(0.0f)));
    T half = sqrt(max(T(0.5f) + T(0.5f) * over * (cosine * rest + sine * allowed), T(1e-6f)));
    T sine_half = T(0.5f) * over * (sine * rest - cosine * allowed) / half;
    sine_half = sine_half * max(foot.rolls, foot.swings);
    return {sine_half, sqrt(max(T(1.0f) - sine_half * sine_half, T(0.0f)))};
}

template <class T, class M>
HWY_INLINE void turn_if(M turns, SinCosOf<T>& half, SinCosOf<T> by) {
    SinCosOf<T> turned = plus(half, by);
    half = {select(turns, turned.sine, half.sine), select(turns, turned.cosine, half.cosine)};
}

// Where the ankle is of a foot whose ball stands on its way.
template <class T>
struct OverBall {
    T up, ahead;
};
template <class T>
HWY_INLINE OverBall<T> over_ball(const Foot<T>& foot, const FootSizes<T>& size) {
    SinCosOf<T> tilt = doubled(foot.half), toes = doubled(foot.toe_half);
    T instep = size.ankle - size.ball_height;
    return {instep * tilt.cosine + size.ball * tilt.sine + size.ball_height * toes.cosine +
                max(size.toe * toes.sine, T(0.0f)),
            size.ball - size.ball * tilt.cosine + instep * tilt.sine};
}

// Turns a foot toes down over its ball, by twice `half`; neither ball nor toes come below its way.
template <class T, class M>
HWY_INLINE void turn_over_ball(M turns, Foot<T>& foot, const FootSizes<T>& size, SinCosOf<T> half) {
    OverBall<T> was = over_ball(foot, size);
    turn_if(turns, foot.half, half);
    OverBall<T> is = over_ball(foot, size);
    T share = select(foot.swings > T(0.0f), foot.rolls, T(1.0f));
    T up = max(foot.ankle_up + (is.up - was.up) * share, is.up);
    foot.ankle_up = select(turns, up, foot.ankle_up);
    foot.ankle_ahead = select(turns, foot.ankle_ahead + (is.ahead - was.ahead) * share, foot.ankle_ahead);
}

// Reaches along the ground, whichever way, from which on a leaving leg bends, by so much of what is beyond.
inline constexpr float k_back = 0.55f, k_back_bends = 0.15f;

// Turns a leaving foot further over its ball until the ankle is within `reach` of the hip: one Newton step on
// the angle. Which legs were too short.
template <class T>
HWY_INLINE auto raise_heel(Foot<T>& foot, const FootSizes<T>& size, V3<T> hip_os, T reach) {
    V3<T> to_hip = hip_os - ankle_of(foot);
    T distance2 = dot(to_hip, to_hip);
    // Hips turn only so far: a leg that points farther bends its knee.
    T back = sqrt(to_hip.x * to_hip.x + to_hip.z * to_hip.z) - reach * T(k_back);
    reach = reach - max(back, T(0.0f)) * T(k_back_bends);
    auto short_leg = (foot.leaving > T(0.0f)) & (foot.half.sine >= T(0.0f)) & (distance2 > reach * reach);
    if (!any(short_leg)) return short_leg;
    T distance = sqrt(distance2);
    // How fast the ankle nears the hip as the heel rises: d/dpitch of its place in the foot's plane.
    SinCosOf<T> tilt = doubled(foot.half);
    T cosine = tilt.cosine, sine = T(0.0f) - tilt.sine;
    T instep = size.ankle - size.ball_height;
    T move_up = instep * sine + size.ball * cosine, move_ahead = instep * cosine - size.ball * sine;
    T gain = (dot(foot.up_ws, to_hip) * move_up + dot(foot.ahead_ws, to_hip) * move_ahead) / distance;
    T angle = min((distance - reach) / max(gain, T(0.03f)), T(0.3f));
    turn_over_ball(short_leg, foot, size, sin_cos_half(angle));
    return short_leg;
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
