// Small motions that come with the program, for those who stand: what `"idles"` and --idle may name instead
// of a file.
#pragma once

#include <optional>
#include <string_view>

#include "sim/animation/clip.h"

namespace flaneur {

// Stretching; looking out with a hand over the eyes; easing the neck.
inline constexpr std::string_view k_idle_names[] = {"stretch", "look-out", "neck"};

bool is_built_in_idle(std::string_view name);

// Additive, for people of any size; in loops of some ten seconds, in most of which one stands as before. None
// of another name.
std::optional<Clip> built_in_idle(std::string_view name);

}  // namespace flaneur
