// A character's mesh as the bytes of a kept file.
#pragma once

#include <span>
#include <string>

#include "assets/character.h"

namespace flaneur {

// Appends vertices and levels of detail.
void put_mesh(std::string& bytes, const Character& character);

// Takes them from the front of `bytes`; false if they are not whole or name what is not there, such as more
// than so many textures.
bool take_mesh(std::span<const char>& bytes, size_t textures, Character& character);

}  // namespace flaneur
