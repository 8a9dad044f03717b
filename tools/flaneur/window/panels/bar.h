// The bar above: time, pace and rooms.
#pragma once

#include <span>

#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/viewer.h"

namespace flaneur {

// The panel on the left while its room is open.
struct RoomPanel {
    Room room;
    const char *name, *tip;
    void (*lay_out)(Show& show, Viewer& viewer, float scale);
};

// What does not fit is in a menu. Below, where there are tabs, those of the panels that are shown.
void lay_out_bar(const Show& show, Viewer& viewer, std::span<const RoomPanel> rooms, float scale);

}  // namespace flaneur
