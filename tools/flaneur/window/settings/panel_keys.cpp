#include "tools/flaneur/window/settings/panel_keys.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <iterator>

#include "tools/flaneur/window/panels.h"
#include "tools/flaneur/window/viewer.h"

namespace flaneur {

void ask_for_panels(Show&, Viewer& v) {
    PanelKeys& keys = v.panel_keys;
    keys.panel = keys.are_on ? keys.panel + 1 : v.room != Room::none ? 1 : 0;
    keys.are_on = keys.wants_focus = v.has_panels = true;
    tell(v, "Arrows, Tab and Space are for the panels; Ctrl+Tab goes to the next one, Esc back to the city.");
}

void leave_panels(Viewer& v) {
    v.panel_keys = {};
    v.note_until = 0;
    ImGui::SetWindowFocus(nullptr);
}

bool press_in_panels(int key, int mods, Viewer& v) {
    if (mods & (GLFW_MOD_CONTROL | GLFW_MOD_ALT)) return false;
    const bool is_busy = ImGui::IsAnyItemActive() || ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup);
    if (key == GLFW_KEY_ESCAPE && !is_busy) return leave_panels(v), true;
    if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F25) return false;
    // Buttons know Space alone.
    const bool is_enter = key == GLFW_KEY_ENTER || key == GLFW_KEY_KP_ENTER;
    v.panel_keys.taps.push_back(is_enter && !ImGui::GetIO().WantTextInput ? GLFW_KEY_SPACE : key);
    return true;
}

bool is_panel_key(int key) {
    constexpr int k_keys[] = {GLFW_KEY_TAB,      GLFW_KEY_SPACE,  GLFW_KEY_ENTER,
                              GLFW_KEY_KP_ENTER, GLFW_KEY_ESCAPE, GLFW_KEY_LEFT,
                              GLFW_KEY_RIGHT,    GLFW_KEY_UP,     GLFW_KEY_DOWN};
    return std::find(std::begin(k_keys), std::end(k_keys), key) != std::end(k_keys);
}

int next_tap(PanelKeys& keys) {
    keys.has_rested = !keys.has_rested || keys.taps.empty();
    if (keys.has_rested) return 0;
    const int key = keys.taps.front();
    keys.taps.pop_front();
    return key;
}

}  // namespace flaneur
