// Keys and mouse.
#pragma once

#include <array>

#include "tools/flaneur/window/events.h"
#include "tools/flaneur/window/viewer.h"

struct GLFWwindow;

namespace flaneur {

// From now on the window's keys and its mouse do to `viewer`, which must outlive it.
void listen(GLFWwindow* window, Viewer& viewer);

// The mouse in the city, from one frame to the next.
struct Mouse {
    double x = 0, y = 0;
    bool is_held = false;               // the left button
    bool pans = false, orbits = false;  // the middle one, the right one
    double held_x = 0, held_y = 0;      // where it was when a button went down
    bool has_clicked = false;           // in this frame, without a drag
    std::array<bool, 3> is_down{};      // buttons, by GLFW_MOUSE_BUTTON_*, those that are a panel's too
};
// A button is the city's, until it is let go of, if it went down where no panel is.
void read_mouse(const Pointer& pointer, bool is_on_panel, Mouse& mouse);
// Whether what the mouse does now is a panel's.
bool is_of_panels(const Mouse& before, const Mouse& now, bool is_on_panel);

// Whether a key edits what is typed; others are letters, which come by themselves.
bool edits(int key, int mods);
// Whether one types where keys have meanings of their own: in the palette, the path of a file.
bool has_own_field(const Viewer& viewer);

// What panels are told of in the next picture; of what is typed that is the end.
struct GuiInput;
GuiInput gui_input(GLFWwindow* window, Viewer& viewer);

// What keys and a mouse that drags ask for.
Steering steering_of(GLFWwindow* window, const Mouse& before, const Mouse& now, const Viewer& viewer);

// Moves the eye so; tells whether anything was asked for.
bool fly(const Steering& hands, float seconds, Viewer& viewer);

}  // namespace flaneur
