// Dear ImGui in a window: its lists become the panels of a frame.
#pragma once

#include <memory>
#include <vector>

#include "renderer/renderer.h"

struct GLFWwindow;

namespace flaneur {

// One in a program at a time. Takes over the window's callbacks, and passes on to those that were set before
// it.
struct Gui {
    std::vector<PanelVertex> vertices;
    std::vector<uint16_t> indices;
    std::vector<PanelDraw> draws;
    float scale = 1;  // of letters and all else
};
struct GuiDelete {
    void operator()(Gui* gui) const;
};
using GuiPtr = std::unique_ptr<Gui, GuiDelete>;

// `scale`: of letters, 1..3; 0: the display's own.
Result<GuiPtr> make_gui(GLFWwindow* window, Renderer& renderer, float scale);

// Between these two the calls of ImGui lay out what is seen. What is returned is valid until the next call.
void begin_gui(Gui& gui);
Panels end_gui(Gui& gui);

// Whether the cursor, or the keys, are a panel's.
bool gui_has_mouse();
bool gui_has_keys();
// Notches that the wheel was turned since the last frame, away from the hand and to the right; none over a
// panel. With Shift it goes to the side.
struct Wheel {
    float away = 0, right = 0;
};
Wheel gui_wheel();

}  // namespace flaneur
