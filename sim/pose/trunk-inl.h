// Spine, head and arms of a chunk of walkers, over float or Lanes.
#if defined(FLANEUR_SIM_POSE_TRUNK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLANEUR_SIM_POSE_TRUNK_INL_H
#undef FLANEUR_SIM_POSE_TRUNK_INL_H
#else
#define FLANEUR_SIM_POSE_TRUNK_INL_H
#endif

#include "sim/ik/aim-inl.h"
#include "sim/ik/two_bone-inl.h"
#include "sim/pose/foot-inl.h"
#include "sim/pose/pose.h"
#include "sim/pose/rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

template <class T>
HWY_INLINE V3<T> joint_place(const PersonBlock& p, int joint, size_t lane) {
    return {at<T>(p.joints[joint][0] + lane), at<T>(p.joints[joint][1] + lane),
            at<T>(p.joints[joint][2] + lane)};
}

template <class T>
HWY_INLINE void set_joint(PoseBlock& out, int joint, size_t lane, V3<T> position, Q4<T> rotation) {
    store_place(position, out.position[joint], lane);
    store_rotation(rotation, out.rotation[joint], lane);
}

// The yaw of the body: sine and cosine of half of it, and of the whole.
template <class T>
struct Heading {
    SineCosine<T> half, whole;
};
// Between the world and the frame that turns with the body.
template <class T>
HWY_INLINE V3<T> along(const Heading<T>& h, V3<T> v) {
    return {v.x * h.whole.cosine + v.z * h.whole.sine, v.y, v.z * h.whole.cosine - v.x * h.whole.sine};
}
template <class T>
HWY_INLINE V3<T> against(const Heading<T>& h, V3<T> v) {
    return {v.x * h.whole.cosine - v.z * h.whole.sine, v.y, v.z * h.whole.cosine + v.x * h.whole.sine};
}

// What the pelvis hands up.
template <class T>
struct Trunk {
    V3<T> place;
    Q4<T> rotation;
    Axes<T> axes;
    V3<T> hips_place;  // canonical
    Heading<T> heading;
    T turn, list, lean, amplitude, running;
    T slow;  // how much longer feet stand than at a natural speed, as a share of the cycle
};

// Of two unit quaternions not far from each other. Length 1 by two Newton steps, without a root.
template <class T>
HWY_INLINE Q4<T> between(Q4<T> a, Q4<T> b, float t) {
    T s = T(1.0f - t), r = T(t);
    Q4<T> q{a.x * s + b.x * r, a.y * s + b.y * r, a.z * s + b.z * r, a.w * s + b.w * r};
    T n = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
    T first = T(1.5f) - T(0.5f) * n;
    T scale = first * (T(1.5f) - T(0.5f) * n * first * first);
    return {q.x * scale, q.y * scale, q.z * scale, q.w * scale};
}

// A hand on a wall: palm flat on it, fingers up and a little ahead. Returns the wrist; `rotation` is the
// hand's.
template <class T>
HWY_INLINE V3<T> wrist_on_wall(const HandBlock& hand, size_t lane, float mirror, T palm, V3<T> origin,
                               Q4<T>& rotation) {
    V3<T> normal{at<T>(hand.normal_x + lane), T(0.0f), at<T>(hand.normal_z + lane)};
    // A body that has the wall at this side, its arm turned up past the shoulder: half a turn about z.
    T cosine = normal.x * T(-mirror), sine = normal.z * T(mirror);
    T c = root(larger((T(1.0f) + cosine) * T(0.5f), T(1e-6f)));
    T s = T(0.5f) * sine / c;
    Q4<T> up = unit(Q4<T>{s * T(mirror), T(0.0f), c * T(mirror), T(0.0f)});
    rotation = turned_x(up, SineCosine<T>{T(0.0f - k_finger_tilt_sine), T(k_finger_tilt_cosine)});
    V3<T> fingers = rotate(rotation, V3<T>{T(0.0f), T(-1.0f), T(0.0f)});
    V3<T> place = V3<T>{at<T>(hand.x + lane), at<T>(hand.y + lane), at<T>(hand.z + lane)} - origin;
    return place + normal * T(k_palm_thickness) - fingers * palm;
}

