// Private to sim/navigation.
#pragma once

#include <cstdint>
#include <span>

#include "sim/base/vec.h"

namespace flaneur {

// A doorway that a way leads through, as who comes to it sees it.
struct Doorway {
    Vec3 left, right;
};

// The corners of the shortest line through the doorways from `from` (exclusive) to `to` (inclusive), at most
// `capacity`; returns how many.
int pull_string(std::span<const Doorway> doorways, Vec3 from, Vec3 to, Vec3* corners, int capacity);

}  // namespace flaneur
