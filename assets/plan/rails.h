// Rails of tracks: upright where ballast lies below them, flush in streets.
#pragma once

#include "assets/city.h"

namespace flaneur {

struct Rails {
    City& city;            // whose ground is indexed
    uint32_t steel = ~0u;  // of its buildings, the one that lends the colour of steel; ~0u: none yet
};
// Both rails of a straight piece of track, whose ends are about as high as its ground, within 0.6 m.
void lay_rails(Rails& rails, Vec3 a, Vec3 b);

}  // namespace flaneur
