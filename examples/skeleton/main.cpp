// Puts a walker's poses into somebody else's skeleton: bones of its own, in centimetres, at rest with the
// arms held out. The body that walks has that skeleton's proportions, so its feet land where these bones
// reach.
#include <flaneur/sim/sim.h>

#include <cstdio>
#include <iterator>

using namespace flaneur;

// What turns bones from rest to the canonical pose, in which arms hang.
const Quat k_as_is, k_hang_left{0, 0, -0.7071068f, 0.7071068f}, k_hang_right{0, 0, 0.7071068f, 0.7071068f};
const struct Bone {
    const char* name;
    int parent;
    Vec3 offset;  // from the parent, at rest
    Joint joint;  // whose pose it takes
    Quat to_hang;
} k_bones[] = {
    {"pelvis", -1, {0, 98, 0}, hips, k_as_is},
    {"spine", 0, {0, 34, 0}, upper_chest, k_as_is},
    {"arm.l", 1, {19, 15, 0}, left_upper_arm, k_hang_left},
    {"forearm.l", 2, {29, 0, 0}, left_lower_arm, k_hang_left},
    {"hand.l", 3, {26, 0, 0}, left_hand, k_hang_left},
    {"arm.r", 1, {-19, 15, 0}, right_upper_arm, k_hang_right},
    {"forearm.r", 5, {-29, 0, 0}, right_lower_arm, k_hang_right},
    {"hand.r", 6, {-26, 0, 0}, right_hand, k_hang_right},
    {"thigh.l", 0, {10, -4, 0}, left_upper_leg, k_as_is},
    {"shin.l", 8, {0, -45, 0}, left_lower_leg, k_as_is},
    {"foot.l", 9, {0, -42, 0}, left_foot, k_as_is},
    {"thigh.r", 0, {-10, -4, 0}, right_upper_leg, k_as_is},
    {"shin.r", 11, {0, -45, 0}, right_lower_leg, k_as_is},
    {"foot.r", 12, {0, -42, 0}, right_foot, k_as_is},
};
JointPose placed[std::size(k_bones)];  // in the world, metres

// Places the bones, each turned by `turn_of` it, the first of them at `root`.
template <class TurnOf>
void place_bones(Vec3 root, TurnOf turn_of) {
    placed[0] = {root, turn_of(k_bones[0])};
    for (size_t b = 1; b < std::size(k_bones); ++b) {
        const JointPose& parent = placed[k_bones[b].parent];
        placed[b] = {parent.position + rotate(parent.rotation, k_bones[b].offset * 0.01f),
                     turn_of(k_bones[b])};
    }
}

int main() {
    Kind kind;
    kind.body = standard_body(1.8f);
    place_bones(k_bones[0].offset * 0.01f, [](const Bone& bone) { return bone.to_hang; });
    for (size_t b = 0; b < std::size(k_bones); ++b) kind.body.joints[k_bones[b].joint] = placed[b].position;

    const Vec3 corners[] = {{-20, 0, -20}, {-20, 0, 20}, {20, 0, 20}, {20, 0, -20}};
    const uint32_t triangles[] = {0, 1, 2, 0, 2, 3};
    WorldOptions options;
    options.capacity = 1;
    options.kinds = {kind};
    Result<WorldPtr> world = make_world({corners, triangles, {}}, options);
    if (!world) return std::fprintf(stderr, "skeleton: %s\n", world.error().message.c_str()), 1;
    Result<WalkerId> walker = add_walker(**world);
    if (!walker || !let_wander(**world, *walker)) return 1;
    for (int tick = 0; tick < 300; ++tick) step(**world);

    std::array<JointPose, k_joint_count> pose;
    pose_of(**world, *walker, pose);
    place_bones(pose[hips].position, [&](const Bone& b) { return pose[b.joint].rotation * b.to_hang; });
    for (size_t b = 1; b < std::size(k_bones); ++b) {
        Quat turn = conjugate(placed[k_bones[b].parent].rotation) * placed[b].rotation;
        float apart = length(placed[b].position - pose[k_bones[b].joint].position);
        std::printf("%-9s against its parent %.3f %.3f %.3f %.3f; %.1f mm from flaneur's joint\n",
                    k_bones[b].name, turn.x, turn.y, turn.z, turn.w, 1000 * apart);
    }
}
