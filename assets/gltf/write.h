// Characters as glTF 2.0.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "assets/character.h"

namespace flaneur {

// VRM's names of humanoid bones, by Joint.
std::array<std::string, k_joint_count> vrm_joint_names();

// The bytes of a binary glTF file (.glb): the finest level of detail as one skinned mesh in the pose it was
// bound in, on 22 joints that bear VRM's names of humanoid bones. `tints`, sRGB as outfit() gives them, are
// laid into the colours of vertices (COLOR_0). Of characters without textures, as the built-in people are.
std::string character_glb(const Character& character, const std::array<uint32_t, k_tint_count>& tints);

// Keys of an animation, linear between them. As many of everything as there are `times`, one at least.
struct GlbMotion {
    std::vector<float> times;  // seconds, rising
    std::vector<Vec3> hips;    // where they are
    // Of each joint against its parent, from the pose of the bind; of one sign from key to key.
    std::array<std::vector<Quat>, k_joint_count> turns;
};

// The same with an animation, on joints that bear k_joint_names. At rest the hips are where the motion
// begins.
std::string character_glb(const Character& character, const std::array<uint32_t, k_tint_count>& tints,
                          const GlbMotion& motion);

}  // namespace flaneur
