// One foot of a chunk of walkers: where it is, how it is pitched, over float or Lanes.
#if defined(FLANEUR_SIM_POSE_FOOT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLANEUR_SIM_POSE_FOOT_INL_H
#undef FLANEUR_SIM_POSE_FOOT_INL_H
#else
#define FLANEUR_SIM_POSE_FOOT_INL_H
#endif

#include "sim/base/vec-inl.h"
#include "sim/gait/curves-inl.h"
#include "sim/gait/fits.h"
#include "sim/gait/gait.h"
#include "sim/ik/foot-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

template <class T>
HWY_INLINE T at(const float* values) {
    T v;
    load(v, values);
    return v;
}

template <class T>
struct FootSizes {
    T ankle;        // height of the ankle over the sole
    T ball;         // from the ankle ahead to the ball
    T ball_height;  // of the toe joint over the sole
    T heel, toe;    // see Body
};

// What the gait wants of a walker now, shared by both feet.
template <class T>
struct Stride {
    T duty, over_duty, over_swing;  // duty; its norm's share over it; the same of the swing
    T amplitude, ahead, running, lift;
};

// The foot moves in the plane of its own `up` and `ahead`, in which places have two coordinates.
template <class T>
struct Foot {
    Q4<T> flat;       // of the foot if it stood flat
    V3<T> place;      // on the ground below the flat foot's ankle
    V3<T> up, ahead;  // axes of the flat foot
    T ankle_up, ankle_ahead;
    SineCosine<T> half, toe_half;  // of the turns of foot and toes about x, toes down +
    T knee;                        // cosine of the flexion that the normal walk has now
    T leaving;                     // 0 while the body rests on it .. 1 at toe-off
    T slack;   // metres that the leg may fall short: none as it lands and stands, some as it leaves
    T give;    // metres before its reach from which on a swinging leg gives way
    T swings;  // 1 in the swing, 0 on the ground
};

template <class T>
HWY_INLINE V3<T> from_place(const Foot<T>& foot, T up, T ahead) {
    return foot.place + foot.up * up + foot.ahead * ahead;
}
template <class T>
HWY_INLINE V3<T> ankle_of(const Foot<T>& foot) {
    return from_place(foot, foot.ankle_up, foot.ankle_ahead);
}
// The toe joint, for the ankle at `ankle`.
template <class T>
HWY_INLINE V3<T> ball_of(const Foot<T>& foot, const FootSizes<T>& size, V3<T> ankle) {
    SineCosine<T> tilt = doubled(foot.half);
    T down = size.ball_height - size.ankle;
    return ankle + foot.up * (down * tilt.cosine - size.ball * tilt.sine) +
           foot.ahead * (size.ball * tilt.cosine + down * tilt.sine);
}

