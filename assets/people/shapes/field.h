// The implicit body that people are cut from: layers (skin, hair, each garment), each a smooth blend of
// lofts. Lengths are in body heights, the bind pose; x is folded, so that a part on the left serves both
// sides.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "sim/base/vec.h"

namespace flaneur {

enum Layer : uint8_t {
    layer_skin,
    layer_hair,
    layer_inner,  // what is worn under a jacket
    layer_top,
    layer_bottom,
    layer_shoes,
    layer_collar,  // of a shirt
    layer_trim,    // lapels, hoods, pockets of what is worn outermost
};
inline constexpr int k_layer_count = 8;
using LayerDistances = std::array<float, k_layer_count>;

// A cross-section: half an ellipse ahead, half an ellipse behind, squared off by `square` (0 round .. 1
// boxy).
struct BodyRing {
    float t;              // along the axis
    float side, front;    // centre
    float width;          // half the width
    float ahead, behind;  // depths from the centre
    float square = 0;
};

// Rings swept along a straight axis and closed at both ends by half ellipsoids, or cut flat where the cap is
// 0. One ring makes an ellipsoid.
struct Loft {
    Vec3 origin, side{1, 0, 0}, axis{0, 1, 0}, front{0, 0, 1};  // orthonormal
    float begin = 0, end = 0, cap_begin = 0, cap_end = 0;
    std::vector<BodyRing> table;  // samples at even steps from begin to end
    Vec3 centre;                  // of a sphere that holds the loft
    float radius = 0;
};

BodyRing mix_rings(const BodyRing& a, const BodyRing& b, float t);

// Rings in rising t, joined by cubics.
Loft make_loft(Vec3 origin, Vec3 side, Vec3 axis, std::span<const BodyRing> rings, float cap_begin,
               float cap_end);
Loft make_ellipsoid(Vec3 centre, Vec3 radii);
// An ellipsoid with its x axis along `side` and its y axis along `axis`.
Loft make_ellipsoid(Vec3 centre, Vec3 radii, Vec3 side, Vec3 axis);
// From a to b with round ends.
Loft make_capsule(Vec3 a, Vec3 b, float radius_a, float radius_b);

// The stretch of a loft between two places along its axis, with caps of its own.
Loft trimmed(const Loft& loft, float begin, float end, float cap_begin, float cap_end);

// About the signed distance to the loft, negative inside; exact to first order near the surface.
float distance(const Loft& loft, Vec3 p);

// Union, difference, intersection, all rounded over `round`.
enum class FieldBlend : uint8_t { add, carve, keep };

struct FieldPart {
    Layer layer;
    FieldBlend blend = FieldBlend::add;
    float round = 0;
    float grow = 0;  // offset of the surface
    Loft loft{};
    bool is_plane = false;  // the half space dot(normal, p) < offset instead of the loft
    Vec3 normal{0, 1, 0};
    float offset = 0;
};

struct Field {
    std::vector<FieldPart> parts;  // applied in order
};

// Indices of the parts that matter within `radius` of p.
void parts_near(const Field& field, Vec3 p, float radius, std::vector<uint16_t>& near);
// Those of them that matter to the surface there, which takes longer to tell.
void parts_touching(const Field& field, Vec3 p, float radius, std::vector<uint16_t>& near);
LayerDistances layer_distances(const Field& field, std::span<const uint16_t> near, Vec3 p);
float distance(const LayerDistances& layers);
// Of one layer's distance, or of the nearest layer's where `layer` is negative.
Vec3 gradient(const Field& field, std::span<const uint16_t> near, Vec3 p, int layer = -1);

}  // namespace flaneur
