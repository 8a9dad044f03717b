// Where people of a city may sit, look at things and wait for something: what its props and destinations are
// good for.
#pragma once

#include "assets/city.h"
#include "sim/pastimes/places.h"

namespace flaneur {

// Seats of benches, of the rims of fountains and planters, of low walls and of flights of steps, windows
// beside the doors of shops, and what is worth a picture. Of the city's ground and props as they are, indexed
// and listed.
PastimePlaces pastime_places(const City& city);

}  // namespace flaneur
