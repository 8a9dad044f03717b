// One chunk of walkers, from gait to joints: feet first, then the pelvis over them, then everything above.
#if defined(FLANEUR_SIM_POSE_WALK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLANEUR_SIM_POSE_WALK_INL_H
#undef FLANEUR_SIM_POSE_WALK_INL_H
#else
#define FLANEUR_SIM_POSE_WALK_INL_H
#endif

#include "sim/base/vec-inl.h"
#include "sim/gait/curves-inl.h"
#include "sim/ik/two_bone-inl.h"
#include "sim/pose/pose.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

template <class T>
HWY_INLINE T at(const float* values) {
    T v;
    load(v, values);
    return v;
}

template <class T>
HWY_INLINE V3<T> joint_place(const PersonBlock& p, int joint, size_t lane) {
    return {at<T>(p.joints[joint][0] + lane), at<T>(p.joints[joint][1] + lane),
            at<T>(p.joints[joint][2] + lane)};
}

template <class T>
HWY_INLINE void set_joint(PoseBlock& out, int joint, size_t lane, V3<T> position, Q4<T> rotation) {
    store(position.x, out.position[joint][0] + lane);
    store(position.y, out.position[joint][1] + lane);
    store(position.z, out.position[joint][2] + lane);
    store(rotation.x, out.rotation[joint][0] + lane);
    store(rotation.y, out.rotation[joint][1] + lane);
    store(rotation.z, out.rotation[joint][2] + lane);
    store(rotation.w, out.rotation[joint][3] + lane);
}

template <class T>
HWY_INLINE Q4<T> about_x(T angle) {
    auto h = sine_cosine(angle * T(0.5f));
    return {h.sine, T(0.0f), T(0.0f), h.cosine};
}
template <class T>
HWY_INLINE Q4<T> about_y(T angle) {
    auto h = sine_cosine(angle * T(0.5f));
    return {T(0.0f), h.sine, T(0.0f), h.cosine};
}
template <class T>
HWY_INLINE Q4<T> about_z(T angle) {
    auto h = sine_cosine(angle * T(0.5f));
    return {T(0.0f), T(0.0f), h.sine, h.cosine};
}

template <class T>
struct FootPose {
    V3<T> ankle;     // in the world
    Q4<T> rotation;  // of the foot
    Q4<T> toe_rotation;
    V3<T> ball;   // the toe joint
    T ground;     // height below the foot
    T knee;       // flexion that the normal walk has now, radians
    T stands;     // 1 while planted, else 0
    T leaving;    // 0 while the body rests on it .. 1 at toe-off
    V3<T> pivot;  // the ground under the ball
};

