// Closed shapes of rock in space, and what is drawn of them.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "assets/city.h"
#include "sim/base/result.h"
#include "sim/surface/compound.h"
#include "sim/surface/gravity.h"

namespace flaneur {

// Triangles without a border, counter-clockwise from outside.
struct RockMesh {
    std::vector<Vec3> vertices;
    std::vector<uint32_t> indices;
};

// A small world: what one walks on, what pulls, and level ground for so many walkers (see Roam), with the
// rock as scenery.
struct SmallWorld {
    Compound compound;  // indexed
    Gravity gravity;    // of its bodies; without points it is one body
    City stage;
};

// A unit ball: an octahedron each of whose triangles becomes four, so many times.
RockMesh make_ball(int times);
// About the y axis, of metres from there to the middle of its tube and of that tube's; `around` and `across`
// are how many corners it has along and about the tube, 3 at least.
RockMesh make_torus(float ring, float tube, int around, int across);
// Turned so that +y becomes `axis`, a unit vector, and moved.
RockMesh placed(RockMesh solid, Vec3 axis, Vec3 middle);

// Between -1 and 1, smooth, unlike itself beyond a metre.
float rock_noise(Vec3 p, uint64_t seed);
// A unit ball with bumps, of so many metres.
RockMesh make_boulder(Vec3 middle, float radius, uint64_t seed);

// Draws it, its colours by the seed.
void draw_rock(Scenery& scenery, const RockMesh& solid, uint64_t seed);
void add_rock(Compound& compound, const RockMesh& solid);

// The level ground.
City make_stage(std::string_view name, int walkers);

// Makes a solid of triangles that anybody may have made, corners counter-clockwise from outside or all from
// inside: joins corners that lie in one place, leaves out triangles of no extent, turns it inside out where
// it has to be, and moves and scales it so that it is `size` metres along its longest side, about the origin.
// Refuses, in words that go on after its name, one without triangles or with too many, one with a border, one
// whose triangles do not all face out, and one that encloses nothing.
Result<RockMesh> make_rock_mesh(std::vector<Vec3> vertices, std::vector<uint32_t> indices, float size);
inline constexpr size_t k_most_rock_triangles = 500'000;

}  // namespace flaneur
