// What is told of a file of everybody's ways.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "assets/trajectories/trajectories.h"

namespace flaneur {

// Format, people, frames, extents, speed, heights, ground, and what was assumed.
nlohmann::ordered_json facts_of(const Trajectories& tracks);

}  // namespace flaneur
