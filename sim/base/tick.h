#pragma once

namespace flaneur {

inline constexpr float k_tick = 1.0f / 60;  // seconds: the simulation goes on in steps of this length

}  // namespace flaneur
