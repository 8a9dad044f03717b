#include "sim/crowd/crowd.h"

#include <bit>
#include <cassert>
#include <cmath>

#include "sim/base/block.h"
#include "sim/base/hash.h"
#include "sim/base/spans.h"
#include "sim/crowd/errand.h"
#include "sim/crowd/places.h"
#include "sim/crowd/values-inl.h"

namespace flaneur {

Crowd make_crowd(uint32_t capacity) {
    Crowd c;
    c.capacity = capacity;
    auto resize_to = [](size_t n, auto&... arrays) { (arrays.resize(n), ...); };
    CrowdIdentity& who = c.identity;
    resize_to(capacity, who.preferred_speed, who.radius, who.lateral, who.body, who.scale, who.stair_pace,
              who.ahead, who.room, who.patience, who.linger);
    CrowdMotion& m = c.motion;
    resize_to(capacity, m.position, m.velocity, m.wish, m.heading, m.turn_rate, m.feet, m.brakes, m.polygon,
              m.under, m.filed);
    CrowdDecision& d = c.decision;
    resize_to(capacity, d.wanted, d.course, d.aim, d.looks, d.chosen, d.claim);
    CrowdScratch& s = c.scratch;
    resize_to(capacity, c.journeys, c.way_back, s.order, s.intents, s.lets_pass);
    c.corners.resize(size_t{capacity} * k_corners);
    c.at_once.assign(block_count(capacity), 1);
    s.woken.assign(block_count(capacity), 0);
    SeenRows& rows = s.seen;
    resize_to(capacity + k_block, rows.x, rows.y, rows.z);
    rows.all.resize(capacity);
    s.requests.reserve(capacity);
    c.passages.reserve(capacity);
    c.slots.living.reserve(capacity);
    c.slots.left.reserve(capacity);
    c.slots.place.assign(capacity, k_nobody);
    c.slots.generation.resize(capacity);
    // About two cells a walker, at least 32 x 32.
    uint32_t cells = std::max(1024u, std::bit_ceil(capacity * 2));
    s.cells_x = 1u << ((std::bit_width(cells) - 1) / 2);
    s.cells_z = cells / s.cells_x;
    s.cell_first.resize(cells + 1);
    s.tallies.resize(size_t{k_sorters} * cells);
    return c;
}

bool has_room(const Crowd& c, Vec3 place, float radius) {
    for (WalkerId id : c.slots.living) {
        float apart = radius + c.identity.radius[id.index];
        Vec3 off = c.motion.position[id.index] - place;
        if (length_squared(on_ground(off)) < apart * apart && std::fabs(off.y) < k_other_level) return false;
    }
    return true;
}

static uint32_t take_slot(Crowd& c) {
    CrowdSlots& slots = c.slots;
    assert(slots.living.size() < c.capacity);
    uint32_t i = c.count;
    if (slots.left.empty()) {
        ++c.count;
    } else {
        i = slots.left.back();
        slots.left.pop_back();
    }
    slots.place[i] = static_cast<uint32_t>(slots.living.size());
    slots.living.push_back({i, slots.generation[i]});
    return i;
}

// Who takes a slot after another goes elsewhere than that one would have.
static constexpr uint32_t k_trips_apart = 1 << 12;

static bool is_empty(const Crowd& c, size_t block) {
    const size_t past = std::min<size_t>(c.count, (block + 1) * k_block);
    for (size_t i = block * k_block; i < past; ++i)
        if (is_there(c, static_cast<uint32_t>(i))) return false;
    return true;
}

uint32_t add_walker(Crowd& c, const Surroundings& around, const Walker& w) {
    assert(w.place.polygon != 0 && w.preferred_speed > 0 && w.radius >= k_least_radius);
    const uint32_t slot = c.slots.left.empty() ? c.count : c.slots.left.back();
    // Nobody's time passes there: who comes need not wait for a turn of those who were there before.
    if (is_empty(c, slot / k_block)) c.at_once[slot / k_block] = 1;
    uint32_t i = take_slot(c);
    Vec3 p = w.place.position;
    c.motion.under[i] = {};
    if (auto hit = ground_at(around, p, 1, 2)) {
        p.y = hit->height;
        c.motion.under[i] = *hit;
    }
    c.motion.position[i] = p;
    c.motion.filed[i] = filed_at(p);
    c.scratch.is_ordered = false;
    c.motion.velocity[i] = {};
    c.motion.heading[i] = w.heading;
    c.motion.wish[i] = {0, 0};
    c.motion.turn_rate[i] = c.motion.brakes[i] = 0;
    c.motion.feet[i] = {};
    c.motion.polygon[i] = w.place.polygon;
    become(c, i, w);
    c.widest = std::max(c.widest, w.radius);
    if (!c.fellows.empty()) c.fellows[i] = {};
    c.decision.wanted[i] = c.decision.course[i] = c.decision.aim[i] = c.decision.chosen[i] = {};
    c.decision.looks[i] = 0;
    if (minds_lamps(c.kerbs)) leave_kerb(c.kerbs, i);
    c.decision.claim[i] = {};
    c.way_back[i] = {};
    Journey j;
    j.errand = w.errand;
    j.trip = c.slots.generation[i] * k_trips_apart;
    j.goal = {p, w.place.polygon};
    j.path_due = w.errand == Errand::wander ? PathDue::to_new_goal : PathDue::no;
    j.arrived = w.errand == Errand::arrive;
    c.journeys[i] = j;
    return i;
}

void remove_walker(Crowd& c, uint32_t i) {
    CrowdSlots& slots = c.slots;
    assert(is_there(c, i));
    WalkerId last = slots.living.back();
    slots.living[slots.place[i]] = last;
    slots.place[last.index] = slots.place[i];
    slots.living.pop_back();
    slots.place[i] = k_nobody;
    ++slots.generation[i];
    slots.left.push_back(i);
    c.scratch.is_ordered = false;
    take_away(c.wayfarers, i);
    take_away(c.passages, i);
    if (c.driven.walker == i) c.driven = {};
    (void)take_away(c.downed, i);
    (void)take_away(c.called, i);
    if (!c.fellows.empty()) c.fellows[i] = {};
    (void)take_away(c.beside, i);
    if (minds_lamps(c.kerbs)) leave_kerb(c.kerbs, i);
}

const Passage* passage_of(const Crowd& c, uint32_t i) { return own_of(c.passages, i); }

const Passage* passage_by_door(const Crowd& c, uint32_t i) {
    const Passage* passage = passage_of(c, i);
    return passage && is_by_door(*passage) ? passage : nullptr;
}

bool is_in_doorway(const Crowd& c, uint32_t i) {
    const Passage* p = passage_by_door(c, i);
    return p && is_within(p->door, c.motion.position[i]);
}

void turn_back(Crowd& c, uint32_t i) {
    if (Passage* p = own_of(c.passages, i))
        p->kind = is_by_door(*p) ? Passage::Kind::in : Passage::Kind::appear;
}

void send_to(Crowd& c, uint32_t i, NavPoint goal) {
    turn_back(c, i);
    Journey& j = c.journeys[i];
    Journey next;
    next.goal = goal;
    next.trip = j.trip + 1;
    next.errand = j.errand;
    next.path_due = PathDue::to_goal;
    j = next;
}

void drive(Crowd& c, uint32_t i) {
    let_go(c);
    turn_back(c, i);
    c.driven = {i, {0, 0}};
    c.journeys[i].insists_since = k_never;
}

bool is_down(const Crowd& c, uint32_t i) { return !c.downed.empty() && own_of(c.downed, i) != nullptr; }

bool is_led(const Crowd& c, uint32_t i) {
    if (!c.leads || c.journeys[i].errand != Errand::by_way) return false;
    const Wayfarer* way = own_of(c.wayfarers, i);
    return way && way->kind == Wayfarer::Kind::is_led;
}

void go_down(Crowd& c, uint32_t i) {
    turn_back(c, i);
    (void)take_away(c.called, i);
    c.downed.insert(take_away(c.downed, i), Downed{.walker = i});
    c.motion.velocity[i] = c.motion.wish[i] = {};
    c.journeys[i].insists_since = k_never;
}

void lie_across(Crowd& c, const Downed& how) {
    if (Downed* own = own_of(c.downed, how.walker)) *own = how;
}

void get_up(Crowd& c, uint32_t i) {
    (void)take_away(c.downed, i);
    go_on_from_here(c, i);
}

void call(Crowd& c, const Called& how) {
    c.called.insert(take_away(c.called, how.walker), how);
    c.journeys[how.walker].insists_since = k_never;
}

void call_off(Crowd& c, uint32_t i) {
    if (!own_of(c.called, i)) return;
    (void)take_away(c.called, i);
    go_on_from_here(c, i);
}

bool stays_put(const Crowd& c, uint32_t i) {
    const Called* called = c.called.empty() ? nullptr : own_of(c.called, i);
    return called && called->speed == 0;
}

// Of those who go by a way only who leads goes to a goal.
static bool has_goal(const Crowd& c, uint32_t i) {
    if (c.journeys[i].errand != Errand::by_way) return true;
    const Wayfarer* way = own_of(c.wayfarers, i);
    return way && way->kind == Wayfarer::Kind::lead;
}

void go_on_from_here(Crowd& c, uint32_t i) {
    Journey& j = c.journeys[i];
    if (!has_goal(c, i))
        j.corner = j.corner_count;
    else if (j.path_due == PathDue::no)
        j.path_due = PathDue::to_goal;
    j.pause_until = 0;
    j.arrived = false;
}

void let_go(Crowd& c) {
    if (c.driven.walker == k_nobody) return;
    go_on_from_here(c, c.driven.walker);
    c.driven = {};
}

void go_by_way(Crowd& c, const Wayfarer& way) {
    const uint32_t i = way.walker;
    turn_back(c, i);
    c.leads = c.leads || way.kind == Wayfarer::Kind::is_led;
    c.wayfarers.insert(take_away(c.wayfarers, i), way)->bearing = c.motion.heading[i];
    if (is_on(c.march)) c.march.turns[i] = {};
    Journey next;
    next.goal = {c.motion.position[i], c.motion.polygon[i]};
    next.trip = c.journeys[i].trip + 1;
    next.errand = Errand::by_way;
    c.journeys[i] = next;
}

bool has_arrived(const Crowd& c, uint32_t i) { return c.journeys[i].arrived && has_goal(c, i); }

void step_crowd(Crowd& crowd, const Surroundings& around, const Navmesh& mesh, Workers& workers,
                uint32_t tick, uint64_t seed) {
    look_on(crowd, workers, tick);
    think(crowd, mesh, workers, tick, seed);
    find_neighbours(crowd, workers, tick);
    steer(crowd, mesh, workers, tick);
    move(crowd, around, mesh, workers, tick);
}

// Of a value, of one that may not be there, and of a list.
template <class T>
static uint64_t hash_value(uint64_t h, const T& value) {
    return hash_bytes(h, &value, sizeof value);
}
template <class T>
static uint64_t hash_value(uint64_t h, const T* value) {
    return value ? hash_value(h, *value) : h;
}
template <class T>
static uint64_t hash_value(uint64_t h, std::span<const T> list) {
    return hash_bytes(h, list.data(), list.size_bytes());
}

uint64_t hash_crowd(const Crowd& c) {
    const CrowdSlots& slots = c.slots;
    uint64_t h = mix(c.count ^ uint64_t{c.next_path} << 32);
    h = hash_bytes(h, slots.generation.data(), c.count * sizeof(uint32_t));
    h = hash_bytes(h, slots.left.data(), slots.left.size() * sizeof(uint32_t));
    h = hash_bytes(h, slots.living.data(), slots.living.size() * sizeof(WalkerId));
    for (uint32_t i = 0; i < c.count; ++i)
        if (is_there(c, i))
            for_each_value(c, i, [&](const FieldName&, const auto& value) { h = hash_value(h, value); });
    if (c.driven.walker != k_nobody) h = hash_value(h, c.driven);
    if (is_on(c.march)) {
        h = hash_value(h, c.march.how);
        h = hash_bytes(h, c.march.pace.data(), c.march.pace.size() * sizeof(float));
        h = hash_bytes(h, c.march.turns.data(), c.march.turns.size() * sizeof(SlowTurn));
    }
    if (!c.beside.empty()) h = hash_bytes(h, c.beside.data(), c.beside.size() * sizeof(GoesBeside));
    const Traffic& traffic = c.traffic;
    if (traffic.is_slow || traffic.done > 0) {
        h = hash_bytes(h, traffic.slow.data(), traffic.slow.size() * sizeof(float));
        h = hash_bytes(h, traffic.coming.data(), traffic.coming.size() * sizeof(float));
        h = hash_value(h, traffic.done);
    }
    return h;
}

}  // namespace flaneur
