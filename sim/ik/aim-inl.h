// Looking at a point with a chain of joints, say chest, neck and head, over float or Lanes.
#if defined(FLANEUR_SIM_IK_AIM_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLANEUR_SIM_IK_AIM_INL_H
#undef FLANEUR_SIM_IK_AIM_INL_H
#else
#define FLANEUR_SIM_IK_AIM_INL_H
#endif

#include "sim/base/math-inl.h"
#include "sim/base/math.h"
#include "sim/base/vec-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

// A joint's share of a turn, before limits, and how far it turns against the joint below. Shares of a chain
// sum to 1. Radians.
template <class T>
struct AimJoint {
    T share;
    T yaw;       // to either side
    T up, down;  // pitch, both > 0
};

// `v` within [-low, high], with its corners rounded over `width` on both sides; low, high >= width > 0.
// Unchanged where it is `width` or more within.
template <class T>
HWY_INLINE T soft_clamped(T v, T low, T high, T width) {
    T over = clamped(v - high + width, T(0.0f), width + width);
    T under = clamped(-low - v + width, T(0.0f), width + width);
    T scale = T(0.25f) / width;
    return clamped(v, -(low + width), high + width) - over * over * scale + under * under * scale;
}

// Turns of N joints, from the body outwards, that point +z of the last along `direction` (in the body's
// space, any length). rotations[i] is of joint i, in the body's space, on top of its pose: a pitch about its
// x within a yaw about the body's y.
//
// The outermost joint takes its share first; what a joint's limit keeps it from, the next one inward takes
// over, and what is left at the innermost is not turned. Limits are rounded over 0.05 radians to both sides.
// The turn goes smoothly back to nothing as the target passes behind the body (from 135 degrees on), its yaw
// alone where the target is straight above or below (within 20 degrees), for no yaw is right there. Elsewhere
// the aim is exact.
template <int N, class T>
HWY_INLINE void aim(const AimJoint<T> (&chain)[N], V3<T> direction, Q4<T> (&rotations)[N]) {
    constexpr float k_rounding = 0.05f;
    T flat = root(direction.x * direction.x + direction.z * direction.z);
    T yaw = arc_tangent(direction.x, direction.z), pitch = arc_tangent(direction.y, flat);
    T ahead = eased((T(k_pi) - absolute(yaw)) * T(4 / k_pi));
    T level = eased((T(0.5f * k_pi) - absolute(pitch)) * T(1 / (20 * k_radians)));
    yaw = yaw * ahead * level;
    pitch = pitch * mixed(T(1.0f), ahead, level);

    T yaws[N], pitches[N], yaw_left = T(0.0f), pitch_left = T(0.0f);
    for (int i = N - 1; i >= 0; --i) {
        T wanted_yaw = yaw * chain[i].share + yaw_left, wanted_pitch = pitch * chain[i].share + pitch_left;
        yaws[i] = soft_clamped(wanted_yaw, chain[i].yaw, chain[i].yaw, T(k_rounding));
        pitches[i] = soft_clamped(wanted_pitch, chain[i].down, chain[i].up, T(k_rounding));
        yaw_left = wanted_yaw - yaws[i];
        pitch_left = wanted_pitch - pitches[i];
    }
    T yaw_sum = T(0.0f), pitch_sum = T(0.0f);
    for (int i = 0; i < N; ++i) {
        yaw_sum = yaw_sum + yaws[i];
        pitch_sum = pitch_sum + pitches[i];
        auto y = sine_cosine(yaw_sum * T(0.5f)), p = sine_cosine(pitch_sum * T(-0.5f));
        rotations[i] = {y.cosine * p.sine, y.sine * p.cosine, -(y.sine * p.sine), y.cosine * p.cosine};
    }
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
