// A character out of a glTF scene, and how its joints lie there, for what else the file says about them.
#pragma once

#include <vector>

#include "assets/gltf/character/rig.h"
#include "assets/gltf/read.h"

namespace flaneur {

struct MappedCharacter {
    Character character;  // no name, textures or levels of detail yet
    RigMap map;
    // By rig joint, as far as it is a node: the node, and joint to scene when the character was bound.
    std::vector<int> nodes;
    std::vector<Affine> binds;
    float scale = 1;  // metres a unit of the file
};

Result<MappedCharacter> map_character(const GltfScene& scene, const CharacterOptions& options = {});

// load_character of a file that was parsed; errors begin with `path`.
Result<Character> make_character(const tinygltf::Model& model, const std::string& path,
                                 const CharacterOptions& options = {});

}  // namespace flaneur
