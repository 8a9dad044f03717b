// Spine, head and arms of a chunk of walkers, over float or Lanes. Ends of names say spaces: see foot-inl.h.
#if defined(FLANEUR_SIM_POSE_TRUNK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLANEUR_SIM_POSE_TRUNK_INL_H
#undef FLANEUR_SIM_POSE_TRUNK_INL_H
#else
#define FLANEUR_SIM_POSE_TRUNK_INL_H
#endif

#include "sim/base/rows-inl.h"
#include "sim/ik/aim-inl.h"
#include "sim/ik/two_bone-inl.h"
#include "sim/pose/foot-inl.h"
#include "sim/pose/pose.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

template <class T>
HWY_INLINE V3<T> joint_ms(const PersonBlock& p, int joint, size_t lane) {
    return {at<T>(p.joints[joint][0] + lane), at<T>(p.joints[joint][1] + lane),
            at<T>(p.joints[joint][2] + lane)};
}

template <class T>
HWY_INLINE void set_joint(PoseBlock& out, int joint, size_t lane, V3<T> place_os, Q4<T> rotation_ws) {
    store_place(place_os, out.position[joint], lane);
    store_rotation(rotation_ws, out.rotation[joint], lane);
}

// The yaw of the body: sine and cosine of half of it, and of the whole.
template <class T>
struct Heading {
    SinCosOf<T> half, whole;
};
// Between the world's axes and the body's.
template <class T>
HWY_INLINE V3<T> os_of_bs(const Heading<T>& h, V3<T> v) {
    return {v.x * h.whole.cosine + v.z * h.whole.sine, v.y, v.z * h.whole.cosine - v.x * h.whole.sine};
}
template <class T>
HWY_INLINE V3<T> bs_of_os(const Heading<T>& h, V3<T> v) {
    return {v.x * h.whole.cosine - v.z * h.whole.sine, v.y, v.z * h.whole.cosine + v.x * h.whole.sine};
}

// What walking does to the pelvis of a body that goes evenly ahead, upright: radians and metres.
template <class T>
struct PelvisCurves {
    T list, turn, lean;  // left side up, left side forward, forward: lean is the trunk's
    T twist;             // of the chest, the other way than the pelvis turns
    T sway;              // to the left, metres
    T surge, aside;      // ahead; to the left of one who sways: legs
    T reel;              // to the left, of the trunk of one who reels
    T climb;             // forward, of one who climbs stairs
    T nod;               // forward, of pelvis and trunk: keeps the head from the surge
    T breath;            // -1 .. 1, of one who stands
    T slow;              // how much longer feet stand than at a natural speed, as a share of the cycle
};

// What the pelvis hands up.
template <class T>
struct Trunk {
    V3<T> pelvis_os, pelvis_ms;
    Q4<T> pelvis_ws;
    Axes<T> pelvis_axes_ws;
    Heading<T> heading;
    PelvisCurves<T> curves;
    T amplitude, running, over;  // over: the pace less a natural one
};

// Of two unit quaternions not far from each other. Length 1 by two Newton steps, without a root.
template <class T>
HWY_INLINE Q4<T> nlerp_near(Q4<T> a, Q4<T> b, float t) {
    T s = T(1.0f - t), r = T(t);
    Q4<T> q{a.x * s + b.x * r, a.y * s + b.y * r, a.z * s + b.z * r, a.w * s + b.w * r};
    T n = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
    T first = T(1.5f) - T(0.5f) * n;
    T scale = first * (T(1.5f) - T(0.5f) * n * first * first);
    return {q.x * scale, q.y * scale, q.z * scale, q.w * scale};
}

