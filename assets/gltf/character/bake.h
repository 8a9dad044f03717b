// The skinned mesh of a glTF scene in one pose, in one array, and the skeleton that carries it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "assets/gltf/character/rig.h"
#include "assets/gltf/read.h"

namespace flaneur {

struct BakedMesh {
    std::vector<CharacterVertex> vertices;  // joints and weights not set yet; normals may be zero
    std::vector<std::vector<std::pair<int, float>>>
        influences;              // by vertex: rig joint, weight; they sum to 1
    std::vector<uint8_t> rigid;  // by vertex: 1 if it is of a thing that hangs from a bone
    std::vector<uint32_t> indices;
    std::vector<RigJoint> rig;
    std::vector<int> nodes;           // of the first rig joints; those behind were made up for loose ends
    std::vector<Affine> binds;        // of the same: joint to scene, in the pose baked
    Vec3 low, high;                   // bounding box
    size_t skins = 0, materials = 0;  // in use
    std::vector<std::string> notes;
};

// The bind pose where the skins agree on one, else the rest pose; in the scene's units and axes.
Result<BakedMesh> bake(const GltfScene& scene);

}  // namespace flaneur
