// Puts a walker's poses into somebody else's skeleton: bones in centimetres, at rest with the arms held out.
// The body that walks has that skeleton's proportions, so its feet land where these bones reach.
#include <flaneur/sim/sim.h>

#include <cstdio>

using namespace flaneur;

const Quat k_hang_left{0, 0, -0.7071068f, 0.7071068f}, k_hang_right{0, 0, 0.7071068f, 0.7071068f};
const struct Bone {
    const char* name;
    int parent;
    Vec3 offset;     // from the parent, at rest
    Joint joint;     // whose pose it takes
    Quat to_hang{};  // turns it from rest to the canonical pose, in which arms hang
} k_bones[] = {
    {"pelvis", -1, {0, 98, 0}, hips},
    {"spine", 0, {0, 34, 0}, upper_chest},
    {"arm.l", 1, {19, 15, 0}, left_upper_arm, k_hang_left},
    {"forearm.l", 2, {29, 0, 0}, left_lower_arm, k_hang_left},
    {"hand.l", 3, {26, 0, 0}, left_hand, k_hang_left},
    {"arm.r", 1, {-19, 15, 0}, right_upper_arm, k_hang_right},
    {"forearm.r", 5, {-29, 0, 0}, right_lower_arm, k_hang_right},
    {"hand.r", 6, {-26, 0, 0}, right_hand, k_hang_right},
    {"thigh.l", 0, {10, -4, 0}, left_upper_leg},
    {"shin.l", 8, {0, -45, 0}, left_lower_leg},
    {"foot.l", 9, {0, -42, 0}, left_foot},
    {"thigh.r", 0, {-10, -4, 0}, right_upper_leg},
    {"shin.r", 11, {0, -45, 0}, right_lower_leg},
    {"foot.r", 12, {0, -42, 0}, right_foot},
};

// Where a bone is in the world, in metres, and how it is turned, when flaneur's joints are so.
static JointPose place(const Bone& bone, const std::array<JointPose, k_joint_count>& joints) {
    const Quat turn = joints[bone.joint].rotation * bone.to_hang;
    if (bone.parent < 0) return {joints[hips].position, turn};
    const JointPose parent = place(k_bones[bone.parent], joints);
    return {parent.position + rotate(parent.rotation, bone.offset * 0.01f), turn};
}

int main() {
    std::array<JointPose, k_joint_count> joints;  // in the canonical pose, in which nothing is turned
    joints[hips].position = k_bones[0].offset * 0.01f;
    Kind kind{standard_body(1.8f)};
    for (const Bone& bone : k_bones) kind.body.joints[bone.joint] = place(bone, joints).position;

    const Vec3 corners[] = {{-20, 0, -20}, {-20, 0, 20}, {20, 0, 20}, {20, 0, -20}};
    const uint32_t triangles[] = {0, 1, 2, 0, 2, 3};
    Result<WorldPtr> world = make_world({corners, triangles}, {.capacity = 1, .kinds = {kind}});
    if (!world) return std::fprintf(stderr, "skeleton: %s\n", world.error().message.c_str()), 1;
    if (!add_walker(**world, {.wanders = true})) return 1;
    for (int tick = 0; tick < 300; ++tick) step(**world);
    pose_of(**world, walkers(**world)[0], joints);
    for (const Bone& bone : std::span(k_bones).subspan(1)) {
        const JointPose own = place(bone, joints), parent = place(k_bones[bone.parent], joints);
        const Quat turn = conjugate(parent.rotation) * own.rotation;  // against its parent
        std::printf("%-9s turned by %.3f %.3f %.3f %.3f, %.1f mm from flaneur's joint\n", bone.name, turn.x,
                    turn.y, turn.z, turn.w, 1000 * length(own.position - joints[bone.joint].position));
    }
}
