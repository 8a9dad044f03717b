// Words and numbers that were mistyped.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace flaneur {

// How many letters must be put in, left out, exchanged or swapped with their neighbour to make one word of
// the other.
size_t typing_errors(std::string_view a, std::string_view b);

// " Did you mean WORD?" of the nearest word of `known`, the first of equals; empty where none is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& known);

}  // namespace flaneur
