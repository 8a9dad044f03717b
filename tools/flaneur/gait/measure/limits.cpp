#include "tools/flaneur/gait/measure/limits.h"

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

float angle_between(Quat a, Quat b) {
    Quat d = conjugate(a) * b;
    return 2 * arctan2(length(Vec3{d.x, d.y, d.z}), std::fabs(d.w)) / k_radians;
}

Quantities measure_body(const Walk& walk, size_t first, size_t last) {
    float spin = 0, beyond = 0;
    double rise = 0, fall = 0;
    auto against_parent = [](const Instant& now, size_t j) {
        return conjugate(now.joints[static_cast<size_t>(k_joint_parents[j])].rotation) *
               now.joints[j].rotation;
    };
    for (size_t t = std::max<size_t>(first, 2); t < std::min(last, walk.ticks.size()); ++t) {
        const Instant &now = walk.ticks[t], &before = walk.ticks[t - 1];
        for (size_t j = 0; j < k_joint_count; ++j) {
            if (k_joint_parents[j] == k_no_parent) continue;
            spin = std::max(spin, angle_between(against_parent(before, j), against_parent(now, j)));
            auto joint = static_cast<Joint>(j);
            Quat parent = now.joints[static_cast<size_t>(k_joint_parents[j])].rotation;
            beyond =
                std::max(beyond, beyond_limits(joint, joint_angles(joint, parent, now.joints[j].rotation)));
        }
        auto height = [&](size_t tick, Joint joint) {
            return static_cast<double>(place(walk.ticks[tick], joint).y);
        };
        rise = std::max(rise, std::fabs(height(t, head) - height(t - 1, head)) * walk.rate);
        double falls = 2 * height(t - 1, hips) - height(t - 2, hips) - height(t, hips);
        if (!now.feet[k_left].swinging || !now.feet[k_right].swinging)
            fall = std::max(fall, falls * walk.rate * walk.rate);
    }
    return {{"joint_speed.deg_s", static_cast<double>(spin) * walk.rate},
            {"joint_outside.deg", static_cast<double>(beyond)},
            {"head_rise.m_s", rise},
            {"pelvis_fall.m_s2", fall}};
}

}  // namespace flaneur
