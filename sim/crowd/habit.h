// What those do who are set down at the start and sent nowhere: stroll from place to place, walk by rays
// among walls, go along circles on a platform. See let_wander, let_ramble and let_stagger in sim/sim.h.
#pragma once

#include <cstdint>
#include <string_view>

namespace flaneur {

enum class Habit : uint8_t { wander, ramble, stagger };
inline constexpr std::string_view k_habit_names[] = {"wander", "ramble", "stagger"};

}  // namespace flaneur
