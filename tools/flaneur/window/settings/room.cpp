#include "tools/flaneur/window/settings/room.h"

#include <imgui.h>

#include <array>
#include <cmath>
#include <string>

#include "tools/flaneur/console/console.h"
#include "tools/flaneur/window/panels.h"
#include "tools/flaneur/window/viewer.h"
#include "tools/flaneur/window/widgets.h"

namespace flaneur {
namespace {

// Of letters: what is dragged takes hold once it is let go of, for the slider itself grows with them.
void lay_out_letters(Settings& s, int& percent, float scale) {
    bool is_display = s.letters == 0;
    if (!ImGui::IsAnyItemActive())
        percent = static_cast<int>(std::lround((is_display ? scale : s.letters) * 100));
    ImGui::SetNextItemWidth(170 * scale);
    ImGui::SliderInt("letters", &percent, 100, 300, "%d %%", ImGuiSliderFlags_AlwaysClamp);
    if (ImGui::IsItemDeactivatedAfterEdit()) s.letters = static_cast<float>(percent) / 100;
    tip("of letters and panels (Ctrl and +, Ctrl and -)");
    if (ImGui::Checkbox("as large as the display asks for", &is_display)) s.letters = is_display ? 0 : scale;
    tip("Ctrl+0");
}

void lay_out_fps(Settings& s, float scale) {
    constexpr std::array k_fps = {0, 15, 30, 60, 120};
    const std::string now = s.fps == 0 ? "as the display shows" : std::to_string(s.fps) + " a second";
    ImGui::SetNextItemWidth(170 * scale);
    if (!ImGui::BeginCombo("pictures", now.c_str())) return;
    for (const int fps : k_fps) {
        const std::string name =
            fps == 0 ? "as the display shows" : std::to_string(fps) + " a second at most";
        if (ImGui::Selectable(name.c_str(), fps == s.fps)) s.fps = fps;
    }
    ImGui::EndCombo();
}

}  // namespace

void open_settings(Show&, Viewer& v) { v.room = v.room == Room::settings ? Room::none : Room::settings; }

void change_letters(Viewer& v, int steps) {
    const glm::vec2 window = v.layout.wish.window;
    const float most = std::min(most_scale(window), k_most_letters);
    const float now = v.settings.letters > 0 ? std::min(v.settings.letters, most) : v.layout.wish.scale;
    const float next = stepped_letters(now, steps);
    if (next > most) return tell(v, "There is no room for larger letters in a window of this size.");
    v.settings.letters = next;
    tell(v, "Letters: " + std::to_string(std::lround(next * 100)) + " %. Ctrl+0: as the display asks for.");
}

void reset_letters(Viewer& v) {
    v.settings.letters = 0;
    tell(v, "Letters as large as the display asks for.");
}

void lay_out_settings(Show&, Viewer& v, float scale) {
    Settings& s = v.settings;
    lay_out_letters(s, v.letters_percent, scale);
    int theme = s.is_light;
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("panels");
    ImGui::SameLine();
    if (ImGui::RadioButton("dark", &theme, 0)) s.is_light = false;
    ImGui::SameLine();
    if (ImGui::RadioButton("light", &theme, 1)) s.is_light = true;
    lay_out_fps(s, scale);
    ImGui::SetNextItemWidth(170 * scale);
    ImGui::SliderFloat("pace of flying", &s.pace, k_least_pace, k_most_pace, "%.2g times",
                       ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    ImGui::Checkbox("dragging down looks up", &s.inverts_look);
    ImGui::Checkbox("the wheel goes the other way", &s.inverts_wheel);
    if (ImGui::Button("As usual")) s = {};
    ImGui::TextDisabled("They are kept for the next time.");
}

void keep_changed_settings(Viewer& v) {
    if (v.settings == v.kept_settings || ImGui::IsAnyItemActive()) return;
    v.kept_settings = v.settings;
    if (Result<void> kept = keep_settings(settings_file(), v.settings); !kept) {
        say(kept.error().message);
        tell(v, printable(kept.error().message));
    }
}

}  // namespace flaneur
