// The room of settings.
#pragma once

#include <span>

#include "tools/flaneur/view/show.h"

namespace flaneur {

struct Action;
struct Viewer;

void open_settings(Show& show, Viewer& viewer);
void lay_out_settings(Show& show, Viewer& viewer, float scale);
// Once a frame: keeps those that have changed. Says so if that fails.
void keep_changed_settings(Viewer& viewer);

// All of it (window/actions.h).
std::span<const Action> settings_actions();

}  // namespace flaneur
