// Who and what goes along with people, as a world is asked for it.
#pragma once

#include <cstdint>

namespace flaneur {

// Shares of those who have their hands free and are of an age for it, 0..1; of one walker the first that
// chance gives counts. All 0: nobody, and nothing is different.
struct AlongShares {
    float dogs = 0;          // walk a dog on a lead
    float wheelchairs = 0;   // go in a wheelchair
    float white_canes = 0;   // feel their way with a white cane
    float umbrellas = 0;     // hold an umbrella
    uint32_t musicians = 0;  // how many play on squares, at most k_most_musicians
    bool operator==(const AlongShares&) const = default;
};
inline constexpr uint32_t k_most_musicians = 16;

inline bool is_any(const AlongShares& c) {
    return c.dogs > 0 || c.wheelchairs > 0 || c.white_canes > 0 || c.umbrellas > 0 || c.musicians > 0;
}

}  // namespace flaneur
