#include "tools/flaneur/gait/limits.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"

namespace flaneur {

namespace {

using namespace joint_limits;

constexpr JointLimits k_any = {{-180, 180}, {-180, 180}, {-180, 180}};

enum class JointKind { root, trunk, neck, clavicle, shoulder, elbow, wrist, hip, knee, ankle, toes };

JointKind kind_of(Joint joint) {
    switch (joint) {
        case hips:
            return JointKind::root;
        case spine:
        case chest:
        case upper_chest:
            return JointKind::trunk;
        case neck:
        case head:
            return JointKind::neck;
        case left_shoulder:
        case right_shoulder:
            return JointKind::clavicle;
        case left_upper_arm:
        case right_upper_arm:
            return JointKind::shoulder;
        case left_lower_arm:
        case right_lower_arm:
            return JointKind::elbow;
        case left_hand:
        case right_hand:
            return JointKind::wrist;
        case left_upper_leg:
        case right_upper_leg:
            return JointKind::hip;
        case left_lower_leg:
        case right_lower_leg:
            return JointKind::knee;
        case left_foot:
        case right_foot:
            return JointKind::ankle;
        default:
            return JointKind::toes;
    }
}

const JointLimits& limits_of(JointKind kind) {
    static constexpr const JointLimits* k_all[] = {&k_any,      &k_trunk, &k_neck,  &k_clavicle,
                                                   &k_shoulder, &k_elbow, &k_wrist, &k_hip,
                                                   &k_knee,     &k_ankle, &k_toes};
    return *k_all[static_cast<int>(kind)];
}

float degrees(float angle) { return wrap_angle(angle) / k_radians; }
float arcsin(float x) { return k_pi / 2 - arccos(x); }

float outside(DegreeSpan span, float value) { return std::max({0.0f, span.low - value, value - span.high}); }

}  // namespace

JointAngles joint_angles(Joint joint, Quat parent, Quat child) {
    Quat q = conjugate(parent) * child;
    bool right = joint >= right_shoulder && joint <= right_hand;
    right = right || joint >= right_upper_leg;
    float mirror = right ? -1.0f : 1.0f;
    switch (kind_of(joint)) {
        case JointKind::root:
        case JointKind::trunk:
        case JointKind::neck: {
            Vec3 d = rotate(q, Vec3{0, 1, 0});
            return {degrees(arctan2(d.z, d.y)), degrees(arcsin(d.x)), degrees(2 * arctan2(q.y, q.w))};
        }
        case JointKind::clavicle: {
            Vec3 d = rotate(q, Vec3{mirror, 0, 0});
            return {degrees(arctan2(d.z, d.x * mirror)), degrees(arcsin(d.y)),
                    degrees(2 * arctan2(q.x, q.w))};
        }
        case JointKind::elbow:
        case JointKind::knee: {
            Vec3 d = rotate(q, Vec3{0, -1, 0});
            float bend = degrees(arccos(-d.y));
            return {d.z < 0 ? -bend : bend, 0, mirror * degrees(2 * arctan2(q.y, q.w))};
        }
        case JointKind::ankle:
        case JointKind::toes: {
            Vec3 d = rotate(q, Vec3{0, 0, 1});
            return {degrees(arctan2(d.y, d.z)), mirror * degrees(arcsin(d.x)),
                    mirror * degrees(2 * arctan2(q.z, q.w))};
        }
        default: {
            Vec3 d = rotate(q, Vec3{0, -1, 0});
            return {degrees(arctan2(d.z, -d.y)), mirror * degrees(arcsin(d.x)),
                    mirror * degrees(2 * arctan2(q.y, q.w))};
        }
    }
}

float beyond_limits(Joint joint, const JointAngles& a) {
    const JointLimits& l = limits_of(kind_of(joint));
    return std::max({outside(l.bend, a.bend), outside(l.side, a.side), outside(l.twist, a.twist)});
}

}  // namespace flaneur
