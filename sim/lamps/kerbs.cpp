#include "sim/lamps/kerbs.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/base/tick.h"

namespace flaneur {

namespace {

constexpr float k_first_row = 0.45f, k_rows_apart = 0.55f, k_beside = 0.8f;  // metres
constexpr int k_rows = 4;
constexpr size_t k_most_spots = 64;
constexpr float k_same_level = 2;    // metres
constexpr float k_minds = 4.5f;      // metres of its way to the kerb within which one minds the lamp
constexpr float k_looks_on = 9;      // metres of its way that are looked at
constexpr float k_over = 0.05f;      // metres beyond the kerb from which on one is on the carriageway,
constexpr float k_goes_over = 1.5f;  // and to which one comes who crosses it
constexpr float k_brisk = 1.25f, k_hurries = 1.45f, k_could_hurry = 1.25f;  // times the usual speed
constexpr float k_sure = 0.6f, k_sets_off = 0.5f;                           // seconds
constexpr float k_stops_before = 1.3f;                    // metres from the kerb, without a place
constexpr float k_there = 0.12f, k_about_there = 0.35f;   // metres from one's place
constexpr float k_near_enough = 0.15f, k_slow = 0.1f;     // metres; m/s
constexpr uint32_t k_settles = 150;                       // ticks, until where one stands will do
constexpr uint32_t k_begun = 90;                          // ticks
constexpr float k_slows = 1.6f;                           // 1/s, on the way to one's place
constexpr float k_least_back = 0.3f, k_most_back = 2.6f;  // metres behind the kerb

// What a path comes to.
struct KerbAhead {
    uint32_t kerb = k_no_kerb;  // the first that it leads over,
    float far = 0;              // so many metres on,
    float aside = 0;            // at this place along it
    uint32_t on = k_no_lamp;    // the crossing whose carriageway one is on,
    float to_go = 0;            // and metres to its other side
    bool has_begun = false;     // is a step beyond that kerb
};

// Whether the rest of a path gets over the carriageway rather than back to the kerb.
bool goes_over(const Crossing& crossing, uint32_t kerb, std::span<const Vec3> path) {
    const float over = std::min(k_goes_over, crossing.half_length);
    for (const Vec3 corner : path) {
        const float beyond = beyond_kerb(crossing, kerb, on_crossing(crossing, on_ground(corner)));
        if (beyond > over) return true;
        if (beyond <= k_over) return false;
    }
    return false;
}

void look_at_kerb(const Crossing& crossing, uint32_t kerb, const PathGoer& goer, KerbAhead& out) {
    Vec2 from = on_ground(goer.at);
    OnCrossing at = on_crossing(crossing, from);
    float beyond = beyond_kerb(crossing, kerb, at), passed = 0;
    for (size_t k = 0; k < goer.path.size() && passed < k_looks_on; ++k) {
        const Vec2 to = on_ground(goer.path[k]);
        const OnCrossing next = on_crossing(crossing, to);
        const float then = beyond_kerb(crossing, kerb, next), piece = length(to - from);
        if (beyond <= k_over && then > k_over) {
            const float share = (k_over - beyond) / (then - beyond), far = passed + share * piece;
            const float aside = at.aside + (next.aside - at.aside) * share;
            const bool is_over_it = std::fabs(aside) < crossing.half_width + k_kerb_margin;
            if (is_over_it && far < k_looks_on && (out.kerb == k_no_kerb || far < out.far) &&
                goes_over(crossing, kerb, goer.path.subspan(k)))
                out.kerb = kerb, out.far = far, out.aside = aside;
            return;
        }
        from = to, at = next, beyond = then;
        passed += piece;
    }
}

// Who has been pushed off a kerb, or has overshot, is still there.
KerbAhead kerb_ahead(const KerbMap& map, const PathGoer& goer, const KerbWait& wait) {
    constexpr float k_steps_back = 0.8f;   // metres beyond the kerb
    constexpr float k_mostly_over = 0.5f;  // cosine
    KerbAhead out;
    bool is_on_one = false;
    if (goer.path.empty()) return out;
    for (const uint32_t number : crossings_near(map.grid, on_ground(goer.at))) {
        const Crossing& crossing = map.crossings.all[number];
        if (std::fabs(crossing.centre.y - goer.at.y) > k_same_level) continue;
        const OnCrossing at = on_crossing(crossing, on_ground(goer.at));
        const float inside = crossing.half_length - std::fabs(at.over);
        const uint32_t nearest = 2 * number + (at.over > 0 ? 1 : 0);
        const bool has_begun = inside > k_over && inside < k_steps_back &&
                               std::fabs(at.aside) < crossing.half_width + k_kerb_margin &&
                               (wait.kerb == nearest || goes_over(crossing, nearest, goer.path));
        if (has_begun) {
            out.kerb = nearest, out.far = 0, out.aside = at.aside;
            out.has_begun = true;
        } else if (inside > k_over) {
            if (std::fabs(at.aside) > crossing.half_width + k_kerb_margin) continue;
            is_on_one |= std::fabs(at.aside) < crossing.half_width;
            // Others only pass there, a step off the pavement.
            const Vec2 way = normalize_or(on_ground(goer.path[0] - goer.at), {0, 0});
            const float over = dot(way, crossing.across);
            if (std::fabs(over) < k_mostly_over) continue;
            out.on = number;
            out.to_go = crossing.half_length - (over < 0 ? -at.over : at.over);
        } else {
            look_at_kerb(crossing, nearest, goer, out);
        }
    }
    // Nobody waits on a carriageway for the next lamp.
    if (out.far > k_minds || (is_on_one && !out.has_begun)) out.kerb = k_no_kerb;
    return out;
}

float ticks_of(float seconds) { return seconds / k_tick; }

bool goes_on_red(const Kerbs& k, uint32_t i, const PathGoer& goer, uint32_t kerb, uint64_t seed) {
    const float likely = k.manners[i].jaywalks;
    return likely > 0 && random_unit({seed, i, goer.trip, Purpose::lamp}, kerb) < likely;
}

// Whether one may step onto the carriageway that is so far ahead of it.
bool may_go(const Kerbs& k, uint32_t i, const PathGoer& goer, const KerbAhead& ahead, uint32_t tick,
            uint64_t seed) {
    if (goes_on_red(k, i, goer, ahead.kerb, seed)) return true;
    const KerbMap& map = *k.map;
    const LampPlan& plan = plan_of(map, ahead.kerb);
    const Lamp lamp = lamp_at(plan, tick);
    const KerbWait& wait = k.waits[i];
    // Who has begun as it turned red goes on.
    if (lamp.light != Light::green) return ahead.has_begun && wait.kerb != ahead.kerb && lamp.since < k_begun;
    if (wait.kerb == ahead.kerb && length(wait.to - on_ground(goer.at)) < k_about_there) {
        const LampManner& manner = k.manners[i];
        const float starts = random_between({seed, i, tick - lamp.since, Purpose::lamp}, manner.starts_least,
                                            manner.starts_most);
        if (static_cast<float>(lamp.since) < ticks_of(starts)) return false;
    }
    const float usual = goer.usual, pace = usual * k_brisk, far = std::max(ahead.far - k_over, 0.0f);
    const float sets_off = length(goer.velocity) < 0.5f * usual ? k_sets_off : 0;
    const float at_kerb = far / pace + sets_off + k_sure;
    const float over = (far + 2 * map.crossings.all[ahead.kerb / 2].half_length) / (usual * k_could_hurry);
    const auto left = static_cast<float>(lamp.left), clear = static_cast<float>(clearance(plan));
    return ticks_of(at_kerb) < left && ticks_of(over + sets_off) < left + clear;
}

// Of one on a carriageway: as fast as brings it over before others drive, if it can.
float pace_over(const Crossings& crossings, const PathGoer& goer, const KerbAhead& ahead, uint32_t tick) {
    const LampPlan& plan = crossings.plans[crossings.all[ahead.on].plan];
    const Lamp lamp = lamp_at(plan, tick);
    const uint32_t clear = clearance(plan);
    const uint32_t ticks = lamp.light == Light::green ? lamp.left + clear
                           : lamp.since < clear       ? clear - lamp.since
                                                      : 1;
    const float needs = ahead.to_go / (static_cast<float>(ticks) * k_tick);
    return clamp(needs / goer.usual, k_brisk, k_hurries);
}

float back_of(const Crossing& crossing, uint32_t kerb, Vec2 place) {
    const Vec2 over = way_over(crossing, kerb), square{-crossing.along.z, crossing.along.x};
    return -beyond_kerb(crossing, kerb, on_crossing(crossing, place)) * std::fabs(dot(over, square));
}

// To its place, or on to where it will get one.
Heed wait_at(Kerbs& k, uint32_t i, const PathGoer& goer, const KerbAhead& ahead, uint32_t tick) {
    KerbWait& wait = k.waits[i];
    if (wait.kerb != ahead.kerb) {
        wait = {};
        k.asks[i] = {ahead.kerb, ahead.aside, on_ground(goer.at), goer.ahead};
        return {.waits = ahead.far < k_stops_before};
    }
    const Vec2 here = on_ground(goer.at);
    Vec2 way = wait.to - here;
    float far = length(way);
    if (far > k_there && tick - wait.since > k_settles) {
        const float back = back_of(k.map->crossings.all[ahead.kerb / 2], ahead.kerb, here);
        if (back > k_least_back + goer.ahead && back < k_most_back) wait.to = here, far = 0;
    }
    const bool is_slow = length(goer.velocity) < k_slow;
    if (far < k_there || (is_slow && far < k_near_enough)) return {.waits = true, .stands = true};
    return {.waits = true, .wanted = way * (std::min(goer.usual, k_slows * far) / far)};
}

}  // namespace

KerbMap make_kerb_map(Crossings crossings, const Navmesh& mesh) {
    KerbMap map{std::move(crossings), {}, {0}, {}};
    map.grid = make_crossing_grid(map.crossings);
    for (uint32_t kerb = 0; kerb < 2 * map.crossings.all.size(); ++kerb) {
        const Crossing& c = map.crossings.all[kerb / 2];
        const size_t first = map.spots.size();
        for (int row = 0; is_ruled(c) && row < k_rows; ++row) {
            const float back = k_first_row + k_rows_apart * static_cast<float>(row),
                        shift = row % 2 == 0 ? 0 : k_beside / 2;
            const int side = static_cast<int>((c.half_width + k_beside) / k_beside);
            for (int n = -side; n <= side && map.spots.size() - first < k_most_spots; ++n) {
                const float aside = shift + k_beside * static_cast<float>(n);
                const Vec2 at = behind_kerb(c, kerb, back, aside);
                const auto place = nearest(mesh, 0, at_height(at, c.centre.y), {0.2f, 1.5f, 0.2f});
                if (!place || length(on_ground(place->position) - at) > 0.02f) continue;
                const Surface kind = surface_of(mesh, place->polygon);
                if (!is_carriageway(kind)) map.spots.push_back({at, back, aside});
            }
        }
        map.first.push_back(static_cast<uint32_t>(map.spots.size()));
    }
    return map;
}

LampManner lamp_manner(float age, float drunk, float conscientiousness, float share) {
    constexpr float k_child = 14, k_old = 65;
    float times = clamp(1 - 0.35f * conscientiousness, 0.2f, 1.9f) * (1 + 2 * drunk);
    if (age < k_child) times *= 0.3f;
    if (age >= k_old) times *= 0.5f;
    LampManner manner;
    manner.jaywalks = share >= 1 ? 1 : std::min(share * times, 0.9f);
    // A step takes a while to be seen: some 0.3 s of these.
    if (age >= k_old) manner.starts_least = 1.6f, manner.starts_most = 2.1f;
    return manner;
}

void mind_lamps(Kerbs& k, std::shared_ptr<const KerbMap> map, uint32_t capacity) {
    k.map = std::move(map);
    const size_t slots = k.map ? capacity : 0;
    k.waits.assign(slots, {});
    k.asks.assign(slots, {});
    k.manners.resize(slots);
    k.asking.reserve(slots);
    k.taken.assign(k.map ? 2 * k.map->crossings.all.size() : 0, 0);
}

Heed heed_lamp(Kerbs& k, uint32_t i, const PathGoer& goer, uint32_t tick, uint64_t seed) {
    const KerbAhead ahead = kerb_ahead(*k.map, goer, k.waits[i]);
    k.asks[i] = {};
    Heed heed;
    if (ahead.kerb != k_no_kerb && !may_go(k, i, goer, ahead, tick, seed))
        heed = wait_at(k, i, goer, ahead, tick);
    if (!heed.waits && k.asks[i].kerb == k_no_kerb) leave_kerb(k, i);
    if (ahead.on != k_no_lamp) heed.pace = pace_over(k.map->crossings, goer, ahead, tick);
    return heed;
}

// The nearest place that is free, rather in the first row than farther back.
static uint32_t free_spot(const KerbMap& map, const KerbAsk& ask, uint64_t taken) {
    constexpr float k_row = 3;  // metres aside that the place in front is worth, for each metre
    uint32_t best = k_no_spot;
    float least = 1e9f;
    const uint32_t first = map.first[ask.kerb], count = map.first[ask.kerb + 1] - first;
    for (uint32_t s = 0; s < count; ++s) {
        if ((taken >> s & 1) != 0) continue;
        const KerbMap::Spot& spot = map.spots[first + s];
        const float cost = std::fabs(spot.aside - ask.aside) + k_row * spot.back;
        if (cost < least) least = cost, best = s;
    }
    return best;
}

void give_spots(Kerbs& k, uint32_t count, uint32_t tick) {
    k.asking.clear();
    for (uint32_t i = 0; i < count; ++i)
        if (k.asks[i].kerb != k_no_kerb) k.asking.push_back(i);
    if (k.asking.empty()) return;
    std::fill(k.taken.begin(), k.taken.end(), 0);
    for (uint32_t i = 0; i < count; ++i) {
        const KerbWait& wait = k.waits[i];
        if (wait.kerb != k_no_kerb && wait.spot != k_no_spot) k.taken[wait.kerb] |= uint64_t{1} << wait.spot;
    }
    for (const uint32_t i : k.asking) {
        const KerbAsk ask = k.asks[i];
        const uint32_t spot = free_spot(*k.map, ask, k.taken[ask.kerb]);
        KerbWait& wait = k.waits[i];
        wait = {ask.kerb, spot, tick, ask.at};
        k.asks[i] = {};
        if (spot == k_no_spot) continue;
        k.taken[ask.kerb] |= uint64_t{1} << spot;
        const KerbMap::Spot& place = k.map->spots[k.map->first[ask.kerb] + spot];
        // Who pushes a pram stands behind it.
        wait.to =
            behind_kerb(k.map->crossings.all[ask.kerb / 2], ask.kerb, place.back + ask.ahead, place.aside);
    }
}

}  // namespace flaneur
