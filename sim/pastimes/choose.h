// What somebody takes up who could do something. Private to sim/pastimes.
#pragma once

#include "sim/pastimes/pastimes.h"

namespace flaneur {

// One who may take up something: sits down, leans, looks, queues or takes out a phone, by chance.
void consider(const PastimeTick& tick, uint32_t walker);

// How many can stand in line there, on the mesh.
uint32_t room_in_line(const Service& service, const Navmesh& mesh);
// Sends one to the end of a line.
void join_line(const PastimeTick& tick, Pastime& pastime, uint32_t service);
// One in a line goes to its place in it, and leaves when it has been served.
void move_up(const PastimeTick& tick, Pastime& pastime);

// Whether it wears a skirt, a dress or a coat.
bool has_robe(const PersonBlock& person, size_t lane);

inline constexpr float k_leans_back = 1.8f;  // seconds until the back is at the wall

}  // namespace flaneur
