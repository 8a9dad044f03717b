#include "tools/flaneur/window/actions.h"

#include <GLFW/glfw3.h>

#include <array>

#include "tools/flaneur/window/open/open.h"

namespace flaneur {

namespace {

constexpr std::array k_opening_actions = {
    Action{"Open a file: a map, a city, a character, a scene", "Ctrl+O", GLFW_KEY_O, GLFW_MOD_CONTROL,
           ask_for_path},
    Action{"Start screen: scenes and recent files", "Ctrl+N", GLFW_KEY_N, GLFW_MOD_CONTROL,
           open_start_screen},
};

}  // namespace

std::span<const Action> opening_actions() { return k_opening_actions; }

}  // namespace flaneur
