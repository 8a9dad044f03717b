#include "tools/flaneur/window/change/room.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>

#include "sim/stepping.h"
#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/actions.h"
#include "tools/flaneur/window/change/drive.h"
#include "tools/flaneur/window/change/hand.h"
#include "tools/flaneur/window/change/life.h"
#include "tools/flaneur/window/change/platform.h"
#include "tools/flaneur/window/change/save.h"
#include "tools/flaneur/window/change/who.h"
#include "tools/flaneur/window/panels.h"
#include "tools/flaneur/window/steppers/steppers.h"
#include "tools/flaneur/window/time/beside.h"
#include "tools/flaneur/window/widgets.h"

namespace flaneur {

bool slide_share(const char* name, float& share, float scale) {
    float percent = 100 * share;
    ImGui::SetNextItemWidth(170 * scale);
    const bool is_moved = ImGui::SliderFloat(name, &percent, 0, 100, "%.0f %%", ImGuiSliderFlags_AlwaysClamp);
    if (is_moved) share = percent / 100;
    return is_moved;
}

uint64_t gesture_of_item(Change& c) {
    if (ImGui::IsItemActivated()) c.gesture = c.next_gesture++;
    return c.gesture;
}

namespace {

void set_hour_wanted(const Show& show, Viewer& v, float hour, uint64_t gesture) {
    Design next = current(v.change.designs);
    next.hour = hour;
    next.hour_set = show.loaded.world->tick;
    want(v, std::move(next), gesture);
}

void set_weather(Viewer& v, bool is_overcast) {
    Design next = current(v.change.designs);
    next.is_overcast = is_overcast;
    want(v, std::move(next));
}

void set_people(Viewer& v, int people, uint64_t gesture) {
    Design next = current(v.change.designs);
    next.people = static_cast<uint32_t>(std::clamp(people, 0, k_max_walkers));
    want(v, std::move(next), gesture);
}

// "17:30", "1730", "17" and "7.30"; none of what is no time of day.
std::optional<int> minute_of(const char* text) {
    int hour = 0, minute = 0, end = 0;
    const bool is_apart = std::sscanf(text, " %2d%*1[:.h]%2d %n", &hour, &minute, &end) == 2 && !text[end];
    if (!is_apart) {
        minute = 0;
        const bool is_whole = std::sscanf(text, " %4d %n", &hour, &end) == 1 && !text[end];
        if (!is_whole) return {};
        if (hour > 24) minute = hour % 100, hour /= 100;
    }
    if (hour < 0 || hour > 24 || minute < 0 || minute > 59) return {};
    return (hour * 60 + minute) % (24 * 60);
}

void lay_out_day(Show& show, Viewer& v, float scale) {
    Change& c = v.change;
    constexpr int k_step = 10, k_last = 24 * 60 / k_step - 1;  // minutes that the slider goes by
    const auto minute = static_cast<int>(std::floor(hour_now(*show.loaded.world) * 60)) % (24 * 60);
    char text[16];
    std::snprintf(text, sizeof text, "%02d:%02d", minute / 60, minute % 60);
    ImGui::TextUnformatted("Time of day");
    int step = minute / k_step;
    ImGui::SetNextItemWidth(170 * scale);
    const bool is_set = ImGui::SliderInt("##hour", &step, 0, k_last, text,
                                         ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoInput);
    const uint64_t gesture = gesture_of_item(c);
    tip("moves the sun, lights lamps and windows, and sends people elsewhere");
    if (is_set) set_hour_wanted(show, v, static_cast<float>(step * k_step) / 60, gesture);
    ImGui::SameLine();
    ImGui::SetNextItemWidth(82 * scale);
    ImGui::InputText("##typed hour", c.typed_hour, sizeof c.typed_hour, ImGuiInputTextFlags_AutoSelectAll);
    if (ImGui::IsItemDeactivatedAfterEdit()) {
        if (const std::optional<int> typed = minute_of(c.typed_hour))
            set_hour_wanted(show, v, static_cast<float>(*typed) / 60, 0);
        else
            tell(v, "A time of day is written as 17:30.");
    } else if (!ImGui::IsItemActive()) {
        std::snprintf(c.typed_hour, sizeof c.typed_hour, "%s", text);
    }
    tip("typed, and Enter");
    const bool is_overcast = current(c.designs).is_overcast;
    if (ImGui::RadioButton("clear", !is_overcast)) set_weather(v, false);
    ImGui::SameLine();
    if (ImGui::RadioButton("overcast", is_overcast)) set_weather(v, true);
}

void lay_out_people(const Show& show, Viewer& v, float scale) {
    Change& c = v.change;
    const bool is_closed = show.loaded.world->roam || is_on_course(*show.loaded.world);
    auto people = static_cast<int>(current(c.designs).people);
    ImGui::TextUnformatted("People");
    if (is_closed) return ImGui::TextDisabled("as many as there are: nobody comes here from elsewhere");
    ImGui::SetNextItemWidth(170 * scale);
    // More are typed; in a yard no more find room.
    const int most_slid = is_of(c.scene, BuiltIn::yard) ? k_yard_walkers : 100'000;
    const bool is_slid = ImGui::SliderInt("##people", &people, 0, most_slid, "%d",
                                          ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    const uint64_t gesture = gesture_of_item(c);
    tip("they come and go out of sight, where there is room");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(82 * scale);
    if (is_slid) set_people(v, people, gesture);
    ImGui::InputInt("##number", &c.typed_people, 0, 0);
    if (ImGui::IsItemDeactivatedAfterEdit())
        set_people(v, c.typed_people, 0);
    else if (!ImGui::IsItemActive())
        c.typed_people = static_cast<int>(current(c.designs).people);
    tip("typed, and Enter");
    if (c.carried.people != current(c.designs).people) ImGui::TextDisabled("%u so far", c.carried.people);
}

struct ToolButton {
    AddedKind kind;
    const char *name, *hint;
};
constexpr ToolButton k_tools[] = {
    {AddedKind::barrier, "Close a street",
     "Click a street, a path or a yard to close it from wall to wall; or drag from one end of the barrier to "
     "the other."},
    {AddedKind::wall, "Wall",
     "Click one end of the wall and then the other, or drag. People find a way through gaps of 2 m."},
    {AddedKind::planter, "Planter", "Click the ground to put one down."},
    {AddedKind::car, "Car", "Click the ground to put one down."},
    {AddedKind::tree, "Tree", "Click the ground to plant one."},
    {AddedKind::bench, "Bench", "Click the ground to put one down; people come and stand there."},
    {AddedKind::lamp, "Lamp", "Click the ground to put one up; it is lit in the dark."},
    {AddedKind::entrance, "Entrance", "Click a house at its foot: people come and go there."},
};

void choose_tool(Viewer& v, AddedKind kind) {
    Change& c = v.change;
    v.room = Room::change;
    c.tool = kind;
    c.grip = {};
    c.ghost.reset();
    c.selected.reset();
}

void lay_out_tools(Viewer& v, float scale) {
    Change& c = v.change;
    ImGui::TextUnformatted("Put into the city");
    if (is_making(c.making)) {
        ImGui::SameLine();
        ImGui::TextDisabled(c.making.is_lamps ? "lighting lamps" : "finding ways anew");
    }
    size_t number = 0;
    const char* hint = "Click what has been put down to choose it, drag to move it.";
    for (const ToolButton& button : k_tools) {
        // Two broad ones, then three a row.
        const size_t place = number < 2 ? number : (number + 1) % 3;
        const float width = number++ < 2 ? 129 : 84;
        if (place > 0) ImGui::SameLine();
        if (c.tool == button.kind) hint = button.hint;
        if (toggle_button(button.name, c.tool == button.kind, {width * scale, 0}))
            choose_tool(v, button.kind);
    }
    ImGui::PushTextWrapPos(264 * scale);
    ImGui::TextDisabled("%s", hint);
    ImGui::PopTextWrapPos();
}

void lay_out_selected(Viewer& v, float scale) {
    Change& c = v.change;
    Design next = current(c.designs);
    if (!c.selected || *c.selected >= next.added.size()) return;
    Addition& a = next.added[*c.selected];
    ImGui::Separator();
    ImGui::Text("%s", std::string(k_added_names[static_cast<size_t>(a.kind)]).c_str());
    ImGui::SameLine();
    ImGui::TextDisabled("%.1f, %.1f", static_cast<double>(a.at.x), static_cast<double>(a.at.z));
    if (is_turned(a.kind)) {
        ImGui::SetNextItemWidth(150 * scale);
        const bool is_turned_now =
            ImGui::SliderFloat("##turn", &a.turn, -180, 180, "%.0f degrees", ImGuiSliderFlags_AlwaysClamp);
        // Made anew once the hand has let go.
        const uint64_t gesture = gesture_of_item(c);
        tip("Alt+R turns it by 15 degrees");
        if (is_turned_now) {
            a.turn = std::round(a.turn);
            want(v, std::move(next), gesture);
        }
        ImGui::SameLine();
    }
    if (ImGui::Button("Remove")) remove_selected(v);
    tip("Delete");
}

void lay_out_name(Show& show, Viewer& v, float scale) {
    Change& c = v.change;
    if (!c.is_naming) return;
    ImGui::SetNextItemWidth(190 * scale);
    if (std::exchange(c.starts_naming, false)) ImGui::SetKeyboardFocusHere();
    ImGui::InputText("##path", c.path, sizeof c.path, ImGuiInputTextFlags_AutoSelectAll);
    ImGui::SameLine();
    if (ImGui::Button("Write")) press_in_name(GLFW_KEY_ENTER, show, v);
    tip("Enter; Esc does not");
}

void lay_out_history(Show& show, Viewer& v, float scale) {
    const Designs& d = v.change.designs;
    ImGui::BeginDisabled(d.at == 0);
    if (ImGui::Button("Undo")) undo_last(show, v);
    ImGui::EndDisabled();
    tip("Ctrl+Z");
    ImGui::SameLine();
    ImGui::BeginDisabled(d.at + 1 >= d.all.size());
    if (ImGui::Button("Redo")) redo_last(show, v);
    ImGui::EndDisabled();
    tip("Ctrl+Y");
    ImGui::SameLine();
    if (ImGui::Button("Save...")) begin_naming(v);
    tip("as the file of a scene (Ctrl+S)");
    go_beside("Compare", scale);
    if (ImGui::Button("Compare")) set_beside_before(show, v);
    tip("before and after: as many people in the streets as they were opened, from the start, beside this "
        "run "
        "(Ctrl+B)");
    lay_out_name(show, v, scale);
    ImGui::Separator();
}

template <AddedKind Kind>
void take_tool(Show& show, Viewer& v) {
    const World& world = *show.loaded.world;
    if (world.roam || is_on_course(world)) return tell(v, "Nothing is put down here: this is no city.");
    choose_tool(v, Kind);
}

void later(Show& show, Viewer& v, float hours) {
    const float hour = hour_now(*show.loaded.world) + hours;
    const float minutes = std::round((hour - 24 * std::floor(hour / 24)) * 60);
    set_hour_wanted(show, v, std::fmod(minutes, 24 * 60.0f) / 60, 0);
}

void more_people(const Show& show, Viewer& v, float times) {
    const World& world = *show.loaded.world;
    if (world.roam || is_on_course(world)) return tell(v, "Nobody comes here from elsewhere.");
    const auto people = static_cast<float>(current(v.change.designs).people);
    const auto wanted =
        static_cast<int>(std::round(times > 1 ? std::max(people * times, people + 1) : people * times));
    const int most = is_of(v.change.scene, BuiltIn::yard) ? k_yard_walkers : k_max_walkers;
    set_people(v, std::min(wanted, most), 0);
}

constexpr std::array k_actions = {
    Action{"Change the city", "T", GLFW_KEY_T, 0,
           [](Show&, Viewer& v) { v.room = v.room == Room::change ? Room::none : Room::change; }},
    Action{"An hour later", "", 0, 0, [](Show& show, Viewer& v) { later(show, v, 1); }},
    Action{"An hour earlier", "", 0, 0, [](Show& show, Viewer& v) { later(show, v, -1); }},
    Action{"Weather: clear", "", 0, 0, [](Show&, Viewer& v) { set_weather(v, false); }},
    Action{"Weather: overcast", "", 0, 0, [](Show&, Viewer& v) { set_weather(v, true); }},
    Action{"Twice as many people", "", 0, 0, [](Show& show, Viewer& v) { more_people(show, v, 2); }},
    Action{"Half as many people", "", 0, 0, [](Show& show, Viewer& v) { more_people(show, v, 0.5f); }},
    Action{"Close a street by a barrier", "", 0, 0, take_tool<AddedKind::barrier>},
    Action{"Draw a wall", "", 0, 0, take_tool<AddedKind::wall>},
    Action{"Put down a planter", "", 0, 0, take_tool<AddedKind::planter>},
    Action{"Put down a car", "", 0, 0, take_tool<AddedKind::car>},
    Action{"Plant a tree", "", 0, 0, take_tool<AddedKind::tree>},
    Action{"Put down a bench", "", 0, 0, take_tool<AddedKind::bench>},
    Action{"Put up a lamp", "", 0, 0, take_tool<AddedKind::lamp>},
    Action{"Make an entrance", "", 0, 0, take_tool<AddedKind::entrance>},
    Action{"Turn what was put down", "Alt+R", GLFW_KEY_R, GLFW_MOD_ALT,
           [](Show&, Viewer& v) { turn_selected(v, 15); }},
    Action{"Save as a scene", "Ctrl+S", GLFW_KEY_S, GLFW_MOD_CONTROL,
           [](Show&, Viewer& v) { begin_naming(v); }},
    Action{"Drive who was asked about, or let go", "X", GLFW_KEY_X, 0, drive_asked},
    Action{"In the gallery: drive a body of key poses, the other, or let go", "Ctrl+X", GLFW_KEY_X,
           GLFW_MOD_CONTROL, drive_figure},
    Action{"Push who was asked about", "P", GLFW_KEY_P, 0,
           [](Show& show, Viewer& v) { push_asked(show, v, k_shove); }},
    Action{"Push so hard that it falls", "Shift+P", GLFW_KEY_P, GLFW_MOD_SHIFT,
           [](Show& show, Viewer& v) { push_asked(show, v, k_hard_shove); }},
    Action{"Throw a ball at who was asked about, or ahead", "Shift+B", GLFW_KEY_B, GLFW_MOD_SHIFT,
           [](Show& show, Viewer& v) { throw_asked(show, v, k_light_throw); }},
    Action{"Throw a ball of 12 kg", "Alt+B", GLFW_KEY_B, GLFW_MOD_ALT,
           [](Show& show, Viewer& v) { throw_asked(show, v, k_heavy_throw); }},
    Action{"Drive by turns of 45 degrees a key, or as keys are held", "Shift+X", GLFW_KEY_X, GLFW_MOD_SHIFT,
           [](Show& show, Viewer& v) {
               drive_by_turns(show, v, !v.change.driving.is_by_turns);
               if (!is_driving(show))
                   tell(v, v.change.driving.is_by_turns ? "X drives by turns of 45 degrees."
                                                        : "X drives as keys are held.");
           }},
};

}  // namespace

// In a few words, the first thing by which two designs differ.
static const char* told_difference(const Design& a, const Design& b) {
    return a.added != b.added                             ? "what was put into the city"
           : a.platform != b.platform                     ? "the platform"
           : a.people != b.people                         ? "the number of people"
           : a.is_overcast != b.is_overcast               ? "the weather"
           : a.held != b.held                             ? "where targets are held"
           : a.methods != b.methods                       ? "how exhibits are solved"
           : a.hour != b.hour || a.hour_set != b.hour_set ? "the time of day"
                                                          : "who comes";
}

void undo_last(Show&, Viewer& v) {
    Designs& designs = v.change.designs;
    const Design was = current(designs);
    if (!undo(designs)) return tell(v, "Nothing has been changed that could be undone.");
    v.change.selected.reset();
    tell(v, std::string("Undone: ") + told_difference(was, current(designs)) + ". Ctrl+Y does it again.");
}

void redo_last(Show&, Viewer& v) {
    Designs& designs = v.change.designs;
    const Design was = current(designs);
    if (!redo(designs)) return tell(v, "Nothing has been undone.");
    v.change.selected.reset();
    tell(v, std::string("Done again: ") + told_difference(was, current(designs)) + ".");
}

std::string armed_tool(const Show& show, const Change& c) {
    if (!c.tool) return "";
    const bool is_row = c.ghost && is_drawn_out(c.ghost->kind);
    const float across = is_row ? length(on_ground(c.ghost->to - c.ghost->at)) : 0;
    const bool is_click = *c.tool == AddedKind::barrier && !c.grip.is_held;
    char text[80];
    if (is_click && is_row)
        std::snprintf(text, sizeof text, "Close this %s, %.1f m",
                      crossed_by(*show.loaded.world->ground, *c.ghost), static_cast<double>(across));
    else if (is_click)
        std::snprintf(text, sizeof text, "No street from wall to wall: click both ends");
    else if (is_row)
        std::snprintf(text, sizeof text, "%s, %.1f m", k_tools[*c.tool == AddedKind::wall ? 1 : 0].name,
                      static_cast<double>(across));
    for (const ToolButton& button : k_tools)
        if (!is_click && !is_row && c.tool == button.kind) return button.name;
    return text;
}

std::span<const Action> change_actions() { return k_actions; }

void lay_out_change(Show& show, Viewer& v, float scale) {
    lay_out_history(show, v, scale);  // first, so that it stays where it is
    lay_out_day(show, v, scale);
    ImGui::Spacing();
    lay_out_people(show, v, scale);
    lay_out_who(show, v, scale);
    lay_out_platform(show, v, scale);
    lay_out_course(show, v);
    lay_out_drink(show, v, scale);
    lay_out_lamps(show, v, scale);
    lay_out_company(show, v, scale);
    lay_out_alongside(show, v, scale);
    lay_out_pastimes(show, v, scale);
    lay_out_traffic(show, v, scale);
    if (!show.loaded.world->roam && !is_on_course(*show.loaded.world)) {
        ImGui::Spacing();
        lay_out_tools(v, scale);
        lay_out_selected(v, scale);
    }
}

}  // namespace flaneur
