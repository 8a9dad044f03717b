// Dear ImGui in a window: its lists become the panels of a frame.
#pragma once

#include <memory>
#include <vector>

#include "renderer/renderer.h"
#include "tools/flaneur/window/events.h"

struct GLFWwindow;
struct ImFont;

namespace flaneur {

// One in a program at a time. Takes over the window's callbacks of wheel and focus; mouse and keys it is told
// of.
struct Gui {
    std::vector<PanelVertex> vertices;
    std::vector<uint16_t> indices;
    std::vector<PanelDraw> draws;
    float scale = 1;                  // of letters and all else
    bool is_light = false;            // of theme
    std::vector<RgbaImage> pictures;  // that panels show beside letters,
    std::vector<glm::vec4> boxes;     // and where they find them: u and v of two corners
};
struct GuiDelete {
    void operator()(Gui* gui) const;
};
using GuiPtr = std::unique_ptr<Gui, GuiDelete>;

// `scale`: of letters, 1..3; 0: the display's own.
Result<GuiPtr> make_gui(GLFWwindow* window, Renderer& renderer, float scale, std::vector<RgbaImage> pictures);

// The letters and pictures of the panels, for a renderer that has not got them.
Result<void> hand_letters(Gui& gui, Renderer& renderer);

// Letters of headings, half as large again.
ImFont* title_font();

// Letters and all else in another size (as make_gui takes it, but no larger than the window has room for) and
// theme, from the next frame on; nothing happens where they are so already.
Result<void> suit_gui(Gui& gui, GLFWwindow* window, Renderer& renderer, float scale, bool is_light);

// Between these two the calls of ImGui lay out what is seen. What is returned is valid until the next call.
struct GuiInput {
    Pointer pointer;
    TypedNow typed;
    bool moves = false;  // arrows, Tab, Space and Enter move about in panels,
    int tap = 0;         // of which this one is pressed; 0: none
    int held = 0;        // of GLFW_MOD_CONTROL, _SHIFT and _ALT
};
void begin_gui(Gui& gui, GLFWwindow* window, const GuiInput& input);
Panels end_gui(Gui& gui);

// Whether the cursor, or the keys, are a panel's; and whether one types in a field.
bool gui_has_mouse();
bool gui_has_keys();
bool gui_has_field();
// Whether a press at this place, pixels, is a panel's, as they were laid out last.
bool is_on_panel(double x, double y);
// Notches that the wheel was turned since the last frame, away from the hand and to the right; none over a
// panel. With Shift it goes to the side.
struct Wheel {
    float away = 0, right = 0;
};
Wheel gui_wheel(bool is_inverted);

}  // namespace flaneur
