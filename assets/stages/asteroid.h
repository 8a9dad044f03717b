// An asteroid to walk on all round: spheres and capsules that lie into one another, and a boulder of
// triangles beside them; or any closed shape in its place.
#pragma once

#include "assets/stages/rocks.h"

namespace flaneur {

SmallWorld make_asteroid(uint64_t seed, int walkers);
SmallWorld make_rock(const RockMesh& solid, uint64_t seed, int walkers);

// Draws a compound's spheres and capsules.
void draw_round(Scenery& scenery, const Compound& compound, uint64_t seed);

}  // namespace flaneur
