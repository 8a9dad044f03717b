#include "tools/flaneur/window/panels/bar.h"

#include <imgui.h>

#include <algorithm>
#include <utility>

#include "tools/flaneur/window/panels.h"
#include "tools/flaneur/window/widgets.h"

namespace flaneur {
namespace {

void open_room(Viewer& v, Room room) {
    v.room = v.room == room ? Room::none : room;
    v.search.is_opening = v.room == Room::find;
}

float button_width(const char* name) {
    return ImGui::CalcTextSize(name).x + 2 * ImGui::GetStyle().FramePadding.x;
}

// How many rows of buttons it takes to hold all.
float rows_of(std::span<const RoomPanel> rooms, float begun, float scale) {
    const float most = fitted(1e9f, scale), gap = ImGui::GetStyle().ItemSpacing.x;
    float count = 1, x = begun;
    auto add = [&](const char* name) {
        if (x + gap + button_width(name) > most) ++count, x = -gap;
        x += gap + button_width(name);
    };
    add("Open");
    for (const RoomPanel& room : rooms) add(room.name);
    add("Find"), add("Keys");
    return count;
}

void lay_out_rooms(Viewer& v, std::span<const RoomPanel> rooms, float scale) {
    go_beside("Open", scale);
    if (toggle_button("Open", v.opening.start.is_open)) v.opening.start.is_open = !v.opening.start.is_open;
    tip_below("cities, scenes and characters: built-in ones, files, and those of late (Ctrl+N, Ctrl+O)");
    for (const RoomPanel& room : rooms) {
        go_beside(room.name, scale);
        if (toggle_button(room.name, v.room == room.room)) open_room(v, room.room);
        tip_below(room.tip);
    }
    go_beside("Find", scale);
    if (ImGui::Button("Find")) v.palette = {.is_open = true};
    tip_below("any action by its name (Ctrl+P)");
    go_beside("Keys", scale);
    if (toggle_button("Keys", v.lists_keys)) v.lists_keys = !v.lists_keys;
    tip_below("F1");
}

// The same, two beside each other, and how many people there are, which may have no other place.
void lay_out_menu(Viewer& v, std::span<const RoomPanel> rooms, float scale) {
    ImGui::SameLine();
    if (ImGui::Button("Menu")) ImGui::OpenPopup("rooms");
    tip_below("all rooms; any action is found by Ctrl+P");
    if (!ImGui::BeginPopup("rooms")) return;
    const ImVec2 each{100 * scale, 0};
    bool is_left = true, is_done = false;
    auto add = [&](const char* name, bool is_on) {
        if (!std::exchange(is_left, !is_left)) ImGui::SameLine();
        const bool is_pressed = toggle_button(name, is_on, each);
        is_done |= is_pressed;
        return is_pressed;
    };
    if (add("Open", v.opening.start.is_open)) v.opening.start.is_open = true;
    for (const RoomPanel& room : rooms)
        if (add(room.name, v.room == room.room)) open_room(v, room.room);
    if (add("Find", false)) v.palette = {.is_open = true};
    if (add("Keys", v.lists_keys)) v.lists_keys = !v.lists_keys;
    ImGui::TextDisabled("%u people   %.0f fps", v.walkers, v.fps);
    if (is_done) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

// Which of the panels is shown, where there is room for one.
void lay_out_tabs(Viewer& v, std::span<const RoomPanel> rooms, float scale) {
    constexpr const char* k_names[k_sides] = {"", "Figures", "Card", "Colours"};
    constexpr const char* k_tips[k_sides] = {"the room that is open", "how both halves differ",
                                             "who or what was asked about",
                                             "what the colours of layers mean"};
    PanelWish& wish = v.layout.wish;
    bool is_first = true;
    for (size_t i = 0; i < k_sides; ++i) {
        if (!wish.is_shown[i] || (i == static_cast<size_t>(SidePanel::card) && wish.is_glimpse)) continue;
        const char* name = k_names[i];
        if (i == static_cast<size_t>(SidePanel::room))
            for (const RoomPanel& room : rooms)
                if (room.room == v.room) name = room.name;
        if (!std::exchange(is_first, false)) go_beside(name, scale);
        ImGui::PushID(static_cast<int>(i));
        if (toggle_button(name, wish.chosen == static_cast<SidePanel>(i)))
            wish.chosen = static_cast<SidePanel>(i);
        tip_below(k_tips[i]);
        ImGui::PopID();
    }
    if (v.room == Room::none) return;
    go_beside("Close room", scale);
    if (ImGui::Button("Close room")) v.room = Room::none;
    tip_below("Esc");
}

}  // namespace

void lay_out_bar(const Show& show, Viewer& v, std::span<const RoomPanel> rooms, float scale) {
    PanelLayout& layout = v.layout;
    const float edge = layout.plan.edge, gap = ImGui::GetStyle().ItemSpacing.x;
    ImGui::SetNextWindowPos({edge, edge});
    ImGui::Begin("time", nullptr, k_plain);
    if (ImGui::Button(v.clock.is_paused ? "  Go  " : " Stop ")) v.clock.is_paused = !v.clock.is_paused;
    tip_below("Space");
    ImGui::SameLine();
    if (ImGui::Button("Step")) v.clock.is_paused = true, ++v.clock.steps;
    tip_below("one tick, 1/60 s (.)");
    ImGui::SameLine();
    const std::string clock = clock_text(show);
    const float others =
        button_width(" Stop ") + button_width("Step") + ImGui::CalcTextSize("00:00:00").x + 3 * gap;
    const float most_pace = 110 * scale, begun = others + most_pace;
    const bool is_folded = rows_of(rooms, begun, scale) > layout.plan.bar_rows;
    const float left = fitted(1e9f, scale) - others - button_width("Menu") - gap;
    ImGui::SetNextItemWidth(is_folded ? std::clamp(left, 30 * scale, most_pace) : most_pace);
    ImGui::SliderFloat("##rate", &v.clock.rate, k_least_rate, k_most_rate, "%.2g x",
                       ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    tip_below("how fast time goes by (- and +)");
    ImGui::SameLine();
    ImGui::TextUnformatted(clock.c_str());
    is_folded ? lay_out_menu(v, rooms, scale) : lay_out_rooms(v, rooms, scale);
    const float padding = ImGui::GetStyle().WindowPadding.y;
    layout.wish.bar_foot = layout.wish.tabs_foot = ImGui::GetItemRectMax().y + padding;
    if (layout.plan.has_tabs) {
        lay_out_tabs(v, rooms, scale);
        layout.wish.tabs_foot = ImGui::GetItemRectMax().y + padding;
    }
    ImGui::End();
}

}  // namespace flaneur
