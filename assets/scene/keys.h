// The keys of a scene file: one table that the reader, its messages and the JSON schema follow.
#pragma once

#include <string_view>
#include <vector>

#include "assets/scene.h"

namespace flaneur {

// Reads a scene's text, and says all that is wrong with it in the order of the text. Paths stay as they are.
std::vector<SceneFault> read_scene(std::string_view text, Scene& scene);

}  // namespace flaneur
