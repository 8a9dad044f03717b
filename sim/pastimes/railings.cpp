// Who puts the hands on a railing and looks out.
#include <cmath>

#include "sim/base/math.h"
#include "sim/base/tick.h"
#include "sim/pastimes/choose.h"

namespace flaneur {

bool leans_out(const PastimeTick& t, const Candidate& c) {
    constexpr float k_stops_within = 4, k_passes_within = 2.2f, k_of_passers = 0.1f;  // metres
    constexpr float k_off = 0.5f, k_beside = 0.2f;     // metres from the edge; by which the mesh may differ
    constexpr float k_shoulder = 0.8f, k_over = 0.1f;  // heights; metres that it is over the hands, at least
    constexpr float k_least = 20, k_most = 120;        // seconds
    const Pastimes& all = t.pastimes;
    const float share = all.shares.leaning;
    if (share <= 0 || all.places.railings.empty() || is_laden(t, c) || !has_free_hands(c)) return false;
    if (random_unit(c.key, c.has_stopped ? 13u : 14u) >= share * (c.has_stopped ? 1 : k_of_passers))
        return false;
    uint32_t best = k_nobody;
    NavPoint to;
    float least = c.has_stopped ? k_stops_within : k_passes_within;
    for_near(all.railings, on_ground(c.at), least, [&](uint32_t r, float far) {
        const Railing& rail = all.places.railings[r];
        const float up = rail.at.y - c.at.y;
        if (far >= least || all.at_railing[r] > 0 || up < 0.7f ||
            up > k_shoulder * c.person.height[c.lane] - k_over)
            return;
        const Vec3 before = {rail.at.x - rail.facing.x * k_off, c.at.y, rail.at.z - rail.facing.z * k_off};
        const auto place = nearest(t.mesh, 0, before, {k_beside, 0.5f, k_beside});
        if (!place || length(on_ground(place->position - before)) > k_beside ||
            !is_clear(t.mesh, c.at, place->position))
            return;
        least = far, best = r, to = *place;
    });
    if (best == k_nobody) return false;
    const Railing& rail = all.places.railings[best];
    Pastime& p = send(t, c, Staying::leans_out, on_ground(to.position), rail.facing,
                      random_between(c.key, k_least, k_most, 15));
    p.place = best;
    p.at = rail.at + at_height(rail.facing, 0);
    ++t.pastimes.at_railing[best];
    return true;
}

void look_out(const PastimeTick& t, Pastime& p) {
    constexpr float k_far = 20, k_aside = 9, k_down = 2.5f;  // metres
    if (t.tick < p.looks_until) return;
    const RandomKey key{t.seed, p.walker, t.tick, Purpose::pastime};
    p.looks_until = t.tick + static_cast<uint32_t>(random_between(key, 2.5f, 8, 16) / k_tick);
    const Railing& rail = t.pastimes.places.railings[p.place];
    const Vec2 left{rail.facing.z, -rail.facing.x};
    const float aside = random_between(key, -k_aside, k_aside, 17);
    p.at = rail.at + at_height(rail.facing * k_far + left * aside, random_between(key, -k_down, 1.0f, 18));
}

}  // namespace flaneur
