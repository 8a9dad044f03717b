// Cameras and light as matrices. Pure functions; metres and radians.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "renderer/scene.h"

namespace flaneur {

// What a camera sees. Depth is reversed with the far plane at infinity: near_plane / distance.
struct View {
    glm::mat4 clip_from_world;
    glm::vec3 eye, forward, right,
        down;                         // forward is a unit; right and down reach the picture's border at 1 m
    float pixels_at_one_metre = 0;    // how many pixels a metre is tall, one metre ahead
    std::array<glm::vec4, 5> planes;  // left, right, top, bottom, near; dot(xyz, p) + w >= 0 inside
};

// Cameras that look nowhere or are not numbers are given a sane direction; near planes and fields of view are
// clamped.
View make_view(const Camera& camera, uint32_t width, uint32_t height);

// A unit vector towards the sun; for no direction at all, the default Sun's.
glm::vec3 sun_direction(const Sun& sun);
// A unit vector turned upwards to at least `lowest` radians above the horizon.
glm::vec3 above_horizon(glm::vec3 direction, float lowest);

// A part of the view, along `forward`, metres.
struct Slice {
    float near = 0, far = 60;
};

// The part that wants fine shadows: the 60 m ahead of an eye on the street, and more, from where the ground
// comes into sight, for an eye `height` metres above it.
Slice fine_shadow_slice(const View& view, float height);

// A square map of depths seen from the sun.
struct ShadowBox {
    glm::mat4 map_from_world{0.0f};  // u, v and depth within 0..1; depth grows away from the sun
    float texel = 1;                 // metres
    float size = 0;                  // metres along each edge
    bool operator==(const ShadowBox&) const = default;
};

// The box about a slice's bounding sphere. It moves in whole steps of an eighth of the sphere's radius, each
// a whole number of texels, so shadows do not crawl and what is still can be kept from frame to frame.
ShadowBox fit_shadow(const View& view, glm::vec3 to_sun, Slice slice, uint32_t resolution);

// Whether a sphere is, at least in part, within the planes (may say yes for a sphere outside near a corner).
bool sees_sphere(const View& view, glm::vec3 centre, float radius);
bool sees_box(const View& view, glm::vec3 low, glm::vec3 high);

// Whether a box may throw a shadow into the map: it overlaps it seen from the sun, and does not lie behind
// it.
bool casts_into(const ShadowBox& box, glm::vec3 low, glm::vec3 high);
bool casts_into(const ShadowBox& box, glm::vec3 centre, float radius);

}  // namespace flaneur
