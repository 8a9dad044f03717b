// All that keys and the palette do: one table, which the list of keys is made from too.
#pragma once

#include <span>
#include <string_view>

#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/viewer.h"

namespace flaneur {

struct Action {
    const char* name;  // plain words, as one would look for it
    const char* keys;  // as the list of keys tells them; "": it has none
    int key = 0;       // one of GLFW_KEY_*
    int mods = 0;      // of GLFW_MOD_CONTROL, _SHIFT and _ALT those that are held with it
    void (*act)(Show& show, Viewer& viewer);
    bool repeats = false;  // while the key is held down
};

struct ActionGroup {
    const char* name;
    std::span<const Action> actions;
    // Of many that are alike: the one row that the list of keys has for all of them.
    const char *in_short = nullptr, *keys_in_short = nullptr;
};
// In the order in which they are listed.
std::span<const ActionGroup> action_groups();

// Does what the keys that were pressed since the last call are for, in their order.
void act_on_presses(Show& show, Viewer& viewer);

// How well `typed` names an action: 0: not at all. Letters may be left out, in order; those that begin words
// and those that follow each other count for more.
int match(std::string_view typed, std::string_view name);

}  // namespace flaneur