// A hand on a wall: palm flat on it, fingers up and a little ahead. Returns the wrist; `hand_ws` is the
// hand's rotation.
//
// With a wall straight at this side (cosine 1) the arm is turned up past the shoulder, half a turn about z.
// Another wall turns that about y by the angle in between, whose half has the sine s and cosine c.
template <class T>
HWY_INLINE V3<T> wrist_on_wall(const HandBlock& hand, size_t lane, float mirror, T palm, V3<T> origin_ws,
                               Q4<T>& hand_ws) {
    V3<T> normal_ws{at<T>(hand.normal_x + lane), T(0.0f), at<T>(hand.normal_z + lane)};
    T cosine = normal_ws.x * T(-mirror), sine = normal_ws.z * T(mirror);
    T c = sqrt(max((T(1.0f) + cosine) * T(0.5f), T(0.0f))),
      s = sqrt(max((T(1.0f) - cosine) * T(0.5f), T(0.0f)));
    s = select(sine < T(0.0f), T(0.0f) - s, s);
    Q4<T> up_ws = normalize(Q4<T>{s * T(mirror), T(0.0f), c * T(mirror), T(0.0f)});
    hand_ws = turned_x(up_ws, SinCosOf<T>{T(0.0f - k_finger_tilt_sine), T(k_finger_tilt_cosine)});
    V3<T> fingers_ws = rotate(hand_ws, V3<T>{T(0.0f), T(-1.0f), T(0.0f)});
    V3<T> palm_os = V3<T>{at<T>(hand.x + lane), at<T>(hand.y + lane), at<T>(hand.z + lane)} - origin_ws;
    return palm_os + normal_ws * T(k_palm_thickness) - fingers_ws * palm;
}

// `b` where `t` is 1, `a` where it is 0.
template <class T>
HWY_INLINE Q4<T> nlerp(Q4<T> a, Q4<T> b, T t) {
    T s = T(1.0f) - t;
    return normalize(Q4<T>{a.x * s + b.x * t, a.y * s + b.y * t, a.z * s + b.z * t, a.w * s + b.w * t});
}
template <class T>
HWY_INLINE Q4<T> negated_if_negative(T value, Q4<T> q) {
    T sign = select(value < T(0.0f), T(-1.0f), T(1.0f));
    return {q.x * sign, q.y * sign, q.z * sign, q.w * sign};
}

// Half the yaw of the elbow's plane while the arm hangs, and its sine when the hand is on a wall, and how
// early the arm gives way before it is straight.
inline constexpr float k_elbow_out_sine = 0.1675f, k_elbow_out_cosine = 0.9859f;  // of 19 degrees
inline constexpr float k_elbow_in_sine = 0.2f;
inline constexpr float k_arm_soft = 0.004f;

// What both arms share.
template <class T>
struct ArmSwing {
    T swings[2];      // of each arm, 0 standing
    T amount, bends;  // factors on that, of the upper arm and the elbow
    T elbows[2];      // radians that each is bent, in the middle of the swing
    T ahead;          // radians that it hangs ahead of the chest's axis
    T twice;          // 0: in time with the legs .. 1: twice a stride
    SinCosOf<T> out;  // of the carriage
};

// The wrist of an arm that hangs and swings, in the chest's axes from the shoulder: the upper arm is turned
// back by `back` and out by the carriage, the forearm bent by `elbow`, a little inward. Along the arms that
// is
//   upper = (0, -cos back, -sin back),
//   lower = bent forward from there by `elbow`, its forward part turned inward by 0.30 rad,
// and both are turned outward about z.
template <class T>
HWY_INLINE V3<T> swung_wrist(const ArmSwing<T>& swing, const Harmonics<T, 3>& cycle, int side,
                             const LimbSizes<T>& size) {
    T zero = T(0.0f), swings = swing.swings[side];
    float mirror = side == k_left ? 1.0f : -1.0f;
    // +1 where the arm is farthest back: at this side's contact.
    T stroke = lerp(cycle.cosine[0] * T(mirror), cycle.cosine[1] * T(0.5f), swing.twice);
    T late = lerp(cycle.sine[0] * T(mirror), cycle.sine[1] * T(0.5f), swing.twice);
    T back = T(0.02f) + swings * swing.amount * (T(0.12f) + T(0.29f) * stroke) - swing.ahead;
    T elbow = swing.elbows[side] - swings * swing.bends * T(0.22f) * (stroke - late * T(0.25f));
    SinCosOf<T> raised = doubled(sin_cos_half(back)), bent = doubled(sin_cos_half(elbow));
    T inward = bent.sine * T(0.2955f), forward = bent.sine * T(0.9553f);  // of 0.30 rad
    V3<T> upper{zero, zero - raised.cosine, zero - raised.sine};
    V3<T> lower{inward * T(-mirror), zero - bent.cosine * raised.cosine - forward * raised.sine,
                forward * raised.cosine - bent.cosine * raised.sine};
    V3<T> hang = upper * size.upper + lower * size.lower;
    T out_sine = swing.out.sine * T(mirror);
    return {hang.x * swing.out.cosine - hang.y * out_sine, hang.y * swing.out.cosine + hang.x * out_sine,
            hang.z};
}

