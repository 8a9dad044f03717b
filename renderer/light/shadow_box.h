// Where the city and its people throw shadows: square boxes seen from the sun. Pure functions; metres and
// radians.
#pragma once

#include "renderer/view.h"

namespace flaneur {

// A part of the view, along `forward`, metres.
struct Slice {
    float near = 0, far = 60;
};

// The part that wants fine shadows: the 60 m ahead of an eye on the street, and more, from where the ground
// comes into sight, for an eye `height` metres above it.
Slice fine_shadow_slice(const View& view, float height);

// The part where the city throws shadows at all: 250 m ahead, and twice, four times... as far where the fine
// part reaches far.
Slice far_shadow_slice(Slice fine);

// A square map of depths seen from the sun.
struct ShadowBox {
    glm::mat4 map_from_world{0.0f};  // u, v and depth within 0..1; depth grows away from the sun
    float texel = 1;                 // metres
    float size = 0;                  // metres along each edge that is seen; it is deeper
    bool operator==(const ShadowBox&) const = default;
};

// The box about a slice's bounding sphere. It moves in whole steps of an eighth of the sphere's radius, each
// a whole number of texels, so shadows do not crawl and what is still can be kept from frame to frame; along
// the light in longer ones.
ShadowBox fit_shadow(const View& view, glm::vec3 to_sun, Slice slice, uint32_t resolution);

// Whether a box may throw a shadow into the map: it overlaps it seen from the sun, and does not lie behind
// it.
bool casts_into(const ShadowBox& box, glm::vec3 low, glm::vec3 high);
bool casts_into(const ShadowBox& box, glm::vec3 centre, float radius);

}  // namespace flaneur
