// Poses of a walk, for what is baked from them.
#pragma once

#include <vector>

#include "assets/character.h"
#include "renderer/scene.h"

namespace flaneur {

// As PersonMesh::strides has them: the character walks at a common speed over level ground, and stands.
std::vector<JointTransform> extract_strides(const Character& character);

}  // namespace flaneur
