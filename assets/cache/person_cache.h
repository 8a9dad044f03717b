// People once made are kept on disk.
#pragma once

#include <string>

#include "assets/character.h"

namespace flaneur {

// generate_person(options), or what an earlier run kept of it in `folder`; keeps it there if it can. The same
// bytes either way: files are named by the options and by the sources of the generator, and one that is
// damaged is made anew. An empty `folder` keeps nothing. May be called from several threads and programs at
// once.
Character cached_person(const PersonOptions& options, const std::string& folder);

}  // namespace flaneur
