// What may be changed of a world between two ticks.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "sim/pose/cane.h"
#include "sim/pose/pram.h"
#include "sim/stepping.h"
#include "sim/world.h"

namespace flaneur {

void change_ground(World& w, std::shared_ptr<const Ground> ground, NavmeshPtr mesh,
                   std::span<const Destination> destinations, std::span<const Rectangle> changed) {
    assert(!w.roam);
    const bool answers_itself = w.around.asked == w.ground.get();
    prepare_queries(*mesh, thread_count(*w.workers));
    change_mesh(w.crowd, *w.navmesh, *mesh, changed, w.tick);
    change_mesh(w.coming, *mesh);
    w.crowd.demand = make_demand(destinations, ground->low, ground->high, *mesh, w.crowd.demand.hour,
                                 w.crowd.demand.leaving);
    w.navmesh = std::move(mesh);
    w.ground = std::move(ground);
    if (minds_lamps(w.crowd.kerbs)) mind_lamps(w, Crossings(w.crowd.kerbs.map->crossings));
    if (answers_itself) w.around = surroundings_of(*w.ground);
    if (w.stepping) w.stepping->ground = w.ground, w.stepping->moving.ground = w.ground.get();
}

void make_room(World& w, uint32_t capacity) {
    if (capacity <= w.crowd.capacity) return;
    make_room(w.crowd, capacity);
    const size_t before = w.gait.blocks.size();
    reserve_gait(w.gait, capacity, w.kinds[0].body, w.seed);
    w.idles.wanted.resize(capacity, k_no_clip);
    w.idles.playing.resize(capacity, 0);
    w.idles.stood.resize(capacity, 0);
    w.idles.plays.reserve(capacity);
    w.poses.resize(w.gait.blocks.size());
    pose_blocks(w.gait, before, w.gait.blocks.size(), w.poses);
    w.previous_poses.resize(w.poses.size());
    w.trails.resize(w.poses.size());
    w.previous_trails.resize(w.poses.size());
    for (size_t block = before; block < w.poses.size(); ++block) w.previous_poses[block] = w.poses[block];
    make_room_to_come(w);
    if (is_on(w.crowd.march)) go_by_curves(w, LimbLead::curves, w.crowd.march.how);
}

void set_lamp_manner(World& w, uint32_t walker) {
    Kerbs& kerbs = w.crowd.kerbs;
    if (!minds_lamps(kerbs)) return;
    kerbs.manners[walker] = lamp_manner(w.kinds[w.crowd.identity.body[walker]].age, drunk_of(w, walker),
                                        personality_of(w, walker).conscientiousness, w.jaywalkers);
    if (is_creature(w.herd, walker)) kerbs.manners[walker].jaywalks = 0;
}

void set_jaywalkers(World& w, float share) {
    w.jaywalkers = share;
    for (const WalkerId id : w.crowd.slots.living) set_lamp_manner(w, id.index);
}

void mind_lamps(World& w, const Crossings& crossings) {
    const bool is_any = std::ranges::any_of(crossings.all, is_ruled);
    const auto map = is_any ? std::make_shared<const KerbMap>(make_kerb_map(crossings, *w.navmesh)) : nullptr;
    mind_lamps(w.crowd.kerbs, map, w.crowd.capacity);
    for (const WalkerId id : w.crowd.slots.living) set_lamp_manner(w, id.index);
}

void set_drunk(World& w, float drunk) {
    w.drunk = drunk;
    for (const WalkerId id : w.crowd.slots.living) {
        const uint32_t i = id.index, kind = w.crowd.identity.body[i];
        change_manner(w.gait, i, w.kinds[kind].body, w.crowd.identity.scale[i], manner_of(w, i));
        set_lamp_manner(w, i);
    }
}

void set_pace(World& w, uint32_t walker) {
    March& march = w.crowd.march;
    if (!is_on(march)) return;
    const float leg = w.gait.people[walker / k_block].joints[left_upper_leg][1][walker % k_block];
    march.pace[walker] = pace_of(march.how, leg);
}

void go_by_curves(World& w, LimbLead limbs, const LimbCurves& how) {
    March& march = w.crowd.march;
    march.how = how;
    const uint32_t slots = limbs == LimbLead::curves ? w.crowd.capacity : 0;
    march.pace.resize(slots);
    march.turns.resize(slots);
    for (uint32_t i = 0; i < slots; ++i) set_pace(w, i);
}

static float passed_hours(const World& w) { return static_cast<float>(w.tick) * (k_tick / 3600); }

static float within_a_day(float hour) { return hour - 24 * std::floor(hour / 24); }

float hour_now(const World& w) { return within_a_day(w.crowd.demand.hour + passed_hours(w)); }

void set_hour(World& w, float hour) { w.crowd.demand.hour = within_a_day(hour - passed_hours(w)); }

}  // namespace flaneur
