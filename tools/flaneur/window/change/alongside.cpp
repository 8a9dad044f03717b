#include "tools/flaneur/window/change/alongside.h"

#include "sim/alongside/alongside.h"
#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/change/room.h"
#include "tools/flaneur/window/viewer.h"
#include "tools/flaneur/window/widgets.h"

namespace flaneur {

void lay_out_alongside(Show& show, Viewer& v, float scale) {
    World& world = *show.loaded.world;
    if (!world.alongside) return;
    AlongShares shares = world.alongside->shares;
    bool is_moved = slide_share("walk a dog", shares.dogs, scale);
    is_moved |= slide_share("in a wheelchair", shares.wheelchairs, scale);
    is_moved |= slide_share("with a white cane", shares.white_canes, scale);
    is_moved |= slide_share("under an umbrella", shares.umbrellas, scale);
    tip("of the grown ones whose hands are free");
    if (!is_moved) return;
    change_along(world, shares);
    changed_by_hand(v.time, world);
}

}  // namespace flaneur
