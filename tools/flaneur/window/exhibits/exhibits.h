// What inverse kinematics moves in the gallery, under one's hands: targets that the left button drags, and
// the method by which each exhibit follows them.
//
// All of it is a change of the city as any other (window/change): it holds from a tick on, is undone by
// Ctrl+Z, and going back in time goes back behind it.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/scene.h"
#include "sim/linkages/linkages.h"
#include "tools/flaneur/options/options.h"

namespace flaneur {

struct Action;
struct Design;
struct Mouse;
struct Show;
struct Viewer;
struct World;

struct TargetGrip {
    size_t target = 0;  // of Linkages::targets
    Vec3 from;          // where the button went down, in the plane that is dragged in,
    Vec3 was;           // and where the target was then
    uint64_t gesture = 0;
};

struct ExhibitsRoom {
    std::optional<size_t> chosen;   // linkage
    std::optional<size_t> hovered;  // target
    std::optional<TargetGrip> grip;
    std::vector<float> us;  // of each linkage, microseconds a tick, smoothed
};

// Whether something is here that can be dragged: creatures of the asteroid are led by their feet.
bool has_exhibits(const World& world);

// The target that is seen nearest to a point of the picture, pixels from the upper left corner, within 16 of
// its outline and before any wall.
std::optional<size_t> target_at(const World& world, const Camera& camera, Size size, glm::vec2 pixel);
// Where the way through a point of the picture meets the plane through `at` that faces the eye; `at` where it
// does not.
Vec3 in_facing_plane(const Camera& camera, Size size, glm::vec2 pixel, Vec3 at);
// The number of the linkage that a target is of.
size_t linkage_of(const Linkages& linkages, size_t target);
// "CCD"; of what is no chain, its name.
std::string told_method(const Linkage& linkage, const Method& method);

// What a design says of targets and methods holds in the world. False if all did already.
bool set_exhibits(const Design& before, const Design& wanted, World& world);
// The same, all of it, of a world that is made anew.
void set_exhibits(const Design& wanted, World& world);

// Whether the left button is a target's: takes hold of it, drags it, lets it stay.
bool drag_target(const Show& show, const Mouse& before, const Mouse& now, Size size, bool is_elsewhere,
                 Viewer& viewer);
// Adds rings about targets that are pointed at or held to the frame.
void mark_targets(const Viewer& viewer, Show& show, FrameInput& frame);

// The room: figures of each exhibit; method, tolerance and iterations of the one that is chosen.
void lay_out_exhibits(Show& show, Viewer& viewer, float scale);

std::span<const Action> exhibit_actions();

}  // namespace flaneur
