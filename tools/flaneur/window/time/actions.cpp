#include "tools/flaneur/window/actions.h"

#include <GLFW/glfw3.h>

#include <array>

#include "sim/base/tick.h"
#include "tools/flaneur/window/panels.h"
#include "tools/flaneur/window/time/time.h"

namespace flaneur {
namespace {

// Where one is, or is going to be: presses in one picture add up.
int64_t now_of(const Show& show, const Viewer& v) {
    const bool is_known = v.time.going && !v.time.going->is_for_event;
    return is_known ? v.time.going->to : show.loaded.world->tick;
}

template <int Seconds>
void skip(Show& show, Viewer& v) {
    go_to(v, *show.loaded.world, now_of(show, v) + Seconds * 60);
}

void tick_back(Show& show, Viewer& v) {
    v.clock.is_paused = true;
    go_to(v, *show.loaded.world, now_of(show, v) - 1);
}

void go_to_start(Show& show, Viewer& v) { go_to(v, *show.loaded.world, 0); }
void go_to_latest(Show& show, Viewer& v) { go_to(v, *show.loaded.world, v.time.latest); }

void go_to_mark(Show& show, Viewer& v, const Mark* mark) {
    if (!mark) return tell(v, "No mark lies there: B marks a moment.");
    go_to_mark(v, *show.loaded.world, *mark);
}

uint32_t people_of(const Show& show) { return people_count(*show.loaded.world); }

constexpr std::array k_actions = {
    Action{"One tick back", ",", GLFW_KEY_COMMA, 0, tick_back, true},
    Action{"A second back", "Ctrl+Left", GLFW_KEY_LEFT, GLFW_MOD_CONTROL, skip<-1>, true},
    Action{"A second on", "Ctrl+Right", GLFW_KEY_RIGHT, GLFW_MOD_CONTROL, skip<1>, true},
    Action{"Ten seconds back", "Ctrl+Shift+Left", GLFW_KEY_LEFT, GLFW_MOD_CONTROL | GLFW_MOD_SHIFT, skip<-10>,
           true},
    Action{"Ten seconds on", "Ctrl+Shift+Right", GLFW_KEY_RIGHT, GLFW_MOD_CONTROL | GLFW_MOD_SHIFT, skip<10>,
           true},
    Action{"To the start of the run", "Home", GLFW_KEY_HOME, 0, go_to_start},
    Action{"As far as the run has come", "End", GLFW_KEY_END, 0, go_to_latest},
    Action{"Mark this moment", "B", GLFW_KEY_B, 0,
           [](Show& show, Viewer& v) { mark_moment(v, *show.loaded.world); }},
    Action{"To the mark before", "Alt+Left", GLFW_KEY_LEFT, GLFW_MOD_ALT,
           [](Show& show, Viewer& v) {
               go_to_mark(show, v, mark_before(v.time, static_cast<uint32_t>(now_of(show, v))));
           }},
    Action{"To the next mark", "Alt+Right", GLFW_KEY_RIGHT, GLFW_MOD_ALT,
           [](Show& show, Viewer& v) {
               go_to_mark(show, v, mark_after(v.time, static_cast<uint32_t>(now_of(show, v))));
           }},
    Action{"To the next event, or on until there is one", "N", GLFW_KEY_N, 0, go_to_next_event},
    Action{"To the event before", "Shift+N", GLFW_KEY_N, GLFW_MOD_SHIFT, go_to_event_before},
    Action{"Time: marks, events, runs anew", "", 0, 0,
           [](Show&, Viewer& v) { v.room = v.room == Room::time ? Room::none : Room::time; }},
    Action{"Restart with the same seed", "", 0, 0,
           [](Show& show, Viewer& v) { restart(show, v, show.loaded.world->seed); }},
    Action{"Restart with another seed", "", 0, 0,
           [](Show& show, Viewer& v) { restart(show, v, show.loaded.world->seed + 1); }},
    Action{"Compare side by side with another seed", "", 0, 0,
           [](Show& show, Viewer& v) {
               set_beside(show, v, {static_cast<uint64_t>(v.time.beside_seed), people_of(show)});
           }},
    Action{"Compare side by side with twice as many people", "", 0, 0,
           [](Show& show, Viewer& v) {
               set_beside(show, v, {show.loaded.world->seed, 2 * people_of(show)});
           }},
    Action{"Compare side by side with this moment, kept", "", 0, 0, set_beside_this_moment},
    Action{"Compare before and after: with the streets as opened", "Ctrl+B", GLFW_KEY_B, GLFW_MOD_CONTROL,
           set_beside_before},
    Action{"Compare side by side with all of the city as opened", "", 0, 0, set_beside_as_opened},
    Action{"End comparing", "", 0, 0, [](Show&, Viewer& v) { v.time.beside.reset(); }},
};

}  // namespace

std::span<const Action> time_actions() { return k_actions; }

}  // namespace flaneur
