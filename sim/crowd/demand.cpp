#include "sim/crowd/demand.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/base/tick.h"

namespace flaneur {

static constexpr float k_cell = 60;                              // metres
static constexpr float k_least_trip = 40;                        // metres
static constexpr float k_least_reach = 120, k_most_reach = 500;  // of trips; the near is sought more often
static constexpr float k_stroll = 0.25f;                         // what going nowhere in particular is worth
static constexpr double k_enough = 6;  // destinations of a kind within reach that take all who want there

// By judgement, not by survey: homes, work and stops draw most at 8 and 18, shops from noon on, squares in
// the evening.
static constexpr int k_hours = 8;  // every three hours from midnight
static constexpr float k_demand[k_destination_count][k_hours] = {
    {1.0f, 0.6f, 1.0f, 1.0f, 0.6f, 0.7f, 1.0f, 1.0f},  // doors
    {0.0f, 0.0f, 0.1f, 0.6f, 1.0f, 1.0f, 0.9f, 0.1f},  // shops
    {0.1f, 0.0f, 0.1f, 0.2f, 0.4f, 0.4f, 0.4f, 0.2f},  // benches
    {0.3f, 0.5f, 1.0f, 0.6f, 0.5f, 0.7f, 1.0f, 0.5f},  // stops
    {0.4f, 0.5f, 0.8f, 0.6f, 0.6f, 0.7f, 0.8f, 0.5f},  // edges of the map
    {0.3f, 0.0f, 0.1f, 0.3f, 0.5f, 0.6f, 0.9f, 0.9f},  // squares
};
static constexpr Stay k_stays[k_destination_count] = {{3, 10},  {6, 25},   {20, 60},
                                                      {15, 60}, {0.5f, 2}, {8, 40}};
static constexpr Stay k_way_out{0.3f, 1};  // of who leaves: until it opens
// How far from a destination's place people stand, metres.
static constexpr float k_spread[k_destination_count] = {0.8f, 1.2f, 0.7f, 1.8f, 1.5f, 2};

float demand_at(DestinationKind kind, float hour) {
    float at = hour / (24.0f / k_hours);
    at -= std::floor(at / k_hours) * k_hours;
    int before = std::min(static_cast<int>(at), k_hours - 1);
    const float* row = k_demand[static_cast<int>(kind)];
    return lerp(row[before], row[(before + 1) % k_hours], at - static_cast<float>(before));
}

Stay stay_at(DestinationKind kind, bool leaves) {
    if (leaves && kind != DestinationKind::stop) return k_way_out;
    return k_stays[static_cast<int>(kind)];
}

static float hour_at(const Demand& demand, uint32_t ticks) {
    return demand.hour + static_cast<float>(ticks) * (k_tick / 3600);
}

// A kind by their shares, for `drawn` from 0 to the shares' sum; k_destination_count beyond.
static int kind_at(const float (&shares)[k_destination_count], float drawn) {
    int kind = 0;
    while (kind < k_destination_count && drawn >= shares[kind]) drawn -= shares[kind++];
    return kind;
}

// Nobody stands on a carriageway because a stop is beside it.
static NavPoint place_beside(const Navmesh& mesh, int thread, const Attraction& a, int kind, RandomKey key) {
    auto is_road = [&](const NavPoint& p) { return is_carriageway(surface_of(mesh, p.polygon)); };
    const Vec2 aside =
        heading_direction(random_between(key, -k_pi, k_pi, 2)) * (k_spread[kind] * random_unit(key, 3));
    for (const Vec2 by : {aside, aside * -1}) {
        const NavPoint to = move_along(mesh, thread, a.place, a.place.position + at_height(by, 0));
        if (is_road(a.place) || !is_road(to)) return to;
    }
    return a.place;
}

Demand make_demand(std::span<const Destination> destinations, Vec2 low, Vec2 high, const Navmesh& mesh,
                   float hour, const Leaving& leaving) {
    Demand demand;
    demand.hour = hour;
    demand.leaving = leaving;
    for (int k = 0; k < k_destination_count; ++k) {
        std::vector<Attraction> found;
        std::vector<float> weights;
        for (const Destination& d : destinations) {
            if (static_cast<int>(d.kind) != k || !(d.weight > 0)) continue;
            auto place = nearest(mesh, 0, d.position, {3, 1.5f, 3});
            if (!place || !is_worth_walking(mesh, place->polygon)) continue;
            found.push_back({*place, d.facing});
            weights.push_back(d.weight);
        }
        demand.grids[k] = make_weighted_grid(
            low, high, k_cell, found.size(), [&](uint32_t i) { return on_ground(found[i].place.position); },
            [&](uint32_t i) { return weights[i]; });
        for (uint32_t i : demand.grids[k].grid.items) demand.attractions[k].push_back(found[i]);
    }
    return demand;
}

std::optional<Trip> choose_trip(const Demand& demand, const Navmesh& mesh, int thread, NavPoint from, By by,
                                uint32_t ticks, RandomKey key) {
    const float hour = hour_at(demand, ticks), u = random_unit(key, 0);
    float reach = lerp(k_least_reach, k_most_reach, u * u), shares[k_destination_count], total = k_stroll;
    Vec2 here = on_ground(from.position);
    for (int k = 0; k < k_destination_count; ++k) {
        double there = std::min(weight_near(demand.grids[k], here, reach) / k_enough, 1.0);
        shares[k] = demand_at(static_cast<DestinationKind>(k), hour) * static_cast<float>(there);
        total += shares[k];
    }
    const int kind = kind_at(shares, random_unit(key, 1) * total);
    if (kind == k_destination_count) return std::nullopt;

    constexpr uint32_t k_tries = 6;
    const auto named = static_cast<DestinationKind>(kind);
    const bool leaves = random_unit(key, 4 + k_tries) < demand.leaving[static_cast<size_t>(kind)];
    for (uint32_t t = 0; t < k_tries; ++t) {
        auto item = item_near(demand.grids[kind], here, reach, random_unit(key, 4 + t));
        if (!item) return std::nullopt;
        const Attraction& a = demand.attractions[kind][*item];
        if (!are_joined(mesh, from.polygon, a.place.polygon, by) ||
            length(on_ground(a.place.position) - here) < k_least_trip) {
            continue;
        }
        const bool is_exact = leaves && is_entrance(named);
        return Trip{named, is_exact ? a.place : place_beside(mesh, thread, a, kind, key), a.facing, leaves};
    }
    return std::nullopt;
}

std::optional<Trip> choose_entrance(const Demand& demand, const Navmesh& mesh, int thread, Vec2 centre,
                                    float reach, uint32_t ticks, RandomKey key) {
    constexpr float k_anywhere = 1e6f;  // metres
    const float hour = hour_at(demand, ticks);
    for (const float within : {reach, k_anywhere}) {
        float shares[k_destination_count], total = 0;
        for (int k = 0; k < k_destination_count; ++k) {
            const double there = std::min(weight_near(demand.grids[k], centre, within) / k_enough, 1.0);
            shares[k] = demand.leaving[static_cast<size_t>(k)] *
                        demand_at(static_cast<DestinationKind>(k), hour) * static_cast<float>(there);
            total += shares[k];
        }
        const int kind = kind_at(shares, random_unit(key, 0) * total);
        if (kind == k_destination_count) continue;
        const auto item = item_near(demand.grids[kind], centre, within, random_unit(key, 1));
        if (!item) continue;
        const Attraction& a = demand.attractions[kind][*item];
        const auto named = static_cast<DestinationKind>(kind);
        return Trip{named, is_entrance(named) ? a.place : place_beside(mesh, thread, a, kind, key),
                    a.facing * -1};
    }
    return std::nullopt;
}

}  // namespace flaneur
