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

void lay_out_traffic(Show& show, Viewer& v, float scale) {
    World& world = *show.loaded.world;
    if (!world.roads) return;
    if (float traffic = world.vehicles.traffic; slide_share("traffic", traffic, scale)) {
        set_traffic(world, traffic);
        changed_by_hand(v.time, world);
    }
    tip("how many drive: at 0 % nobody, at 50 % as many as usual, at 100 % as in a rush hour");
}

}  // namespace flaneur
