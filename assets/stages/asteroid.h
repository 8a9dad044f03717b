// An asteroid to walk on all round: spheres and capsules that lie into one another, and a boulder of
// triangles beside them.
#pragma once

#include <cstdint>

#include "assets/city.h"
#include "sim/surface/compound.h"

namespace flaneur {

struct Asteroid {
    Compound compound;  // indexed
    City stage;         // level ground for so many walkers (see Roam), and the asteroid as scenery
};
Asteroid make_asteroid(uint64_t seed, int walkers);

}  // namespace flaneur
