// Those who go with others, as the crowd needs to know of them; sim/company decides it all.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/base/vec.h"

namespace flaneur {

inline constexpr uint32_t k_no_group = ~0u;

// One walker among those it goes with.
struct Fellow {
    uint32_t group = k_no_group;  // none: goes alone, and nothing below is of it
    uint32_t leads = 0;           // 1: the errand is its own, and the others come along
    float pace = 1;               // of who leads: share of its own speed at which all can go
    float most = 0;               // of the others: m/s, at most, to be where they should be
    Vec3 spot{};                  // there, metres, at tick
    uint32_t since = 0;           // `since`,
    Vec2 drift{};                 // which moves on, m/s
    Vec2 facing{};                // unit: where it looks as it stands; zero: no matter
};
using Fellows = std::vector<Fellow>;  // by walker; empty: nobody goes with others

inline bool are_together(const Fellows& fellows, uint32_t a, uint32_t b) {
    return fellows[a].group != k_no_group && fellows[a].group == fellows[b].group;
}

}  // namespace flaneur
