// Dear ImGui in a window: its lists become the panels of a frame.
#pragma once

#include <memory>
#include <vector>

#include "renderer/renderer.h"

struct GLFWwindow;
struct ImFont;

namespace flaneur {

// One in a program at a time. Takes over the window's callbacks, and passes on to those that were set before
// it.
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
// `keys`: whether arrows, Tab, Space and Enter move about in panels; of them ImGui learns in this frame that
// `tap` is pressed, and of none in another way. 0: of none.
void begin_gui(Gui& gui, bool keys = false, int tap = 0);
Panels end_gui(Gui& gui);

// Whether the cursor, or the keys, are a panel's.
bool gui_has_mouse();
bool gui_has_keys();
// Notches that the wheel was turned since the last frame, away from the hand and to the right; none over a
// panel. With Shift it goes to the side.
struct Wheel {
    float away = 0, right = 0;
};
Wheel gui_wheel(bool is_inverted);

}  // namespace flaneur
