// Private to sim/crowd.
#pragma once

#include "sim/crowd/crowd.h"

namespace flaneur {

// The velocity along the path to the goal, m/s.
Vec2 follow_path(Crowd& crowd, const Navmesh& mesh, int thread, uint32_t walker, uint32_t tick,
                 uint64_t seed);

// Finds its way anew, from where it is now. Who follows sees for himself whether he needs one.
void go_on_from_here(Crowd& crowd, uint32_t walker);

// The velocity of one who is called somewhere; none as it is there.
Vec2 go_where_called(const Crowd& crowd, const Called& called);

// What one likes who goes by a way.
struct WayWish {
    Vec2 wanted;              // m/s
    bool is_by_path = false;  // else straight
    bool staggers = false;
};
WayWish wish_by_way(Crowd& crowd, const Navmesh& mesh, int thread, uint32_t walker, uint32_t tick,
                    uint64_t seed);

// Finds the path that the walker's path_due asks for, choosing a new goal first where it asks for one.
void plan_path(Crowd& crowd, const Navmesh& mesh, int thread, uint32_t walker, uint32_t tick, uint64_t seed);

}  // namespace flaneur
