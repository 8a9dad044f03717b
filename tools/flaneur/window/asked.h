// Those whom one points at and asks about.
#pragma once

#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/input.h"

namespace flaneur {

// Who is under the cursor, and who has been clicked; nobody is where a panel is.
void ask(const Show& show, const Mouse& mouse, Size size, bool is_panels, Viewer& viewer);

// Adds to the frame a ring on the ground round each of them and, of who was clicked, the way ahead and the
// goal.
void mark_asked(const Viewer& viewer, Show& show, FrameInput& frame);

}  // namespace flaneur