// `b` where `t` is 1, `a` where it is 0, by the shorter way.
template <class T>
HWY_INLINE Q4<T> blended(Q4<T> a, Q4<T> b, T t) {
    T sign = select(a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w < T(0.0f), T(-1.0f), T(1.0f));
    T r = t * sign, s = T(1.0f) - t;
    return unit(Q4<T>{a.x * s + b.x * r, a.y * s + b.y * r, a.z * s + b.z * r, a.w * s + b.w * r});
}

// Half the yaw of the elbow's plane while the arm hangs, and its sine when the hand is on a wall, and how
// early the arm gives way before it is straight.
inline constexpr float k_elbow_out_sine = 0.1675f, k_elbow_out_cosine = 0.9859f;  // of 19 degrees
inline constexpr float k_elbow_in_sine = 0.2f;
inline constexpr float k_arm_soft = 0.004f;

// Arms swing with the leg of the other side, or both twice a stride in a slow walk. The wrist's target is
// where the curves of shoulder and elbow would have it, in the frame of the chest, or a place on a wall;
// two-bone IK brings it there.
template <class T>
HWY_INLINE void pose_arms(const GaitBlock& g, const PersonBlock& p, PoseBlock& out, size_t lane,
                          V3<T> chest_at, Q4<T> chest_rot, V3<T> chest_place, const Trunk<T>& trunk,
                          const Harmonics<T, 3>& cycle, V3<T> origin) {
    T zero = T(0.0f);
    V3<T> clavicle = joint_place<T>(p, left_shoulder, lane),
          shoulder = joint_place<T>(p, left_upper_arm, lane);
    T elbow_height = at<T>(p.joints[left_lower_arm][1] + lane);
    T wrist_height = at<T>(p.joints[left_hand][1] + lane);
    LimbSizes<T> size = limb_sizes(shoulder.y - elbow_height, elbow_height - wrist_height);
    T swing = trunk.amplitude * at<T>(p.arm_swing + lane);
    T mean_elbow = mixed(mixed(T(0.22f), T(0.60f), trunk.amplitude), T(k_run_elbow), trunk.running);
    T twice = ramp(T(k_arms_twice_0), T(k_arms_twice_1), trunk.slow);
    SineCosine<T> outward = doubled(half_turn(at<T>(p.carriage + lane)));
    Axes<T> chest = axes_of(chest_rot);
    V3<T> clavicle_up = chest.y * (clavicle.y - chest_place.y) + chest.z * (clavicle.z - chest_place.z);
    V3<T> shoulder_up = chest.y * (shoulder.y - chest_place.y) + chest.z * (shoulder.z - chest_place.z);

    for (int side = 0; side < 2; ++side) {
        int joint = side == k_left ? left_shoulder : right_shoulder;
        float mirror = side == k_left ? 1.0f : -1.0f;
        V3<T> clavicle_at = chest_at + clavicle_up + chest.x * (clavicle.x * T(mirror));
        V3<T> shoulder_at = chest_at + shoulder_up + chest.x * (shoulder.x * T(mirror));
        set_joint(out, joint, lane, clavicle_at, chest_rot);

        // +1 where the arm is farthest back: at this side's contact.
        T stroke = mixed(cycle.cosine[0] * T(mirror), cycle.cosine[1] * T(0.5f), twice);
        T late = mixed(cycle.sine[0] * T(mirror), cycle.sine[1] * T(0.5f), twice);
        T back = T(0.02f) + swing * (T(0.12f) + T(0.29f) * stroke);
        T elbow = mean_elbow - swing * T(0.22f) * (stroke - late * T(0.25f));
        // The upper arm hangs turned back by `back` and out by the carriage, the forearm bent by `elbow`, a
        // little inward.
        SineCosine<T> raised = doubled(half_turn(back)), bent = doubled(half_turn(elbow));
        T inward = bent.sine * T(0.2955f), forward = bent.sine * T(0.9553f);  // of 0.30 rad
        V3<T> upper{zero, zero - raised.cosine, zero - raised.sine};
        V3<T> lower{inward * T(-mirror), zero - bent.cosine * raised.cosine - forward * raised.sine,
                    forward * raised.cosine - bent.cosine * raised.sine};
        V3<T> hang = upper * size.upper + lower * size.lower;
        T out_sine = outward.sine * T(mirror);
        V3<T> wrist{hang.x * outward.cosine - hang.y * out_sine, hang.y * outward.cosine + hang.x * out_sine,
                    hang.z};

        // The elbow points back and a little out, away from a wall.
        SineCosine<T> front{T(k_elbow_out_sine * -mirror), T(k_elbow_out_cosine)};
        T reach = at<T>(g.hands[side].reach + lane);
        bool reaching = any(reach > zero);
        Q4<T> on_wall;
        if (reaching) {
            V3<T> to = wrist_on_wall(g.hands[side], lane, mirror, size.lower * T(0.32f), origin, on_wall) -
                       shoulder_at;
            wrist = mixed(wrist, V3<T>{dot(to, chest.x), dot(to, chest.y), dot(to, chest.z)}, reach);
            front.sine = mixed(front.sine, T(k_elbow_in_sine * mirror), reach);
        }
        Limb<T> limb = two_bone(wrist, front, size, -1.0f, k_arm_soft);
        auto placed = [&](V3<T> v) { return shoulder_at + chest.x * v.x + chest.y * v.y + chest.z * v.z; };
        Q4<T> lower_rot = chest_rot * limb.lower_rot, hand_rot = lower_rot;
        if (reaching) {
            auto lies = reach > zero;
            Q4<T> laid = blended(lower_rot, on_wall, reach);
            // The forearm takes half of what the hand twists.
            SineCosine<T> twist = twist_about_y(inverse(lower_rot) * laid);
            T cosine = root(larger(T(0.5f) + T(0.5f) * twist.cosine, T(1e-6f)));
            SineCosine<T> half{T(0.5f) * twist.sine / cosine, cosine};
            lower_rot = select(lies, turned_y(lower_rot, half), lower_rot);
            hand_rot = select(lies, laid, hand_rot);
        }
        set_joint(out, joint + 1, lane, shoulder_at, chest_rot * limb.upper_rot);
        set_joint(out, joint + 2, lane, placed(limb.middle), lower_rot);
        set_joint(out, joint + 3, lane, placed(limb.end), hand_rot);
    }
}

