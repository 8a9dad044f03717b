// The screen that one may begin with.
#pragma once

#include "tools/flaneur/options/options.h"

namespace flaneur {

struct Show;
struct Viewer;

void lay_out_start(Show& show, Viewer& viewer, Size size, float scale);
// Whether the key was for it.
bool press_in_start(int key, Show& show, Viewer& viewer);

}  // namespace flaneur
