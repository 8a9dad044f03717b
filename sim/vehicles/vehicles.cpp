#include "sim/vehicles/vehicles.h"

#include <algorithm>
#include <cmath>

#include "sim/base/hash.h"
#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/base/spans.h"
#include "sim/base/tick.h"
#include "sim/crowd/places.h"
#include "sim/vehicles/drive.h"

namespace flaneur {

namespace {

constexpr float k_bicycles = 0.16f, k_vans = 0.14f, k_buses = 0.06f;  // shares of those who drive
constexpr float k_off_border = 0.5f;  // metres from a lane's border to where a bicycle rides
constexpr float k_fades = 5;          // metres from a gate over which one is seen
constexpr float k_comes_at = 6;       // m/s, at most, as one comes in
constexpr uint32_t k_enters = 30;     // ticks between tries to come in
constexpr float k_bus_lane = 3.05f;   // metres, at least
constexpr float k_bus_bend = 3.2f;    // m/s, of bends that it gets round

RandomKey key_of(uint64_t seed, uint32_t number, uint32_t when) {
    return {seed, number, when, Purpose::vehicle};
}

float aside_of(const Lanes& lanes, const Vehicle& v, uint32_t lane) {
    if (v.kind != VehicleKind::bicycle) return 0;
    const float off = std::max(lanes.all[lane].width / 2 - k_off_border, 0.0f);
    return lanes.drives_left ? off : -off;
}

// Whether one turns off or onto a track there, where a bus would swing its tail out before those who come.
bool turns_at_track(const Lanes& lanes, const Lane& curve) {
    constexpr float k_turns = 0.6f;  // radians
    return std::fabs(curve.turn) > k_turns &&
           std::ranges::any_of(conflicts_of(lanes, curve),
                               [&](uint32_t other) { return lanes.all[other].is_track != 0; });
}

// Lanes where a bus gets on: wide enough, and leading to others that are, or out.
std::vector<uint8_t> lanes_for_buses(const Lanes& lanes) {
    std::vector<uint8_t> takes(lanes.all.size());
    for (uint32_t i = 0; i < takes.size(); ++i) {
        const Lane& lane = lanes.all[i];
        float slowest = 1e3f;
        for (float at = 0; at <= lane.length; at += 2) slowest = std::min(slowest, bend_speed(lanes, i, at));
        takes[i] = !lane.is_track && lane.width >= k_bus_lane && slowest >= k_bus_bend &&
                   !turns_at_track(lanes, lane);
    }
    // Those off which a bus gets on; where none could come in again, without leaving the map.
    auto leave_out = [&](bool may_leave) {
        for (bool is_any = true; is_any;) {
            is_any = false;
            for (uint32_t i = 0; i < takes.size(); ++i) {
                const Lane& lane = lanes.all[i];
                if (!takes[i] || (may_leave && lane.is_gate_out)) continue;
                if (std::ranges::none_of(nexts_of(lanes, lane),
                                         [&](uint32_t next) { return takes[next] != 0; }))
                    takes[i] = 0, is_any = true;
            }
        }
    };
    leave_out(true);
    bool comes_in = false;
    for (uint32_t i = 0; i < takes.size(); ++i) comes_in |= takes[i] != 0 && lanes.all[i].is_gate_in;
    if (!comes_in) leave_out(false);
    return takes;
}

VehicleKind kind_by_chance(uint64_t seed, uint32_t number, bool has_buses) {
    const float lot = random_unit(key_of(seed, number, 0), 0);
    if (lot < k_bicycles) return VehicleKind::bicycle;
    if (lot < k_bicycles + k_vans) return VehicleKind::van;
    return has_buses && lot < k_bicycles + k_vans + k_buses ? VehicleKind::bus : VehicleKind::car;
}

bool is_free_of_people(const Crowd& c, const VehicleBox& box, float grown) {
    for (const WalkerId id : c.slots.living)
        if (off_box(box, on_ground(c.motion.position[id.index])).far < c.identity.radius[id.index] + grown)
            return false;
    return true;
}

bool is_free_of_vehicles(const Roadway& r, const VehicleBox& box, float grown) {
    bool is_free = true;
    for_boxes_near(r, box.middle, box.half_length + grown,
                   [&](uint32_t k) { is_free = is_free && !overlap(box, r.boxes[k], grown); });
    return is_free;
}

// Whether all of it, so much longer ahead, is off people and other vehicles by so many metres.
bool is_free(const Vehicles& vs, const Crowd& c, const Vehicle& v, float ahead, float of_people,
             float of_vehicles) {
    for (uint32_t s = 0; s < sections_of(v); ++s) {
        VehicleBox box = box_of(v, place_of(vs.map->lanes, v, s));
        if (!is_free_of_people(c, box, of_people)) return false;
        if (s == 0) box.half_length += ahead / 2, box.middle += box.ahead * (ahead / 2);
        if (!is_free_of_vehicles(c.roadway, box, of_vehicles)) return false;
    }
    return true;
}

void put_on(const Vehicles& vs, Vehicle& v, uint32_t number, uint32_t lane, float metres, uint64_t seed) {
    std::fill(std::begin(v.route), std::end(v.route), k_no_lane);
    v.route[k_here] = lane;
    v.metres = metres;
    v.speed = v.acceleration = 0;
    v.brakes = Brakes::no;
    v.wants = v.granted = v.served = k_no_lane;
    v.stays_until = 0;
    v.stood_since = k_never;
    extend_route(vs, v, number, seed);
}

bool may_be_on(const Vehicles& vs, const Vehicle& v, uint32_t lane) {
    if ((v.kind == VehicleKind::tram) != (vs.map->lanes.all[lane].is_track != 0)) return false;
    return v.kind != VehicleKind::bus || vs.takes_buses[lane] != 0;
}

// Somewhere along the lanes, by their length, off junctions and crossings.
// `ends`: how many metres of such lanes there are up to the end of each, curves left out.
void set_somewhere(Vehicles& vs, const Crowd& c, uint32_t number, const std::vector<float>& ends,
                   uint64_t seed) {
    constexpr uint32_t k_tries = 24;
    constexpr float k_apart = 3;
    const Lanes& lanes = vs.map->lanes;
    Vehicle& v = vs.all[number];
    for (uint32_t t = 1; t <= k_tries; ++t) {
        const float lot = random_unit(key_of(seed, number, 0), t) * ends.back();
        const auto lane = static_cast<uint32_t>(std::ranges::upper_bound(ends, lot) - ends.begin());
        if (lane >= ends.size() || is_curve(lanes.all[lane])) continue;
        const Lane& l = lanes.all[lane];
        const float at = lot - (ends[lane] - l.length);
        if (!may_be_on(vs, v, lane) || at < shape_of(v).length + 1 || at > l.stop - 2) continue;
        const bool is_over = std::ranges::any_of(crossings_of(lanes, l), [&](const LaneCrossing& x) {
            return at > x.from - 2 && at - shape_of(v).length < x.to + 1;
        });
        if (is_over) continue;
        put_on(vs, v, number, lane, at, seed);
        if (is_free(vs, c, v, 0, 0.3f, k_apart)) return;
        v.route[k_here] = k_no_lane;
    }
}

// In by a gate, where there is room; returns whether it did.
bool come_in(Vehicles& vs, const Crowd& c, uint32_t number, uint32_t tick, uint64_t seed) {
    constexpr float k_room = 9;  // metres ahead
    const Lanes& lanes = vs.map->lanes;
    Vehicle& v = vs.all[number];
    const std::vector<uint32_t>& gates = v.kind == VehicleKind::tram ? vs.tram_gates : vs.gates;
    if (gates.empty()) return false;
    const uint32_t gate = gates[random_bits(key_of(seed, number, tick), 1) % gates.size()];
    // Of a tram the first section; the others follow from beyond the gate.
    const float length = shape_of(v).length / static_cast<float>(sections_of(v));
    if (!may_be_on(vs, v, gate) || lanes.all[gate].length < length + 1) return false;
    put_on(vs, v, number, gate, length, seed);
    if (!is_free(vs, c, v, k_room, 0.5f, 0.3f)) {
        v.route[k_here] = k_no_lane;
        return false;
    }
    // So that it can stop before what comes next.
    const float brakes = std::min(2.0f, shape_of(v).hardest / 2);
    const float stops = std::sqrt(2 * brakes * std::max(lanes.all[gate].stop - v.metres, 0.0f));
    v.speed = std::min({k_comes_at, shape_of(v).fastest * 0.8f, lanes.all[gate].speed, stops});
    const uint32_t first = first_section(vs, number);
    for (uint32_t s = 0; s < sections_of(v); ++s)
        vs.places[first + s] = vs.previous[first + s] = place_of(lanes, v, s);
    return true;
}

// Onto the next lane of its route.
void shift_route(const Vehicles& vs, Vehicle& v, uint32_t number, uint64_t seed) {
    v.metres -= vs.map->lanes.all[v.route[k_here]].length;
    if (v.granted == v.route[k_here + 1]) v.granted = v.wants = k_no_lane;
    std::copy(std::begin(v.route) + 1, std::end(v.route), std::begin(v.route));
    v.route[k_route - 1] = k_no_lane;
    extend_route(vs, v, number, seed);
}

// Whether something is where one of its sections would come to from where all are now.
bool is_stopped(const Crowd& c, uint32_t number, std::span<const VehicleBox> now, uint32_t section,
                const VehicleBox& box) {
    constexpr float k_apart = 0.04f, k_level = 2.5f;  // metres
    const Roadway& r = c.roadway;
    bool is = false;
    for_boxes_near(r, box.middle, box.half_length + 1, [&](uint32_t k) {
        if (r.numbers[k] != number && overlap(box, r.boxes[k], k_apart) &&
            !overlap(now[section], r.boxes[k], k_apart / 2))
            is = true;
    });
    auto is_hit = [&](Vec2 place, float radius) {
        const float far = off_box(box, place).far;
        // Who is beside or behind it, or has come under it, only keeps it from coming nearer.
        const float apart = on_box(box, place).ahead > 0 ? k_apart : k_apart / 4;
        return far < radius + apart && std::ranges::all_of(now, [&](const VehicleBox& own) {
                   return far < off_box(own, place).far - 1e-4f;
               });
    };
    for_seen_near(c.scratch, at_height(box.middle, box.y), box.half_length + c.widest + k_lying_reach,
                  [&](uint32_t begin, uint32_t end) {
                      for (uint32_t k = begin; k < end && !is; ++k) {
                          const uint32_t i = c.scratch.seen.all[k].id;
                          const Vec3 at = c.motion.position[i];
                          if (std::fabs(at.y - box.y) > k_level) continue;
                          is = is_hit(on_ground(at), c.identity.radius[i]);
                          if (c.identity.ahead[i] > 0)
                              is |= is_hit(on_ground(at + at_height(c.scratch.seen.all[k].ahead, 0)),
                                           k_pram_radius);
                          if (c.downed.empty() || !is_down(c, i)) continue;
                          for (const LyingPart& part : own_of(c.downed, i)->parts)
                              is |= part.radius > 0 && is_hit(on_ground(at) + part.from, part.radius);
                      }
                  });
    return is;
}

// A tick's way.
void go_on(Vehicles& vs, Crowd& c, uint32_t number, uint32_t tick, uint64_t seed) {
    const Lanes& lanes = vs.map->lanes;
    Vehicle& v = vs.all[number];
    const float speed = std::max(v.speed + v.acceleration * k_tick, 0.0f);
    const float way = 0.5f * (v.speed + speed) * k_tick;
    const Vehicle before = v;
    v.speed = speed;
    v.metres += way;
    v.rolled += way;
    // Out by a gate with the last section.
    const uint32_t sections = sections_of(v);
    const float length = shape_of(v).length, out = length - length / static_cast<float>(sections);
    while (v.metres > lanes.all[v.route[k_here]].length) {
        if (v.route[k_here + 1] != k_no_lane) {
            shift_route(vs, v, number, seed);
        } else if (v.metres - out > lanes.all[v.route[k_here]].length) {
            v.route[k_here] = k_no_lane;
            return;
        } else {
            break;
        }
    }
    VehiclePlace* places = &vs.places[first_section(vs, number)];
    const std::span boxes(&c.roadway.boxes[vs.shown_as[number]], sections);
    VehiclePlace next[k_tram_sections];
    bool stops = false;
    for (uint32_t s = 0; s < sections; ++s) {
        next[s] = place_of(lanes, v, s);
        stops |= way > 0 && is_stopped(c, number, boxes, s, box_of(v, next[s]));
    }
    if (stops) {
        v = before;
        vs.held_back += before.speed > 0.5f;
        v.speed = 0;
    } else {
        std::copy(next, next + sections, places);
    }
    for (uint32_t s = 0; s < sections; ++s) boxes[s] = box_of(v, places[s]);
    const bool stands = v.speed < 0.05f;
    if (!stands) v.stood_since = k_never;
    if (stands && v.stood_since == k_never) v.stood_since = tick;
}

// When it will be where, as it drives now.
void foretell(const Vehicles& vs, Roadway& r, const Vehicle& v) {
    constexpr float k_foresees = 6.5f, k_step = 0.9f, k_creeps = 0.3f,
                    k_sets_off = 2.5f;  // seconds; metres; m/s
    const float half = shape_of(v).width / 2 + 0.35f;
    // One that has begun to go counts as quicker than it is, and one that has waited long, or a tram
    // that rings its bell, as if it went.
    const bool insists = (v.brakes == Brakes::crossing && (v.whom & k_insists_on_it) != 0) ||
                         (v.kind == VehicleKind::tram && v.brakes == Brakes::people);
    const bool sets_off = v.acceleration > 0.2f || insists;
    const float slows = sets_off ? 0 : std::min(v.acceleration, 0.0f);
    const float speed = sets_off ? std::max(v.speed, k_sets_off) : v.speed;
    // Who brakes less hard than a car is let pass as if it came so much sooner.
    const float brakes_longer = v.speed / shape_of(v).hardest - v.speed / k_vehicle_shapes[0].hardest;
    if (speed < k_creeps) return;
    for (float far = 0;; far += k_step) {
        const float under = speed * speed + 2 * slows * far;
        if (under < 0) break;  // it stops before
        const float seconds = 2 * far / (speed + std::sqrt(under)) - brakes_longer;
        if (seconds > k_foresees) break;
        const OnLane at = ahead_of(vs.map->lanes, v, far);
        paint(r, on_ground(at.at), at.along, half, static_cast<uint32_t>(std::max(seconds, 0.0f) / k_tick));
    }
}

}  // namespace

void show_vehicles(Vehicles& vs, Crowd& c) {
    Roadway& r = c.roadway;
    clear(r);
    for (uint32_t n = 0; n < vs.all.size(); ++n) {
        const Vehicle& v = vs.all[n];
        if (!is_there(v)) continue;
        vs.shown_as[n] = static_cast<uint32_t>(r.boxes.size());
        for (uint32_t s = 0; s < sections_of(v); ++s)
            add_box(r, box_of(v, vs.places[first_section(vs, n) + s]), n);
    }
    sort_boxes(r);
    for (const Vehicle& v : vs.all)
        if (is_there(v)) foretell(vs, r, v);
}

OnLane ahead_of(const Lanes& lanes, const Vehicle& v, float metres) {
    int k = k_here;
    float at = v.metres + metres;
    while (at < 0 && k > 0 && v.route[k - 1] != k_no_lane) at += lanes.all[v.route[--k]].length;
    while (at > lanes.all[v.route[k]].length && k + 1 < k_route && v.route[k + 1] != k_no_lane)
        at -= lanes.all[v.route[k++]].length;
    OnLane there = on_lane(lanes, v.route[k], at);
    // From lane to lane its own way aside changes little by little.
    if (const float aside = aside_of(lanes, v, v.route[k]); aside != 0) {
        constexpr float k_mixes = 6;
        const Lane& lane = lanes.all[v.route[k]];
        float mixed = aside;
        if (k > 0 && v.route[k - 1] != k_no_lane && at < k_mixes)
            mixed =
                lerp(aside_of(lanes, v, v.route[k - 1]), mixed, 0.5f + 0.5f * std::max(at, 0.0f) / k_mixes);
        if (k + 1 < k_route && v.route[k + 1] != k_no_lane && at > lane.length - k_mixes)
            mixed = lerp(aside_of(lanes, v, v.route[k + 1]), mixed,
                         0.5f + 0.5f * std::max(lane.length - at, 0.0f) / k_mixes);
        there.at += at_height(Vec2{there.along.z, -there.along.x} * mixed, 0);
    }
    return there;
}

// Metres that its front has come since the gate that it came in by, and that are left to the one by which it
// leaves; many, where there is none near.
static float from_gate(const Lanes& lanes, const Vehicle& v) {
    int k = k_here;
    float at = v.metres;
    while (k > 0 && v.route[k - 1] != k_no_lane) at += lanes.all[v.route[--k]].length;
    return k > 0 && lanes.all[v.route[k]].is_gate_in ? at : 1e9f;
}
static float to_gate(const Lanes& lanes, const Vehicle& v) {
    const Lane& lane = lanes.all[v.route[k_here]];
    return lane.is_gate_out ? lane.length - v.metres : 1e9f;
}

VehiclePlace place_of(const Lanes& lanes, const Vehicle& v, uint32_t section) {
    const VehicleShape& shape = shape_of(v);
    const float length_of_one = shape.length / static_cast<float>(shape.sections);
    const float back = static_cast<float>(section) * length_of_one;
    const OnLane front = ahead_of(lanes, v, -back - shape.front_axle),
                 rear = ahead_of(lanes, v, -back - shape.rear_axle);
    const Vec3 between = front.at - rear.at;
    const Vec2 ahead = normalize_or(on_ground(between), front.along);
    VehiclePlace place;
    // The middle of its box is not halfway between the axles.
    const float middle = shape.rear_axle - length_of_one / 2, apart = shape.rear_axle - shape.front_axle;
    place.middle = rear.at + between * (middle / apart);
    place.heading = heading_of(ahead);
    place.pitch = arctan2(between.y, length(on_ground(between)));
    place.steer = wrap_angle(heading_of(ahead_of(lanes, v, 0.4f - shape.front_axle).along) - place.heading);
    place.rolled = v.rolled;
    const float gone = from_gate(lanes, v) - back - length_of_one, left = to_gate(lanes, v) + back;
    place.presence = clamp(std::min(gone, left) / k_fades, 0, 1);
    return place;
}

VehicleBox box_of(const Vehicle& v, const VehiclePlace& place) {
    const VehicleShape& shape = shape_of(v);
    return {on_ground(place.middle),
            heading_direction(place.heading),
            shape.length / 2 / static_cast<float>(shape.sections),
            shape.width / 2,
            place.middle.y,
            v.speed};
}

void find_places(Vehicles& vs) {
    for (uint32_t n = 0; n < vs.all.size(); ++n)
        for (uint32_t s = 0; is_there(vs.all[n]) && s < sections_of(vs.all[n]); ++s)
            vs.places[first_section(vs, n) + s] = place_of(vs.map->lanes, vs.all[n], s);
    vs.previous = vs.places;
}

VehiclePlace place_between(const VehiclePlace& a, const VehiclePlace& b, float t) {
    auto mixed = [&](float from, float to) { return from + (to - from) * t; };
    return {lerp(a.middle, b.middle, t), a.heading + wrap_angle(b.heading - a.heading) * t,
            mixed(a.pitch, b.pitch),     mixed(a.steer, b.steer),
            mixed(a.rolled, b.rolled),   mixed(a.presence, b.presence)};
}

void make_vehicles(Vehicles& vs, Crowd& c, std::shared_ptr<const RoadMap> map, float traffic, uint64_t seed) {
    vs = {};
    vs.traffic = traffic;
    if (!map || !has_lanes(map->lanes) || traffic <= 0) {
        make_room(c.roadway, nullptr, 0);
        return;
    }
    vs.map = std::move(map);
    const Lanes& lanes = vs.map->lanes;
    vs.takes_buses = lanes_for_buses(lanes);
    bool has_buses = false;
    std::vector<float> ends(lanes.all.size()), tram_ends = ends;
    float whole = 0, tracks = 0;
    for (uint32_t i = 0; i < lanes.all.size(); ++i) {
        const Lane& lane = lanes.all[i];
        if (!is_curve(lane)) {
            (lane.is_track ? tracks : whole) += lane.length;
            has_buses |= vs.takes_buses[i] != 0;
            if (lane.is_gate_in) (lane.is_track ? vs.tram_gates : vs.gates).push_back(i);
        }
        ends[i] = whole, tram_ends[i] = tracks;
    }
    const float wanted = traffic * k_vehicles_a_kilometre * whole / 1000,
                trams = traffic * k_trams_a_kilometre * tracks / 1000;
    vs.first_tram = static_cast<uint32_t>(std::max(wanted + 0.5f, 1.0f));
    const uint32_t count =
        vs.first_tram + (tracks > 0 ? static_cast<uint32_t>(std::max(trams + 0.5f, 1.0f)) : 0);
    vs.all.resize(count);
    vs.places.resize(first_section(vs, count));
    vs.shown_as.assign(count, 0);
    vs.held.assign(lanes.all.size(), 0);
    vs.free.assign(lanes.all.size(), 0);
    vs.comers.reserve(count);
    make_room(c.roadway, vs.map, static_cast<uint32_t>(vs.places.size()));
    for (uint32_t n = 0; n < count; ++n) {
        Vehicle& v = vs.all[n];
        std::fill(std::begin(v.route), std::end(v.route), k_no_lane);
        v.stood_since = k_never;
        v.kind = n < vs.first_tram ? kind_by_chance(seed, n, has_buses) : VehicleKind::tram;
        v.taste = random_between(key_of(seed, n, 0), 0.82f, 1.02f, 60);
        set_somewhere(vs, c, n, n < vs.first_tram ? ends : tram_ends, seed);
        for (uint32_t s = 0; is_there(v) && s < sections_of(v); ++s) {
            VehiclePlace& place = vs.places[first_section(vs, n) + s];
            place = place_of(lanes, v, s);
            add_box(c.roadway, box_of(v, place), n);
        }
        if (is_there(v)) sort_boxes(c.roadway);
    }
    show_vehicles(vs, c);
    vs.previous = vs.places;
}

void step_vehicles(Vehicles& vs, Crowd& c, uint32_t tick, uint64_t seed) {
    if (vs.all.empty()) return;
    const auto count = static_cast<uint32_t>(vs.all.size());
    vs.previous = vs.places;
    find_held(vs);
    for (uint32_t n = tick % k_decision_ticks; n < count; n += k_decision_ticks)
        if (is_there(vs.all[n])) decide(vs, c, n, tick);
    grant(vs, tick);
    for (uint32_t n = 0; n < count; ++n)
        if (is_there(vs.all[n])) go_on(vs, c, n, tick, seed);
    bool has_come = vs.gates.empty() && vs.tram_gates.empty();
    for (uint32_t n = tick % k_enters; n < count && !has_come; n += k_enters)
        if (!is_there(vs.all[n])) has_come = come_in(vs, c, n, tick, seed);
    show_vehicles(vs, c);
}

uint64_t hash_vehicles(const Vehicles& vs) {
    return hash_bytes(vs.all.size(), vs.all.data(), vs.all.size() * sizeof(Vehicle));
}

}  // namespace flaneur
