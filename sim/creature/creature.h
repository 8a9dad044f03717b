// Creatures with six legs that walk all round a compound, with any up. Their trunk follows a walker of
// SurfaceWalkers; their feet stay where they are put until the trunk has gone on from there, then three of
// them step at once while the other three stand: the tripod gait of insects (Wilson, Insect walking, 1966).
// Legs are three bones each, bent by FABRIK.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/linkages/linkages.h"
#include "sim/surface/surface_walk.h"

namespace flaneur {

inline constexpr int k_creature_legs = 6;  // left front, middle, hind; then right. Even ones step together

struct CreatureLeg {
    Vec3 foot;        // where it is
    Vec3 from, to;    // of its step, or of the last one
    Vec3 normal;      // unit, of the surface at `to`
    float swing = 1;  // how much of its step is done; 1: it stands
};

struct Creature {
    float size = 1;          // metres from head to hind leg
    uint32_t walker = 0;     // whom its trunk follows
    Vec3 middle, up, ahead;  // of its trunk; unit vectors square to each other
    CreatureLeg legs[k_creature_legs];
};

// Metres to each side that it takes.
float creature_radius(float size);
// And from the ground to its trunk's middle.
float creature_height(float size);
inline constexpr float k_creature_turn = 2;  // radians a second, that its up turns at most
// Whether all of its feet are down.
bool is_standing(const Creature& creature);
// Its bones at rest; who draws it finds its joints where step_creature() puts them.
Linkage creature_linkage(float size);

// Where its walker is, all feet on the surface below.
Creature make_creature(const Rays& rays, const SurfaceWalkers& walkers, uint32_t walker, float size);

// One tick of `dt` seconds after its walker's. In a leap its feet are drawn in below it, and each looks for
// ground as it lands.
void step_creature(const Rays& rays, const SurfaceWalkers& walkers, Creature& creature, float dt);

// Joints of its linkage, as many as that has, as it stands now.
void place_creature(const Linkage& linkage, const Creature& creature, std::span<Vec3> places);

}  // namespace flaneur
