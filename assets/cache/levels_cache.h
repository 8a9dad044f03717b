// Levels of detail once made are kept on disk.
#pragma once

#include <string>

#include "assets/character.h"

namespace flaneur {

// build_lods(character), or what an earlier run kept of it in `folder`; keeps it there if it can. The same
// mesh, levels and measures either way: files are named by all that a level is made from and by the sources
// that make it, and one that is damaged is made anew. An empty `folder` keeps nothing. May be called from
// several threads and programs at once.
void cached_lods(Character& character, const std::string& folder);

}  // namespace flaneur
