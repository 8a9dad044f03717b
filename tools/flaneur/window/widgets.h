// What panels have in common. Private to the files that lay panels out.
#pragma once

#include <imgui.h>

#include <algorithm>
#include <cstdint>
#include <iterator>

namespace flaneur {

inline constexpr float k_edge = 10;      // between panels and the window's edge, at scale 1
inline constexpr float k_state = 34;     // of the line that says how fast it goes
inline constexpr float k_timeline = 36;  // of the timeline's height

// 0xrrggbb.
constexpr ImU32 panel_colour(uint32_t rgb, float alpha = 1) {
    return IM_COL32(rgb >> 16 & 255, rgb >> 8 & 255, rgb & 255, static_cast<int>(alpha * 255));
}

// Of what is not as one would expect.
inline ImVec4 warning_colour() {
    const bool is_light = ImGui::GetStyleColorVec4(ImGuiCol_Text).x < 0.5f;
    return is_light ? ImVec4(0.6f, 0.36f, 0, 1) : ImVec4(0.95f, 0.71f, 0.36f, 1);
}

// A panel that stays where it is put.
inline constexpr ImGuiWindowFlags k_plain =
    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
    ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoMove;
// One with a title, which is closed by a cross.
inline constexpr ImGuiWindowFlags k_room = ImGuiWindowFlags_AlwaysAutoResize |
                                           ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoCollapse |
                                           ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoMove;

// What the last item is for, while one points at it: below the panel that the item is in.
inline void tip_below(const char* what) {
    if (!ImGui::IsItemHovered()) return;
    const ImGuiStyle& style = ImGui::GetStyle();
    const float width = ImGui::CalcTextSize(what).x + 2 * style.WindowPadding.x;
    const float most = ImGui::GetIO().DisplaySize.x - width;
    ImGui::SetNextWindowPos({std::max(std::min(ImGui::GetItemRectMin().x, most), 0.0f),
                             ImGui::GetWindowPos().y + ImGui::GetWindowHeight() + style.ItemSpacing.y / 2});
    ImGui::SetTooltip("%s", what);
}
// The same of more than a line: beside the panel, on the right or, where there is more room, on the left, as
// wide as this at most; by the cursor where neither has room for a half of it. ImGui::PopTextWrapPos() and
// EndTooltip() end it.
inline void begin_tip_beside(float width) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float gap = style.ItemSpacing.x / 2, left = ImGui::GetWindowPos().x,
                right = left + ImGui::GetWindowWidth(), y = ImGui::GetItemRectMin().y;
    const float on_left = left - gap, on_right = ImGui::GetIO().DisplaySize.x - right - gap;
    const float all = width + 2 * style.WindowPadding.x;
    const bool is_right = on_right >= std::min(all, on_left);
    const float own = (is_right ? on_right : on_left) - 2 * style.WindowPadding.x;
    const bool is_beside = own >= width / 2;
    if (is_beside)
        ImGui::SetNextWindowPos({is_right ? right + gap : on_left, y}, ImGuiCond_Always,
                                {is_right ? 0.0f : 1.0f, 0});
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(style.WindowPadding.x + (is_beside ? std::min(width, own) : width));
}
// The same of a few words, as wide as they are.
inline void tip(const char* what) {
    if (!ImGui::IsItemHovered()) return;
    begin_tip_beside(ImGui::CalcTextSize(what).x + 1);
    ImGui::TextUnformatted(what);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

// A button that shows whether what it is for is on, also while the cursor is still on it.
inline bool toggle_button(const char* name, bool is_on, ImVec2 size = {0, 0}) {
    constexpr ImGuiCol k_both[] = {ImGuiCol_Button, ImGuiCol_ButtonHovered};
    if (is_on)
        for (const ImGuiCol what : k_both)
            ImGui::PushStyleColor(what, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
    const bool is_pressed = ImGui::Button(name, size);
    if (is_on) ImGui::PopStyleColor(static_cast<int>(std::size(k_both)));
    return is_pressed;
}

// So many pixels at scale 1, or fewer where a panel as wide as the window has no more.
inline float fitted(float pixels, float scale) {
    constexpr float k_about = 44;  // edges, padding and what scrolls
    return std::min(pixels * scale, std::max(ImGui::GetIO().DisplaySize.x - k_about * scale, 60 * scale));
}

// The next item is beside the last one if a panel as wide as the window has room for a button of that name;
// else below it.
inline void go_beside(const char* name, float scale) {
    const float right = ImGui::GetItemRectMax().x + ImGui::GetStyle().ItemSpacing.x +
                        ImGui::CalcTextSize(name).x + 2 * ImGui::GetStyle().FramePadding.x;
    const float left = ImGui::GetWindowPos().x + ImGui::GetStyle().WindowPadding.x - ImGui::GetScrollX();
    if (right - left <= fitted(1e9f, scale)) ImGui::SameLine();
}

// Of a field over a list of so many rows: where it begins, and how high the list is, in a window of this
// size.
struct DialogPlace {
    float top, list;
};
inline DialogPlace dialog_place(int height, int rows, float scale) {
    const float all = static_cast<float>(height), line = ImGui::GetTextLineHeightWithSpacing();
    const float around = (k_edge + 60) * scale;  // the field, padding, and the gap below
    const float wanted = static_cast<float>(rows) * line;
    const float top =
        std::clamp(all - around - wanted, k_edge * scale, std::max(0.18f * all, k_edge * scale));
    return {top, std::clamp(all - around - top, line, wanted)};
}

}  // namespace flaneur
