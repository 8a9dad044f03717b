// Cities made by hand for tests, small enough to reason about.
#pragma once

#include "sim/ground/surroundings.h"

namespace flaneur {

// A horizontal rectangle of ground.
void add_floor(Ground& ground, Vec2 low, Vec2 high, float y, Surface kind);
// A quad of ground with corners in counter-clockwise order seen from above: (x+ z+), (x+ z-), (x- z-), (x-
// z+).
void add_quad(Ground& ground, Vec3 a, Vec3 b, Vec3 c, Vec3 d, Surface kind);
// A wall from `a` to `b` whose free side is on the right of that way on a map with z down the page (see
// Face).
void add_wall(Ground& ground, Vec3 a, Vec3 b, float height, FaceKind kind = FaceKind::facade);

// A sidewalk of `length` along +x and `width` along z about z = 0, from x = 0, with facades on both long
// sides.
Ground corridor(float length, float width);
// Two corridors of `width` that meet at a right angle: along +x, then along +z, each `length` long.
Ground corner(float length, float width);
// A square plaza of edge `size` about the origin with walls all round.
Ground square(float size);
// A street along x: road between z = -4 and 4 at height 0, sidewalks beyond to +-8 at 0.12 with kerbs, a
// crossing between x = -2 and 2; x from -40 to 40; facades at z = +-8.
Ground street();
// A plain of 60 x 20 m at height 0, and over it along x, at height 5, a bridge 4 m wide from x = -10 to 10
// with ramps of 1 in 4 down to the plain at its ends; facades close the sides of the ramps.
Ground bridge();
// A solid box on the ground.
void add_solid_box(Ground& ground, Vec3 low, Vec3 high);
// A square of 20 x 20 m at height 0, steps of 0.15 m x 0.35 m up along +z, and a terrace at 1.5 m.
Ground steps();

}  // namespace flaneur
