#include "tools/flaneur/history/events.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>

#include "sim/base/tick.h"

namespace flaneur {
namespace {

constexpr uint32_t k_look_ticks = 4;      // between looks at who is near whom,
constexpr uint32_t k_count_ticks = 15;    // and at how dense it is
constexpr uint32_t k_same_miss = 3 * 60;  // ticks in which the same people come near each other only once
constexpr float k_other_floor = 1.8f;     // metres above or below
constexpr float k_still_dense = 0.75f;    // of the bound, above which it is the same crowd
constexpr float k_least_trip = 20;        // metres
constexpr float k_stuck_seconds = 3;      // for one of Journey::stuck
constexpr float k_cell = k_crowd_cell;

struct Cell {
    int x, z;
    friend bool operator==(Cell, Cell) = default;
};
Cell cell_of(Vec3 p) {
    return {static_cast<int>(std::floor(p.x / k_cell)), static_cast<int>(std::floor(p.z / k_cell))};
}
uint64_t key_of(Cell c) { return uint64_t{static_cast<uint32_t>(c.z)} << 32 | static_cast<uint32_t>(c.x); }

// Walkers by cell of the plane, which is wrapped onto a table: who is in it may be of another cell.
struct Table {
    uint32_t mask;
    uint32_t row_of(Cell c) const {
        return (static_cast<uint32_t>(c.x) * 73856093u ^ static_cast<uint32_t>(c.z) * 19349663u) & mask;
    }
};

Table sort_by_cell(Watch& w, const Crowd& crowd) {
    const Table table{std::bit_ceil(std::max(crowd.count, 256u)) * 2 - 1};
    w.first.assign(size_t{table.mask} + 2, 0);
    w.sorted.resize(crowd.slots.living.size());
    auto row = [&](WalkerId id) { return table.row_of(cell_of(crowd.motion.position[id.index])); };
    for (const WalkerId id : crowd.slots.living) ++w.first[row(id)];
    uint32_t before = 0;
    for (uint32_t& first : w.first) before += first, first = before;
    for (const WalkerId id : crowd.slots.living) w.sorted[--w.first[row(id)]] = id.index;
    for (uint32_t i = 0; i <= table.mask; ++i)
        std::sort(w.sorted.begin() + w.first[i], w.sorted.begin() + w.first[i + 1]);
    return table;
}

template <class Visit>
void for_those_in(const Watch& w, const Table& table, const Crowd& crowd, Cell cell, const Visit& visit) {
    const uint32_t row = table.row_of(cell);
    for (uint32_t k = w.first[row]; k < w.first[row + 1]; ++k)
        if (cell_of(crowd.motion.position[w.sorted[k]]) == cell) visit(w.sorted[k]);
}

void add(Watch& w, const Event& event) {
    if (w.events.size() >= k_most_events)
        w.events.erase(w.events.begin(), w.events.begin() + k_most_events / 10);
    w.events.push_back(event);
}

void look_at_trips(Watch& w, const World& world) {
    const Crowd& crowd = world.crowd;
    for (uint32_t i = 0; i < crowd.count; ++i) {
        if (!is_there(crowd, i)) continue;
        const Journey& j = crowd.journeys[i];
        Watch::Person& p = w.people[i];
        const Vec3 at = crowd.motion.position[i];
        if (p.generation != crowd.slots.generation[i] || p.trip != j.trip) {
            const bool is_same = p.generation == crowd.slots.generation[i];
            p = {.generation = crowd.slots.generation[i],
                 .trip = j.trip,
                 .began = world.tick,
                 .missed = p.missed,
                 .from = on_ground(at),
                 .is_stuck = is_same && p.is_stuck};
        }
        const float stuck = static_cast<float>(j.stuck) * k_stuck_seconds;
        if (!p.is_stuck && stuck >= w.bounds.stuck_seconds)
            add(w, {.tick = world.tick, .kind = EventKind::stuck, .walker = i, .place = at, .value = stuck});
        p.is_stuck = j.stuck > 0 && (p.is_stuck || stuck >= w.bounds.stuck_seconds);
        if (j.arrived && !p.has_arrived && world.tick > p.began) {
            const float metres = length(on_ground(at) - p.from),
                        speed = metres / (static_cast<float>(world.tick - p.began) * k_tick);
            const bool is_fastest = metres >= k_least_trip && speed > w.fastest;
            if (is_fastest) w.fastest = speed;
            if (is_fastest || !w.has_anybody_arrived)
                add(w, {.tick = world.tick,
                        .kind = EventKind::arrival,
                        .walker = i,
                        .place = at,
                        .value = speed});
            w.has_anybody_arrived = true;
        }
        p.has_arrived = j.arrived;
    }
}

void look_at_misses(Watch& w, const World& world, const Table& table) {
    const Crowd& crowd = world.crowd;
    const CrowdMotion& m = crowd.motion;
    auto look_at = [&](uint32_t i, uint32_t k) {
        const Vec3 off = m.position[k] - m.position[i];
        const float radii = crowd.identity.radius[i] + crowd.identity.radius[k], reach = radii + w.bounds.gap,
                    apart2 = length_squared(on_ground(off));
        if (apart2 >= reach * reach || std::fabs(off.y) > k_other_floor) return;
        const float apart = std::sqrt(apart2);
        const Vec2 way = normalize_or(on_ground(off), {1, 0});
        if (dot(m.velocity[i] - m.velocity[k], way) < w.bounds.closing) return;
        Watch::Person &a = w.people[i], &b = w.people[k];
        const bool is_known =
            a.missed > 0 && b.missed > 0 && world.tick - std::max(a.missed, b.missed) < k_same_miss;
        a.missed = b.missed = world.tick;
        if (is_known) return;
        add(w, {world.tick, EventKind::near_miss, i, k, m.position[i], std::max(apart - radii, 0.0f)});
    };
    for (const uint32_t i : w.sorted) {
        const Cell at = cell_of(m.position[i]);
        for (int z = at.z - 1; z <= at.z + 1; ++z)
            for (int x = at.x - 1; x <= at.x + 1; ++x)
                for_those_in(w, table, crowd, {x, z}, [&](uint32_t k) {
                    if (k > i) look_at(i, k);
                });
    }
}

void look_at_density(Watch& w, const World& world, const Table& table) {
    const Crowd& crowd = world.crowd;
    w.dense_now.clear();
    for (const uint32_t i : w.sorted) {
        const Cell cell = cell_of(crowd.motion.position[i]);
        const float height = crowd.motion.position[i].y;
        uint32_t count = 0, least = ~0u;
        for_those_in(w, table, crowd, cell, [&](uint32_t k) {
            least = std::min(least, k);
            if (std::fabs(crowd.motion.position[k].y - height) < k_other_floor) ++count;
        });
        const float density = static_cast<float>(count) / (k_cell * k_cell);
        if (least != i || density < w.bounds.density * k_still_dense) continue;
        const bool is_known = std::binary_search(w.dense.begin(), w.dense.end(), key_of(cell));
        if (!is_known && density < w.bounds.density) continue;
        w.dense_now.push_back(key_of(cell));
        if (is_known) continue;
        add(w, {.tick = world.tick,
                .kind = EventKind::crowding,
                .walker = i,
                .place = crowd.motion.position[i],
                .value = density});
    }
    std::sort(w.dense_now.begin(), w.dense_now.end());
    w.dense.swap(w.dense_now);
}

}  // namespace

std::string event_text(const Event& e) {
    const auto value = static_cast<double>(e.value);
    char text[96];
    switch (e.kind) {
        case EventKind::stuck:
            std::snprintf(text, sizeof text, "stuck for %.0f s", value);
            break;
        case EventKind::crowding:
            std::snprintf(text, sizeof text, "%.1f people/m2", value);
            break;
        case EventKind::near_miss:
            std::snprintf(text, sizeof text, "near miss, %.2f m", value);
            break;
        case EventKind::arrival:
            std::snprintf(text, sizeof text, "arrives, at %.2f m/s", value);
            break;
    }
    return text;
}

void watch(Watch& w, const World& world) {
    if (world.roam || (w.has_begun && world.tick <= w.seen)) return;
    w.people.resize(world.crowd.capacity);
    if (!w.has_begun) {  // as it is now is how it is
        for (uint32_t i = 0; i < world.crowd.count; ++i) {
            const Journey& j = world.crowd.journeys[i];
            w.people[i] = {.generation = world.crowd.slots.generation[i],
                           .trip = j.trip,
                           .began = world.tick,
                           .from = on_ground(world.crowd.motion.position[i]),
                           .is_stuck = j.stuck > 0,
                           .has_arrived = j.arrived};
        }
    }
    w.has_begun = true;
    w.seen = world.tick;
    look_at_trips(w, world);
    const bool looks = world.tick % k_look_ticks == 0, counts = world.tick % k_count_ticks == 0;
    if (!looks && !counts) return;
    const Table table = sort_by_cell(w, world.crowd);
    if (looks) look_at_misses(w, world, table);
    if (counts) look_at_density(w, world, table);
}

const Event* event_after(std::span<const Event> events, uint32_t tick, const EventFilter& wants) {
    for (const Event& event : events)
        if (event.tick > tick && wants[static_cast<size_t>(event.kind)]) return &event;
    return nullptr;
}

const Event* event_before(std::span<const Event> events, uint32_t tick, const EventFilter& wants) {
    for (size_t i = events.size(); i-- > 0;)
        if (events[i].tick < tick && wants[static_cast<size_t>(events[i].kind)]) return &events[i];
    return nullptr;
}

}  // namespace flaneur
