// Edges of the ground's walls and steps on which people sit, of any city that has them as faces.
#pragma once

#include "assets/city.h"
#include "sim/pastimes/places.h"

namespace flaneur {

// Seats on level walls whose tops are 0.35 to 0.6 m over ground that is not a road, where they are at least
// 0.25 m thick and nothing rises behind. Back to back only where there is room for both.
void add_wall_seats(const City& city, std::vector<Seat>& seats);

// Seats on the treads of straight flights at least 3 m wide: along their sides, so that at least 1.8 m
// of the width stay for those who walk, and along one side of those below 3.6 m; on every fourth tread, so
// that nobody has feet in the back.
void add_step_seats(const City& city, std::vector<Seat>& seats);

// Places at railings and parapets, level and 0.9 to 1.2 m high, beyond which there is water, or at least a
// metre down to the ground; a body's breadth apart.
void add_railings(const City& city, std::vector<Railing>& railings);

}  // namespace flaneur
