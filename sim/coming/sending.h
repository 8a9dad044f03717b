// People who are sent: from where, at what time, and where to.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sim/base/vec.h"

namespace flaneur {

// A place, or all of an area, on the ground plane.
struct SentPlace {
    std::vector<Vec2> corners;  // one: a place; three or more: of a polygon, either way round
    // Metres: the floor that lies within three metres of it. None: the one that is nearest to height 0.
    std::optional<float> height{};
};

// People who are sent from one place to another, evenly over a time, and leave there.
struct Sending {
    SentPlace from, to;
    uint32_t people = 1;
    uint32_t group = 1;        // so many come at a time; they do not walk together yet
    float begin = 0, end = 0;  // seconds since the first tick; equal: all of them then
    float speed = 0;           // m/s that they like to walk, 0.3..2; 0: as people of their kind do
};
inline constexpr uint32_t k_most_sent = 1'000'000;  // people of all sendings

// How many of a sending have been due by `seconds`.
uint32_t due_by(const Sending& sending, double seconds);

}  // namespace flaneur
