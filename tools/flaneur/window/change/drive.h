// Somebody goes where keys or a stick say.
#pragma once

struct GLFWwindow;

namespace flaneur {

struct Show;
struct Viewer;

// Takes over who was asked about, or lets go of who is driven.
void drive_asked(Show& show, Viewer& viewer);
bool is_driving(const Show& show);
// Gives whoever is driven back to its errand; false if nobody is.
bool let_go_of_driven(Show& show, Viewer& viewer);
// The one who is driven jumps; false if nobody is driven.
bool jump_driven(Show& show);

// Who was asked about, or is pointed at, is pushed away from the eye by so many newton seconds.
void push_asked(Show& show, Viewer& viewer, float impulse);
inline constexpr float k_shove = 45, k_hard_shove = 170;

// Once a frame: arrows, W A S D or the left stick of a gamepad say where to go, as the camera sees it; Shift
// runs.
void steer_driven(GLFWwindow* window, Show& show, const Viewer& viewer);

}  // namespace flaneur
