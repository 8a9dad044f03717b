// Those on a course and the place under the pointer: all look there who can turn their heads so far, and who
// is driven may go there.
#pragma once

#include <optional>
#include <span>

#include "renderer/scene.h"
#include "sim/base/vec.h"
#include "tools/flaneur/options/options.h"

namespace flaneur {

struct Action;
struct Mouse;
struct Show;
struct Viewer;
struct World;

struct SteppersHand {
    bool eyes_follow = true;    // heads turn to the pointer
    bool driven_goes = true;    // who is driven goes there, rather than by keys
    std::optional<Vec3> place;  // under the pointer, as the last picture had it
};

// Where the way through a point of the picture, pixels from the upper left corner, meets the course.
std::optional<Vec3> place_under(const World& world, const Camera& camera, Size size, double x, double y);

// Once a frame: tells the world where they look and go. `is_elsewhere`: the pointer is on a panel.
void follow_pointer(Show& show, const Mouse& mouse, Size size, bool is_elsewhere, Viewer& viewer);
// Whether a hand leads them so, which is not simulated again.
bool is_led_by_pointer(const Show& show);

// In the room Change: whether the course is in one line. Nothing elsewhere.
void lay_out_course(const Show& show, Viewer& viewer);

std::span<const Action> stepper_actions();

}  // namespace flaneur
