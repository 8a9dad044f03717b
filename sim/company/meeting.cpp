#include "sim/company/meeting.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/base/spans.h"
#include "sim/base/tick.h"
#include "sim/company/kinship.h"
#include "sim/crowd/places.h"

namespace flaneur {

namespace {

constexpr float k_sees = 9, k_too_near = 3.5f;  // metres
constexpr uint32_t k_looks = 20;                // ticks between two looks of one walker
constexpr uint32_t k_rests = 120 * 60;          // ticks until one stops for an acquaintance again

uint32_t ticks_of(float seconds) { return static_cast<uint32_t>(seconds / k_tick); }

// Whether two know each other; as long as both are there.
bool know_each_other(const Company& company, uint32_t a, uint32_t b, uint64_t seed) {
    const RandomKey key{seed, std::min(a, b), std::max(a, b), Purpose::company};
    return random_unit(key, 80) < company.acquaintances;
}

// Who goes alone about an errand, in full view, and has time.
bool can_stop(const Company& company, const Crowd& c, std::span<const Folk> folk, uint32_t i, uint32_t tick) {
    constexpr float k_least = 0.5f;  // m/s
    const Journey& j = c.journeys[i];
    return c.fellows[i].group == k_no_group && j.errand == Errand::wander && !j.arrived &&
           j.path_due == PathDue::no && tick >= company.bearings[i].meets_next &&
           c.at_once[i / k_block] == 1 && c.way_back[i].polygon == 0 && i != c.driven.walker &&
           c.identity.ahead[i] == 0 && folk[c.identity.body[i]].age >= k_never_alone && !is_down(c, i) &&
           !own_of(c.called, i) && !passage_of(c, i) && !waits_at_kerb(c.kerbs, i) &&
           !is_carriageway(c.motion.under[i].kind) && length(c.motion.velocity[i]) > k_least;
}

// Places about a middle, each for who is nearest to it.
bool set_places(Crowd& c, const Navmesh& mesh, Group& g, Vec2 middle, Vec2 from) {
    constexpr float k_radius[] = {0, 0, 0.5f, 0.58f, 0.7f};  // metres
    std::array<Vec2, k_most_company> places{};
    std::array<uint32_t, k_most_company> order{0, 1, 2, 3}, best = order;
    const float first = heading_of(from), turn = 2 * k_pi / static_cast<float>(g.count);
    for (uint32_t k = 0; k < g.count; ++k)
        places[k] = middle + heading_direction(first + turn * static_cast<float>(k)) * k_radius[g.count];
    float least = 1e9f;
    do {
        float sum = 0;
        for (uint32_t k = 0; k < g.count; ++k)
            sum += length_squared(places[order[k]] - on_ground(c.motion.position[g.members[k].index]));
        if (sum < least) least = sum, best = order;
    } while (std::next_permutation(order.begin(), order.begin() + g.count));
    for (uint32_t k = 0; k < g.count; ++k) {
        const uint32_t i = g.members[k].index;
        const Vec3 there = at_height(places[best[k]], c.motion.position[i].y);
        const auto place = nearest(mesh, 0, there, {0.1f, 1.5f, 0.1f});
        if (!place || length(on_ground(place->position) - places[best[k]]) > 0.05f ||
            is_carriageway(surface_of(mesh, place->polygon)) || !is_clear(mesh, c.motion.position[i], there))
            return false;
    }
    g.middle = middle;
    for (uint32_t k = 0; k < g.count; ++k) {
        const uint32_t i = g.members[k].index;
        const Vec2 to = places[best[k]], facing = normalize_or(middle - to, {0, 1});
        c.fellows[i].spot = at_height(to, c.motion.position[i].y);
        c.fellows[i].facing = facing;
        call(c, {i, to, facing, c.identity.preferred_speed[i]});
    }
    return true;
}

void set_stage(Group& g, Encounter stage, uint32_t tick, float seconds) {
    g.stage = stage;
    g.stage_began = tick;
    g.stage_ends = tick + ticks_of(seconds);
}

void begin_meeting(Company& company, Crowd& c, const Navmesh& mesh, uint32_t a, uint32_t b, uint32_t tick,
                   uint64_t seed) {
    constexpr float k_sees_for = 2.2f, k_shake = 0.5f;
    Group& g = vacant_group(company);
    g.does = Together::meets;
    g.count = 2;
    const uint32_t number = number_of(company, g), both[] = {a, b};
    for (uint32_t k = 0; k < 2; ++k) {
        g.members[k] = {both[k], c.slots.generation[both[k]]};
        const uint32_t next = company.bearings[both[k]].runs_next;
        company.bearings[both[k]] = {.runs_next = next, .meets_next = tick + k_rests};
        c.fellows[both[k]] = {.group = number};
    }
    const Vec2 here = on_ground(c.motion.position[a]), there = on_ground(c.motion.position[b]);
    if (!set_places(c, mesh, g, (here + there) * 0.5f, normalize_or(here - there, {0, 1}))) {
        for (const uint32_t i : both) c.fellows[i] = {};
        g = {};
        ++company.vacant;
        return;
    }
    g.shakes_hands = random_unit({seed, a, tick, Purpose::company}, 81) < k_shake ? 1 : 0;
    set_stage(g, Encounter::sees, tick, k_sees_for);
}

// Whether one comes towards another, who is ahead.
bool comes_towards(const Crowd& c, uint32_t i, uint32_t other) {
    constexpr float k_ahead = 0.82f;  // cosine
    const Vec2 to = on_ground(c.motion.position[other] - c.motion.position[i]);
    return dot(c.decision.course[i], to) > k_ahead * length(to);
}

void look_for_acquaintance(Company& company, Crowd& c, const Navmesh& mesh, std::span<const Folk> folk,
                           uint32_t i, uint32_t tick, uint64_t seed) {
    uint32_t found = k_nobody;
    const Vec3 here = c.motion.position[i];
    for_seen_near(c.scratch, here, k_sees, [&](uint32_t begin, uint32_t end) {
        for (uint32_t at = begin; at < end; ++at) {
            const uint32_t other = c.scratch.order[at];
            if (other == i || !know_each_other(company, i, other, seed) || !comes_towards(c, i, other))
                continue;
            const Vec3 off = c.motion.position[other] - here;
            const float far = length(on_ground(off));
            if (far > k_sees || std::fabs(off.y) > k_other_level) continue;
            const Group* g = group_of(company, c, other);
            const bool talks = g && g->does == Together::meets && g->stage == Encounter::talks &&
                               g->count < k_most_company && tick + ticks_of(6) < g->stage_ends;
            const bool meets = !g && far > k_too_near && comes_towards(c, other, i) &&
                               can_stop(company, c, folk, other, tick);
            if ((talks || meets) && other < found) found = other;
        }
    });
    if (found == k_nobody || !is_clear(mesh, here, c.motion.position[found])) return;
    if (c.fellows[found].group == k_no_group) return begin_meeting(company, c, mesh, i, found, tick, seed);
    // The circle opens.
    Group& g = company.groups[c.fellows[found].group];
    const Vec2 from = normalize_or(on_ground(here) - g.middle, {0, 1});
    g.members[g.count++] = {i, c.slots.generation[i]};
    company.bearings[i] = {.meets_next = tick + k_rests};
    c.fellows[i] = {.group = number_of(company, g)};
    if (set_places(c, mesh, g, g.middle, from)) return;
    --g.count;
    c.fellows[i] = {};
}

// Whether it still stands where it has been called to by this.
bool is_of_it(const Crowd& c, const Group& g, uint32_t k) {
    const WalkerId id = g.members[k];
    if (!is_there(c, id) || is_down(c, id.index) || id.index == c.driven.walker) return false;
    if (g.stage == Encounter::parts) return true;
    const Called* called = own_of(c.called, id.index);
    return called && called->to == on_ground(c.fellows[id.index].spot);
}

// They go on about their errands.
void part(Crowd& c, Group& g, uint32_t tick) {
    constexpr float k_looks_back_for = 1.6f;
    for (uint32_t k = 0; k < g.count; ++k) {
        const uint32_t i = g.members[k].index;
        if (is_of_it(c, g, k) && g.stage != Encounter::parts) call_off(c, i);
        if (is_there(c, g.members[k])) c.fellows[i].facing = {};
    }
    set_stage(g, Encounter::parts, tick, k_looks_back_for);
}

}  // namespace

void meet(Company& company, Crowd& c, const Navmesh&, std::span<const Folk> folk, Group& g, uint32_t tick,
          uint64_t seed) {
    constexpr float k_comes_for = 8, k_shakes_for = 2.1f, k_nods_for = 1;          // seconds
    constexpr float k_least = 10, k_most = 60, k_there = 0.25f, k_stands = 0.25f;  // seconds; metres; m/s
    for (uint32_t k = 0; k < g.count;) {
        if (is_of_it(c, g, k)) {
            ++k;
            continue;
        }
        if (g.count == 2 && g.stage != Encounter::parts) part(c, g, tick);
        leave_group(company, c, g, k, folk);
        if (g.count == 0) return;
        k = 0;
    }
    if (g.stage == Encounter::comes) {
        bool all_there = true;
        for (uint32_t k = 0; k < g.count; ++k) {
            const uint32_t i = g.members[k].index;
            all_there &= length(on_ground(c.fellows[i].spot - c.motion.position[i])) < k_there &&
                         length(c.motion.velocity[i]) < k_stands;
        }
        if (all_there)
            return set_stage(g, Encounter::greets, tick, g.shakes_hands != 0 ? k_shakes_for : k_nods_for);
    }
    if (tick < g.stage_ends) return;
    switch (g.stage) {
        case Encounter::sees:
            return set_stage(g, Encounter::comes, tick, k_comes_for);
        case Encounter::greets: {
            const RandomKey key{seed, g.members[0].index, tick, Purpose::company};
            return set_stage(g, Encounter::talks, tick, random_between(key, k_least, k_most, 82));
        }
        case Encounter::comes:
        case Encounter::talks:
            return part(c, g, tick);
        case Encounter::parts:
            return end_group(company, c, g, folk);
    }
}

void find_meetings(Company& company, Crowd& c, const Navmesh& mesh, std::span<const Folk> folk, uint32_t tick,
                   uint64_t seed) {
    for (uint32_t i = tick % k_looks; i < c.count; i += k_looks)
        if (is_there(c, i) && can_stop(company, c, folk, i, tick))
            look_for_acquaintance(company, c, mesh, folk, i, tick, seed);
}

}  // namespace flaneur
