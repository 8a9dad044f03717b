// Keys and mouse.
#pragma once

#include "tools/flaneur/window/viewer.h"

struct GLFWwindow;

namespace flaneur {

// From now on the window's keys do to `viewer`, which must outlive it.
void listen(GLFWwindow* window, Viewer& viewer);

// The mouse, from one frame to the next.
struct Mouse {
    double x = 0, y = 0;
    bool is_held = false;               // the left button
    bool pans = false, orbits = false;  // the middle one, the right one
    double held_x = 0, held_y = 0;      // where it was when a button went down
    bool has_clicked = false;           // in this frame, without a drag
};
// What is a panel's is left to it.
void read_mouse(GLFWwindow* window, bool is_panels, Mouse& mouse);

// What keys and a mouse that drags ask for.
Steering steering_of(GLFWwindow* window, const Mouse& before, const Mouse& now, const Viewer& viewer);

// Moves the eye so; tells whether anything was asked for.
bool fly(const Steering& hands, float seconds, Viewer& viewer);

}  // namespace flaneur
