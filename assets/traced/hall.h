// The place where people were recorded, as a model of it: a floor where they could be, walls cut so low that
// one looks over them, and a plate round it.
#pragma once

#include "assets/city.h"
#include "assets/trajectories/trajectories.h"

namespace flaneur {

// How high the area is at a place, or where it is nearest to that: 0 of none.
float level_at(const Trajectories& recorded, Vec2 at);

inline constexpr float k_cut_wall = 1.1f;     // metres over the floor
inline constexpr float k_hall_margin = 2.5f;  // metres that the plate reaches beyond everybody and all walls

// Walls stand round the area and in all of its holes, but where people cross its edge, and on its lines.
// Without an area people walk on the plate alone. Where the area is not level there is no plate, and ground
// is also where people are beside it, as high as they are.
City build_hall(const Trajectories& recorded, const std::string& name);

}  // namespace flaneur
