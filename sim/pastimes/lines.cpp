// Lines before places of service: single file, 0.5 .. 0.8 m apart, and up in waves as one is served (Fruin,
// "Pedestrian Planning and Design", 1971).
#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/base/tick.h"
#include "sim/pastimes/choose.h"

namespace flaneur {

namespace {

constexpr float k_apart = 0.68f, k_bends = 0.06f;  // metres from one to the next, and out of line by turns

uint32_t ticks_of(float seconds) { return static_cast<uint32_t>(seconds / k_tick); }

Vec2 spot_in(const Service& service, uint32_t rank) {
    const auto n = static_cast<float>(rank);
    const float aside = rank == 0 ? 0 : rank % 2 == 0 ? k_bends : -0.5f * k_bends;
    return on_ground(service.at) + service.along * (k_apart * n) - service.facing * aside;
}

void go_to_spot(const PastimeTick& t, Pastime& p) {
    const Service& service = t.pastimes.places.services[p.place];
    p.to = spot_in(service, p.rank);
    p.facing = p.rank == 0 ? service.facing : -service.along;
    call(t.crowd, {p.walker, p.to, p.facing, 0.9f});
}

// How many came before it and are still there.
uint32_t rank_of(const Pastimes& all, const Pastime& p) {
    return static_cast<uint32_t>(std::ranges::count_if(all.all, [&](const Pastime& q) {
        const bool is_before = q.joined != p.joined ? q.joined < p.joined : q.walker < p.walker;
        return q.what == Staying::queues && q.place == p.place && q.phase != StayPhase::over &&
               q.phase != StayPhase::ends && is_before;
    }));
}

}  // namespace

uint32_t room_in_line(const Service& service, const Navmesh& mesh) {
    constexpr uint32_t k_longest = 7;
    constexpr float k_beside = 0.12f;
    uint32_t room = 0;
    Vec3 before{};
    for (; room < k_longest; ++room) {
        const Vec3 at = at_height(spot_in(service, room), service.at.y);
        const auto place = nearest(mesh, 0, at, {k_beside, 0.5f, k_beside});
        if (!place || length(on_ground(place->position - at)) > k_beside) return room;
        if (room > 0 && !is_clear(mesh, before, place->position)) return room;
        before = place->position;
    }
    return room;
}

void join_line(const PastimeTick& t, Pastime& p, uint32_t service) {
    p.place = service;
    p.joined = t.tick;
    p.served = 0;
    p.rank = rank_of(t.pastimes, p);
    go_to_spot(t, p);
}

void move_up(const PastimeTick& t, Pastime& p) {
    constexpr float k_minds = 0.5f, k_later = 0.3f;  // seconds until one moves up, and each behind it
    if (p.phase == StayPhase::ends) return;
    const Service& service = t.pastimes.places.services[p.place];
    const uint32_t rank = rank_of(t.pastimes, p);
    if (rank != p.rank) {
        p.rank = rank;
        p.moves_up = t.tick + ticks_of(k_minds + k_later * static_cast<float>(rank));
    }
    if (t.tick >= p.moves_up && p.to != spot_in(service, rank)) go_to_spot(t, p);
    const float off = length(p.to - on_ground(t.crowd.motion.position[p.walker]));
    if (p.phase != StayPhase::stays || rank > 0 || p.to != spot_in(service, 0) || off > 0.3f) return;
    const RandomKey key{t.seed, p.walker, p.joined, Purpose::pastime};
    if (p.served == 0) p.served = t.tick + ticks_of(service.seconds * random_between(key, 0.5f, 1.5f, 60));
    if (t.tick >= p.served) p.until = t.tick;
}

}  // namespace flaneur
