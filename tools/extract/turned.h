// Solids of revolution in the meshes of what moves.
#pragma once

#include <cstdint>
#include <span>

#include "renderer/scene.h"

namespace flaneur {

// Of a solid of revolution about +y. Twice the same: an edge there.
struct TurnedRing {
    float radius, height;  // metres
    uint32_t colour;
};

// Appends one that moves with a joint to a mesh, from its lowest ring to its highest.
void add_turned(PersonMesh& mesh, std::span<const TurnedRing> rings, uint8_t joint);

}  // namespace flaneur
