// Watches those who drive, tick by tick: whom they come near, how they brake, how long they stand.
#pragma once

#include <algorithm>
#include <vector>

#include "sim/base/math.h"
#include "sim/crowd/places.h"
#include "sim/world.h"

namespace flaneur {

struct TrafficTally {
    float into_people = -9, into_vehicles = -9;  // metres that boxes are into bodies, into boxes
    float hardest = 0, jump = 0;  // m/s2 of braking of those who go; metres that one moves in a tick
    float longest_stood = 0;      // seconds
    uint32_t stopped = 0;         // times that one was stopped at the last moment
    uint32_t on_red = 0;          // went over a line though its lamp was red
    uint32_t left = 0;            // by gates
    float mean_speed = 0;
    uint32_t decided[7] = {};  // by Brakes, vehicle ticks
};

inline float deepest_in(const Crowd& c, const VehicleBox& box) {
    float deepest = -9;
    for (const WalkerId id : c.slots.living) {
        const Vec3 at = c.motion.position[id.index];
        if (std::fabs(at.y - box.y) > 2) continue;
        deepest = std::max(deepest, c.identity.radius[id.index] - off_box(box, on_ground(at)).far);
    }
    return deepest;
}

// How far two boxes are into each other, to a centimetre; less than 0: they are not.
inline float boxes_overlap(const VehicleBox& a, const VehicleBox& b) {
    if (!overlap(a, b, 0)) return -1;
    float in = 0.01f;
    while (in < 1 && overlap(a, b, -in)) in += 0.01f;
    return in;
}

// Whether a vehicle's front went over the line of a lamp that has been red for a second.
inline bool passes_red(const World& w, const Vehicle& before, const Vehicle& now) {
    const Lanes& lanes = w.vehicles.map->lanes;
    if (before.route[k_here] != now.route[k_here]) return false;
    for (const LaneCrossing& at : crossings_of(lanes, lanes.all[now.route[k_here]])) {
        const Crossing& crossing = w.vehicles.map->crossings.all[at.crossing];
        if (!is_ruled(crossing) || at.leaves != 0 || before.metres >= at.from || now.metres < at.from)
            continue;
        const Lamp lamp = lamp_of_drivers(w.vehicles.map->crossings.plans[crossing.plan], w.tick);
        if (lamp.light == Light::red && lamp.since > 60) return true;
    }
    return false;
}

inline TrafficTally watch_traffic(World& w, uint32_t ticks) {
    TrafficTally seen;
    Vehicles& vs = w.vehicles;
    double speeds = 0, drives = 0;
    const uint32_t before_held = vs.held_back;
    for (uint32_t t = 0; t < ticks; ++t) {
        const std::vector<Vehicle> before = vs.all;
        step(w);
        const Roadway& r = w.crowd.roadway;
        for (size_t a = 0; a < r.boxes.size(); ++a) {
            seen.into_people = std::max(seen.into_people, deepest_in(w.crowd, r.boxes[a]));
            for (size_t b = 0; b < a; ++b)
                if (r.numbers[a] != r.numbers[b])
                    seen.into_vehicles = std::max(seen.into_vehicles, boxes_overlap(r.boxes[a], r.boxes[b]));
        }
        for (size_t n = 0; n < vs.all.size(); ++n) {
            const Vehicle& v = vs.all[n];
            seen.left += is_there(before[n]) && !is_there(v);
            if (!is_there(v)) continue;
            speeds += wide(v.speed), drives += 1;
            ++seen.decided[static_cast<size_t>(v.brakes)];
            if (v.stood_since != k_never)
                seen.longest_stood =
                    std::max(seen.longest_stood, static_cast<float>(w.tick - v.stood_since) * k_tick);
            if (!is_there(before[n])) continue;
            seen.hardest = std::max(seen.hardest, -v.acceleration * (v.speed > 0.2f ? 1 : 0));
            const uint32_t section = first_section(vs, static_cast<uint32_t>(n));
            seen.jump = std::max(seen.jump, length(vs.places[section].middle - vs.previous[section].middle));
            seen.on_red += passes_red(w, before[n], v);
        }
    }
    seen.stopped = vs.held_back - before_held;
    seen.mean_speed = drives > 0 ? static_cast<float>(speeds / drives) : 0;
    return seen;
}

inline void print(const char* what, const TrafficTally& t) {
    std::printf(
        "%s: into people %.3f, into vehicles %.3f m; hardest %.1f m/s2, %.2f m a tick; stood %.0f s; stopped "
        "%u, "
        "on red %u, left %u, mean %.2f m/s; no %u ahead %u lamp %u crossing %u people %u junction %u stop "
        "%u\n",
        what, wide(t.into_people), wide(t.into_vehicles), wide(t.hardest), wide(t.jump),
        wide(t.longest_stood), t.stopped, t.on_red, t.left, wide(t.mean_speed), t.decided[0], t.decided[1],
        t.decided[2], t.decided[3], t.decided[4], t.decided[5], t.decided[6]);
}

}  // namespace flaneur
