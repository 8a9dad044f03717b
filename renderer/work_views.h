// Views for work: what surfaces show in place of light, and what is laid over a picture. FrameInput asks for
// them; what is not asked for costs nothing.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace flaneur {

// What surfaces show: their light, or for work how they are made. Overdraw: brighter where a pixel is drawn
// more often. Ids: the renderer's own, for FrameInput::wants_ids.
enum class Surfaces : uint8_t { lit, wireframe, normals, overdraw, ids };

// What people are coloured by: their own colours; their tints alone, without textures; or one colour for each
// level of detail (k_level_colours).
enum class PeopleColours : uint8_t { own, tints, levels };
// sRGB, R in the lowest byte: of meshes, finest first, then of impostors.
inline constexpr uint32_t k_level_colours[] = {0xff5fae4eu, 0xff3cc4d8u, 0xff2f86e2u,
                                               0xff3a45c8u, 0xffa04a9bu, 0xffd08a3fu};

// A line drawn over the picture, with round ends, anti-aliased. As wide as it says in pixels, or as its radii
// look from the eye, whichever is more; one with radii is shaded like a rod. A point is a line without
// length.
enum class GizmoPlace : uint32_t {
    in_world,         // dimmed where things hide it
    in_world_hidden,  // not drawn where things hide it
    on_picture,  // x and y of both ends are shares of the picture's width and height, from the upper left
};
struct GizmoLine {
    glm::vec3 a{0};      // metres
    float radius_a = 0;  // metres
    glm::vec3 b{0};
    float radius_b = 0;
    glm::vec2 shift_a{0}, shift_b{0};  // of the ends on the picture, pixels to the right and down
    float pixels = 2;
    uint32_t colour = ~0u;  // sRGB and alpha, R in the lowest byte
    GizmoPlace place = GizmoPlace::in_world;
};

// A corner of a triangle laid over the scene, a little nearer to the eye than it is.
struct GizmoCorner {
    glm::vec3 place;      // metres
    uint32_t colour = 0;  // sRGB and alpha, R in the lowest byte
};

}  // namespace flaneur
