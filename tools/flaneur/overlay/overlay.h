// The views for work: what is laid over a frame, made from the state of the world.
#pragma once

#include <vector>

#include "sim/without.h"
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
// Where somebody stands, on small worlds too.
inline Vec3 place_of(const World& world, uint32_t walker) {
    return world.roam ? world.roam->walkers.position[walker] : world.crowd.motion.position[walker];
}

struct Overlay {
    bool letters_legends = true;  // else whoever shows the picture has legends_of() elsewhere
    std::vector<GizmoLine> lines;
    std::vector<GizmoCorner> fills;
    Trails trails;
    std::vector<GizmoCorner> walkable;  // made when it is first wanted
};

// What they are made from.
struct OverlayInput {
    const World& world;
    const std::vector<Character>& characters;
    const Camera& camera;
    float between = 1;                 // the last two ticks
    const Without* without = nullptr;  // by which people are drawn, as they were last caught up; null: whole
};

// Sets what `views` ask for in `frame`, which refers to `overlay` and `people` then.
void lay_over(const OverlayInput& input, WorkViews views, PeopleFrame& people, Overlay& overlay,
              FrameInput& frame);

// What colours of the views mean; of those that have any, in the order of their numbers.
struct LegendEntry {
    const char* what;
    uint32_t colour;
};
struct Legend {
    const char* title;
    std::vector<LegendEntry> entries;
};
std::vector<Legend> legends_of(WorkViews views, const World& world);

// The views, each adding to the overlay.
void add_density(const OverlayInput& input, Overlay& overlay);
// Where there are more people than in another world, and where fewer; from the same eye.
inline constexpr uint32_t k_more_people = 0xe0871e, k_fewer_people = 0x2f7fd6;  // RGB
void add_density_difference(const OverlayInput& input, const World& other, Overlay& overlay);
void add_walkable(const OverlayInput& input, Overlay& overlay);
void add_trails(const OverlayInput& input, Overlay& overlay);
void add_ways(const OverlayInput& input, Overlay& overlay);
// Of crossings with lamps.
void add_kerbs(const OverlayInput& input, Overlay& overlay);
// Where one drives, and what those who do brake for.
void add_lanes(const OverlayInput& input, Overlay& overlay);
// Of those on a course.
void add_stepper_ways(const OverlayInput& input, Overlay& overlay);
void add_linkage_gizmos(const OverlayInput& input, Overlay& overlay);
// What each figure of the gallery shows.
void add_figure_gizmos(const OverlayInput& input, Overlay& overlay);
void add_deed_gizmos(const OverlayInput& input, Overlay& overlay);
void add_skeletons(const OverlayInput& input, const PeopleFrame& people, Overlay& overlay);
void add_gait_gizmos(const OverlayInput& input, const PeopleFrame& people, Overlay& overlay);
// Of one who has joints: where heels and balls press on the ground; and footprints, targets of feet and
// hands, velocity, way and gaze.
void add_contact_marks(const OverlayInput& input, uint32_t walker, Overlay& overlay);
void add_gizmos_of(const OverlayInput& input, const PeopleFrame& people, uint32_t walker, Overlay& overlay);

// Where a joint of one who has joints is drawn.
glm::vec3 joint_place(const OverlayInput& input, const PeopleFrame& people, uint32_t walker, Joint joint);
// A vector of the canonical pose, turned as a joint is.
glm::vec3 joint_turned(const PeopleFrame& people, uint32_t walker, const Character& character, Joint joint,
                       glm::vec3 v);

// Of Fruin's levels of service, A to F. Any two are at least 18 apart in CIELAB for those too who see no red,
// no green or no blue (G. M. Machado and others, A Physiologically-based Model for Simulation of Color Vision
// Deficiency, 2009); so are the colours of speed.
inline constexpr uint32_t k_fruin_colours[] = {ink(0x2f6f9f), ink(0x4fa3a5), ink(0xa9c66c),
                                               ink(0xf0d24a), ink(0xe08a34), ink(0xa8323f)};
inline constexpr uint32_t k_surface_colours[k_surface_count] = {
    ink(0x5f6f86, 0.6f), ink(0x3f9f9a, 0.6f), ink(0xe7c14a, 0.6f), ink(0xd98c5f, 0.6f), ink(0x9dbb4f, 0.6f),
    ink(0xa06ab4, 0.6f), ink(0x5f8f3f, 0.6f), ink(0x3d5a99, 0.6f), ink(0x6b5f57, 0.6f)};
inline constexpr uint32_t k_left_colour = ink(0x3fa7b5), k_right_colour = ink(0xe2725b);
// Of ways: the document's red and blue, and green.
inline constexpr uint32_t k_barred_colour = ink(0xd8352a), k_chosen_colour = ink(0x2a62d8),
                          k_free_colour = ink(0x3fae5a);
// And of the ways on a compound: rays ahead and behind, normals where they hit, and their mean.
inline constexpr uint32_t k_ray_colours[] = {ink(0xf2d433), ink(0xe8402f)},
                          k_normal_colours[] = {ink(0x4fc24a), ink(0xd64bc4)}, k_mean_colour = ink(0x39c6d6);
inline constexpr uint32_t k_trunk_colour = ink(0xf3e9d8), k_joint_colour = ink(0xffffff);

}  // namespace flaneur
