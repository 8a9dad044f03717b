// What the ids of a picture stand for, for who reads them: a JSON text.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "assets/city.h"
#include "tools/flaneur/options/options.h"

namespace flaneur {

// Of those that are in the picture, growing: what each is, its number, what kind of ground or prop, how many
// pixels it has and the box that holds them (left, upper, width, height). docs/files.md has the keys.
std::string legend_of(const std::vector<uint32_t>& ids, Size size, const City& city);

}  // namespace flaneur
