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
struct AimJoint {
    float share;
    float yaw;       // to either side
    float up, down;  // pitch, both > 0
};
inline constexpr float k_aim_rounding = 0.05f;

// `v` within [-low, high], with its corners rounded over k_aim_rounding on both sides; low, high >= that.
// Unchanged where it is as much or more within.
template <class T>
HWY_INLINE T soft_clamp(T v, float low, float high) {
    constexpr float w = k_aim_rounding;
    T over = clamp(v - T(high - w), T(0.0f), T(2 * w));
    T under = clamp(T(w - low) - v, T(0.0f), T(2 * w));
    return clamp(v, T(0.0f - low - w), T(high + w)) + (under * under - over * over) * T(0.25f / w);
}

// The turns of N joints against the body, from the body outwards, that share `turn`. The outermost takes its
// share first; what a joint's limit keeps it from, the next one inward takes over, and what is left at the
// innermost is not turned. `low` and `high` say which limits count.
template <int N, class T>
HWY_INLINE void share_turn(const AimJoint (&chain)[N], float AimJoint::*low, float AimJoint::*high, T turn,
                           T (&turns)[N]) {
    T left = T(0.0f), sum = T(0.0f);
    for (int i = N - 1; i >= 0; --i) {
        T wanted = turn * T(chain[i].share) + left;
        turns[i] = soft_clamp(wanted, chain[i].*low, chain[i].*high);
        left = wanted - turns[i];
    }
    for (T& t : turns) t = sum = sum + t;
}

// Turns of N joints, from the body outwards, that point +z of the last along `direction` (in the body's
// space, any length). rotations[i] is of joint i, in the body's space, on top of its pose: a pitch about its
// x within a yaw about the body's y.
//
// The turn goes smoothly back to nothing as the target passes behind the body (from 135 degrees on), its yaw
// alone where the target is straight above or below (within 20 degrees), for no yaw is right there. Elsewhere
// the aim is exact as far as the limits allow, which are rounded over 0.05 radians to both sides.
template <int N, class T>
HWY_INLINE void aim(const AimJoint (&chain)[N], V3<T> direction, Q4<T> (&rotations)[N]) {
    T flat = sqrt(direction.x * direction.x + direction.z * direction.z);
    T yaw = arctan2(direction.x, direction.z), pitch = arctan2(direction.y, flat);
    T ahead = smoothstep((T(k_pi) - abs(yaw)) * T(4 / k_pi));
    T level = smoothstep((T(0.5f * k_pi) - abs(pitch)) * T(1 / (20 * k_radians)));
    T yaws[N], pitches[N];
    share_turn(chain, &AimJoint::yaw, &AimJoint::yaw, yaw * ahead * level, yaws);
    share_turn(chain, &AimJoint::down, &AimJoint::up, pitch * lerp(T(1.0f), ahead, level), pitches);
    for (int i = 0; i < N; ++i) {
        auto y = sin_cos(yaws[i] * T(0.5f)), p = sin_cos(pitches[i] * T(-0.5f));
        rotations[i] = {y.cosine * p.sine, y.sine * p.cosine, -(y.sine * p.sine), y.cosine * p.cosine};
    }
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
