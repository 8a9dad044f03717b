// What bodies in space pull with. Each is a handful of points with the mass of what lies about them, which
// pull as Newton has it: with the square of the distance. Near a surface that is as much as the body itself
// would, as long as its points lie closer together than they are deep.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/surface/compound.h"

namespace flaneur {

struct PullPoint {
    Vec3 place;
    float strength = 0;  // m3/s2: at a distance d it pulls with strength / d^2
    uint32_t body = 0;   // whose it is; the points of a body follow each other
};

struct Gravity {
    std::vector<PullPoint> points;
    uint32_t bodies = 0;
};

// One more body of these points, each with as much mass as the others. It pulls with `pull`, m/s2, at the
// places `surface` on the mean; both are not empty.
void add_body(Gravity& gravity, std::span<const Vec3> points, std::span<const Vec3> surface, float pull);

// All of a compound as one body, by a ball for each of its spheres, a row for each of its capsules and a grid
// in what its triangles enclose.
Gravity gravity_of(const Compound& compound, float pull);

struct Pull {
    Vec3 all;           // m/s2, of all bodies together
    Vec3 strongest;     // of the body that pulls most there
    uint32_t body = 0;  // which that is
};
// Within k_deepest of a point the pull grows no more.
inline constexpr float k_deepest = 0.5f;  // metres
Pull pull_at(const Gravity& gravity, Vec3 place);
// Of one body alone, m/s2.
Vec3 pull_of(const Gravity& gravity, uint32_t body, Vec3 place);

}  // namespace flaneur
