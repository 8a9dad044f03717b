#include "tools/flaneur/window/actions.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <utility>

#include "tools/flaneur/window/ask/find.h"
#include "tools/flaneur/window/ask/gait.h"
#include "tools/flaneur/window/ask/techniques.h"
#include "tools/flaneur/window/cameras/cameras.h"
#include "tools/flaneur/window/change/drive.h"
#include "tools/flaneur/window/change/hand.h"
#include "tools/flaneur/window/change/room.h"
#include "tools/flaneur/window/change/save.h"
#include "tools/flaneur/window/change/who.h"
#include "tools/flaneur/window/exhibits/exhibits.h"
#include "tools/flaneur/window/gui.h"
#include "tools/flaneur/window/input.h"
#include "tools/flaneur/window/measure/drawing.h"
#include "tools/flaneur/window/panels.h"
#include "tools/flaneur/window/panels/palette.h"
#include "tools/flaneur/window/settings/room.h"
#include "tools/flaneur/window/steppers/steppers.h"

namespace flaneur {
namespace {

template <WorkView View>
void turn(Show&, Viewer& v) {
    v.toggles.push_back(View);
}

// What lies on top goes first; the window itself only by a second time.
void dismiss(Show& show, Viewer& v) {
    constexpr double k_again_seconds = 2;
    if (let_go_of_driven(show, v) || std::exchange(v.change.is_naming, false)) return;
    if (std::exchange(v.lists_keys, false)) return;
    if (give_up_opening(v.opening)) return tell(v, "Nothing new is opened.");
    if (stop_going(v)) return;
    if (abandon_drawing(v) || abandon_line(v)) return;
    if (v.room == Room::change && std::exchange(v.change.tool, std::nullopt)) return;
    if (std::exchange(v.room, Room::none) != Room::none) return;
    if (v.selected) return v.selected.reset();
    if (v.asking.selected) return v.asking.selected.reset();
    const double now = glfwGetTime();
    if (now - v.escaped_at < k_again_seconds) {
        v.wants_close = true;
        return;
    }
    v.escaped_at = now;
    tell(v, "Esc once more closes the window.");
}

template <Room To>
void open(Show&, Viewer& v) {
    v.room = v.room == To ? Room::none : To;
}

constexpr std::array k_time = {
    Action{"Stop or go", "Space", GLFW_KEY_SPACE, 0,
           [](Show& show, Viewer& v) {
               if (!jump_driven(show)) v.clock.is_paused = !v.clock.is_paused;
           }},
    Action{"One tick, 1/60 s", ".", GLFW_KEY_PERIOD, 0,
           [](Show&, Viewer& v) { v.clock.is_paused = true, ++v.clock.steps; }, true},
    Action{"Slower", "-", GLFW_KEY_MINUS, 0, [](Show&, Viewer& v) { v.clock.rate = slower(v.clock.rate); }},
    Action{"Faster", "+", GLFW_KEY_EQUAL, 0, [](Show&, Viewer& v) { v.clock.rate = faster(v.clock.rate); }},
    Action{"As fast as it is", "", 0, 0, [](Show&, Viewer& v) { v.clock.rate = 1; }},
};
// What was done last, in the city or drawn in the room Measure; 0: nothing.
struct Deeds {
    uint64_t city = 0, drawn = 0;
};
void undo(Show& show, Viewer& v) {
    const Designs& d = v.change.designs;
    const MeasureRoom& room = v.measure;
    const Deeds last{d.at > 0 ? d.deeds[d.at] : 0, room.before.empty() ? 0 : room.before.back().deed};
    const bool is_drawing = v.room == Room::measure && !room.draft.empty();
    is_drawing || last.drawn > last.city ? undo_drawing(show, v) : undo_last(show, v);
}
void redo(Show& show, Viewer& v) {
    const Designs& d = v.change.designs;
    const MeasureRoom& room = v.measure;
    const Deeds next{d.at + 1 < d.all.size() ? d.deeds[d.at + 1] : 0,
                     room.after.empty() ? 0 : room.after.back().deed};
    const bool is_drawn = next.drawn > 0 && (next.city == 0 || next.drawn < next.city);
    is_drawn ? redo_drawing(show, v) : redo_last(show, v);
}
// What is removed is of the room that is open.
void remove(Show& show, Viewer& v) {
    v.room == Room::measure ? remove_selected(show, v) : remove_selected(v);
}
constexpr std::array k_editing = {
    Action{"Undo", "Ctrl+Z", GLFW_KEY_Z, GLFW_MOD_CONTROL, undo},
    Action{"Redo", "Ctrl+Y", GLFW_KEY_Y, GLFW_MOD_CONTROL, redo},
    Action{"Do again what was undone", "Ctrl+Shift+Z", GLFW_KEY_Z, GLFW_MOD_CONTROL | GLFW_MOD_SHIFT, redo},
    Action{"Remove what is selected", "Delete", GLFW_KEY_DELETE, 0, remove},
};
constexpr std::array k_layers = {
    Action{"Layers", "L", GLFW_KEY_L, 0, open<Room::layers>},
    Action{"Layer: wireframe", "F2", GLFW_KEY_F2, 0, turn<WorkView::wireframe>},
    Action{"Layer: normals", "F3", GLFW_KEY_F3, 0, turn<WorkView::normals>},
    Action{"Layer: overdraw", "F4", GLFW_KEY_F4, 0, turn<WorkView::overdraw>},
    Action{"Layer: levels of detail", "F5", GLFW_KEY_F5, 0, turn<WorkView::lods>},
    Action{"Layer: speed", "F6", GLFW_KEY_F6, 0, turn<WorkView::speed>},
    Action{"Layer: density", "F7", GLFW_KEY_F7, 0, turn<WorkView::density>},
    Action{"Layer: walkable ground", "F8", GLFW_KEY_F8, 0, turn<WorkView::walkable>},
    Action{"Layer: trails", "F9", GLFW_KEY_F9, 0, turn<WorkView::trails>},
    Action{"Layer: skeletons", "F10", GLFW_KEY_F10, 0, turn<WorkView::skeletons>},
    Action{"Layer: gizmos of the gait", "F11", GLFW_KEY_F11, 0, turn<WorkView::gizmos>},
    Action{"Layer: ways", "Shift+F11", GLFW_KEY_F11, GLFW_MOD_SHIFT, turn<WorkView::ways>},
};
template <size_t Level>
void set_quality(Show&, Viewer& v) {
    v.quality = k_quality_names[Level];
}

// For who has no mouse: the cursor goes there first, so that one sees what a click would mean.
void click_in_middle(Show&, Viewer& v) {
    const glm::dvec2 window(v.layout.wish.window);
    const double x = std::floor(window.x / (has_two(v) ? 4 : 2)), y = std::floor(window.y / 2);
    Events& events = v.events;
    const bool is_there = events.x == x && events.y == y;
    events.x = x, events.y = y;
    if (!is_there) return add_event(events.mouse, {x, y});
    for (const bool is_down : {true, false}) add_event(events.mouse, {x, y, GLFW_MOUSE_BUTTON_LEFT, is_down});
}

constexpr std::array k_window = {
    Action{"Point at the middle of the picture; again: click there", "K", GLFW_KEY_K, 0, click_in_middle},
    Action{"What a picture costs, and what makes it slow", "I", GLFW_KEY_I, 0, open<Room::frame>},
    Action{"Copy the command that measures this", "", 0, 0,
           [](Show&, Viewer& v) { v.wants_bench_command = true; }},
    Action{"Quality: low", "", 0, 0, set_quality<0>},
    Action{"Quality: medium", "", 0, 0, set_quality<1>},
    Action{"Quality: high", "", 0, 0, set_quality<2>},
    Action{"Quality: ultra", "", 0, 0, set_quality<3>},
    Action{"Quality: what suits the device", "", 0, 0, [](Show&, Viewer& v) { v.quality.clear(); }},
    Action{"Copy the command that draws this", "C", GLFW_KEY_C, 0,
           [](Show&, Viewer& v) { v.wants_command = true; }},
    Action{"Hide the panels, or show them", "H", GLFW_KEY_H, 0,
           [](Show&, Viewer& v) { v.has_panels = !v.has_panels; }},
    Action{"Find an action by its name", "Ctrl+P", GLFW_KEY_P, GLFW_MOD_CONTROL,
           [](Show&, Viewer& v) { v.palette = {.is_open = true}; }},
    Action{"List the keys", "F1", GLFW_KEY_F1, 0, [](Show&, Viewer& v) { v.lists_keys = !v.lists_keys; }},
    Action{"Let go, or dismiss what is open", "Esc", GLFW_KEY_ESCAPE, 0, dismiss},
    Action{"Close the window", "Ctrl+Q", GLFW_KEY_Q, GLFW_MOD_CONTROL,
           [](Show&, Viewer& v) { v.wants_close = true; }},
};
// Of keys that have a twin.
int plain(int key) {
    if (key == GLFW_KEY_KP_ADD) return GLFW_KEY_EQUAL;
    if (key == GLFW_KEY_KP_SUBTRACT) return GLFW_KEY_MINUS;
    if (key == GLFW_KEY_KP_0) return GLFW_KEY_0;
    if (key == GLFW_KEY_KP_ENTER) return GLFW_KEY_ENTER;
    return key;
}

bool is_for(const Action& action, const KeyPress& press) {
    constexpr int k_mods = GLFW_MOD_CONTROL | GLFW_MOD_SHIFT | GLFW_MOD_ALT;
    // Shift makes one fast while flying, and is held where + is above =.
    const int held = press.mods & k_mods;
    const bool ignores_shift = action.mods == 0 || action.key == GLFW_KEY_EQUAL;
    return action.key != 0 && action.key == plain(press.key) &&
           (held == action.mods || (ignores_shift && (held & ~GLFW_MOD_SHIFT) == action.mods)) &&
           (action.repeats || !press.repeats);
}

}  // namespace

std::span<const ActionGroup> action_groups() {
    static const std::array all = {
        ActionGroup{"Time", k_time},
        ActionGroup{"Back and forth in time", time_actions()},
        ActionGroup{"Cameras", camera_actions()},
        ActionGroup{"Bookmarks", bookmark_actions(), "Keep a camera; go back there", "Ctrl+1..9, Alt+1..9"},
        ActionGroup{"Layers", k_layers},
        ActionGroup{"People", find_actions()},
        ActionGroup{"Gait", gait_actions()},
        ActionGroup{"Techniques of bodies", technique_actions(), "Bodies before and after, side by side",
                    "Shift+J"},
        ActionGroup{"Measure", measure_actions()},
        ActionGroup{"Change", change_actions()},
        ActionGroup{"Who comes", who_actions(), "More or fewer children, old people, prams", "T"},
        ActionGroup{"Exhibits of inverse kinematics", exhibit_actions()},
        ActionGroup{"Those on a course", stepper_actions()},
        ActionGroup{"Undo and redo", k_editing},
        ActionGroup{"Opening", opening_actions()},
        ActionGroup{"Pictures and films", record_actions()},
        ActionGroup{"Window", k_window},
        ActionGroup{"Settings and keys", settings_actions()},
    };
    return all;
}

void act_on_presses(Show& show, Viewer& v) {
    if (v.presentation.is_on && !v.presses.empty()) {
        v.presses.clear();
        end_presentation(v);
    }
    // What was typed before a key reaches its field first.
    auto waits = [&] { return (gui_has_field() || has_own_field(v)) && !v.events.typing.waiting.empty(); };
    while (!v.presses.empty() && !waits()) {
        const KeyPress press = v.presses.front();
        v.presses.erase(v.presses.begin());
        if (press.key == GLFW_KEY_Q && (press.mods & GLFW_MOD_CONTROL)) v.wants_close = true;
        if (v.palette.is_open) {
            press_in_palette(press.key, show, v);
            continue;
        }
        if (press_in_opening(press.key, press.mods, show, v)) continue;
        if (v.change.is_naming && gui_has_keys()) {
            press_in_name(press.key, show, v);
            continue;
        }
        if (v.panel_keys.are_on && press_in_panels(press.key, press.mods, v)) continue;
        if (press_in_drive(press.key, press.mods, show, v)) continue;
        const Action* found = nullptr;
        for (const ActionGroup& group : action_groups())
            for (const Action& action : group.actions)
                if (is_for(action, press) && (!found || action.mods > found->mods)) found = &action;
        if (found) found->act(show, v);
    }
}

int match(std::string_view typed, std::string_view name) {
    auto low = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
    int worth = 1;
    // What is typed may stand there as it is, best of all where a word begins.
    const auto same = std::search(name.begin(), name.end(), typed.begin(), typed.end(),
                                  [&](char a, char b) { return low(a) == low(b); });
    if (same != name.end()) worth += same == name.begin() || *(same - 1) == ' ' ? 40 : 20;
    size_t at = 0;
    bool is_next = false;
    for (const char c : typed) {
        if (c == ' ') {
            is_next = false;
            continue;
        }
        size_t found = at;
        while (found < name.size() && low(name[found]) != low(c)) ++found;
        if (found == name.size()) return 0;
        const bool begins = found == 0 || name[found - 1] == ' ';
        worth += 1 + (is_next && found == at ? 3 : 0) + (begins ? 2 : 0);
        at = found + 1;
        is_next = true;
    }
    return worth;
}

}  // namespace flaneur
