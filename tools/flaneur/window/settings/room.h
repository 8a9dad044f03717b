// The room of settings.
#pragma once

#include <span>

#include "tools/flaneur/view/show.h"

namespace flaneur {

struct Action;
struct Viewer;

void open_settings(Show& show, Viewer& viewer);
// Of letters and panels: so many steps larger, or smaller where that is less than 0, or as the display asks
// for. Says how large.
void change_letters(Viewer& viewer, int steps);
void reset_letters(Viewer& viewer);
void lay_out_settings(Show& show, Viewer& viewer, float scale);
// Once a frame: keeps those that have changed. Says so if that fails.
void keep_changed_settings(Viewer& viewer);

// All of it (window/actions.h).
std::span<const Action> settings_actions();

}  // namespace flaneur