// Heel, flat foot, ball: a planted foot rolls over the heel while its toes point up and over the ball when
// the heel has left, and neither point moves. In the swing the pivot wanders from ball back to heel while the
// foot goes from one place to the next, its lowest point just above the ground. Places are from `origin`.
template <class T>
HWY_INLINE Foot<T> pose_foot(const FootBlock& f, const FootBlock& other, size_t lane, const Stride<T>& s,
                             const FootSizes<T>& size, V3<T> origin) {
    T zero = T(0.0f), one = T(1.0f);
    T phase = at<T>(f.phase + lane);
    auto planted = phase < s.duty;
    T u = select(planted, zero, (phase - s.duty) * s.over_swing);
    T norm = select(planted, phase * s.over_duty, T(k_norm_toe_off) + u * T(1.0f - k_norm_toe_off));
    Harmonics<T, 6> wave = harmonics<6>(norm);

    Foot<T> out;
    T pitch = curve_at(k_norm_foot_pitch, wave) * s.ahead;
    T rolling = one - ramp(T(0.06f), T(0.12f), norm) * (one - ramp(T(k_heel_off_0), T(k_heel_off_1), norm));
    T rest = one - u, product = u * rest;
    T hop = T(16.0f) * product * product;  // 0 at both ends, 1 in the middle
    pitch = select(planted, pitch * rolling, pitch - T(k_droop) * hop * s.ahead);
    pitch = select(pitch > zero, pitch * T(k_heel_strike), pitch);
    T rises = ramp(T(0.36f), T(0.48f), norm) * (one - ramp(T(0.5f), T(k_norm_toe_off), norm));
    pitch = pitch - rises * T(k_heel_rise) * s.ahead;
    // Who lets the body down onto a lower step stands on the ball meanwhile: shins tilt only so far.
    T drop = at<T>(f.from.y + lane) - at<T>(other.to.y + lane);
    auto lets_down = planted & (drop > T(k_drop_0));
    if (any(lets_down)) {
        T tiptoe = ramp(T(k_drop_0), T(k_drop_1), drop) * ramp(T(0.18f), T(0.42f), norm) *
                   (one - ramp(T(0.5f), T(k_norm_toe_off), norm));
        pitch = select(lets_down, pitch - tiptoe * T(k_tiptoe), pitch);
    }
    if (any(s.running > zero)) {
        T more = s.running * T(k_run_heel) *
                 select(planted, ramp(T(0.26f), T(k_norm_toe_off), norm), one - ramp(zero, T(0.7f), u));
        pitch = select(s.running > zero, pitch - more, pitch);
    }
    // One who lands on the forefoot points the foot down before and sets the heel down after.
    T landing = select(planted, one - ramp(zero, T(0.16f), norm), ramp(T(0.45f), T(0.9f), u)) *
                at<T>(f.forefoot + lane);
    pitch = mixed(pitch, T(k_forefoot_pitch), landing);
    auto toes_up = pitch > zero;
    T toe_pitch = select(toes_up, pitch, pitch * eased(u * T(2.5f)) * (one - landing) * T(k_toes));
    out.half = half_turn(zero - pitch);
    out.toe_half = half_turn(zero - toe_pitch);
    SineCosine<T> tilt = doubled(out.half);
    T cosine = tilt.cosine, sine = zero - tilt.sine;

    // How high the ankle stands over heel, ball and tip of the toes, each on the ground.
    T level = size.ankle * cosine;
    T over_heel = level + size.heel * sine;
    T over_ball = level - size.ball * sine;
    T over_tip = over_ball + size.toe * doubled(out.toe_half).sine;
    T soft = T(k_soft) * hop;
    T over = soft_larger(over_heel, soft_larger(over_ball, over_tip, soft), soft);
    T square = product * product;
    T clearance = mixed(
        hop * T(0.05f),
        (T(k_clear_early) + T(k_heel_kick) * s.running) * square * rest * rest * rest + T(k_clear) * hop,
        s.amplitude);
    if (any(s.running > zero)) {
        T rising = u * rest * rest * rest * rest * T(k_run_rise), falling = u * u * rest * T(k_run_fall);
        clearance = select(s.running > zero, clearance + s.running * (rising + falling), clearance);
    }
    out.ankle_up = over + clearance;

    T back = size.ankle * sine;
    T from_heel = size.heel * cosine - back - size.heel;
    T from_ball = size.ball - size.ball * cosine - back;
    out.ankle_ahead = mixed(from_ball, from_heel, select(planted, select(toes_up, one, zero), eased(u)));

    // The way from place to place: along the ground's slope, and over its steps.
    T from_x = at<T>(f.from.x + lane), from_y = at<T>(f.from.y + lane), from_z = at<T>(f.from.z + lane);
    T far_x = at<T>(f.to.x + lane) - from_x, far_z = at<T>(f.to.z + lane) - from_z;
    T rise = at<T>(f.to.y + lane) - from_y;
    from_x = from_x - origin.x, from_y = from_y - origin.y, from_z = from_z - origin.z;
    T from_nx = at<T>(f.from.normal_x + lane), from_nz = at<T>(f.from.normal_z + lane);
    T far_nx = at<T>(f.to.normal_x + lane) - from_nx, far_nz = at<T>(f.to.normal_z + lane) - from_nz;
    T way = eased(u) - T(k_way_late) * square * (u * u) * (u * u) - T(k_way) * hop;
    way = way + s.running * T(k_run_way) * u * rest * rest * rest;
    T climb = way;
    // A foot climbs before it goes on, so that its toes pass the edges, and goes on before it comes down, so
    // that its heel does.
    T mean_nx = from_nx + far_nx * T(0.5f), mean_nz = from_nz + far_nz * T(0.5f);
    T step = rise +
             (mean_nx * far_x + mean_nz * far_z) * (one + T(0.5f) * (mean_nx * mean_nx + mean_nz * mean_nz));
    T height = larger(step, zero - step), steep = ramp(T(k_step_0), T(k_step_1), height);
    if (any(steep > zero)) {
        auto up = step > zero;
        // Up, knees rise high; down, the way itself is clear of the ground left.
        out.ankle_up = out.ankle_up - select(up, hop * steep * T(-0.02f), clearance * steep);
        T v = select(up, u, rest), climbs = smaller(T(k_step_climbs) + height, one);
        T far2 = far_x * far_x + far_z * far_z + T(0.01f);
        T waits = select(up, steep, smaller(T(k_step_waits) * step * step / far2, one) * steep);
        climbs = select(up, climbs, mixed(T(k_step_falls), climbs, waits));
        T onward = eased((v - T(k_step_wait)) * T(1 / (1 - k_step_wait))), upward = eased(v / climbs);
        way = select(steep > zero, mixed(way, select(up, onward, one - onward), waits), way);
        climb = select(steep > zero, mixed(climb, select(up, upward, one - upward), steep), climb);
    }
    T over_step = select(steep > zero, step * (climb - way), zero);
    out.place = {from_x + far_x * way,
                 from_y + rise * way + over_step + at<T>(f.obstacle + lane) * hop + s.lift,
                 from_z + far_z * way};
    T yaw = mixed(at<T>(f.from.yaw + lane), at<T>(f.to.yaw + lane), way);
    T nx = from_nx + far_nx * way, nz = from_nz + far_nz * way;

    out.flat = flat_on_ground(nx, nz, sine_cosine(yaw * T(0.5f)));
    Axes<T> axes = axes_of(out.flat);
    out.up = axes.y;
    out.ahead = axes.z;

    T knee = mixed(T(0.09f), larger(curve_at(k_norm_knee, wave) + T(k_knee_more), T(0.03f)), s.amplitude);
    out.knee = doubled(half_turn(knee)).cosine;
    out.swings = select(planted, zero, one);
    out.leaving = select(planted, ramp(T(0.38f), T(0.55f), norm), zero);
    out.give =
        select(planted, zero, T(k_give) * ramp(zero, T(0.15f), u) * (one - ramp(T(0.7f), T(0.92f), u)));
    // Let go little by little, and bound again before it lands.
    T free = T(k_landing_slack) * (one - ramp(T(k_landing), one, u)) +
             T(0.3f) * (one - ramp(T(0.5f), T(k_landing), u));
    out.slack = select(planted, out.leaving * T(k_leaving_slack),
                       mixed(T(k_leaving_slack), free, ramp(zero, T(0.35f), u)));
    return out;
}

