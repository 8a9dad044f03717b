#include "tools/flaneur/window/change/pastimes.h"

#include "sim/pastimes/pastimes.h"
#include "sim/stepping.h"
#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/change/room.h"
#include "tools/flaneur/window/viewer.h"
#include "tools/flaneur/window/widgets.h"

namespace flaneur {

void lay_out_pastimes(Show& show, Viewer& v, float scale) {
    World& world = *show.loaded.world;
    if (world.roam || is_on_course(world)) return;
    const PastimePlaces& places = world.pastimes->places;
    struct {
        const char *name, *tip;
        float PastimeShares::*share;
        bool is_there;
    } const sliders[] = {
        {"sit down", "of those who stop at benches", &PastimeShares::sitting, !places.seats.empty()},
        {"lean at walls", "of those who stop beside one", &PastimeShares::leaning, true},
        {"use phones", "of all, at any time; 10 to 30 % is usual", &PastimeShares::phones, true},
        {"look at windows", "of those who like to, as they pass shops", &PastimeShares::windows,
         !places.windows.empty()},
        {"line up", "of those who pass a window that sells to the street", &PastimeShares::queues,
         !places.services.empty()}};
    for (const auto& slider : sliders) {
        if (!slider.is_there) continue;
        PastimeShares shares = world.pastimes->shares;
        if (slide_share(slider.name, shares.*slider.share, scale)) {
            set_shares(*world.pastimes, shares, world.crowd);
            changed_by_hand(v.time, world);
        }
        tip(slider.tip);
    }
}

}  // namespace flaneur
