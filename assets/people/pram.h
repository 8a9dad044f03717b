// The pram that a built-in person pushes.
#pragma once

#include <array>

#include "assets/character.h"
#include "sim/base/levels.h"

namespace flaneur {

// Triangles for each level of detail, finest first.
using PramLevels = std::array<std::vector<uint32_t>, k_person_levels>;

// Sets Body::pram of a person in its bind pose and sets a pram with a child in it there: its vertices and
// followers are added; appends the finest triangles to the person's, and returns what each level is to show.
// `seed` chooses the colours.
PramLevels add_pram(uint64_t seed, Character& person);

}  // namespace flaneur
