#include "tools/flaneur/window/change/life.h"

#include <algorithm>

#include "sim/alongside/alongside.h"
#include "sim/pastimes/pastimes.h"
#include "sim/stepping.h"
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
         !places.services.empty()},
        {"look up at houses", "of those who go alone, now and then", &PastimeShares::tourists, true},
        {"hurry", "of those who go alone; who is on the way to a bus that is there runs",
         &PastimeShares::hurrying, true},
        {"stroll", "of those who go alone", &PastimeShares::strolling, true}};
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

// How many are in groups of those who come in; and another number, of which as many are in pairs, threes and
// fours as before.
static float grouped_share(const GroupShares& shares) {
    const float grouped = shares[1] + shares[2] + shares[3];
    return grouped / std::max(grouped + shares[0], 1e-6f);
}
static GroupShares with_grouped(const GroupShares& shares, float share) {
    const GroupShares& usual = has_groups(shares) ? shares : k_usual_groups;
    const float grouped = usual[1] + usual[2] + usual[3];
    return {1 - share, share * usual[1] / grouped, share * usual[2] / grouped, share * usual[3] / grouped};
}

void lay_out_company(Show& show, Viewer& v, float scale) {
    World& world = *show.loaded.world;
    if (!is_on(world.company)) return;
    if (float share = grouped_share(world.company.shares); slide_share("in groups", share, scale)) {
        world.company.shares = with_grouped(world.company.shares, share);
        changed_by_hand(v.time, world);
    }
    tip("of those who come in through doors and at the map's edges: they walk, stop and talk together");
    if (float share = world.company.acquaintances; slide_share("acquaintances", share, scale)) {
        world.company.acquaintances = share;
        changed_by_hand(v.time, world);
    }
    tip("how likely two who come towards each other know each other, greet and stop to talk");
}

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
