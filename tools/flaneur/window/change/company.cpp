#include "tools/flaneur/window/change/company.h"

#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/change/room.h"
#include "tools/flaneur/window/viewer.h"
#include "tools/flaneur/window/widgets.h"

namespace flaneur {

void lay_out_company(Show& show, Viewer& v, float scale) {
    World& world = *show.loaded.world;
    if (!is_on(world.company)) return;
    if (float share = grouped_share(world.company); slide_share("in groups", share, scale)) {
        set_grouped_share(world.company, share);
        changed_by_hand(v.time, world);
    }
    tip("of those who come in through doors and at the map's edges: they walk, stop and talk together");
    if (float share = world.company.acquaintances; slide_share("acquaintances", share, scale)) {
        world.company.acquaintances = share;
        changed_by_hand(v.time, world);
    }
    tip("how likely two who come towards each other know each other, greet and stop to talk");
}

}  // namespace flaneur
