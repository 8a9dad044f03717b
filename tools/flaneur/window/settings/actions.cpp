#include "tools/flaneur/window/actions.h"

#include <GLFW/glfw3.h>

#include <array>

#include "tools/flaneur/window/settings/panel_keys.h"
#include "tools/flaneur/window/settings/room.h"

namespace flaneur {

namespace {

constexpr std::array k_settings_actions = {
    Action{"Settings", "Ctrl+,", GLFW_KEY_COMMA, GLFW_MOD_CONTROL, open_settings},
    Action{"Larger letters", "Ctrl++", GLFW_KEY_EQUAL, GLFW_MOD_CONTROL,
           [](Show&, Viewer& v) { change_letters(v, 1); }},
    Action{"Smaller letters", "Ctrl+-", GLFW_KEY_MINUS, GLFW_MOD_CONTROL,
           [](Show&, Viewer& v) { change_letters(v, -1); }},
    Action{"Letters as the display asks for", "Ctrl+0", GLFW_KEY_0, GLFW_MOD_CONTROL,
           [](Show&, Viewer& v) { reset_letters(v); }},
    Action{"Use the panels by keys", "Ctrl+Tab", GLFW_KEY_TAB, GLFW_MOD_CONTROL, ask_for_panels},
};

}  // namespace

std::span<const Action> settings_actions() { return k_settings_actions; }

}  // namespace flaneur
