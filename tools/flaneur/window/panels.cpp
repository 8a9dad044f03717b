#include "tools/flaneur/window/panels.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/base/tick.h"
#include "tools/flaneur/window/ask/find.h"
#include "tools/flaneur/window/ask/gait.h"
#include "tools/flaneur/window/cameras/map.h"
#include "tools/flaneur/window/card.h"
#include "tools/flaneur/window/change/room.h"
#include "tools/flaneur/window/measure/drawing.h"
#include "tools/flaneur/window/palette.h"
#include "tools/flaneur/window/settings/room.h"
#include "tools/flaneur/window/widgets.h"

namespace flaneur {
namespace {

struct RoomPanel {
    Room room;
    const char *name, *tip;
    void (*lay_out)(Show& show, Viewer& viewer, float scale);
};

// What is drawn over the city.
void lay_out_layers(Show& show, Viewer& v, float scale) {
    for (int i = 0; i < k_work_views; ++i) {
        bool is_on = show.work_views[static_cast<WorkView>(i)];
        if (ImGui::Checkbox(k_work_view_names[i], &is_on)) v.toggles.push_back(static_cast<WorkView>(i));
        ImGui::SameLine(130 * scale);
        ImGui::TextDisabled("F%d", i + 2);
    }
}

constexpr RoomPanel k_rooms[] = {
    {Room::cameras, "Cameras", "where to look from: modes, lens, bookmarks, path", lay_out_cameras},
    {Room::layers, "Layers", "what is drawn over the city (L)", lay_out_layers},
    {Room::time, "Time", "back and forth: the past, marks, events, runs anew", lay_out_time},
    {Room::measure, "Measure", "distances, areas, counting lines and zones (M)", lay_out_measures},
    {Room::find, "People", "find people by what they are and do (/)", lay_out_finding},
    {Room::gait, "Gait", "how the selected walker walks (J)", lay_out_gait},
    {Room::change, "Change", "time of day, weather, people, and what stands in the streets (T)",
     lay_out_change},
    {Room::record, "Show", "pictures and films (F12, R)", lay_out_record},
    {Room::settings, "Settings", "of panels and of how one moves (Ctrl+,)", lay_out_settings},
};

// What the colours of the layers mean.
void lay_out_legends(const Show& show, Size size, float scale) {
    const std::vector<Legend> legends = legends_of(show.work_views);
    if (legends.empty()) return;
    ImGui::SetNextWindowPos({static_cast<float>(size.width) - k_edge * scale,
                             static_cast<float>(size.height) - (k_edge + k_timeline + k_scale_bar) * scale},
                            ImGuiCond_Always, {1, 1});
    if (!ImGui::Begin("legends", nullptr, k_plain | ImGuiWindowFlags_NoInputs)) return ImGui::End();
    const float swatch = ImGui::GetFontSize();
    for (const Legend& legend : legends) {
        ImGui::TextDisabled("%s", legend.title);
        for (const LegendEntry& entry : legend.entries) {
            const ImVec2 at = ImGui::GetCursorScreenPos();
            ImGui::GetWindowDrawList()->AddRectFilled({at.x, at.y + 0.1f * swatch},
                                                      {at.x + swatch, at.y + 0.95f * swatch},
                                                      entry.colour | 0xff000000u, 2 * scale);
            ImGui::Dummy({swatch, swatch});
            ImGui::SameLine();
            ImGui::TextUnformatted(entry.what);
        }
    }
    ImGui::End();
}

void lay_out_room(Show& show, Viewer& v, Size size, float scale) {
    for (const RoomPanel& room : k_rooms) {
        if (room.room != v.room) continue;
        // Between the bar above and what lies below.
        ImGui::SetNextWindowPos({k_edge * scale, v.bar_foot});
        ImGui::SetNextWindowSizeConstraints({0, 0}, {static_cast<float>(size.width) * 0.45f,
                                                     std::max(static_cast<float>(size.height) - v.bar_foot -
                                                                  (k_edge + k_timeline + k_state) * scale,
                                                              80.0f)});
        bool is_open = true;
        if (ImGui::Begin(room.name, &is_open, k_room)) room.lay_out(show, v, scale);
        ImGui::End();
        if (!is_open) v.room = Room::none;
    }
}

// To the panel whose turn it is: the bar, the room, the card.
void give_keys(Viewer& v) {
    if (!std::exchange(v.panel_keys.wants_focus, false)) return;
    std::vector<const char*> shown = {"time"};
    for (const RoomPanel& room : k_rooms)
        if (room.room == v.room) shown.push_back(room.name);
    if (v.selected) shown.push_back("who");
    ImGui::SetWindowFocus(shown[v.panel_keys.panel % shown.size()]);
}

// Beside the last item, or below it where the window ends.
void go_beside(const char* next, Size size, float scale) {
    const float right = ImGui::GetItemRectMax().x + ImGui::GetStyle().ItemSpacing.x +
                        ImGui::CalcTextSize(next).x + 2 * ImGui::GetStyle().FramePadding.x;
    if (right < static_cast<float>(size.width) - 2 * k_edge * scale) ImGui::SameLine();
}

void lay_out_bar(const Show& show, Viewer& v, Size size, float scale) {
    ImGui::SetNextWindowPos({k_edge * scale, k_edge * scale});
    if (!ImGui::Begin("time", nullptr, k_plain)) return ImGui::End();
    if (ImGui::Button(v.clock.is_paused ? "  Go  " : " Stop ")) v.clock.is_paused = !v.clock.is_paused;
    tip("Space");
    ImGui::SameLine();
    if (ImGui::Button("Step")) v.clock.is_paused = true, ++v.clock.steps;
    tip("one tick, 1/60 s (.)");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(110 * scale);
    ImGui::SliderFloat("##rate", &v.clock.rate, k_least_rate, k_most_rate, "%.2g x",
                       ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    tip("how fast time goes by (- and +)");
    ImGui::SameLine();
    ImGui::Text("%s", clock_text(show).c_str());
    for (const RoomPanel& room : k_rooms) {
        go_beside(room.name, size, scale);
        if (ImGui::Button(room.name)) {
            v.room = v.room == room.room ? Room::none : room.room;
            v.search.is_opening = v.room == Room::find;
        }
        tip(room.tip);
    }
    go_beside("Find", size, scale);
    if (ImGui::Button("Find")) v.palette = {.is_open = true};
    tip("any action by its name (Ctrl+P)");
    go_beside("Keys", size, scale);
    if (ImGui::Button("Keys")) v.lists_keys = !v.lists_keys;
    tip("F1");
    v.bar_foot = ImGui::GetWindowPos().y + ImGui::GetWindowHeight() + k_edge * scale;
    ImGui::End();
}

// Above the timeline, at the left: what comes and goes, so that no button moves.
void lay_out_state(const Viewer& v, Size size, float scale) {
    ImGui::SetNextWindowPos({k_edge * scale, static_cast<float>(size.height) - (k_edge + k_timeline) * scale},
                            ImGuiCond_Always, {0, 1});
    if (!ImGui::Begin("state", nullptr, k_plain | ImGuiWindowFlags_NoInputs)) return ImGui::End();
    const char* coarser = v.record.filming ? "   coarser while a film is made" : "   coarser while you move";
    ImGui::TextDisabled("%u people   %.0f fps%s", v.walkers, v.fps, v.resolution < 1 ? coarser : "");
    if (const std::optional<float> reached = reached_rate(v.clock)) {
        ImGui::SameLine();
        ImGui::TextColored({0.95f, 0.71f, 0.36f, 1}, "%.2g x wanted, %.2g x reached",
                           static_cast<double>(v.clock.rate), static_cast<double>(*reached));
    }
    ImGui::End();
}

// "so far 43 %" as 0.43.
std::optional<float> share_of(const std::string& line) {
    if (!line.ends_with(" %")) return {};
    const size_t space = line.rfind(' ', line.size() - 3);
    return space == std::string::npos ? std::nullopt
                                      : std::optional(std::strtof(&line[space], nullptr) / 100);
}

void lay_out_note(const Viewer& v, Size size, float scale) {
    if (ImGui::GetTime() >= v.note_until) return;
    ImGui::SetNextWindowPos(
        {static_cast<float>(size.width) / 2,
         static_cast<float>(size.height) - (12 + (v.has_panels ? k_timeline : 0)) * scale},
        ImGuiCond_Always, {0.5f, 1});
    if (ImGui::Begin("note", nullptr, k_plain | ImGuiWindowFlags_NoInputs)) {
        ImGui::PushTextWrapPos(std::max(static_cast<float>(size.width) - 60 * scale, 100.0f));
        ImGui::TextUnformatted(v.note.c_str());
        ImGui::PopTextWrapPos();
    }
    ImGui::End();
}

}  // namespace

std::string clock_text(const Show& show) {
    const float seconds = static_cast<float>(show.loaded.world->tick) * k_tick;
    const double hour =
        static_cast<double>(show.loaded.world->crowd.demand.hour) + static_cast<double>(seconds) / 3600;
    const auto second = static_cast<int>(std::fmod(hour, 24.0) * 3600);
    char text[32];
    std::snprintf(text, sizeof text, "%02d:%02d:%02d", second / 3600, second / 60 % 60, second % 60);
    return text;
}

void tell(Viewer& viewer, const std::string& what) {
    constexpr double k_seconds = 5;
    viewer.note = what;
    const bool has_window = ImGui::GetCurrentContext() != nullptr;  // tests have none
    viewer.note_until = (has_window ? ImGui::GetTime() : 0) + k_seconds;
}

void lay_out_loading(const std::string& city, const std::string& doing, const char* hint, Size size,
                     float scale) {
    ImGui::SetNextWindowPos({static_cast<float>(size.width) / 2, static_cast<float>(size.height) / 2},
                            ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(460 * scale, static_cast<float>(size.width)), 0});
    if (ImGui::Begin("loading", nullptr, k_plain)) {
        ImGui::Text("%s", city.c_str());
        // A bar where the line says how many hundredths; else dots that come and go.
        const std::optional<float> share = share_of(doing);
        const auto dots = static_cast<size_t>(ImGui::GetTime() * 3) % 4;
        const std::string line = doing.empty() ? "opening" : doing;
        ImGui::TextDisabled("%s", (share ? line : line + std::string(dots, '.')).c_str());
        ImGui::ProgressBar(share.value_or(0), {-1, 6 * scale}, "");
        ImGui::TextDisabled("%s", hint);
    }
    ImGui::End();
}

void lay_out_panels(Show& show, Viewer& viewer, Size size, float scale) {
    if (viewer.presentation.is_on) return lay_out_presentation(show, viewer, size, scale);
    lay_out_keys(viewer, size, scale);
    lay_out_palette(show, viewer, size, scale);
    lay_out_note(viewer, size, scale);
    lay_out_filming(viewer, size);
    lay_out_opening(show, viewer, size, scale);
    lay_out_labels(viewer, size, scale);
    if (!viewer.has_panels) return viewer.time.scrubbed_to.reset();  // no hand is on what is hidden
    lay_out_map(viewer, size, scale);
    lay_out_legends(show, size, scale);
    lay_out_bar(show, viewer, size, scale);
    lay_out_state(viewer, size, scale);
    lay_out_room(show, viewer, size, scale);
    lay_out_timeline(show, viewer, size, scale);
    lay_out_beside(show, viewer, size, scale);
    lay_out_halves(viewer, size, scale);
    lay_out_card(show, viewer, size, scale);
    give_keys(viewer);
    keep_changed_settings(viewer);
}

}  // namespace flaneur
