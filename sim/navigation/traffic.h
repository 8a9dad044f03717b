// Ways that know how full they are: where people stand close, a metre takes longer, and who sets out goes
// round if that is quicker.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "sim/navigation/navmesh.h"

namespace flaneur {

struct ShortcutCosts;

// Of whoever goes on feet. What it says follows from `slow`, `coming` and `done` alone.
struct Traffic {
    // By number_of: how many times as long a metre takes as where nobody is, 1 or more; in use, and being
    // put in.
    std::vector<float> slow, coming;
    std::vector<float> areas;                            // of each polygon on the ground plane, square metres
    uint32_t done = 0;                                   // of the work of putting it in; 0: nothing is
    bool is_slow = false;                                // anywhere, as it is in use
    std::shared_ptr<ShortcutCosts> costs, coming_costs;  // of both, as far as they are put in
};

// Nowhere is it slow. Allocates.
Traffic make_traffic(const Navmesh& mesh);

// The number of a polygon of the mesh.
uint32_t number_of(const Navmesh& mesh, uint32_t polygon);
// What the time for a metre is times, where so many people a square metre walk: 1 up to half a one, then as
// their speed falls (Weidmann 1993), 5 at most.
float slowness(float density);

// Begins to put in what `traffic.coming` says; nothing else may be under way. This, and going on, allocates
// nothing.
void begin(Traffic& traffic, const Navmesh& mesh);
// Goes on with it, by a `share` of all the work, above 0; once all is done it is in use. Nothing is under
// way: does nothing.
void go_on(Traffic& traffic, const Navmesh& mesh, float share);
// Makes the rest of it true again where `slow`, `coming` and `done` were set.
void restore(Traffic& traffic, const Navmesh& mesh);

// find_path() by what the traffic makes of it.
int find_path(const Navmesh& mesh, const Traffic& traffic, int thread, NavPoint from, NavPoint to,
              Vec3* corners, int capacity, By by);

}  // namespace flaneur