// Heel, flat foot, ball: a planted foot rolls over the heel while its toes point up and over the ball when
// the heel has left, and neither point moves. In the swing the pivot wanders from ball back to heel while the
// foot goes from one place to the next, its lowest point just above the ground.
template <class T>
HWY_INLINE FootPose<T> pose_foot(const FootBlock& f, const PersonBlock& p, size_t lane, T phase, T duty,
                                 T amplitude, int joint_foot, int joint_toes) {
    T zero = T(0.0f), one = T(1.0f);
    auto planted = phase < duty;
    T u = select(planted, zero, (phase - duty) / (one - duty));
    T norm = norm_phase(phase, duty);
    auto angle = sine_cosine(norm * T(2 * k_pi));

    T pitch = curve_at(k_norm_foot_pitch, angle) * amplitude;
    T rolling = one - ramp(T(0.06f), T(0.12f), norm) * (one - ramp(T(0.32f), T(0.44f), norm));
    pitch = select(planted, pitch * rolling, pitch);
    auto toes_up = pitch > zero;
    T toe_pitch = select(toes_up, pitch, pitch * eased(u * T(2.5f)));

    V3<T> ankle_place = joint_place<T>(p, joint_foot, lane), ball_place = joint_place<T>(p, joint_toes, lane);
    T height = ankle_place.y, ball = ball_place.z - ankle_place.z;
    T heel = at<T>(p.heel + lane), toe = at<T>(p.toe + lane);
    auto tilt = sine_cosine(pitch);
    T toe_sine = sine_cosine(toe_pitch).sine;

    // How high the ankle stands over heel, ball and tip of the toes, each on the ground.
    T over_heel = height * tilt.cosine + heel * tilt.sine;
    T over_ball = height * tilt.cosine - ball * tilt.sine;
    T over_tip = over_ball - toe * toe_sine;
    T hop = T(16.0f) * u * u * (one - u) * (one - u);  // 0 at both ends, 1 in the middle
    T soft = T(0.05f) * hop;
    T over = soft_larger(over_heel, soft_larger(over_ball, over_tip, soft), soft);
    T clearance = hop * mixed(T(0.05f), T(0.004f), amplitude);

    T back_on_heel = select(planted, select(toes_up, one, zero), eased(u));
    T from_heel = heel * tilt.cosine - height * tilt.sine - heel;
    T from_ball = ball - ball * tilt.cosine - height * tilt.sine;
    T along = mixed(from_ball, from_heel, back_on_heel);

    // The way from place to place. A foot climbs early and comes down late.
    T from_y = at<T>(f.from.y + lane), to_y = at<T>(f.to.y + lane);
    T u2 = u * u, rest = one - u;
    T way =
        eased(u) - T(2.0f) * u2 * u2 * rest * rest;  // as the foot of the normal walk moves, a little late
    T climb = select(to_y > from_y, eased(u * T(1.6f)), eased(u * T(1.6f) - T(0.6f)));
    V3<T> place{mixed(at<T>(f.from.x + lane), at<T>(f.to.x + lane), way),
                mixed(from_y, to_y, climb) + at<T>(f.obstacle + lane) * hop,
                mixed(at<T>(f.from.z + lane), at<T>(f.to.z + lane), way)};
    T yaw = mixed(at<T>(f.from.yaw + lane), at<T>(f.to.yaw + lane), way);
    T nx = mixed(at<T>(f.from.normal_x + lane), at<T>(f.to.normal_x + lane), way);
    T nz = mixed(at<T>(f.from.normal_z + lane), at<T>(f.to.normal_z + lane), way);
    T ny = root(larger(one - nx * nx - nz * nz, T(0.01f)));

    Q4<T> flat = arc(V3<T>{zero, one, zero}, V3<T>{nx, ny, nz}) * about_y(yaw);
    FootPose<T> out;
    out.ankle = place + rotate(flat, V3<T>{zero, over + clearance, along});
    out.rotation = flat * about_x(-pitch);
    out.toe_rotation = flat * about_x(-toe_pitch);
    out.ball = out.ankle + rotate(out.rotation, ball_place - ankle_place);
    out.ground = place.y;
    out.knee = mixed(T(0.09f), larger(curve_at(k_norm_knee, angle), T(0.03f)), amplitude);
    out.stands = select(planted, one, zero);
    out.leaving = select(planted, ramp(T(0.38f), T(0.55f), norm), zero);
    out.pivot = out.ball - rotate(out.rotation, V3<T>{zero, ball_place.y, zero});
    return out;
}

// Turns a leaving foot further over its ball until the ankle is within reach of the hip: one Newton step on
// the angle.
template <class T>
HWY_INLINE void raise_heel(FootPose<T>& foot, V3<T> hip, T reach) {
    V3<T> to_hip = hip - foot.ankle, arm = foot.ankle - foot.pivot;
    T distance = root(dot(to_hip, to_hip));
    V3<T> axis = rotate(foot.rotation, V3<T>{T(1.0f), T(0.0f), T(0.0f)});
    T gain = dot(cross(axis, arm), to_hip) / distance;  // metres nearer for each radian
    T angle = (distance - reach) / larger(gain, T(0.03f));
    angle = select((foot.leaving > T(0.0f)) & (distance > reach), smaller(angle, T(0.3f)), T(0.0f));
    T half = angle * T(0.5f);
    Q4<T> turn = unit(Q4<T>{axis.x * half, axis.y * half, axis.z * half, T(1.0f)});
    foot.ankle = foot.pivot + rotate(turn, arm);
    foot.ball = foot.pivot + rotate(turn, foot.ball - foot.pivot);
    foot.rotation = turn * foot.rotation;
}