// Lays a hand on a wall as far as it reaches: from hanging it is turned up past its side, by whichever way
// the wall stands to the chest. The forearm takes half of what the hand twists.
template <class T>
HWY_INLINE void lay_hand(T reach, float mirror, Q4<T> chest_ws, Q4<T> on_wall_ws, Q4<T>& lower_ws,
                         Q4<T>& hand_ws) {
    auto lies = reach > T(0.0f);
    Q4<T> lower_cs = conjugate(chest_ws) * lower_ws, on_wall_cs = conjugate(chest_ws) * on_wall_ws;
    lower_cs = negated_if_negative(lower_cs.w, lower_cs);
    on_wall_cs = negated_if_negative(on_wall_cs.z * T(mirror), on_wall_cs);
    // The arm goes ahead, so that the wrist need not bend far.
    T late = reach * reach;
    Q4<T> laid_cs = nlerp(lower_cs, on_wall_cs, late * late), turn = conjugate(lower_cs) * laid_cs;
    T over = T(1.0f) / sqrt(max(turn.y * turn.y + turn.w * turn.w, T(1e-12f)));
    SinCosOf<T> twist{turn.y * over, turn.w * over};
    T cosine = sqrt(max(T(0.5f) + T(0.5f) * twist.cosine, T(1e-6f)));
    SinCosOf<T> half{T(0.5f) * twist.sine / cosine, cosine};
    lower_ws = select(lies, turned_y(lower_ws, half), lower_ws);
    hand_ws = select(lies, chest_ws * laid_cs, hand_ws);
}

// The wrist of a hand that has a place on its own body, in the chest's axes from the shoulder.
template <class T>
HWY_INLINE V3<T> held_wrist(const HoldBlock& hold, size_t lane, const Trunk<T>& trunk,
                            const Axes<T>& chest_ws, V3<T> shoulder_os) {
    const Axes<T>& pelvis_ws = trunk.pelvis_axes_ws;
    V3<T> place{at<T>(hold.x + lane), at<T>(hold.y + lane), at<T>(hold.z + lane)};
    T anchor = at<T>(hold.anchor + lane);
    auto on_chest = anchor<T(0.5f), on_ground = anchor> T(1.5f);
    V3<T> from_shoulder_ws =
        trunk.pelvis_os - shoulder_os + pelvis_ws.x * place.x + pelvis_ws.y * place.y + pelvis_ws.z * place.z;
    if (any(on_ground))
        from_shoulder_ws = select(on_ground, os_of_bs(trunk.heading, place) - shoulder_os, from_shoulder_ws);
    return select(on_chest, place,
                  V3<T>{dot(from_shoulder_ws, chest_ws.x), dot(from_shoulder_ws, chest_ws.y),
                        dot(from_shoulder_ws, chest_ws.z)});
}

