// What is drawn of walls and roofs. Maps draw houses over one another, parts over outlines and outlines
// twice: their surfaces share planes, and a picture would show now the one and now the other.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/city.h"

namespace flaneur {

// What is left of a face or a roof triangle of which a part lies in the plane of another.
struct Remnant {
    uint32_t of = 0;                        // index of the face or of the roof triangle
    std::vector<std::vector<Vec3>> pieces;  // convex, counter-clockwise from outside; none: it is not drawn
};

// In the order of `of`. Whoever is not listed is drawn whole.
struct Skin {
    std::vector<Remnant> faces, roofs;
};

// Where surfaces lie within 6 mm of each other and face the same way, to 4 degrees, one of them is drawn:
// ground before facades, facades before other walls, walls before roofs, and of the same sort the first in
// the city, which is the higher house's. What is alike (roofs of one building, its garden walls) is left as
// it is.
Skin skin_of(const City& city);

}  // namespace flaneur
