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
#include "tools/flaneur/window/change/room.h"
#include "tools/flaneur/window/frame/room.h"
#include "tools/flaneur/window/gui.h"
#include "tools/flaneur/window/measure/drawing.h"
#include "tools/flaneur/window/panels/bar.h"
#include "tools/flaneur/window/panels/card.h"
#include "tools/flaneur/window/panels/palette.h"
#include "tools/flaneur/window/settings/room.h"
#include "tools/flaneur/window/widgets.h"

namespace flaneur {
namespace {

// What is drawn over the city.
void lay_out_layers(Show& show, Viewer& v, float scale) {
    for (int i = 0; i < k_work_views; ++i) {
        bool is_on = show.work_views[static_cast<WorkView>(i)];
        if (ImGui::Checkbox(k_work_view_names[i], &is_on)) v.toggles.push_back(static_cast<WorkView>(i));
        ImGui::SameLine(130 * scale);
        ImGui::TextDisabled(static_cast<WorkView>(i) == WorkView::ways ? "Shift+F11" : "F%d", i + 2);
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
    {Room::exhibits, "Exhibits", "what moves exhibits: methods, iterations, targets (Shift+T)",
     lay_out_exhibits},
    {Room::record, "Show", "pictures and films (F12, R)", lay_out_record},
    {Room::frame, "Frame", "what a picture costs, and what makes it slow (I)", lay_out_frame},
    {Room::settings, "Settings", "of panels and of how one moves (Ctrl+,)", lay_out_settings},
};

// What the colours of the layers mean.
void lay_out_legends(const std::vector<Legend>& legends, Viewer& v, float scale) {
    if (legends.empty() || !begin_side(v, SidePanel::legend, "legends", nullptr, k_plain)) return;
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
    end_side(v, SidePanel::legend);
}

void lay_out_room(Show& show, Viewer& v, float scale) {
    for (const RoomPanel& room : k_rooms) {
        bool is_open = true;
        if (room.room != v.room || !begin_side(v, SidePanel::room, room.name, &is_open, k_room)) continue;
        room.lay_out(show, v, scale);
        end_side(v, SidePanel::room);
        if (!is_open) v.room = Room::none;
        return;  // another one may have been opened
    }
}

// To the panel whose turn it is: the bar, the room, the figures, the card.
void give_keys(Viewer& v) {
    if (!std::exchange(v.panel_keys.wants_focus, false)) return;
    std::vector<const char*> shown = {"time"};
    auto is_there = [&](SidePanel side) { return v.layout.plan.sides[static_cast<size_t>(side)].is_there; };
    for (const RoomPanel& room : k_rooms)
        if (room.room == v.room && is_there(SidePanel::room)) shown.push_back(room.name);
    if (is_there(SidePanel::figures)) shown.push_back("beside");
    if (is_there(SidePanel::card)) shown.push_back("who");
    ImGui::SetWindowFocus(shown[v.panel_keys.panel % shown.size()]);
}

// Above the timeline, at the left: what comes and goes, so that no button moves.
void lay_out_state(Viewer& v) {
    const PanelPlan& plan = v.layout.plan;
    if (!plan.has_state) return;
    const char* coarser = v.record.filming ? "   coarser while a film is made" : "   coarser while you move";
    char figures[96], pace[64] = "";
    std::snprintf(figures, sizeof figures, "%u people   %.*f fps%s", v.walkers, v.fps < 9.95 ? 1 : 0, v.fps,
                  v.resolution < 1 ? coarser : "");
    if (const std::optional<float> reached = reached_rate(v.clock))
        std::snprintf(pace, sizeof pace, "%.2g x wanted, %.2g x reached", static_cast<double>(v.clock.rate),
                      static_cast<double>(*reached));
    // As wide as it is now, not as it was in the last picture.
    const ImGuiStyle& style = ImGui::GetStyle();
    const float width = ImGui::CalcTextSize(figures).x + 2 * style.WindowPadding.x +
                        (*pace ? style.ItemSpacing.x + ImGui::CalcTextSize(pace).x : 0);
    ImGui::SetNextWindowPos({plan.edge, plan.row_foot}, ImGuiCond_Always, {0, 1});
    ImGui::SetNextWindowSize({std::ceil(width), 0});
    if (!ImGui::Begin("state", nullptr,
                      (k_plain & ~ImGuiWindowFlags_AlwaysAutoResize) | ImGuiWindowFlags_NoInputs))
        return ImGui::End();
    ImGui::TextDisabled("%s", figures);
    if (*pace) {
        ImGui::SameLine();
        ImGui::TextColored(warning_colour(), "%s", pace);
    }
    v.layout.wish.state = {ImGui::GetWindowWidth(), ImGui::GetWindowHeight()};
    ImGui::End();
}

// What a click does in the city, beside the cursor, while it is more than to ask.
void lay_out_tool(const Show& show, const Viewer& v, float scale) {
    std::string tool;
    if (v.room == Room::measure && v.measure.tool) tool = k_drawn_names[static_cast<size_t>(*v.measure.tool)];
    if (v.room == Room::change) tool = armed_tool(show, v.change);
    const Pointer& pointer = v.events.pointer;
    if (tool.empty() || show.loaded.world->roam || is_on_panel(pointer.x, pointer.y)) return;
    const std::string text = tool.append(" (Esc ends)");
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    ImVec2 at{static_cast<float>(pointer.x) + 18 * scale, static_cast<float>(pointer.y) + 14 * scale};
    const float right = at.x + size.x;
    const bool is_hidden = right > v.layout.wish.window.x || is_on_panel(right, at.y);
    if (is_hidden) at.x = static_cast<float>(pointer.x) - 12 * scale - size.x;
    const float room = 5 * scale;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddRectFilled({at.x - room, at.y - room / 2}, {at.x + size.x + room, at.y + size.y + room / 2},
                       ImGui::GetColorU32(ImGuiCol_PopupBg), 4 * scale);
    list.AddText(at, ImGui::GetColorU32(ImGuiCol_CheckMark), text.c_str());
}

// "so far 43 %" as 0.43.
std::optional<float> share_of(const std::string& line) {
    if (!line.ends_with(" %")) return {};
    const size_t space = line.rfind(' ', line.size() - 3);
    return space == std::string::npos ? std::nullopt
                                      : std::optional(std::strtof(&line[space], nullptr) / 100);
}

void lay_out_note(Viewer& v, Size size, float scale) {
    v.layout.wish.note = {};
    if (ImGui::GetTime() >= v.note_until) return;
    const float foot =
        v.has_panels ? v.layout.plan.row_foot : static_cast<float>(size.height) - k_edge * scale;
    ImGui::SetNextWindowPos({static_cast<float>(size.width) / 2, foot}, ImGuiCond_Always, {0.5f, 1});
    if (ImGui::Begin("note", nullptr, k_plain | ImGuiWindowFlags_NoInputs)) {
        ImGui::PushTextWrapPos(fitted(1e9f, scale));
        ImGui::TextUnformatted(v.note.c_str());
        ImGui::PopTextWrapPos();
        v.layout.wish.note = {ImGui::GetWindowWidth(), ImGui::GetWindowHeight()};
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
    ImGui::SetNextWindowSize({fitted(460, scale), 0});
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
    const std::vector<Legend> legends = legends_of(show.work_views, *show.loaded.world);
    const Card card = card_of(show, viewer);
    plan_picture(
        viewer, {static_cast<float>(size.width), static_cast<float>(size.height)}, scale,
        {viewer.room != Room::none, viewer.time.beside != nullptr, card != Card::none, !legends.empty()},
        card == Card::glimpse);
    lay_out_keys(viewer, size, scale);
    lay_out_palette(show, viewer, size, scale);
    lay_out_note(viewer, size, scale);
    lay_out_filming(viewer, size);
    lay_out_opening(show, viewer, size, scale);
    lay_out_labels(viewer, size, scale);
    if (!viewer.has_panels) return viewer.time.scrubbed_to.reset();  // no hand is on what is hidden
    lay_out_tool(show, viewer, scale);
    lay_out_map(viewer, size, scale);
    lay_out_legends(legends, viewer, scale);
    std::vector<RoomPanel> rooms(std::begin(k_rooms), std::end(k_rooms));
    if (!has_exhibits(*show.loaded.world))
        std::erase_if(rooms, [](const RoomPanel& room) { return room.room == Room::exhibits; });
    lay_out_bar(show, viewer, rooms, scale);
    lay_out_state(viewer);
    lay_out_room(show, viewer, scale);
    lay_out_timeline(show, viewer, size, scale);
    lay_out_beside(show, viewer);
    lay_out_halves(viewer, size);
    lay_out_card(show, viewer, scale);
    give_keys(viewer);
    keep_changed_settings(viewer);
}

}  // namespace flaneur