// The cosine, of at most a quarter turn, that goes with a sine.
template <class T>
HWY_INLINE SinCosOf<T> with_cosine(T sine) {
    return {sine, sqrt(max(T(1.0f) - sine * sine, T(0.0f)))};
}

// Turns the forearm and the hand of an arm that holds; others keep their bits.
template <class T>
HWY_INLINE void turn_held_hand(const HoldBlock& hold, size_t lane, T weight, Q4<T>& lower_ws,
                               Q4<T>& hand_ws) {
    auto holds = weight > T(0.0f);
    SinCosOf<T> twist = with_cosine(at<T>(hold.twist + lane));
    T x = at<T>(hold.bend + lane), z = at<T>(hold.side + lane);
    T w = sqrt(max(T(1.0f) - x * x - z * z, T(0.0f)));
    Q4<T> turned_ws = turned_y(lower_ws, twist), palm_ws = turned_y(turned_ws, twist);
    Q4<T> bent_ws{
        palm_ws.w * x + palm_ws.x * w + palm_ws.y * z, palm_ws.y * w - palm_ws.x * z + palm_ws.z * x,
        palm_ws.w * z - palm_ws.y * x + palm_ws.z * w, palm_ws.w * w - palm_ws.x * x - palm_ws.z * z};
    lower_ws = select(holds, turned_ws, lower_ws);
    hand_ws = select(holds, bent_ws, hand_ws);
}

// Ways are stairs that rise from the first to the second of these, metres for each metre ahead. The least
// that arms swing there, of a natural walk's, and radians that those of the slow are spread.
inline constexpr float k_stairs_0 = 0.2f, k_stairs_1 = 0.5f, k_stair_arms = 0.5f, k_stair_carriage = 0.13f;
// Radians that the slow lean ahead more as they climb stairs; of a small child, for whom they are high.
inline constexpr float k_climb_lean = 0.07f, k_child_climb_lean = 0.36f;

