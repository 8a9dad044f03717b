// Everyone moves as legs can follow the chosen velocity, and never off the mesh.
#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/base/spans.h"
#include "sim/base/tick.h"
#include "sim/crowd/crowd.h"
#include "sim/crowd/deciders.h"
#include "sim/crowd/half_planes.h"
#include "sim/crowd/locomotion.h"
#include "sim/crowd/places.h"
#include "sim/lanes/near.h"

namespace flaneur {

static constexpr float k_overlap = 0.015f;    // metres that bodies may press into each other for long
static constexpr float k_push = 0.5f;         // m/s that they are parted by, at most
static constexpr float k_nearing = 6;         // m/s that two who walk can near each other, at most
static constexpr float k_sees_coming = 0.6f;  // metres between bodies from which on one brakes for another
static constexpr float k_comfortable = 2;     // m/s2, of that
static constexpr float k_rounding = 1e-3f;    // m/s, of places two hundred metres out
static constexpr float k_hardest = 3.2f;      // m/s2, of one who brakes for a border or for others
static constexpr float k_slow = 0.05f, k_foresees = 0.05f;         // m/s, seconds
static constexpr float k_sees_end = 1.4f, k_before_end = 0.2f;     // metres, of one with a pram
static constexpr float k_swings_clear = 0.1f, k_swings_by = 0.1f;  // metres, of a pram that turns
static constexpr float k_back = 0.02f;    // metres from the mesh at which one is on it again
static constexpr size_t k_together = 64;  // walkers whose ground is asked for at once
static constexpr int k_contacts = k_most_planes, k_within = 256;  // who count, of those within reach

namespace {

// What those who are so near that one might step into them leave of a walker's velocities.
struct Contacts {
    HalfPlane planes[k_contacts];
    int count = 0;
    HalfPlane brakes[k_contacts];  // of wish and velocity, ahead of others and of borders, evenly
    int brake_count = 0;
    Vec2 push{0, 0};                   // m/s, that parts those who overlap
    bool by_pram[2] = {false, false};  // somebody is where a turn to less, to more would bring the pram
};

}  // namespace

// Only what one who goes no faster than `fastest` may come to: in a throng, in the many ticks of who is afar,
// far more are within reach.
static void add_plane(Contacts& out, const HalfPlane& plane, float fastest) {
    if (plane.offset > -fastest && out.count < k_contacts) out.planes[out.count++] = plane;
}

// m/s that one comes to in a step, at most.
static float fastest_of(Vec2 wish, Vec2 velocity) {
    return std::max(length(wish), length(velocity)) + k_push + k_rounding;
}

// Metres between bodies within which one minds others who goes so many seconds at once.
static float mindful_reach(float dt) { return std::max(k_sees_coming, k_nearing * dt); }

// The speed from which one who brakes comfortably, tick by tick, stops in so many metres.
static float fastest_within(float room, float dt) {
    const float last = 0.5f * k_comfortable * dt;
    return std::sqrt(2 * k_comfortable * room + last * last) - last;
}

// Nobody goes faster than `nearing` towards somebody, who is against `direction`.
static void add_brake(Contacts& out, Vec2 direction, float nearing, Vec2 wish, Vec2 velocity) {
    const float wished = -dot(wish, direction), is = -dot(velocity, direction);
    if (std::max(wished, is) > nearing && out.brake_count < k_contacts)
        out.brakes[out.brake_count++] = {direction, -nearing};
}

// Who lies does not make room: nobody steps on any part of it, nor pushes a pram over one, and whom it has
// fallen on gets off. `place` and `radius` are of who comes, or its pram; `from` is where the other's hips
// are.
static void add_lying(const Downed& down, Vec2 from, Vec2 place, float radius, Vec2 wish, Vec2 velocity,
                      float dt, Contacts& out) {
    for (const LyingPart& part : down.parts) {
        if (part.radius <= 0) continue;
        const Vec2 away = place - from - part.from;
        const float touching = radius + part.radius, d = length(away);
        if (d > touching + mindful_reach(dt)) continue;
        const Vec2 direction = d > 1e-5f ? away / d : Vec2{1, 0};
        add_brake(out, direction, fastest_within(std::max(d - touching, 0.0f), dt), wish, velocity);
        if (d > touching + k_nearing * dt) continue;
        add_plane(out, {direction, -std::max(d - touching, 0.0f) / dt}, fastest_of(wish, velocity));
        if (d < touching) out.push += direction * (0.5f * (touching - d) / dt);
    }
}

// A pram is not pushed into anybody; who comes into its way himself is only steered clear of.
static void add_contacts_of_pram(const Crowd& c, uint32_t at, Vec2 wish, float dt, Contacts& out) {
    const Seen& me = c.scratch.seen.all[at];
    const Vec2 velocity = c.motion.velocity[me.id];
    const Vec3 middle = me.position + at_height(me.ahead, 0);
    uint32_t near[k_within];
    const bool any_down = !c.downed.empty();
    const float reach = k_pram_radius + c.widest + mindful_reach(dt) + (any_down ? k_lying_reach : 0);
    const int count = find_within(c.scratch, middle, at, reach, near, k_within);
    for (int k = 0; k < count; ++k) {
        const Seen& other = c.scratch.seen.all[near[k]];
        if (const Downed* down = any_down ? own_of(c.downed, other.id) : nullptr)
            add_lying(*down, on_ground(other.position), on_ground(middle), k_pram_radius, wish, velocity, dt,
                      out);
        Vec2 away = on_ground(middle - other.position);
        float touching = k_pram_radius + other.radius, d = length(away);
        if (d > touching + mindful_reach(dt) || d < 1e-5f) continue;
        Vec2 direction = away / d;
        float room = std::max(d - touching, 0.0f), leaves = -dot(other.velocity, direction);
        float nearing = fastest_within(room, dt) + std::max(leaves, 0.0f);
        add_brake(out, direction, nearing, wish, velocity);
        if (room < k_swings_clear) {
            const float swing = dot(direction, {me.ahead.z, -me.ahead.x});
            out.by_pram[swing < 0] |= std::fabs(swing) > k_swings_by;
        }
        if (d < touching + k_nearing * dt)
            add_plane(out, {direction, -0.5f * room / dt}, fastest_of(wish, velocity));
    }
}

// Nobody walks into a vehicle, and whom one has come to gets off it.
static void add_vehicles(const Roadway& r, const Seen& me, Vec2 wish, Vec2 velocity, float dt,
                         Contacts& out) {
    constexpr float k_apart = 0.03f;  // metres
    const Vec2 p = on_ground(me.position);
    if (!is_near_vehicles(r, p)) return;
    for_boxes_near(r, p, me.radius + mindful_reach(dt), [&](uint32_t k) {
        const VehicleBox& box = r.boxes[k];
        if (std::fabs(box.y - me.position.y) > k_other_level) return;
        const OffBox off = off_box(box, p);
        const float far = off.far - me.radius, room = std::max(far - k_apart, 0.0f);
        if (far > mindful_reach(dt)) return;
        const float leaves = std::max(-dot(box.ahead, off.out) * box.speed, 0.0f);
        add_brake(out, off.out, fastest_within(room, dt) + leaves, wish, velocity);
        if (far > k_nearing * dt) return;
        add_plane(out, {off.out, -room / dt}, fastest_of(wish, velocity));
        if (far < 0) out.push += off.out * std::min(-far / dt, k_push);
    });
}

// Each of two who are near takes half of the gap between them at most, along the line between them: so no
// step brings them nearer than k_most_overlap allows, whatever both do.
static Contacts contacts_of(const Crowd& c, uint32_t at, Vec2 wish, float dt) {
    const Seen& me = c.scratch.seen.all[at];
    const Vec2 velocity = c.motion.velocity[me.id];
    Contacts out;
    uint32_t near[k_within];
    const bool any_down = !c.downed.empty();
    const float off = any_down && own_of(c.called, me.id) ? k_beside_who_lies : k_off_who_lies;
    const float reach = me.radius + c.widest + mindful_reach(dt) + (any_down ? k_lying_reach : 0);
    const int count = find_within(c.scratch, me.position, at, reach, near, k_within);
    for (int k = 0; k < count; ++k) {
        const Seen& other = c.scratch.seen.all[near[k]];
        if (const Downed* down = any_down ? own_of(c.downed, other.id) : nullptr)
            add_lying(*down, on_ground(other.position), on_ground(me.position), me.radius + off, wish,
                      velocity, dt, out);
        Vec2 away = on_ground(me.position - other.position);
        float touching = me.radius + other.radius, d2 = length_squared(away);
        if (d2 > (touching + mindful_reach(dt)) * (touching + mindful_reach(dt))) continue;
        float d = std::sqrt(d2);
        Vec2 direction = d > 1e-5f ? away / d : Vec2{me.id < other.id ? 1.0f : -1.0f, 0};
        float gap = std::max(d - (touching - k_most_overlap), 0.0f);
        // No faster towards the other than one can stop, or than it goes away.
        float leaves = -dot(other.velocity, direction);
        float room = std::max(d - touching, 0.0f) * (leaves < 0 ? 0.5f : 1.0f);
        float nearing = fastest_within(room, dt) + std::max(leaves, 0.0f);
        add_brake(out, direction, nearing, wish, velocity);
        if (d > touching + k_nearing * dt) continue;
        add_plane(out, {direction, -0.5f * gap / dt}, fastest_of(wish, velocity));
        float overlap = touching - k_overlap - d;
        if (overlap > 0) out.push += direction * (0.5f * overlap / dt);
    }
    if (has_traffic(c.roadway)) add_vehicles(c.roadway, me, wish, velocity, dt, out);
    if (c.identity.ahead[me.id] > 0) add_contacts_of_pram(c, at, wish, dt, out);
    float l = length(out.push);
    if (l > k_push) out.push = out.push * (k_push / l);
    return out;
}

// Where the mesh does not let one who goes on by `ahead`, and comes to `end`, go on straight, one comes no
// nearer than `before`, as evenly as one can stop.
static void add_brake_at_border(const Navmesh& mesh, NavPoint from, Vec2 ahead, NavPoint end, float before,
                                float dt, Contacts& out) {
    if (out.brake_count == k_contacts) return;
    const Vec2 moved = on_ground(end.position - from.position);
    Vec2 inward;
    float room = 0;
    if (length(ahead - moved) >= 0.002f) {
        inward = normalize_or(moved - ahead, {0, 0});
        room = -dot(moved, inward);
    } else {
        // It comes there, but maybe round a corner.
        if (end.polygon == from.polygon) return;
        const auto border = first_border(mesh, from.position, end.position);
        if (!border) return;
        inward = inward_of(*border);
        room = dot(on_ground(from.position) - on_ground(border->a), inward);
    }
    out.brakes[out.brake_count++] = {inward, -fastest_within(std::max(room - before, 0.0f), dt)};
}

// What the brakes leave of velocity `v`, which was `was` a tick ago, as hard as one can stop.
static Vec2 braked(const Contacts& near, Vec2 was, Vec2 v, float dt) {
    Vec2 left = v;
    // Twice, since what keeps to one may press against another.
    for (int pass = 0; pass < 2; ++pass)
        for (int k = 0; k < near.brake_count; ++k) {
            const HalfPlane& brake = near.brakes[k];
            left += brake.normal * std::max(brake.offset - dot(left, brake.normal), 0.0f);
        }
    const float change = length(left - was), most = std::max(k_hardest * dt, length(v - was));
    if (change > most) left = was + (left - was) * (most / change);
    // Who turns quickly does not brake as quickly.
    const float speed = length(left), least = std::min(length(v), length(was) - k_hardest * dt);
    return speed < least && speed > 0 ? left * (least / speed) : left;
}

// The largest share, 0..1, of velocity `v` that keeps to all planes.
static float share_within(const Contacts& near, Vec2 v) {
    float share = 1;
    for (int k = 0; k < near.count; ++k) {
        float along = dot(v, near.planes[k].normal), most = near.planes[k].offset;
        if (along < most - k_rounding) share = std::min(share, most / along);
    }
    return share;
}

// Where one with a pram that something stands before turns it, on the spot: to where it is to go, by the
// other way round if somebody is in the way, or nowhere.
static Vec2 turns_pram_to(const Contacts& near, float heading, Vec2 wanted) {
    if (wanted == Vec2{}) return wanted;
    const float to_turn = wrap_angle(heading_of(wanted) - heading);
    const bool more = to_turn > 0;
    if (!near.by_pram[more]) return wanted;
    if (near.by_pram[!more] || std::fabs(to_turn) < k_pi / 2) return {0, 0};
    return heading_direction(heading + (more ? -k_pi / 2 : k_pi / 2));
}

// Of one that others move: only so far as those whom it touches, or would step into, shift it.
static void shift_led(Crowd& c, uint32_t at, float dt) {
    CrowdMotion& m = c.motion;
    const uint32_t i = c.scratch.seen.all[at].id;
    const Contacts near = contacts_of(c, at, m.velocity[i], dt);
    Vec2 step = m.velocity[i] + near.push;
    if (share_within(near, step) < 1)
        step = best_velocity(near.planes, near.count, near.count, length(step), step);
    m.position[i] += at_height((step - m.velocity[i]) * dt, 0);
}

// All but the height of the ground where it comes to.
static void move_walker(Crowd& c, const Navmesh& mesh, int thread, uint32_t at, float dt) {
    uint32_t i = c.scratch.seen.all[at].id;
    CrowdMotion& m = c.motion;
    if (is_down(c, i) || stays_put(c, i)) {
        m.velocity[i] = m.wish[i] = {};
        if (stays_put(c, i)) m.turn_rate[i] = 0;
        return;
    }
    if (is_led(c, i)) return shift_led(c, at, dt);
    const bool pushes = c.identity.ahead[i] > 0;
    const By by = pushes ? By::wheels : By::feet;
    Vec2 wish = wish_on(m.under[i], c.decision.chosen[i], c.identity.stair_pace[i]);
    const NavPoint from{m.position[i], m.polygon[i]};
    Contacts near = contacts_of(c, at, wish, dt);
    const bool is_beside = c.way_back[i].polygon != 0;
    const Passage* passage = is_beside ? passage_by_door(c, i) : nullptr;
    auto end_of = [&](Vec2 ahead, By who) {
        return move_along(mesh, thread, from, from.position + at_height(ahead, 0), who);
    };
    // The mesh ends for wheels at the foot of steps, where it goes on for everybody else.
    if (pushes && !is_beside)
        for (Vec2 way : {wish, m.velocity[i]}) {
            const Vec2 ahead = normalize_or(way, {0, 0}) * k_sees_end;
            const NavPoint end = end_of(ahead, By::wheels);
            if (end.position != end_of(ahead, By::feet).position)
                add_brake_at_border(mesh, from, ahead, end, k_before_end, dt, near);
        }
    const float going = length(m.velocity[i]);
    if (!is_beside && going > k_slow) {
        const Vec2 ahead = m.velocity[i] * (going / (2 * k_comfortable) + k_foresees);
        add_brake_at_border(mesh, from, ahead, end_of(ahead, by), 0, dt, near);
    }
    const Vec2 wished = wish;
    if (near.brake_count > 0)
        wish = best_velocity(near.brakes, near.brake_count, near.brake_count, length(wish), wish);
    // Who slows down for others, or pushes something, does not finish a step before.
    const bool hurries =
        pushes || wish != wished || length(c.decision.chosen[i]) < length(c.decision.wanted[i]) - k_slow;
    const Called* called = c.called.empty() ? nullptr : own_of(c.called, i);
    const Vec2 looks_at = c.decision.looks[i] ? (called                      ? called->facing
                                                 : waits_at_kerb(c.kerbs, i) ? faces_over(c.kerbs, i)
                                                                             : c.journeys[i].facing)
                          : pushes            ? turns_pram_to(near, m.heading[i], c.decision.wanted[i])
                                              : Vec2{0, 0};
    Motion motion = next_motion({.velocity = m.velocity[i],
                                 .heading = m.heading[i],
                                 .turn_rate = m.turn_rate[i],
                                 .aim = hurries ? Vec2{} : m.wish[i],
                                 .brakes = m.brakes[i],
                                 .feet = m.feet[i]},
                                wish, dt, looks_at, pushes ? c.identity.ahead[i] - k_axle_to_middle : 0);
    m.wish[i] = motion.aim;
    m.heading[i] = motion.heading;
    m.turn_rate[i] = motion.turn_rate;
    m.brakes[i] = motion.brakes;
    Vec2 v = braked(near, m.velocity[i], motion.velocity, dt);
    float speed = length(v);

    Vec2 step = v + near.push;
    if (share_within(near, step) < 1)
        step = best_velocity(near.planes, near.count, near.count, length(step), step);
    auto go_on = [&](Vec2 way) {
        const Vec3 wanted = from.position + at_height(way * dt, 0);
        if (passage) return NavPoint{kept_in_line(passage->door, from.position, wanted), from.polygon};
        return is_beside ? NavPoint{wanted, from.polygon} : move_along(mesh, thread, from, wanted, by);
    };
    NavPoint to = go_on(step);
    Vec2 real = on_ground(to.position - from.position) / dt;
    // Along a wall one may have slid into somebody; and places are rounded.
    for (float less : {0.98f, 0.7f, 0.0f}) {
        float share = share_within(near, real);
        if (share >= 1) break;
        to = less > 0 ? go_on(real * (less * share)) : from;
        real = on_ground(to.position - from.position) / dt;
    }
    // Stopped or turned aside by the border or by others: velocity is what became of it, but for what only
    // kept one from being pushed.
    Vec2 change = real - v - near.push;
    if (length_squared(change) > 1e-4f * 0.36f) {
        const float push = length(near.push);
        const Vec2 pushed = normalize_or(near.push, {0, 0});
        real = v + change + pushed * clamp(-dot(change, pushed), 0, push);
        float r = length(real);
        v = r > speed ? real * (speed / r) : real;
    }
    if (is_beside && !(passage && passage->kind == Passage::Kind::out)) {
        const NavPoint on_it = move_along(mesh, thread, c.way_back[i], to.position, by);
        if (length(on_ground(on_it.position - to.position)) < k_back) to = on_it, c.way_back[i] = {};
    }
    to.position.y = from.position.y;
    m.position[i] = to.position;
    m.velocity[i] = v;
    m.polygon[i] = to.polygon;
}

namespace {
// Walkers whose ground is asked for at once.
struct Together {
    uint32_t who[k_together];
    Vec3 places[k_together];
    size_t count = 0;
};
}  // namespace

// Sets those who have moved onto the ground.
static void set_down(Crowd& c, const Surroundings& around, const Navmesh& mesh, Together& moved) {
    std::optional<GroundHit> hits[k_together];
    ground_at(around, {moved.places, moved.count}, 0.5f, 1.5f, hits);
    for (size_t k = 0; k < moved.count; ++k) {
        if (!hits[k]) continue;
        const uint32_t i = moved.who[k];
        Vec3& place = c.motion.position[i];
        place.y = hits[k]->height;
        c.motion.under[i] = *hits[k];
        if (is_near_steps(mesh, on_ground(place)))
            c.motion.under[i] = slowing_ground(around, *hits[k], place, c.motion.velocity[i],
                                               length(c.decision.chosen[i]), c.identity.stair_pace[i]);
    }
    moved.count = 0;
}

void move(Crowd& c, const Surroundings& around, const Navmesh& mesh, Workers& workers, uint32_t tick) {
    // In the order of places, so that walkers who share ground and mesh find them in the cache.
    parallel_for(workers, c.slots.living.size(), 256, [&](size_t begin, size_t end, int thread) {
        Together moved;
        for (size_t at = begin; at < end; ++at) {
            const uint32_t i = c.scratch.order[at], ticks = ticks_due(c, i / k_block, tick);
            if (ticks == 0) continue;
            move_walker(c, mesh, thread, static_cast<uint32_t>(at), static_cast<float>(ticks) * k_tick);
            moved.who[moved.count] = i;
            moved.places[moved.count++] = c.motion.position[i];
            if (moved.count == k_together) set_down(c, around, mesh, moved);
        }
        set_down(c, around, mesh, moved);
    });
}

}  // namespace flaneur
