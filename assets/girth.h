// How thick the trunk of a character is, for hands.
#pragma once

#include <span>

#include "assets/character.h"

namespace flaneur {

// The body's girth, from places on the surface of trunk and thighs in its canonical pose, metres. Where there
// is none to be found, that of a body of its height.
Girth measure_girth(const Body& body, std::span<const Vec3> surface);

// Whether a surface that goes mostly with that joint is of trunk or thighs.
bool is_of_trunk(int joint);

}  // namespace flaneur
