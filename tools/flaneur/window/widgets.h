// What panels have in common. Private to the files that lay panels out.
#pragma once

#include <imgui.h>

namespace flaneur {

inline constexpr float k_edge = 10;       // between panels and the window's edge, at scale 1
inline constexpr float k_scale_bar = 58;  // of a map's scale, with the gap above it
inline constexpr float k_state = 40;      // of the line that says how fast it goes
inline constexpr float k_timeline = 46;   // of the timeline's height, with the gap above it

// A panel that stays where it is put.
inline constexpr ImGuiWindowFlags k_plain =
    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
    ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoMove;
// One with a title, which is closed by a cross.
inline constexpr ImGuiWindowFlags k_room = ImGuiWindowFlags_AlwaysAutoResize |
                                           ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoCollapse |
                                           ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoMove;

// What the last item is for, while one points at it.
inline void tip(const char* what) {
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", what);
}

}  // namespace flaneur
