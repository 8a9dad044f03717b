#pragma once

#include <cstdint>

namespace flaneur {

inline constexpr uint32_t k_ticks_a_second = 60;
// Seconds: the simulation goes on in steps of this length.
inline constexpr float k_tick = 1.0f / k_ticks_a_second;

}  // namespace flaneur