// Chest, neck and head share the turn to what is looked at.
inline constexpr AimJoint k_look[3] = {
    {0.08f, 0.30f, 0.2f, 0.2f}, {0.37f, 0.55f, 0.4f, 0.4f}, {0.55f, 0.80f, 0.5f, 0.5f}};

// Each joint of the spine turns back a little more against the pelvis, so that the chest turns the other way
// and the head keeps still.
template <class T>
HWY_INLINE void pose_trunk(const GaitBlock& g, const PersonBlock& p, PoseBlock& out, size_t lane,
                           const Trunk<T>& trunk, const Harmonics<T, 3>& cycle, V3<T> origin) {
    T one = T(1.0f);
    T look[3];  // of chest, neck and head
    share_turn(k_look, &AimJoint::yaw, &AimJoint::yaw, at<T>(g.look + lane), look);
    T lean = trunk.lean * mixed(T(0.4f), one, trunk.amplitude);
    SineCosine<T> half_lean = half_turn(lean);
    Q4<T> chest_rot = turned_yzx(plus(trunk.heading.half, half_turn(trunk.turn * T(0.4f) + look[0])),
                                 half_turn(trunk.list * T(-0.2f)), half_lean);
    Q4<T> neck_rot = turned_x(Q4<T>{T(0.0f), T(0.0f), T(0.0f), one}, half_turn(lean * T(0.55f)));
    neck_rot = after_y(plus(trunk.heading.half, half_turn(look[1])), neck_rot);
    SineCosine<T> gaze = plus(trunk.heading.half, half_turn(look[2]));
    Q4<T> head_rot{T(0.0f), gaze.sine, T(0.0f), gaze.cosine};

    const Q4<T> rotations[] = {trunk.rotation,
                               between(trunk.rotation, chest_rot, 1.0f / 3),
                               between(trunk.rotation, chest_rot, 2.0f / 3),
                               chest_rot,
                               neck_rot,
                               head_rot};
    V3<T> position = trunk.place, place = trunk.hips_place;
    for (int joint = spine; joint <= head; ++joint) {
        // The middle of the body: x = 0.
        V3<T> next = place;
        next.y = at<T>(p.joints[joint][1] + lane);
        next.z = at<T>(p.joints[joint][2] + lane);
        Axes<T> axes = axes_of(rotations[joint - 1]);
        position = position + axes.y * (next.y - place.y) + axes.z * (next.z - place.z);
        place = next;
        set_joint(out, joint, lane, position, rotations[joint]);
        if (joint == upper_chest)
            pose_arms(g, p, out, lane, position, chest_rot, place, trunk, cycle, origin);
    }
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
