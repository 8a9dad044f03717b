// Commands that pictures hold: the viewer writes into each one what draws it.
#pragma once

#include <string>
#include <vector>

#include "sim/base/result.h"

namespace flaneur {

// What follows `flaneur render` in the command that a PNG holds as its comment. Refuses, in a sentence, a
// file that is no PNG, and one that holds none.
Result<std::vector<std::string>> words_in_picture(const std::string& path);

// The picture of --like among these words; empty: there is none.
std::string picture_of_like(const std::vector<std::string>& words);

// `words`, which follow `flaneur render`, with what the picture of --like says before them: what they say
// themselves goes before it. As they are where there is no --like.
Result<std::vector<std::string>> words_like(const std::vector<std::string>& words);

}  // namespace flaneur
