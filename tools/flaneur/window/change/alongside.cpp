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
    Company company = world.alongside->company;
    bool is_moved = slide_share("walk a dog", company.dogs, scale);
    is_moved |= slide_share("in a wheelchair", company.wheelchairs, scale);
    is_moved |= slide_share("with a white cane", company.white_canes, scale);
    is_moved |= slide_share("under an umbrella", company.umbrellas, scale);
    tip("of the grown ones whose hands are free");
    if (!is_moved) return;
    change_company(world, company);
    changed_by_hand(v.time, world);
}

}  // namespace flaneur
