// Textures that are palettes: each triangle shows one colour of theirs.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/character.h"

namespace flaneur {

// The finest triangles, where those that show one colour of a palette have vertices of their own, appended to
// `c`, that have this colour and no texture: nothing coarser can mix it with its neighbours on the texture.
// Palettes are textures of which nine in ten triangles show a single colour each, and which give few colours
// in all.
std::vector<uint32_t> without_palettes(Character& c);

}  // namespace flaneur
