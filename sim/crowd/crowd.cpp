#include "sim/crowd/crowd.h"

#include <bit>
#include <cassert>

#include "sim/base/hash.h"

namespace flaneur {

Crowd make_crowd(uint32_t capacity) {
    Crowd c;
    c.capacity = capacity;
    size_t n = capacity;
    auto reserve = [n](auto&... arrays) { (arrays.resize(n), ...); };
    reserve(c.position, c.velocity, c.heading, c.turn_rate, c.polygon, c.under, c.preferred_speed, c.radius,
            c.lateral, c.body, c.scale, c.errand, c.goal, c.goal_facing, c.goal_stay, c.trip, c.pause_until,
            c.corner, c.corner_count, c.path_due, c.leg_start, c.closest, c.closest_tick, c.stuck, c.jam,
            c.wanted, c.looks, c.chosen, c.neighbour_count, c.next_position, c.next_velocity, c.next_polygon,
            c.cell, c.sorted);
    c.corners.resize(n * k_corners);
    c.neighbours.resize(n * k_neighbours);
    c.requests.reserve(n);
    // About two cells a walker, at least 32 x 32.
    uint32_t cells = std::max(1024u, std::bit_ceil(capacity * 2));
    c.cells_x = 1u << ((std::bit_width(cells) - 1) / 2);
    c.cells_z = cells / c.cells_x;
    c.cell_first.resize(cells + 1);
    return c;
}

uint32_t add_walker(Crowd& c, const City& city, const Walker& w) {
    assert(c.count < c.capacity && w.place.polygon != 0);
    uint32_t i = c.count++;
    Vec3 p = w.place.position;
    if (auto hit = ground(city, p, 1, 2)) {
        p.y = hit->height;
        c.under[i] = *hit;
    }
    c.position[i] = p;
    c.polygon[i] = w.place.polygon;
    c.heading[i] = w.heading;
    c.preferred_speed[i] = w.preferred_speed;
    c.radius[i] = w.radius;
    c.lateral[i] = w.lateral;
    c.body[i] = w.body;
    c.scale[i] = w.scale;
    c.errand[i] = w.errand;
    c.goal[i] = {p, w.place.polygon};
    c.path_due[i] = static_cast<uint8_t>(w.errand == Errand::wander ? PathDue::new_goal : PathDue::no);
    return i;
}

void send_to(Crowd& c, uint32_t i, NavPoint goal) {
    c.goal[i] = goal;
    c.pause_until[i] = 0;
    c.path_due[i] = static_cast<uint8_t>(PathDue::same_goal);
}

bool has_arrived(const Crowd& c, uint32_t i) {
    return c.path_due[i] == static_cast<uint8_t>(PathDue::no) && c.corner[i] >= c.corner_count[i];
}

void step_crowd(Crowd& crowd, const City& city, const Navmesh& mesh, Workers& workers, uint32_t tick,
                uint64_t seed) {
    think(crowd, city, mesh, workers, tick, seed);
    find_neighbours(crowd, workers, tick);
    steer(crowd, mesh, workers, tick);
    move(crowd, city, mesh, workers);
}

uint64_t hash_crowd(const Crowd& c) {
    uint64_t h = mix(c.count ^ uint64_t{c.next_path} << 32);
    auto add = [&](const auto&... arrays) {
        ((h = hash_bytes(h, arrays.data(), c.count * sizeof(arrays[0]))), ...);
    };
    add(c.position, c.velocity, c.heading, c.turn_rate, c.polygon, c.preferred_speed, c.radius, c.lateral,
        c.body, c.scale, c.errand, c.goal, c.goal_facing, c.goal_stay, c.trip, c.pause_until, c.corner,
        c.corner_count, c.path_due, c.leg_start, c.closest, c.closest_tick, c.stuck, c.jam, c.wanted, c.looks,
        c.chosen, c.neighbour_count);
    for (uint32_t i = 0; i < c.count; ++i) {
        const Vec3* corners = &c.corners[size_t{i} * k_corners];
        h = hash_bytes(h, corners + c.corner[i], (c.corner_count[i] - c.corner[i]) * sizeof(Vec3));
        h = hash_bytes(h, &c.neighbours[size_t{i} * k_neighbours], c.neighbour_count[i] * sizeof(uint32_t));
    }
    return h;
}

}  // namespace flaneur
