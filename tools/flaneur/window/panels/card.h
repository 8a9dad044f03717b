// Who is asked about, or else under the cursor, on a card at the right.
#pragma once

#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/viewer.h"

namespace flaneur {

// Whether there is one: of what one points at, or of what was clicked.
enum class Card : uint8_t { none, glimpse, kept };
Card card_of(const Show& show, Viewer& viewer);
void lay_out_card(Show& show, Viewer& viewer, float scale);

}  // namespace flaneur
