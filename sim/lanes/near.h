// Whether any vehicle is near: one look for those, mostly all, who are not.
#pragma once

#include <cmath>

#include "sim/lanes/roadway.h"

namespace flaneur {

inline constexpr uint32_t k_roadway_squares = Roadway::k_side * Roadway::k_side;
inline constexpr float k_minds_vehicles =
    4.5f;  // metres from a box, at most, within which is_near_vehicles() says so

// The square of Roadway::first of a place.
inline uint32_t roadway_square(Vec2 place) {
    auto wrapped = [](float v) {
        return static_cast<uint32_t>(static_cast<int>(std::floor(v / Roadway::k_square)) &
                                     (Roadway::k_side - 1));
    };
    return wrapped(place.z) * Roadway::k_side + wrapped(place.x);
}

// Roadway::first holds, after where each square's boxes begin and where the last ends, whether any is near
// it.
inline bool is_near_vehicles(const Roadway& r, Vec2 place) {
    return r.first[k_roadway_squares + 1 + roadway_square(place)] != 0;
}

}  // namespace flaneur
