// Actions (actions.h) as lists: of all keys, and one that is searched by name.
#pragma once

#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/viewer.h"

namespace flaneur {

void lay_out_keys(Viewer& viewer, Size size, float scale);
// Up, down, Enter and Esc, while it is open: pressed within a picture as well.
void press_in_palette(int key, Show& show, Viewer& viewer);
// Does what is clicked.
void lay_out_palette(Show& show, Viewer& viewer, Size size, float scale);

}  // namespace flaneur
