// Lines of places as lanes are made of them. Private to sim/lanes.
#pragma once

#include <vector>

#include "sim/base/vec.h"

namespace flaneur {

float length_along(const std::vector<Vec2>& line);
// The same line by places evenly apart, about a metre.
std::vector<Vec2> evenly(const std::vector<Vec2>& line);
// From `from` to `to` metres along it.
std::vector<Vec2> piece_of(const std::vector<Vec2>& line, float from, float to);
// Moved by so many metres to its left.
std::vector<Vec2> beside(const std::vector<Vec2>& line, float left);
// Its corners cut, so that it bends rather than turns.
std::vector<Vec2> rounded(std::vector<Vec2> line);
// From where one line ends to where another begins, as smoothly as both run there.
std::vector<Vec2> curve_between(const std::vector<Vec2>& from, const std::vector<Vec2>& to);

}  // namespace flaneur
