// The views for work: what is laid over a frame, made from the state of the world.
#pragma once

#include <vector>

#include "sim/world.h"
#include "tools/extract/extract.h"
#include "tools/flaneur/options/options.h"
#include "tools/flaneur/overlay/shapes.h"

namespace flaneur {

// Where everybody was, ten times a second for the last ten seconds.
struct Trails {
    std::vector<Vec3> places;  // k_trail_places a walker, a ring
    uint32_t taken = 0;        // of each walker
};
inline constexpr uint32_t k_trail_places = 100;
inline constexpr uint32_t k_trail_ticks = 6;  // between two places

// To be called after every tick while trails are wanted.
void follow_trails(const World& world, Trails& trails);

struct Overlay {
    std::vector<GizmoLine> lines;
    std::vector<GizmoCorner> fills;
    Trails trails;
    std::vector<GizmoCorner> walkable;  // made when it is first wanted
    float legend_foot = 0;              // pixels of the picture that legends stand above its lower edge
};

// What they are made from.
struct OverlayInput {
    const World& world;
    const std::vector<Character>& characters;
    const Camera& camera;
    float between = 1;  // the last two ticks
};

// Sets what `views` ask for in `frame`, which refers to `overlay` and `people` then.
void lay_over(const OverlayInput& input, WorkViews views, PeopleFrame& people, Overlay& overlay,
              FrameInput& frame);

// The views, each adding to the overlay.
void add_density(const OverlayInput& input, Overlay& overlay);
void add_walkable(const OverlayInput& input, Overlay& overlay);
void add_trails(const OverlayInput& input, Overlay& overlay);
void add_skeletons(const OverlayInput& input, const PeopleFrame& people, Overlay& overlay);
void add_gait_gizmos(const OverlayInput& input, const PeopleFrame& people, Overlay& overlay);

// Where a joint of one who has joints is drawn.
glm::vec3 joint_place(const OverlayInput& input, const PeopleFrame& people, uint32_t walker, Joint joint);
// A vector of the canonical pose, turned as a joint is.
glm::vec3 joint_turned(const PeopleFrame& people, uint32_t walker, const Character& character, Joint joint,
                       glm::vec3 v);

// Of Fruin's levels of service, A to F.
inline constexpr uint32_t k_fruin_colours[] = {ink(0x4f9f6a), ink(0x9dbb4f), ink(0xe0cf4a),
                                               ink(0xe79a3c), ink(0xd9573a), ink(0x9b2335)};
inline constexpr uint32_t k_surface_colours[k_surface_count] = {
    ink(0x5f6f86, 0.6f), ink(0x3f9f9a, 0.6f), ink(0xe7c14a, 0.6f), ink(0xd98c5f, 0.6f), ink(0x9dbb4f, 0.6f),
    ink(0xa06ab4, 0.6f), ink(0x5f8f3f, 0.6f), ink(0x3d5a99, 0.6f), ink(0x6b5f57, 0.6f)};
inline constexpr uint32_t k_left_colour = ink(0x3fa7b5), k_right_colour = ink(0xe2725b);
inline constexpr uint32_t k_trunk_colour = ink(0xf3e9d8), k_joint_colour = ink(0xffffff);

}  // namespace flaneur
