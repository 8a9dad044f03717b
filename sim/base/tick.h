#pragma once

#include <cstdint>

namespace flaneur {

inline constexpr uint32_t k_ticks_a_second = 60;
inline constexpr float k_tick =
    1.0f / k_ticks_a_second;  // seconds: the simulation goes on in steps of this length

}  // namespace flaneur
