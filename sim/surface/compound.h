// Solids in any position, to be walked on all round: spheres, capsules and triangles that lie into one
// another. There is no up here; whoever asks brings one.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sim/base/vec.h"

namespace flaneur {

struct Sphere {
    Vec3 centre;
    float radius = 1;  // metres
};

// All within `radius` of the line from a to b.
struct Capsule {
    Vec3 a, b;
    float radius = 1;  // metres
};

// A box of the tree over a compound's triangles: a leaf holds triangles [first, first + count) of
// Compound::order, another (count 0) the boxes `first` and `first` + 1.
struct CompoundBox {
    Vec3 low, high;
    uint32_t first = 0, count = 0;
};

struct Compound {
    std::vector<Sphere> spheres;
    std::vector<Capsule> capsules;
    std::vector<Vec3> vertices;
    std::vector<uint32_t> indices;  // three a triangle, counter-clockwise from outside
    std::vector<Vec3> middles;      // of the pieces that these are in; none: they are one

    // Filled by index_compound.
    std::vector<CompoundBox> boxes;
    std::vector<uint32_t> order;
};

// To be called once, after the arrays are filled.
void index_compound(Compound& compound);

struct SurfaceHit {
    float distance = 0;
    Vec3 point, normal;  // out of the solid, unit
};

// The first surface along origin + t * direction, 0 <= t <= reach. `direction` is a unit vector. Solids are
// hit from outside: one that holds the origin is not there for that ray, nor is a triangle's back.
std::optional<SurfaceHit> cast_ray(const Compound& compound, Vec3 origin, Vec3 direction, float reach);

// The first surface below `point`, within `reach` metres along -`up`.
inline std::optional<SurfaceHit> surface_below(const Compound& compound, Vec3 point, Vec3 up, float reach) {
    return cast_ray(compound, point, -up, reach);
}

// What casts rays: a compound, which must outlive it, or whatever else has surfaces. `cast` does as
// cast_ray() does, on any thread.
struct Rays {
    const void* asked = nullptr;
    std::optional<SurfaceHit> (*cast)(const void* asked, Vec3 origin, Vec3 direction, float reach) = nullptr;
};
Rays rays_of(const Compound& compound);

}  // namespace flaneur
