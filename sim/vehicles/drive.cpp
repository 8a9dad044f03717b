#include "sim/vehicles/drive.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/base/tick.h"

namespace flaneur {

namespace {

// Of the intelligent driver model in a town (Treiber & Kesting 2013, table 11.2): seconds to the one ahead.
constexpr float k_headway = 1.1f;
constexpr float k_standing = 1.8f;                      // metres kept to the one ahead in a queue,
constexpr float k_to_people = 1.2f, k_to_line = 0.35f;  // to people, to a line
constexpr float k_can_stop = 3;       // m/s2 with which one still stops for amber, or gives way,
constexpr float k_of_hardest = 0.6f;  // at most this share of as hard as one can
constexpr float k_insists = 15;       // seconds that one gives way to those who are not yet on it
constexpr float k_stays_least = 10, k_stays_most = 20;  // seconds at a stop,
constexpr float k_tram_stays = 20;                      // and a tram
constexpr float k_slows_for_bend = 1.4f;                // m/s2, at most,
constexpr float k_sees_bend = 40;                       // metres ahead
constexpr float k_on_rails = 0.6f;  // of the speed in bends: 0.7 m/s2 to the side, where people stand
constexpr float k_creeps = 0.12f;   // m/s2, at which one who stands does not set off
constexpr float k_farthest = 72;    // metres that it looks ahead, at most
constexpr float k_reckons = 6;      // metres more than it takes to stop

float stops_within(float speed, float braking) { return speed * speed / (2 * braking); }
// Metres within which it still stops.
float could_stop(const Vehicle& v) {
    return stops_within(v.speed, std::min(k_can_stop, k_of_hardest * shape_of(v).hardest));
}

struct Deciding {
    const Vehicles& vehicles;
    const Crowd& crowd;
    const Vehicle& v;
    uint32_t number, tick;
    float acceleration = 1e3f;
    Ahead ahead;           // what makes it so
    float behind = 1e9f;   // metres to the vehicle ahead
    bool is_held = false;  // before the next junction, by something else than that
    uint32_t wants = k_no_lane;
    bool gives_back = false;  // what it was granted
    uint32_t stays_until = 0, served = k_no_lane;
};

void take(Deciding& d, const Ahead& ahead, float keeps) {
    const float a = driven(shape_of(d.v), d.v.speed, 1e3f, ahead, keeps);
    if (a < d.acceleration) d.acceleration = a, d.ahead = ahead;
}

// Whether its lamp lets it over the crossing that is so far ahead.
bool is_lamp_free(const Deciding& d, const Crossing& crossing, float far) {
    const Lamp lamp = lamp_of_drivers(d.crowd.roadway.map->crossings.plans[crossing.plan], d.tick);
    if (lamp.light == Light::green) return true;
    return lamp.light == Light::amber && could_stop(d.v) > far;
}

// Before a crossing whose stripes begin at `far` metres ahead; `beyond`: its front is over the line already.
void mind_crossing(Deciding& d, uint32_t lane, const LaneCrossing& at, float far) {
    constexpr float k_before = 1;  // metres
    const Crossings& crossings = d.crowd.roadway.map->crossings;
    const Crossing& crossing = crossings.all[at.crossing];
    const Lanes& lanes = d.vehicles.map->lanes;
    const float line = far - k_before;
    if (line < -0.6f) return;
    const float stop = std::max(line, 0.05f);
    if (is_ruled(crossing) && at.leaves == 0) {
        if (!is_lamp_free(d, crossing, stop)) {
            take(d, {stop, 0, Brakes::lamp, at.crossing}, k_to_line);
            d.is_held = true;
            return;
        }
    }
    if (could_stop(d.v) > stop) return;  // those who are on it are looked out for anyway
    const bool has_waited = stood(d.v, d.tick) > k_insists;
    const bool is_green = is_ruled(crossing) && at.leaves == 0;
    const Vec2 middle = on_ground(on_lane(lanes, lane, (at.from + at.to) / 2).at);
    const int people = count_on_crossing(d.crowd, crossing, middle, has_waited || is_green);
    if (people == 0) return;
    const uint32_t whom = static_cast<uint32_t>(people) | (has_waited ? k_insists_on_it : 0);
    take(d, {stop, 0, Brakes::crossing, whom}, k_to_line);
    d.is_held = true;
}

// A bus stops once on a lane, a tram at each of its stops.
void mind_stops(Deciding& d, const Lane& lane, uint32_t number, float base) {
    constexpr float k_past = 2;  // metres
    const bool is_tram = d.v.kind == VehicleKind::tram;
    if (!is_tram && d.v.kind != VehicleKind::bus) return;
    const auto stops = stops_of(d.vehicles.map->lanes, lane);
    size_t which = 0;
    while (is_tram && which < stops.size() &&
           (base + stops[which] < -k_past || d.served == lane.first_stop + which))
        ++which;
    if (which == stops.size()) return;
    const uint32_t mark = is_tram ? lane.first_stop + static_cast<uint32_t>(which) : number;
    const float far = base + stops[which];
    if (d.served == mark || far < -k_past) return;
    if (d.stays_until > 0) {
        if (d.tick >= d.stays_until) {
            d.stays_until = 0, d.served = mark;
            return;
        }
    } else if (far < 1.2f && d.v.speed < 0.1f) {
        const RandomKey key{1, d.number, d.tick, Purpose::vehicle};
        const float stays = is_tram ? k_tram_stays : random_between(key, k_stays_least, k_stays_most);
        d.stays_until = d.tick + static_cast<uint32_t>(stays / k_tick);
    }
    take(d, {std::max(far, 0.05f), 0, Brakes::stop, 0}, k_to_line);
    d.is_held = true;
}

// What lies along its route within so many metres: crossings, stops, and the next junction.
void mind_route(Deciding& d, float reach) {
    const Lanes& lanes = d.vehicles.map->lanes;
    float base = -d.v.metres;
    for (int k = k_here; k < k_route && d.v.route[k] != k_no_lane && base < reach; ++k) {
        const uint32_t number = d.v.route[k];
        const Lane& lane = lanes.all[number];
        for (const LaneCrossing& at : crossings_of(lanes, lane))
            if (base + at.from < reach) mind_crossing(d, number, at, base + at.from);
        mind_stops(d, lane, number, base);
        const uint32_t next = k + 1 < k_route ? d.v.route[k + 1] : k_no_lane;
        // Who stops before a junction after all lets others in.
        if (next == d.v.granted && next != k_no_lane && d.is_held) d.gives_back = true;
        if (next != k_no_lane && is_curve(lanes.all[next]) && lanes.all[next].conflict_count > 0 &&
            next != d.v.granted) {
            const float far = base + lane.stop;
            if (far < reach) {
                if (!d.is_held && d.behind > far) d.wants = next;
                take(d, {std::max(far, 0.05f), 0, Brakes::junction, lanes.all[next].node}, k_to_line);
            }
            return;
        }
        base += lane.length;
    }
}

// m/s at which it likes to go here, with bends ahead.
float wanted_speed(const Deciding& d) {
    const Lanes& lanes = d.vehicles.map->lanes;
    const VehicleShape& shape = shape_of(d.v);
    float most = std::min(lanes.all[d.v.route[k_here]].speed * d.v.taste, shape.fastest * d.v.taste);
    const bool is_tram = d.v.kind == VehicleKind::tram;
    const float sees = is_tram ? k_farthest : k_sees_bend, leans = is_tram ? k_on_rails : 1;
    const float slows = std::min(k_slows_for_bend, shape.comfort);
    float base = -d.v.metres;
    for (int k = k_here; k < k_route && d.v.route[k] != k_no_lane && base < sees; ++k) {
        const Lane& lane = lanes.all[d.v.route[k]];
        for (float at = std::max(-base - shape.length / 2, 0.0f); at < lane.length && base + at < sees;
             at += 3) {
            const float bend = std::min(leans * bend_speed(lanes, d.v.route[k], at), lane.speed * d.v.taste);
            most = std::min(most, std::sqrt(bend * bend + 2 * slows * std::max(base + at, 0.0f)));
        }
        base += lane.length;
    }
    return std::max(most, 1.5f);
}

}  // namespace

float driven(const VehicleShape& shape, float speed, float wanted, const Ahead& ahead, float keeps) {
    const float share = speed / wanted, square = share * share;
    // Who is too fast slows down comfortably.
    const float free = std::max(shape.acceleration * (1 - square * square), -shape.comfort);
    if (ahead.gap > 1e8f) return free;
    if (ahead.gap < 0.02f) return -shape.hardest;
    const float nears = speed * (speed - ahead.speed) / (2 * std::sqrt(shape.acceleration * shape.comfort));
    const float headway = ahead.speed > 0 || ahead.why == Brakes::ahead ? k_headway : 0.5f;
    const float room = keeps + std::max(speed * headway + nears, 0.0f), tight = room / ahead.gap;
    return std::max(free - shape.acceleration * tight * tight, -shape.hardest);
}

float stood(const Vehicle& v, uint32_t tick) {
    return v.stood_since == k_never ? 0 : static_cast<float>(tick - v.stood_since) * k_tick;
}

void decide(Vehicles& vs, const Crowd& c, uint32_t number, uint32_t tick) {
    Vehicle& v = vs.all[number];
    const VehicleShape& shape = shape_of(v);
    Deciding d{vs, c, v, number, tick, 1e3f, {}, 1e9f, false, k_no_lane, false, v.stays_until, v.served};
    const float reach = std::min(stops_within(v.speed, shape.comfort) + k_reckons + v.speed, k_farthest);
    const Ahead body = look_ahead(vs, c, number, reach);
    take(d, body, body.why == Brakes::people ? k_to_people : k_standing);
    if (body.why == Brakes::ahead) d.behind = body.gap;
    mind_route(d, reach);
    v.acceleration = std::min(d.acceleration, driven(shape, v.speed, wanted_speed(d), {}, 0));
    // Who stands before something does not creep.
    if (v.speed < 0.15f && v.acceleration < k_creeps && d.ahead.gap < 3) v.acceleration = -shape.hardest;
    const bool brakes = d.acceleration < k_creeps && d.ahead.gap < 1e8f;
    v.brakes = brakes ? d.ahead.why : Brakes::no;
    v.whom = brakes ? d.ahead.whom : 0;
    v.wants = d.wants;
    if (d.gives_back) v.granted = k_no_lane;
    v.stays_until = d.stays_until;
    v.served = d.served;
}

void extend_route(const Vehicles& vs, Vehicle& v, uint32_t number, uint64_t seed) {
    constexpr float k_straight = 0.5f, k_likes_straight = 2.2f;  // radians; times others' chance
    const Lanes& lanes = vs.map->lanes;
    for (int k = k_here; k + 1 < k_route; ++k) {
        if (v.route[k] == k_no_lane) return;
        if (v.route[k + 1] != k_no_lane) continue;
        const auto nexts = nexts_of(lanes, lanes.all[v.route[k]]);
        auto weight = [&](uint32_t next) {
            if (v.kind == VehicleKind::bus && vs.takes_buses[next] == 0) return 0.0f;
            const Lane& lane = lanes.all[next];
            return is_curve(lane) && std::fabs(lane.turn) < k_straight ? k_likes_straight : 1.0f;
        };
        float sum = 0;
        for (const uint32_t next : nexts) sum += weight(next);
        if (sum <= 0) return;
        float lot = random_unit({seed, number, v.turns++, Purpose::vehicle}, 2) * sum;
        for (const uint32_t next : nexts) {
            const float own = weight(next);
            if (own <= 0) continue;
            v.route[k + 1] = next;
            if (lot < own) break;
            lot -= own;
        }
    }
}

}  // namespace flaneur
