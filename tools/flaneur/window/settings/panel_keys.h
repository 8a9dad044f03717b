// Keys in panels. Arrows, Tab, Space and Enter belong to the city, until one asks for panels: then they move
// about in them, and the city stays as it is.
#pragma once

#include <deque>

#include "renderer/scene.h"
#include "tools/flaneur/options/options.h"

namespace flaneur {

struct Show;
struct Viewer;

struct PanelKeys {
    bool are_on = false;
    size_t panel = 0;  // of those that are shown, which has the keys
    bool wants_focus = false;
    std::deque<int> taps;    // keys that panels have not been told of yet
    bool has_rested = true;  // no tap in the last picture
};

// The keys are the next panel's; with panels that is asked for by a key (window/actions.h).
void ask_for_panels(Show& show, Viewer& viewer);
void leave_panels(Viewer& viewer);

// While they are on: whether the key is a panel's.
bool press_in_panels(int key, int mods, Viewer& viewer);

// Whether it moves about in panels.
bool is_panel_key(int key);

// Between pictures: which key panels are told of in the next one, 0: none. A tap is a picture long, and a
// picture lies between two, so that none is lost however slowly pictures come.
int next_tap(PanelKeys& keys);

}  // namespace flaneur