// Shins tilt over a foot only so far: beyond the first angle ever less, to the second at most (sines of 26
// and 36 degrees). Half the turn, toes down, by which `shin`, a unit vector up along it, is tilted farther,
// in the lanes that become `tilted`.
inline constexpr float k_tilt_free = 0.438f, k_tilt_gives = 0.15f;
template <class T, class M>
HWY_INLINE SineCosine<T> over_tilt(const Foot<T>& foot, V3<T> shin, M& tilted) {
    SineCosine<T> tilt = doubled(foot.half);
    T up = dot(foot.up, shin), ahead = dot(foot.ahead, shin);
    T sine = ahead * tilt.cosine - up * tilt.sine, cosine = up * tilt.cosine + ahead * tilt.sine;
    T excess = sine - T(k_tilt_free);
    tilted = excess > T(0.0f);
    if (!any(tilted)) return {};
    T over = T(1.0f) / (sine * sine + cosine * cosine);
    excess = smaller(select(cosine > T(0.0f), excess, T(1.0f)), T(2 * k_tilt_gives));
    T allowed = T(k_tilt_free) + excess - excess * excess * T(0.25f / k_tilt_gives);
    T rest = root(larger(sine * sine + cosine * cosine - allowed * allowed, T(0.0f)));
    T half = root(larger(T(0.5f) + T(0.5f) * over * (cosine * rest + sine * allowed), T(1e-6f)));
    return {T(0.5f) * over * (sine * rest - cosine * allowed) / half, half};
}

template <class T, class M>
HWY_INLINE void turn_if(M turns, SineCosine<T>& half, SineCosine<T> by) {
    SineCosine<T> turned = plus(half, by);
    half = {select(turns, turned.sine, half.sine), select(turns, turned.cosine, half.cosine)};
}

// Turns a foot on the ground toes down over its ball, by twice `half`.
template <class T, class M>
HWY_INLINE void turn_over_ball(M turns, Foot<T>& foot, const FootSizes<T>& size, SineCosine<T> half) {
    turn_if(turns, foot.half, half);
    SineCosine<T> tilt = doubled(foot.half);
    foot.ankle_up = select(turns, size.ankle * tilt.cosine + size.ball * tilt.sine, foot.ankle_up);
    foot.ankle_ahead =
        select(turns, size.ball - size.ball * tilt.cosine + size.ankle * tilt.sine, foot.ankle_ahead);
}

// Turns a leaving foot further over its ball until the ankle is within `reach` of the hip: one Newton step on
// the angle.
template <class T>
HWY_INLINE void raise_heel(Foot<T>& foot, const FootSizes<T>& size, V3<T> hip, T reach) {
    V3<T> to_hip = hip - ankle_of(foot);
    T distance2 = dot(to_hip, to_hip);
    auto short_leg = (foot.leaving > T(0.0f)) & (foot.half.sine >= T(0.0f)) & (distance2 > reach * reach);
    if (!any(short_leg)) return;
    T distance = root(distance2);
    // How fast the ankle nears the hip as the heel rises: d/dpitch of its place in the foot's plane.
    SineCosine<T> tilt = doubled(foot.half);
    T cosine = tilt.cosine, sine = T(0.0f) - tilt.sine;
    T move_up = size.ankle * sine + size.ball * cosine, move_ahead = size.ankle * cosine - size.ball * sine;
    T gain = (dot(foot.up, to_hip) * move_up + dot(foot.ahead, to_hip) * move_ahead) / distance;
    T angle = smaller((distance - reach) / larger(gain, T(0.03f)), T(0.3f));
    turn_over_ball(short_leg, foot, size, half_turn(angle));
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