// Arms swing with the leg of the other side, or both twice a stride in a slow walk. The wrist's target is
// where the curves of shoulder and elbow would have it, a place on the body, or one on a wall; two-bone IK
// brings it there.
template <class T>
HWY_INLINE void pose_arms(const GaitBlock& g, const PersonBlock& p, PoseBlock& out, size_t lane,
                          V3<T> chest_os, Q4<T> chest_ws, V3<T> chest_ms, const Trunk<T>& trunk,
                          const Harmonics<T, 3>& cycle, V3<T> origin_ws) {
    V3<T> clavicle_ms = joint_ms<T>(p, left_shoulder, lane),
          shoulder_ms = joint_ms<T>(p, left_upper_arm, lane);
    T elbow_height = at<T>(p.joints[left_lower_arm][1] + lane);
    T wrist_height = at<T>(p.joints[left_hand][1] + lane);
    LimbSizes<T> size = limb_sizes(shoulder_ms.y - elbow_height, elbow_height - wrist_height);
    T elbow =
        lerp(lerp(T(0.22f), T(0.56f) + T(0.3f) * trunk.over, trunk.amplitude), T(k_run_elbow), trunk.running);
    // Who goes up or down steps slowly keeps the balance with the arms.
    T balances = smoothstep(T(k_stairs_0), T(k_stairs_1), abs(at<T>(g.rise + lane)));
    T swings = max(trunk.amplitude, balances * T(k_stair_arms));
    T spread = balances * (T(1.0f) - trunk.amplitude) * T(k_stair_carriage);
    ArmSwing<T> swing{
        {swings * at<T>(p.arm_swing[k_left] + lane), swings * at<T>(p.arm_swing[k_right] + lane)},
        max(T(0.85f) + T(1.85f) * trunk.over, T(0.3f)) + trunk.running * T(k_run_arms),
        clamp(T(1.0f) + T(4.2f) * trunk.over, T(0.25f), T(2.0f)),
        {at<T>(p.elbow[k_left] + lane) + elbow, at<T>(p.elbow[k_right] + lane) + elbow},
        at<T>(p.stoop + lane),
        smoothstep(T(k_arms_twice_0), T(k_arms_twice_1), trunk.curves.slow),
        doubled(sin_cos_half(at<T>(p.carriage + lane) + spread + trunk.running * T(k_run_carriage)))};
    Axes<T> chest = axes_of(chest_ws);
    V3<T> to_clavicle_ws = chest.y * (clavicle_ms.y - chest_ms.y) + chest.z * (clavicle_ms.z - chest_ms.z);
    V3<T> to_shoulder_ws = chest.y * (shoulder_ms.y - chest_ms.y) + chest.z * (shoulder_ms.z - chest_ms.z);

    for (int side = 0; side < 2; ++side) {
        int joint = side == k_left ? left_shoulder : right_shoulder;
        float mirror = side == k_left ? 1.0f : -1.0f;
        V3<T> clavicle_os = chest_os + to_clavicle_ws + chest.x * (clavicle_ms.x * T(mirror));
        V3<T> shoulder_os = chest_os + to_shoulder_ws + chest.x * (shoulder_ms.x * T(mirror));
        set_joint(out, joint, lane, clavicle_os, chest_ws);

        V3<T> wrist_cs = swung_wrist(swing, cycle, side, size);
        // The elbow points back and a little out, away from a wall.
        SinCosOf<T> front{T(k_elbow_out_sine * -mirror), T(k_elbow_out_cosine)};
        T weight = at<T>(g.holds[side].weight + lane);
        bool holding = any(weight > T(0.0f));
        if (holding) {
            V3<T> held_cs = held_wrist(g.holds[side], lane, trunk, chest, shoulder_os);
            wrist_cs = lerp(wrist_cs, held_cs, weight);
            T elbow_sine = at<T>(g.holds[side].elbow + lane) * T(k_elbow_out_cosine);
            front.sine = lerp(front.sine, elbow_sine, weight);
        }
        T reach = at<T>(g.hands[side].reach + lane);
        bool reaching = any(reach > T(0.0f));
        Q4<T> on_wall_ws;
        if (reaching) {
            V3<T> to_wall_ws =
                wrist_on_wall(g.hands[side], lane, mirror, size.lower * T(0.32f), origin_ws, on_wall_ws) -
                shoulder_os;
            V3<T> to_wall_cs{dot(to_wall_ws, chest.x), dot(to_wall_ws, chest.y), dot(to_wall_ws, chest.z)};
            wrist_cs = lerp(wrist_cs, to_wall_cs, reach);
            front.sine = lerp(front.sine, T(k_elbow_in_sine * mirror), reach);
        }
        PosedLimb<T> limb = two_bone(wrist_cs, front, size, -1.0f, k_arm_soft);
        auto os_of_cs = [&](V3<T> v) { return shoulder_os + chest.x * v.x + chest.y * v.y + chest.z * v.z; };
        Q4<T> lower_ws = chest_ws * limb.lower_rot, hand_ws = lower_ws;
        if (holding) turn_held_hand(g.holds[side], lane, weight, lower_ws, hand_ws);
        if (reaching) lay_hand(reach, mirror, chest_ws, on_wall_ws, lower_ws, hand_ws);
        set_joint(out, joint + 1, lane, shoulder_os, chest_ws * limb.upper_rot);
        set_joint(out, joint + 2, lane, os_of_cs(limb.middle), lower_ws);
        set_joint(out, joint + 3, lane, os_of_cs(limb.end), hand_ws);
    }
}

// Radians that a head is bowed to see where it treads, coming down stairs and climbing them; and the neck's
// share of that.
inline constexpr float k_watch_down = 0.32f, k_watch_up = 0.17f, k_watch_neck = 0.5f;

// Chest, neck and head share the turn to what is looked at.
inline constexpr AimJoint k_look[3] = {
    {0.08f, 0.30f, 0.2f, 0.2f}, {0.37f, 0.55f, 0.4f, 0.4f}, {0.55f, 0.80f, 0.5f, 0.5f}};

