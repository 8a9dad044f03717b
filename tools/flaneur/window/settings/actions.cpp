#include "tools/flaneur/window/actions.h"

#include <GLFW/glfw3.h>

#include <array>

#include "tools/flaneur/window/settings/panel_keys.h"
#include "tools/flaneur/window/settings/room.h"

namespace flaneur {

namespace {

constexpr std::array k_settings_actions = {
    Action{"Settings", "Ctrl+,", GLFW_KEY_COMMA, GLFW_MOD_CONTROL, open_settings},
    Action{"Use the panels by keys", "Ctrl+Tab", GLFW_KEY_TAB, GLFW_MOD_CONTROL, ask_for_panels},
};

}  // namespace

std::span<const Action> settings_actions() { return k_settings_actions; }

}  // namespace flaneur
