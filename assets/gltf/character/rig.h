// Finds the humanoid in a skeleton: limbs by their shape, place and flesh, names only tip the scale.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "sim/base/result.h"
#include "sim/body/body.h"

namespace flaneur {

// A joint of a skin, in any units and axes. Parents come before children.
struct RigJoint {
    std::string name;
    int parent = -1;
    Vec3 place;
    Vec3 rest;             // its place when the file's nodes rest; `place` is as the mesh was bound
    float mass = 0;        // sum of the weights it has over all vertices
    Vec3 flesh;            // weighted mean place of those vertices
    bool made_up = false;  // no joint of the file: where the flesh of a chain's last bone ends
};

inline constexpr int k_not_found = -1;

struct RigMap {
    std::array<int, k_joint_count> joints;  // index of the rig's joint, or k_not_found
    std::vector<uint8_t> carried_by;        // by the rig's joint: the Joint that moves what hangs from it
    // By the rig's joint: 1 for that of a thing which hangs from no bone of the body and was bound apart from
    // it. Who carries it is whose joint is nearest at rest, and it is to be held as it is then.
    std::vector<uint8_t> loose;
    Vec3 left, up, ahead;            // orthonormal, in the rig's axes
    std::vector<std::string> notes;  // what was doubtful, a sentence each
};

// Hips, knees, ankles, shoulders, elbows and a head are always found, and wrists on one side at least; wrists
// and ankles may be made up. Spine, chest, neck, clavicles and toes may be k_not_found. Joints that carry no
// flesh nor hold together what does (targets, poles, controls) are not looked at. A rig in pieces, or whose
// pieces hang from what carries no flesh, is joined where its bones meet. `low` and `high` are the corners of
// the mesh's bounding box. Refuses with the sentence that names the limb that is missing; with `force` only
// what lacks a leg, and else finds the legs alone.
Result<RigMap> map_rig(const std::vector<RigJoint>& rig, Vec3 low, Vec3 high, bool force = false);

}  // namespace flaneur
