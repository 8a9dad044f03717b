#include "tools/flaneur/window/actions.h"

#include <GLFW/glfw3.h>

#include <array>

#include "tools/flaneur/window/record/capture.h"
#include "tools/flaneur/window/record/present.h"
#include "tools/flaneur/window/record/record.h"

namespace flaneur {

namespace {

constexpr std::array k_record_actions = {
    Action{"Write a picture, into out/", "F12", GLFW_KEY_F12, 0, ask_for_picture},
    Action{"Capture the picture for RenderDoc, into out/", "Ctrl+F12", GLFW_KEY_F12, GLFW_MOD_CONTROL,
           ask_for_capture},
    Action{"Record a film into out/, or end it", "R", GLFW_KEY_R, 0, ask_for_film},
    Action{"Film once round what is in the middle", "Shift+R", GLFW_KEY_R, GLFW_MOD_SHIFT, ask_for_turn},
    Action{"Presentation; any key ends it", "Ctrl+Shift+P", GLFW_KEY_P, GLFW_MOD_CONTROL | GLFW_MOD_SHIFT,
           ask_for_presentation},
    Action{"How pictures and films are written", "", 0, 0, open_record_room},
};

}  // namespace

std::span<const Action> record_actions() { return k_record_actions; }

}  // namespace flaneur
