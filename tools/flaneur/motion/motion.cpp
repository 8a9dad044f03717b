#include "tools/flaneur/motion/motion.h"

namespace flaneur {

Quat own_turn(const JointPoses& poses, size_t joint) {
    int parent = k_joint_parents[joint];
    if (parent == k_no_parent) return poses[joint].rotation;
    return conjugate(poses[static_cast<size_t>(parent)].rotation) * poses[joint].rotation;
}

Vec3 bone_end(const Body& body, size_t joint) {
    if (joint == head) return {0, body.height - body.joints[head].y, 0};
    if (joint == left_toes || joint == right_toes) return {0, -body.joints[joint].y, body.toe};
    return {0, 0.1f * (body.joints[left_foot].y - body.joints[left_upper_leg].y), 0};
}

Body scaled_body(const Body& body, float scale) {
    Body out = body;
    for (Vec3& joint : out.joints) joint = joint * scale;
    for (float* size : {&out.height, &out.heel, &out.toe}) *size *= scale;
    return out;
}

}  // namespace flaneur
