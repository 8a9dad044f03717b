// From how a character was bound to how it stands: the body that the simulation moves, in its canonical pose.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "assets/character.h"

namespace flaneur {

// Extent of a foot's flesh, seen from its ankle, in canonical axes.
struct FootShape {
    float sole = 0, heel = 0, tip = 0;  // below, behind and ahead of the ankle
};

// In axes that `turn` turns to.
FootShape foot_shape(const Character& c, int ankle, Quat turn);

// Feet bound as one piece, left and right, get toes that bend at the ball.
void bend_feet(Character& c, const std::array<bool, 2>& sides);

// Sets bind_to_canonical and body from bind_joints and the weighted vertices: arms and legs straight down,
// feet ahead; the trunk stays as it was bound. Clavicles that carry flesh sink with the arms. `held` tells
// for each vertex whether it is of a thing rather than of the body.
void set_body(Character& c, const std::vector<uint8_t>& held, bool has_clavicles);

// The lowest that a leg's vertex, and the highest that any but a hand's, stands in the canonical pose.
std::pair<float, float> canonical_extent(const Character& c);

}  // namespace flaneur