// The chest's share of the pelvis's list: the other way.
inline constexpr float k_chest_list = -0.35f;

// Of the angle that the body reels by: the trunk goes on the way that the legs lean, farther.
inline constexpr float k_reel_chest = 1.6f;

// Each joint of the spine turns back a little more against the pelvis, the loins least, so that the chest
// turns the other way and the head keeps still.
template <class T>
HWY_INLINE void pose_trunk(const GaitBlock& g, const PersonBlock& p, PoseBlock& out, size_t lane,
                           const Trunk<T>& trunk, const Harmonics<T, 3>& cycle, V3<T> origin_ws) {
    T one = T(1.0f);
    T look[3];  // of chest, neck and head
    share_turn(k_look, &AimJoint::yaw, &AimJoint::yaw, at<T>(g.look + lane), look);
    T lean = trunk.curves.lean * lerp(T(0.4f), one, trunk.amplitude) + trunk.curves.climb + trunk.curves.nod -
             trunk.curves.breath * T(k_breath_lean);
    T stoops = at<T>(p.stoop + lane);
    SinCosOf<T> half_lean = sin_cos_half(lean + stoops);
    Q4<T> chest_ws =
        turned_yzx(plus(trunk.heading.half, sin_cos_half(trunk.curves.twist + look[0])),
                   sin_cos_half(trunk.curves.list * T(k_chest_list) - at<T>(g.bank + lane) * T(k_bank_lean) -
                                trunk.curves.reel * T(k_reel_chest)),
                   half_lean);
    // On stairs one watches them.
    T rise = at<T>(g.rise + lane);
    T watches = T(k_watch_down) * smoothstep(T(k_stairs_0), T(k_stairs_1), T(0.0f) - rise) +
                T(k_watch_up) * smoothstep(T(k_stairs_0), T(k_stairs_1), rise);
    Q4<T> neck_ws = turned_x(Q4<T>{T(0.0f), T(0.0f), T(0.0f), one},
                             sin_cos_half(lean * T(0.55f) + stoops + watches * T(k_watch_neck)));
    neck_ws = after_y(plus(trunk.heading.half, sin_cos_half(look[1])), neck_ws);
    // Down as the body rises, so that the eyes keep to what they look at.
    T nods = cycle.cosine[1] * trunk.amplitude * T(-k_head_nod) + watches,
      rolls = trunk.curves.list * T(k_head_roll);
    Q4<T> head_ws =
        turned_yzx(plus(trunk.heading.half, sin_cos_half(look[2] + trunk.curves.twist * T(k_head_turn))),
                   sin_cos_half(rolls), sin_cos_half(nods));

    const Q4<T> rotations_ws[] = {trunk.pelvis_ws,
                                  nlerp_near(trunk.pelvis_ws, chest_ws, 0.15f),
                                  nlerp_near(trunk.pelvis_ws, chest_ws, 0.4f),
                                  chest_ws,
                                  neck_ws,
                                  head_ws};
    V3<T> place_os = trunk.pelvis_os, place_ms = trunk.pelvis_ms;
    for (int joint = spine; joint <= head; ++joint) {
        // The middle of the body: x = 0.
        V3<T> next_ms = place_ms;
        next_ms.y = at<T>(p.joints[joint][1] + lane);
        next_ms.z = at<T>(p.joints[joint][2] + lane);
        Axes<T> axes_ws = axes_of(rotations_ws[joint - 1]);
        place_os = place_os + axes_ws.y * (next_ms.y - place_ms.y) + axes_ws.z * (next_ms.z - place_ms.z);
        place_ms = next_ms;
        set_joint(out, joint, lane, place_os, rotations_ws[joint]);
        if (joint == upper_chest)
            pose_arms(g, p, out, lane, place_os, chest_ws, place_ms, trunk, cycle, origin_ws);
    }
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
