// Characters as glTF 2.0.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "assets/character.h"

namespace flaneur {

// The bytes of a binary glTF file (.glb): the finest level of detail as one skinned mesh in the pose it was
// bound in, on 22 joints that bear VRM's names of humanoid bones. `tints`, sRGB as outfit() gives them, are
// laid into the colours of vertices (COLOR_0). Of characters without textures, as the built-in people are.
std::string character_glb(const Character& character, const std::array<uint32_t, k_tint_count>& tints);

}  // namespace flaneur
