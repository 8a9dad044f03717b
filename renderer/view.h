// What a camera sees, as matrices and planes, and who is seen how large. Pure functions; metres and radians.
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

// Whether a view does not go on from the one before, but shows something else.
bool is_cut(const View& before, const View& now);

// Whether a sphere is, at least in part, within the planes (may say yes for a sphere outside near a corner).
bool sees_sphere(const View& view, glm::vec3 centre, float radius);
bool sees_box(const View& view, glm::vec3 low, glm::vec3 high);

// How many pixels high a sphere is seen.
float pixels_of(const View& view, glm::vec3 centre, float radius);

struct BodySphere {
    glm::vec3 centre;
    float radius;
};
// About the middle of a body and its shadow on the ground, both within it. Shadows longer than ten times the
// body are not followed.
BodySphere with_shadow(glm::vec3 centre, float radius, glm::vec3 to_sun);

// Whose joints a frame asks for, as pose_needs() in renderer.h says: the others may be handed over with
// k_no_palette, and the picture is the same. `centre` and `radius` as WalkerDraw's.
struct PoseNeeds {
    View view;
    glm::vec3 to_sun{0, 1, 0};
    float pixels = 0;  // bodies whose spheres are smaller are drawn without joints
};
bool needs_pose(const PoseNeeds& needs, glm::vec3 centre, float radius);

// A unit vector square to `v`, level where that is possible.
glm::vec3 level_across(glm::vec3 v);
glm::mat4 from_rows(glm::vec4 a, glm::vec4 b, glm::vec4 c, glm::vec4 d);

}  // namespace flaneur