template <class T>
HWY_INLINE void pose_chunk(const GaitBlock& g, const PersonBlock& p, PoseBlock& out, size_t lane) {
    T zero = T(0.0f), one = T(1.0f);
    T phase = at<T>(g.phase + lane), duty = at<T>(g.duty + lane), amplitude = at<T>(g.amplitude + lane);
    T right_phase = phase + T(0.5f);
    right_phase = select(right_phase >= one, right_phase - one, right_phase);

    FootPose<T> feet[2] = {
        pose_foot(g.feet[k_left], p, lane, phase, duty, amplitude, left_foot, left_toes),
        pose_foot(g.feet[k_right], p, lane, right_phase, duty, amplitude, right_foot, right_toes)};

    // Pelvis: list, rotation and sway from the curves; its height so that the legs that carry it have the
    // knees of the normal walk.
    auto cycle = sine_cosine(phase * T(2 * k_pi));
    T walk = amplitude * at<T>(p.sway + lane);
    T list = curve_at(k_norm_pelvic_list, cycle) * walk;
    T turn = curve_at(k_norm_pelvic_rotation, cycle) * walk;
    T heading = at<T>(g.heading + lane);
    T sway = cycle.sine * mixed(T(0.004f), T(0.020f), amplitude) * at<T>(p.sway + lane);
    T load = left_load(phase, duty);

    auto facing = sine_cosine(heading);
    V3<T> left{facing.cosine, zero, zero - facing.sine};
    V3<T> pelvis{at<T>(g.x + lane) + left.x * sway, zero, at<T>(g.z + lane) + left.z * sway};
    Q4<T> pelvis_rot = about_y(heading - turn) * about_z(list) * about_x(at<T>(p.lean + lane) * T(0.3f));

    V3<T> hips_place = joint_place<T>(p, hips, lane);
    V3<T> hip_offset[2];
    T base = at<T>(g.base + lane);
    T wanted = zero, limits[2], full[2];
    for (int side = 0; side < 2; ++side) {
        int leg = side == k_left ? left_upper_leg : right_upper_leg;
        V3<T> hip_place = joint_place<T>(p, leg, lane), knee_place = joint_place<T>(p, leg + 1, lane);
        V3<T> ankle_place = joint_place<T>(p, leg + 2, lane);
        T thigh = hip_place.y - knee_place.y, shank = knee_place.y - ankle_place.y;
        hip_offset[side] = rotate(pelvis_rot, hip_place - hips_place);
        V3<T> away = pelvis + hip_offset[side] - feet[side].ankle;
        T flat2 = away.x * away.x + away.z * away.z;
        T bend = sine_cosine(feet[side].knee).cosine;
        T length2 = thigh * thigh + shank * shank + T(2.0f) * thigh * shank * bend;
        full[side] = (thigh + shank) * T(0.998f);
        T least = thigh * thigh * T(0.8f);
        T rise = root(larger(length2 - flat2, least)) - hip_offset[side].y;
        T share = side == k_left ? load : one - load;
        wanted = wanted + (rise + feet[side].ankle.y - feet[side].ground) * share;
        limits[side] =
            root(larger(full[side] * full[side] - flat2, least)) + feet[side].ankle.y - hip_offset[side].y;
    }
    // Never so high that a planted leg would be stretched, rounded so that the knee does not snap straight;
    // but a leg about to leave may be: its heel gives.
    pelvis.y = base + wanted;
    for (int side = 0; side < 2; ++side) {
        T free = pelvis.y + T(0.3f);
        T limit = select(feet[side].stands > T(0.5f), limits[side] + feet[side].leaving * T(0.03f), free);
        pelvis.y = soft_smaller(pelvis.y, smaller(limit, free), T(0.004f));
    }
    for (int side = 0; side < 2; ++side) {
        raise_heel(feet[side], pelvis + hip_offset[side], full[side]);
        raise_heel(feet[side], pelvis + hip_offset[side], full[side]);
    }
    set_joint(out, hips, lane, pelvis, pelvis_rot);

    // Legs.
    for (int side = 0; side < 2; ++side) {
        int leg = side == k_left ? left_upper_leg : right_upper_leg;
        V3<T> hip_place = joint_place<T>(p, leg, lane), knee_place = joint_place<T>(p, leg + 1, lane);
        V3<T> ankle_place = joint_place<T>(p, leg + 2, lane);
        V3<T> ahead = rotate(pelvis_rot, V3<T>{zero, zero, one});
        V3<T> foot_ahead = rotate(feet[side].rotation, V3<T>{zero, T(0.35f), one});
        TwoBoneInput<T> in{pelvis + hip_offset[side],
                           feet[side].ankle,
                           hip_place.y - knee_place.y,
                           knee_place.y - ankle_place.y,
                           ahead + foot_ahead,
                           one,
                           pelvis_rot};
        TwoBoneOutput<T> limb = two_bone(in);
        set_joint(out, leg, lane, in.root, limb.upper_rot);
        set_joint(out, leg + 1, lane, limb.middle, limb.lower_rot);
        set_joint(out, leg + 2, lane, limb.end, feet[side].rotation);
        V3<T> ball = feet[side].ball + (limb.end - feet[side].ankle);
        set_joint(out, leg + 3, lane, ball, feet[side].toe_rotation);
    }

    // Trunk: each joint turns back a little more against the pelvis, so that the chest turns the other way
    // and the head keeps still.
    T lean = at<T>(p.lean + lane) * mixed(T(0.4f), one, amplitude);
    V3<T> below_place = hips_place, below = pelvis;
    Q4<T> below_rot = pelvis_rot;
    T look = at<T>(g.look + lane);
    for (int joint = spine; joint <= head; ++joint) {
        T t = T(static_cast<float>(joint - hips) / 3.0f);
        Q4<T> rotation;
        if (joint <= upper_chest) {
            T yaw = mixed(zero - turn, turn * T(0.4f), t) + look * T(0.08f) * t;
            rotation = about_y(heading + yaw) * about_z(mixed(list, list * T(-0.2f), t)) * about_x(lean);
        } else {
            T share = joint == neck ? T(0.45f) : one;
            rotation = about_y(heading + look * share) * about_x(lean * (one - share));
        }
        V3<T> place = joint_place<T>(p, joint, lane);
        V3<T> position = below + rotate(below_rot, place - below_place);
        set_joint(out, joint, lane, position, rotation);
        below_place = place;
        below = position;
        below_rot = rotation;
        if (joint != upper_chest) continue;

        // Arms swing with the leg of the other side. The wrist's target is where the curves of shoulder and
        // elbow would have it; two-bone IK brings it there.
        for (int side = 0; side < 2; ++side) {
            int clavicle = side == k_left ? left_shoulder : right_shoulder;
            T mirror = side == k_left ? one : T(-1.0f);
            V3<T> clavicle_place = joint_place<T>(p, clavicle, lane);
            V3<T> shoulder_place = joint_place<T>(p, clavicle + 1, lane);
            V3<T> elbow_place = joint_place<T>(p, clavicle + 2, lane);
            V3<T> wrist_place = joint_place<T>(p, clavicle + 3, lane);
            V3<T> clavicle_at = position + rotate(rotation, clavicle_place - place);
            V3<T> shoulder_at = clavicle_at + rotate(rotation, shoulder_place - clavicle_place);
            set_joint(out, clavicle, lane, clavicle_at, rotation);

            T upper = shoulder_place.y - elbow_place.y, lower = elbow_place.y - wrist_place.y;
            T swing = amplitude * at<T>(p.arm_swing + lane);
            T stroke = cycle.cosine * mirror;  // +1 at this side's contact
            T flexion = T(-0.02f) - swing * (T(0.12f) + T(0.29f) * stroke);
            T elbow = mixed(T(0.22f), T(0.60f), amplitude) -
                      swing * T(0.22f) * (stroke - T(0.25f) * cycle.sine * mirror);
            T outward = at<T>(p.carriage + lane) * mirror;
            Q4<T> arm = rotation * about_z(outward) * about_x(zero - flexion);
            Q4<T> forearm = arm * about_y(T(0.0f) - mirror * T(0.30f)) * about_x(zero - elbow);
            V3<T> elbow_at = shoulder_at + rotate(arm, V3<T>{zero, zero - upper, zero});
            V3<T> wrist_at = elbow_at + rotate(forearm, V3<T>{zero, zero - lower, zero});
            // The elbow points back and a little out.
            V3<T> front = rotate(rotation, V3<T>{zero - mirror * T(0.35f), zero, one});
            TwoBoneInput<T> in{shoulder_at, wrist_at, upper, lower, front, T(-1.0f), rotation};
            TwoBoneOutput<T> limb = two_bone(in);
            set_joint(out, clavicle + 1, lane, shoulder_at, limb.upper_rot);
            set_joint(out, clavicle + 2, lane, limb.middle, limb.lower_rot);
            set_joint(out, clavicle + 3, lane, limb.end, limb.lower_rot);
        }
    }
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
