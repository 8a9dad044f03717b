#include "sim/coming/coming.h"

#include <algorithm>
#include <cmath>

#include "sim/base/hash.h"
#include "sim/base/math.h"
#include "sim/base/planar.h"
#include "sim/base/rng.h"
#include "sim/base/spans.h"
#include "sim/base/tick.h"
#include "sim/coming/passages.h"
#include "sim/crowd/places.h"

namespace flaneur {

static constexpr uint32_t k_most_tries = 256;    // to come in, of a line, at a time
static constexpr uint32_t k_tries_a_place = 15;  // in a second
static constexpr float k_spare = 0.15f;          // metres between one who comes in and others, at least
static constexpr float k_step = 0.6f;            // metres, before a threshold
static constexpr float k_floors = 3;             // metres above and below the height that is meant

uint32_t kept_people(const Coming& coming, const Crowd& c) {
    const auto here = std::ranges::count_if(c.slots.living, [&](WalkerId id) {
        const Journey& j = c.journeys[id.index];
        return !j.leaves || j.errand == Errand::wander;
    });
    return static_cast<uint32_t>(static_cast<size_t>(here) + coming.successors.entrants.size());
}

uint32_t waiting(const Coming& coming) {
    return static_cast<uint32_t>(coming.successors.entrants.size() + coming.sent.entrants.size());
}

bool is_under_way(const Coming& coming, const Crowd& c, uint32_t i) {
    const Journey& j = c.journeys[i];
    return j.leaves && j.errand != Errand::wander && i < coming.sending_of.size() &&
           coming.sending_of[i] != k_no_sending;
}

uint32_t due_by(const Sending& sending, double seconds) {
    if (seconds < static_cast<double>(sending.begin)) return 0;
    if (seconds >= static_cast<double>(sending.end)) return sending.people;
    const double passed = (seconds - static_cast<double>(sending.begin)) /
                          (static_cast<double>(sending.end) - static_cast<double>(sending.begin));
    const uint32_t groups = (sending.people + sending.group - 1) / sending.group;
    return std::min(sending.people, (static_cast<uint32_t>(passed * groups) + 1) * sending.group);
}

bool comes_and_goes(const Coming& coming, const Crowd& c) {
    return !coming.sendings.empty() || c.demand.leaving != k_nobody_leaves;
}

void make_room(Coming& coming, const Crowd& c) {
    if (!comes_and_goes(coming, c)) return;
    size_t sent = 0;
    for (const Sending& sending : coming.sendings) sent += sending.people;
    coming.successors.entrants.reserve(c.capacity);
    coming.sent.entrants.reserve(sent);
    coming.so_far.resize(coming.sendings.size());
    if (!coming.sendings.empty()) coming.sending_of.resize(c.capacity, k_no_sending);
    constexpr size_t k_most_awaited = 1024;
    coming.awaited.reserve(std::min<size_t>(c.capacity, k_most_awaited));
    coming.gone.reserve(c.capacity);
    coming.arrivals.reserve(size_t{2} * k_most_tries);
}

static void add_entrant(WaitingLine& line, const Entrant& entrant) {
    if (line.entrants.size() < line.entrants.capacity()) line.entrants.push_back(entrant);
}

// Those who leave are gone once they are out of sight; for each who wandered another is due.
static void let_out(Coming& coming, Crowd& c, const Surroundings& around, uint32_t tick) {
    for (uint32_t i = 0; i < c.count; ++i) {
        const Journey& j = c.journeys[i];
        if (!j.leaves || !j.arrived || tick < j.pause_until || i == c.driven.walker || !is_there(c, i) ||
            is_down(c, i) || own_of(c.called, i))
            continue;
        if (!has_left(c, around, i, tick)) continue;
        if (j.errand == Errand::wander) add_entrant(coming.successors, {.number = coming.numbered++});
        if (is_under_way(coming, c, i)) ++coming.so_far[coming.sending_of[i]].arrived;
        remove_walker(c, i);
        coming.gone.push_back(i);
        ++coming.left;
    }
}

static bool is_one_place(const SentPlace& area) { return area.corners.size() == 1; }

// By chance; of a thin area perhaps none.
static std::optional<NavPoint> place_in(const SentPlace& area, const Navmesh& mesh, RandomKey key) {
    constexpr uint32_t k_tries = 32;
    Vec2 low = area.corners[0], high = low;
    for (const Vec2 corner : area.corners) {
        low = {std::min(low.x, corner.x), std::min(low.z, corner.z)};
        high = {std::max(high.x, corner.x), std::max(high.z, corner.z)};
    }
    const uint32_t tries = is_one_place(area) ? 1 : k_tries;
    for (uint32_t t = 0; t < tries; ++t) {
        const Vec2 p{lerp(low.x, high.x, random_unit(key, 2 * t)),
                     lerp(low.z, high.z, random_unit(key, 2 * t + 1))};
        if (!is_one_place(area) && !is_within(area.corners, p)) continue;
        const Vec3 there = at_height(p, area.height.value_or(0));
        if (const auto place = nearest(mesh, 0, there, {2, k_floors, 2})) return place;
        if (area.height) continue;
        if (const auto place = nearest(mesh, 0, there, {2, 1000, 2})) return place;
    }
    return std::nullopt;
}

std::optional<float> other_height(const SentPlace& area, const Navmesh& mesh) {
    constexpr RandomKey k_some{1, 0, 0, Purpose::coming};
    if (!area.height || place_in(area, mesh, k_some)) return std::nullopt;
    const auto place = place_in({area.corners, std::nullopt}, mesh, k_some);
    return place ? std::optional(place->position.y) : std::nullopt;
}

Unwalkable why_unwalkable(const Sending& sending, const Navmesh& mesh) {
    constexpr uint32_t k_tries = 8;
    auto place_of = [&](const SentPlace& area) {
        std::optional<NavPoint> place;
        for (uint32_t t = 0; !place && t < (is_one_place(area) ? 1 : k_tries); ++t)
            place = place_in(area, mesh, {1, 0, t, Purpose::coming});
        return place;
    };
    const auto from = place_of(sending.from), to = place_of(sending.to);
    if (!from) return Unwalkable::from;
    if (!to) return Unwalkable::to;
    const bool is_known = is_one_place(sending.from) && is_one_place(sending.to);
    return is_known && !are_joined(mesh, from->polygon, to->polygon) ? Unwalkable::way : Unwalkable::no;
}

static std::optional<Entrant> draw_entrant(const Sending& sending, const Navmesh& mesh, uint32_t number,
                                           uint64_t seed) {
    constexpr uint32_t k_tries = 8;
    const uint32_t tries = is_one_place(sending.from) && is_one_place(sending.to) ? 1 : k_tries;
    for (uint32_t t = 0; t < tries; ++t) {
        const auto place = place_in(sending.from, mesh, {seed, number, 2 * t, Purpose::coming}),
                   goal = place_in(sending.to, mesh, {seed, number, 2 * t + 1, Purpose::coming});
        if (!place || !goal || !are_joined(mesh, place->polygon, goal->polygon)) continue;
        const Vec2 way = on_ground(goal->position - place->position);
        return Entrant{.place = *place,
                       .goal = *goal,
                       .heading = length_squared(way) > 0 ? heading_of(way) : 0,
                       .speed = sending.speed,
                       .number = number};
    }
    return std::nullopt;
}

// Those of the sendings who are due since this was asked last.
static void call_sent(Coming& coming, const Navmesh& mesh, uint32_t tick, uint64_t seed) {
    auto seconds = [](uint32_t ticks) { return ticks * static_cast<double>(k_tick); };
    for (uint32_t s = 0; s < coming.sendings.size(); ++s) {
        const Sending& sending = coming.sendings[s];
        uint32_t due = due_by(sending, seconds(tick));
        if (tick > 0) due -= due_by(sending, seconds(tick - k_decision_ticks));
        for (uint32_t k = 0; k < due; ++k) {
            auto entrant = draw_entrant(sending, mesh, coming.numbered++, seed);
            if (entrant) {
                entrant->sending = s;
                add_entrant(coming.sent, *entrant);
            } else {
                ++coming.so_far[s].lost;
            }
        }
    }
}

namespace {
// What a body takes of the ground: itself, and a pram.
struct Footprint {
    Vec3 place;
    Vec2 ahead;
    float radius = 0;
    bool has_pram = false;
};
}  // namespace

static Footprint footprint(Vec3 place, float heading, float radius, float ahead) {
    return {place, heading_direction(heading) * ahead, radius, ahead > 0};
}

static bool touch(const Footprint& a, const Footprint& b) {
    const Vec3 off = b.place - a.place;
    if (std::fabs(off.y) > k_other_level) return false;
    const Vec2 way = on_ground(off);
    auto near = [](Vec2 between, float radii) {
        return length_squared(between) < (radii + k_spare) * (radii + k_spare);
    };
    return near(way, a.radius + b.radius) || (a.has_pram && near(way - a.ahead, k_pram_radius + b.radius)) ||
           (b.has_pram && near(way + b.ahead, k_pram_radius + a.radius)) ||
           (a.has_pram && b.has_pram && near(way + b.ahead - a.ahead, 2 * k_pram_radius));
}

// The order of places holds all but those who came in this tick, and some who are gone.
static bool is_free(const Coming& coming, const Crowd& c, const Footprint& wanted, float ahead) {
    auto is_in_the_way = [&](uint32_t i) {
        return touch(wanted, footprint(c.motion.position[i], c.motion.heading[i], c.identity.radius[i],
                                       c.identity.ahead[i]));
    };
    if (std::ranges::any_of(coming.arrivals, is_in_the_way)) return false;
    constexpr float k_farthest_pram = 1.5f + k_pram_radius;  // from who pushes it, metres
    const float reach = std::max(wanted.radius, ahead > 0 ? ahead + k_pram_radius : 0) +
                        std::max(c.widest, k_farthest_pram) + k_spare;
    bool is_free = true;
    for_seen_near(c.scratch, wanted.place, reach, [&](uint32_t begin, uint32_t end) {
        for (uint32_t at = begin; is_free && at < end; ++at)
            if (const uint32_t i = c.scratch.order[at]; is_there(c, i) && is_in_the_way(i)) is_free = false;
    });
    return is_free;
}

static bool is_sent(const Entrant& e) { return e.sending != k_no_sending; }

// One without a pram where a pram does not get to the goal.
static Walker draw_entrant_body(const Crowd& c, const Navmesh& mesh, std::span<const Folk> folk,
                                const Entrant& e, uint64_t seed) {
    constexpr uint32_t k_tries = 32;
    const uint32_t slot = c.slots.left.empty() ? c.count : c.slots.left.back();
    const bool takes_steps = is_sent(e) && !are_joined(mesh, e.place.polygon, e.goal.polygon, By::wheels);
    Walker w;
    for (uint32_t t = 0; t < k_tries; ++t) {
        w = draw_walker(folk, {seed, slot, c.slots.generation[slot] + (t << 26), Purpose::body});
        if (!takes_steps || w.ahead == 0) break;
    }
    w.place = e.place;
    w.heading = e.heading;
    if (e.speed > 0) w.preferred_speed = e.speed;
    w.errand = is_sent(e) ? Errand::arrive : Errand::wander;
    return w;
}

// Whether there was room.
static bool let_in(Coming& coming, Crowd& c, const Surroundings& around, const Navmesh& mesh,
                   std::span<const Folk> folk, const Entrant& e, uint32_t tick, uint64_t seed) {
    Walker w = draw_entrant_body(c, mesh, folk, e, seed);
    Vec3 at = w.place.position;
    if (const auto hit = ground_at(around, at, 1, 2)) at.y = hit->height;
    auto is_room = [&](Vec3 place) {
        return is_free(coming, c, footprint(place, w.heading, w.radius, w.ahead), w.ahead);
    };
    if (!is_room(at)) return false;
    const Vec2 out = heading_direction(e.heading);
    const auto door = e.by_door && w.ahead == 0 ? door_at(around, at, out * -1) : std::nullopt;
    if (door && (is_in_use(c, *door) || !is_room(at + at_height(out * k_step, 0)))) return false;
    const uint32_t i = add_walker(c, around, w);
    door ? come_by_door(c, i, *door, tick) : appear(c, i);
    if (!coming.sending_of.empty()) coming.sending_of[i] = e.sending;
    if (is_sent(e)) {
        send_to(c, i, e.goal);
        c.journeys[i].leaves = true;
        ++coming.so_far[e.sending].came;
    }
    coming.arrivals.push_back(i);
    ++coming.came;
    return true;
}

// Finds a place to come in for one who wanders; false: there is none.
static bool choose_place(const Coming& coming, const Crowd& c, Entrant& e, const Navmesh& mesh, uint32_t tick,
                         uint64_t seed) {
    const auto chosen = choose_entrance(c.demand, mesh, 0, coming.home.centre, coming.home.radius, tick,
                                        {seed, e.number, e.tries, Purpose::coming});
    if (!chosen) return false;
    e.place = chosen->place;
    e.by_door = is_entrance(chosen->kind);
    e.heading = length_squared(chosen->facing) > 0 ? heading_of(chosen->facing) : 0;
    return true;
}

// Comes in where somebody waits for one, if anybody does.
static void come_where_awaited(Coming& coming, Entrant& e) {
    for (Awaited& a : coming.awaited) {
        if (a.count == 0) continue;
        --a.count;
        e.place = a.place;
        e.heading = a.heading;
        e.by_door = a.by_door;
        e.tries = 1;  // and looks for no other place
        return;
    }
}

// Those of a line whose turn it is, as long as there are fewer than `most` people.
static void let_in_those_due(Coming& coming, WaitingLine& line, size_t most, Crowd& c,
                             const Surroundings& around, const Navmesh& mesh, std::span<const Folk> folk,
                             uint32_t tick, uint64_t seed) {
    std::vector<Entrant>& queue = line.entrants;
    if (line.next >= queue.size()) line.next = 0;
    const size_t first = line.next, last = std::min(queue.size(), first + k_most_tries);
    size_t kept = first;
    for (size_t at = first; at < last; ++at) {
        Entrant e = queue[at];
        bool is_in = false;
        if (!is_sent(e) && !e.place.polygon) come_where_awaited(coming, e);
        const bool has_to_choose = !is_sent(e) && (!e.place.polygon || e.tries % k_tries_a_place == 0);
        if (!has_to_choose || choose_place(coming, c, e, mesh, tick, seed))
            is_in = c.slots.living.size() < most && e.place.polygon &&
                    let_in(coming, c, around, mesh, folk, e, tick, seed);
        ++e.tries;
        if (!is_in) queue[kept++] = e;
    }
    queue.erase(queue.begin() + static_cast<ptrdiff_t>(kept), queue.begin() + static_cast<ptrdiff_t>(last));
    line.next = static_cast<uint32_t>(kept);
}

void come_and_go(Coming& coming, Crowd& c, const Surroundings& around, const Navmesh& mesh, Workers& workers,
                 std::span<const Folk> folk, uint32_t tick, uint64_t seed) {
    coming.gone.clear();
    coming.arrivals.clear();
    step_passages(c);
    if (tick % k_decision_ticks != 0 || !comes_and_goes(coming, c)) return;
    // The order still holds those who go now.
    const bool was_ordered = c.scratch.is_ordered;
    let_out(coming, c, around, tick);
    c.scratch.is_ordered = was_ordered;
    call_sent(coming, mesh, tick, seed);
    WaitingLine &successors = coming.successors, &sent = coming.sent;
    if (!c.scratch.is_ordered && !(successors.entrants.empty() && sent.entrants.empty()))
        order_places(c, workers, false);
    let_in_those_due(coming, successors, c.capacity, c, around, mesh, folk, tick, seed);
    // Who is sent leaves room for those who wait to come in instead of others.
    const size_t most = c.capacity - std::min<size_t>(c.capacity, successors.entrants.size());
    let_in_those_due(coming, sent, most, c, around, mesh, folk, tick, seed);
    c.scratch.is_ordered = false;
}

// Who comes in at a place that is no more looks for another; who is sent comes in as near as may be.
void change_mesh(Coming& coming, const Navmesh& mesh) {
    constexpr Vec3 k_near{8, 4, 8};
    for (WaitingLine* line : {&coming.successors, &coming.sent})
        for (Entrant& e : line->entrants) {
            const bool has_place = e.place.polygon || is_sent(e);
            const auto place = has_place ? nearest(mesh, 0, e.place.position, k_near) : std::nullopt;
            const auto goal = is_sent(e) ? nearest(mesh, 0, e.goal.position, k_near) : std::nullopt;
            if (place && (!is_sent(e) || goal))
                e.place = *place;
            else
                e.place.polygon = 0;  // who is sent looks there again when the mesh changes back
            if (goal) e.goal = *goal;
        }
}

uint64_t hash_coming(const Coming& coming) {
    const uint32_t numbers[] = {coming.successors.next, coming.sent.next, coming.numbered, coming.left,
                                coming.came};
    static_assert(sizeof(Entrant) == 14 * 4, "has no padding");
    uint64_t h = hash_bytes(1, numbers, sizeof numbers);
    for (const WaitingLine* line : {&coming.successors, &coming.sent})
        h = hash_bytes(h, line->entrants.data(), line->entrants.size() * sizeof(Entrant));
    return h;
}

}  // namespace flaneur
