// Who is asked about, or else under the cursor, on a card at the right.
#pragma once

#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/viewer.h"

namespace flaneur {

void lay_out_card(Show& show, Viewer& viewer, Size size, float scale);

}  // namespace flaneur
