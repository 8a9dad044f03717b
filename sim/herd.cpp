#include "sim/herd.h"

#include <algorithm>
#include <string>

#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/world.h"

namespace flaneur {

namespace {

constexpr float k_smallest = 0.7f, k_largest = 1.1f;  // metres
constexpr float k_slowest = 0.7f, k_quickest = 1.0f;  // of its size, a second
constexpr float k_probe = 0.35f;                      // of its size, from its middle: how steep the ground is
constexpr float k_up = 0.5f, k_down = 1;              // metres in which it is looked for

Rays rays_of(const Ground& ground) {
    return {&ground,
            [](const void* asked, Vec3 origin, Vec3 direction, float reach) -> std::optional<SurfaceHit> {
                const auto hit = raycast(*static_cast<const Ground*>(asked), origin, direction, reach);
                if (!hit) return std::nullopt;
                const Vec3 out = dot(hit->normal, direction) > 0 ? -hit->normal : hit->normal;
                return SurfaceHit{hit->distance, origin + direction * hit->distance, out};
            }};
}

// Of the plane through the ground on all sides: over kerbs and steps it leans before its feet are there.
Vec3 mean_up(const Surroundings& around, Vec3 at, Vec3 ahead, float reach) {
    const Vec3 left{ahead.z, 0, -ahead.x};
    const Vec3 points[] = {at + ahead * reach, at - ahead * reach, at + left * reach, at - left * reach};
    std::optional<GroundHit> hits[4];
    ground_at(around, points, k_up, k_down, hits);
    auto high = [&](int k) { return hits[k] ? hits[k]->height : at.y; };
    const Vec3 along = ahead * (2 * reach) + Vec3{0, high(0) - high(1), 0};
    const Vec3 across = left * (2 * reach) + Vec3{0, high(2) - high(3), 0};
    return normalize_or(cross(along, across), {0, 1, 0});
}

void put_where_the_crowd_has_it(World& w, size_t n) {
    const uint32_t i = w.herd.goes_as[n];
    const CrowdMotion& m = w.crowd.motion;
    SurfaceWalkers& s = w.herd.walkers;
    const Vec3 ahead = at_height(heading_direction(m.heading[i]), 0);
    s.position[n] = m.position[i];
    s.up[n] = mean_up(w.around, m.position[i], ahead, k_probe * w.herd.creatures[n].size);
    s.ahead[n] = normalize_or(ahead - s.up[n] * dot(ahead, s.up[n]), ahead);
    s.moved[n] = length(m.velocity[i]) * k_tick;
    s.turn_rate[n] = m.turn_rate[i];
}

// One that has neither cane nor pram: nobody sees it.
uint32_t plain_kind(const std::vector<Kind>& kinds) {
    const auto plain = std::ranges::find_if(
        kinds, [](const Kind& kind) { return kind.body.cane == Vec3{} && kind.body.pram == Vec3{}; });
    return plain == kinds.end() ? 0 : static_cast<uint32_t>(plain - kinds.begin());
}

}  // namespace

Result<void> set_loose(World& w, uint32_t creatures) {
    make_room(w, w.crowd.count + creatures);
    Herd& herd = w.herd;
    SurfaceWalkers& s = herd.walkers;
    for (auto* list : {&s.position, &s.up, &s.ahead}) list->resize(creatures);
    for (auto* list : {&s.moved, &s.turn_rate}) list->resize(creatures);
    s.leaps.resize(creatures);
    for (uint32_t n = 0; n < creatures; ++n) {
        const float size = random_between({w.seed, n, 4, Purpose::spawn}, k_smallest, k_largest);
        const float pace = random_between({w.seed, n, 5, Purpose::spawn}, k_slowest, k_quickest);
        const Result<WalkerId> id = add_walker(
            w,
            {.kind = plain_kind(w.kinds), .speed = size * pace, .radius = k_widest_radius, .wanders = true});
        if (!id)
            return Error{"Only " + std::to_string(n) + " of " + std::to_string(creatures) +
                         " creatures find room among the people; ask for fewer."};
        herd.goes_as.push_back(id->index);
        set_lamp_manner(w, id->index);
        herd.creatures.emplace_back().size = size;
        put_where_the_crowd_has_it(w, n);
        herd.creatures[n] = make_creature(rays_of(*w.ground), s, n, size);
    }
    w.linkages = make_bones(herd.creatures);
    make_room_to_mind(w, creatures);
    return {};
}

void keep_herd(World& w) {
    for (const uint32_t i : w.herd.goes_as) w.crowd.journeys[i].leaves = false;
}

void step_herd(World& w) {
    Herd& herd = w.herd;
    parallel_for(*w.workers, herd.creatures.size(), 4, [&](size_t begin, size_t end, int) {
        for (size_t n = begin; n < end; ++n) {
            put_where_the_crowd_has_it(w, n);
            step_creature(rays_of(*w.ground), herd.walkers, herd.creatures[n], k_tick);
            place_creature(w.linkages.all[n], herd.creatures[n], places_of(w.linkages, n));
        }
    });
}

}  // namespace flaneur
