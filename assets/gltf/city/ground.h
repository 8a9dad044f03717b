// Which triangles of any still scene are ground, and which are walls.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "assets/city.h"
#include "sim/base/result.h"

namespace flaneur {

// What a name says of a triangle.
struct Hint {
    Surface kind = Surface::plaza;
    bool is_bare = true;   // may be walked on
    bool is_solid = true;  // stops walkers, unless it is ground
};

// By words in the name of a material or a node, such as "road", "Sidewalk_01" or "stoneStairs". `hint` is
// left as it is where the name says nothing.
bool read_hint(const std::string& name, Hint& hint);

// Fills the city's ground from its scenery, and Scenery::solid; where the map ends there are destinations.
// `hints` has one a triangle. Refuses, in a
// sentence, scenery without ground.
Result<void> find_ground(City& city, const std::vector<Hint>& hints);

}  // namespace flaneur
