// Private to sim/crowd.
#pragma once

#include "sim/crowd/crowd.h"

namespace flaneur {

// The velocity along the path to the goal, m/s.
Vec2 follow_path(Crowd& crowd, const Navmesh& mesh, int thread, uint32_t walker, uint32_t tick,
                 uint64_t seed);

// What one likes who goes by a way.
struct WayWish {
    Vec2 wanted;              // m/s
    bool is_by_path = false;  // else straight
};
WayWish wish_by_way(Crowd& crowd, const Navmesh& mesh, int thread, uint32_t walker, uint32_t tick,
                    uint64_t seed);

// Finds the path that the walker's path_due asks for, choosing a new goal first where it asks for one.
void plan_path(Crowd& crowd, const Navmesh& mesh, int thread, uint32_t walker, uint32_t tick, uint64_t seed);

}  // namespace flaneur
