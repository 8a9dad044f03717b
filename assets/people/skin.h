// Skin weights of built-in people, by distance along and from the bones. Body height 1, bind pose.
#pragma once

#include <array>
#include <span>

#include "assets/people/shape.h"

namespace flaneur {

// One weight for each joint; they sum to 1. What comes out below the hem of a robe goes along with that, or
// is moved by the legs alone where the robe is `hung` on followers.
std::array<float, k_joint_count> skin_weights(Vec3 p, Layer layer, const Figure& figure,
                                              const std::array<Vec3, k_joint_count>& bind_joints,
                                              bool hung = false);

// Whether what it shows there hangs round both legs: a skirt or the lower part of a coat.
bool is_robe(Layer layer, const Figure& figure);

// With followers: how much of `body`, which are skin_weights there, these take over.
using HungWeights = std::array<float, k_joint_count + k_follower_count>;
HungWeights robe_weights(Vec3 p, const std::array<float, k_joint_count>& body);
HungWeights hair_weights(Vec3 p, const Figure& figure, const std::array<float, k_joint_count>& body);
// All of `body`, but for the share of one follower.
HungWeights hung_on(int follower, float share, const std::array<float, k_joint_count>& body);

// The four heaviest, whatever their sum, as bytes that fall and sum to 255.
void pack_weights(std::span<const float> weights, uint8_t (&joints)[4], uint8_t (&bytes)[4]);
inline void pack_weights(std::span<const float> weights, CharacterVertex& vertex) {
    pack_weights(weights, vertex.joints, vertex.weights);
}

}  // namespace flaneur
