// Skin weights of built-in people, by distance along and from the bones. Body height 1, bind pose.
#pragma once

#include <array>

#include "assets/people/shape.h"

namespace flaneur {

// One weight for each joint; they sum to 1.
std::array<float, k_joint_count> skin_weights(Vec3 p, Layer layer, const Figure& figure,
                                              const std::array<Vec3, k_joint_count>& bind_joints);

// The four heaviest, whatever their sum, as bytes that fall and sum to 255.
void pack_weights(const std::array<float, k_joint_count>& weights, CharacterVertex& vertex);

}  // namespace flaneur
