// Capes, hair cards and leaves: surfaces without an inside, which are seen from both sides.
#pragma once

#include "assets/gltf/read.h"

namespace flaneur {

// Adds a back to each connected part of a two-sided primitive that encloses next to nothing. Closed parts and
// sleeves need none: nobody looks into them.
void add_backs(GltfPrimitive& primitive);

}  // namespace flaneur
