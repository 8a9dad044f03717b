#include "tools/flaneur/window/change/lamps.h"

#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/change/room.h"
#include "tools/flaneur/window/viewer.h"
#include "tools/flaneur/window/widgets.h"

namespace flaneur {

void lay_out_lamps(Show& show, Viewer& v, float scale) {
    World& world = *show.loaded.world;
    if (!minds_lamps(world.crowd.kerbs)) return;
    if (float share = world.jaywalkers; slide_share("go on red", share, scale)) {
        set_jaywalkers(world, share);
        changed_by_hand(v.time, world);
    }
    tip("of those who come to a crossing while its lamp is red; at 100 % nobody minds lamps");
}

}  // namespace flaneur
