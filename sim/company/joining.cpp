// Groups that come in: one after the other through one door, or where nobody sees it.
#include <algorithm>

#include "sim/base/rng.h"
#include "sim/base/tick.h"
#include "sim/company/kinship.h"

namespace flaneur {

namespace {

constexpr uint32_t k_waits = 20 * 60;  // ticks, for who is to come in after

// A body that fits, of those that are drawn by chance.
void become_kin(Crowd& c, std::span<const Folk> folk, uint32_t i, const Folk& of, Kin kin, uint64_t seed) {
    constexpr uint32_t k_tries = 24;
    Walker best;
    float least = 2 * k_unfit;
    for (uint32_t t = 1; t <= k_tries; ++t) {
        const RandomKey key{seed, i, c.slots.generation[i] + (t << 26), Purpose::company};
        const Walker w = draw_walker(folk, key);
        const float unlike = misfit(folk[w.body], of, kin);
        if (unlike < least) least = unlike, best = w;
    }
    if (least >= 2 * k_unfit) return;
    const RandomKey own{seed, i, c.slots.generation[i], Purpose::body};
    become(c, i, draw_walker_as(folk, best.body, own));
}

Kin kin_of_next(const Group& g, const Crowd& c, std::span<const Folk> folk, uint64_t seed) {
    const uint32_t lead = g.members[g.leader].index;
    const RandomKey key{seed, lead, c.slots.generation[lead], Purpose::company};
    const bool has_child = g.count > 1 && folk[c.identity.body[g.members[1].index]].age < k_never_alone;
    if (g.brings_child != 0 && g.count == 1) return Kin::child;
    if (has_child || (g.count == 1 && random_unit(key, 1) < k_couples)) return Kin::spouse;
    return Kin::friends;
}

// The group that waits for one who comes in there.
Group* expecting(Company& company, const Crowd& c, uint32_t i) {
    constexpr float k_same = 0.6f;  // metres
    const Vec3 at = c.way_back[i].polygon != 0 ? c.way_back[i].position : c.motion.position[i];
    for (Group& g : company.groups)
        if (g.count > 0 && g.expects > 0 && length(on_ground(g.entry.position - at)) < k_same) return &g;
    return nullptr;
}

void join(Company& company, Crowd& c, std::span<const Folk> folk, Group& g, uint32_t i, uint64_t seed) {
    become_kin(c, folk, i, folk[c.identity.body[g.members[g.leader].index]], kin_of_next(g, c, folk, seed),
               seed);
    const Journey came = c.journeys[i];
    --g.expects;
    add_member(company, c, folk, g, {i, c.slots.generation[i]}, seed);
    // Others make way for one in a doorway, still.
    c.journeys[i].insists_since = came.insists_since;
    c.journeys[i].insists_from = came.insists_from;
}

// Who comes in first may be one of several. Children bring somebody who is grown up.
void begin(Company& company, Crowd& c, std::span<const Folk> folk, uint32_t i, uint32_t tick, uint64_t seed) {
    const RandomKey key{seed, i, c.slots.generation[i], Purpose::company};
    const Folk own = folk[c.identity.body[i]];
    const bool is_child = own.age < k_never_alone;
    const uint32_t size = draw_size(company.shares, is_child ? 2 : 1, key);
    if (size < 2) return;
    if (is_child) become_kin(c, folk, i, own, Kin::parent, seed);
    const WalkerId who[] = {{i, c.slots.generation[i]}};
    Group& g = begin_group(company, c, folk, who, 0, seed);
    g.brings_child = is_child ? 1 : 0;
    g.expects = size - 1;
    g.expects_until = tick + k_waits;
    const bool by_door = passage_by_door(c, i) != nullptr;
    g.entry = by_door ? c.way_back[i] : NavPoint{c.motion.position[i], c.motion.polygon[i]};
    g.entry_heading = c.motion.heading[i];
    g.by_door = by_door ? 1 : 0;
}

}  // namespace

void await_others(const Company& company, Coming& coming) {
    coming.awaited.clear();
    for (const Group& g : company.groups) {
        if (g.count == 0 || g.expects == 0 || coming.awaited.size() == coming.awaited.capacity()) continue;
        uint32_t called = 0;
        for (Entrant& e : coming.successors.entrants) {
            if (e.place.polygon == 0 || e.place.position != g.entry.position) continue;
            e.tries = 1;  // and looks for no other place
            ++called;
        }
        if (called < g.expects)
            coming.awaited.push_back({g.entry, g.entry_heading, g.by_door, g.expects - called});
    }
}

void join_arrivals(Company& company, Crowd& c, const Coming& coming, std::span<const Folk> folk,
                   uint32_t tick, uint64_t seed) {
    for (const uint32_t i : coming.arrivals) {
        if (c.journeys[i].errand != Errand::wander) continue;
        if (Group* g = expecting(company, c, i))
            join(company, c, folk, *g, i, seed);
        else
            begin(company, c, folk, i, tick, seed);
    }
}

}  // namespace flaneur
