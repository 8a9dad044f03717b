// How thick the trunk of a character is, for hands.
#pragma once

#include "assets/character.h"

namespace flaneur {

// The girth of the character's finest level in what it wears, without what is carried and without hair. Where
// there is no surface to be found, that of a body of its height.
Girth measure_girth(const Character& character);

}  // namespace flaneur
