// Fewer keys for a curve: those between which straight lines, or turns at an even rate, keep within a bound.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/base/vec.h"

namespace flaneur {

// From one turn to another the short way, at an even rate, as players of glTF have it. `t` 0..1.
Quat slerp(Quat from, Quat to, float t);
// Radians between two, 0..pi; q and -q are one.
float radians_apart(Quat a, Quat b);

// Which of the values become keys, rising: the first and the last, one alone where none is farther than
// `most` from the first, and of the others as many as hold all within `most`, metres or radians. `times` are
// theirs, rising.
std::vector<uint32_t> keys_of(std::span<const float> times, std::span<const Vec3> places, float most);
std::vector<uint32_t> keys_of(std::span<const float> times, std::span<const Quat> turns, float most);

}  // namespace flaneur
