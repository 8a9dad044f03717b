// Who came and went in a run, told at its end.
#pragma once

#include <span>
#include <string>

#include "sim/sim.h"

namespace flaneur {

inline constexpr size_t k_most_told = 20;  // entries of a demand by themselves; the rest in one row

// Lines: of those who wander how many left and came in instead, and a row for each entry of the demand, by
// its name. "" where nobody came or went and nobody is sent.
std::string told_coming(const ComingCount& all, std::span<const SentCount> sent,
                        std::span<const std::string> names);

}  // namespace flaneur
