// Somebody goes where keys or a stick say.
#pragma once

#include <optional>

#include "sim/base/vec.h"

struct GLFWwindow;

namespace flaneur {

struct Driving;
struct Show;
struct Viewer;
struct World;

// Takes over who was asked about, or lets go of who is driven.
void drive_asked(Show& show, Viewer& viewer);
bool is_driving(const Show& show);
// The same of bodies that key poses make: the first, the next, or none any more.
void drive_figure(Show& show, Viewer& viewer);
// Gives whoever is driven back to its errand; false if nobody is.
bool let_go_of_driven(Show& show, Viewer& viewer);
// The one who is driven jumps; false if nobody is driven.
bool jump_driven(Show& show);

// Who was asked about, or is pointed at, is pushed away from the eye by so many newton seconds.
void push_asked(Show& show, Viewer& viewer, float impulse);
inline constexpr float k_shove = 45, k_hard_shove = 170;
// A ball of so many kilograms is thrown from the eye at who was asked about or is pointed at, or else ahead.
void throw_asked(Show& show, Viewer& viewer, float mass);
inline constexpr float k_light_throw = 4, k_heavy_throw = 12;
// Of one who is driven by turns: Up or W goes on, Down or S stops, Left or A and Right or D turn by 45
// degrees, one turn at a time, on the way. False of all other keys and of one who is not.
bool press_in_drive(int key, int mods, Show& show, Viewer& viewer);
// By turns from now on, or as keys are held.
void drive_by_turns(Show& show, Viewer& viewer, bool is_by_turns);
// The wish of one who is driven by turns, after the world's last tick; who runs at `speed` m/s, or walks at
// its own.
Vec2 wish_by_turns(const World& world, Driving& driving, std::optional<float> speed);

// Once a frame: arrows, W A S D or the left stick of a gamepad say where to go, as the camera sees it; Shift
// runs.
void steer_driven(GLFWwindow* window, Show& show, Viewer& viewer);

}  // namespace flaneur
