// Everyone moves as legs can follow the chosen velocity, and never off the mesh.
#include <algorithm>
#include <cmath>
#include <functional>

#include "sim/crowd/crowd.h"
#include "sim/crowd/locomotion.h"

namespace flaneur {

static constexpr float k_overlap = 0.015f;  // metres that bodies may press into each other
static constexpr float k_push = 0.008f;     // metres that they are parted by in a tick, at most
static constexpr size_t k_together = 64;    // walkers whose ground is asked for at once
static constexpr int k_pushers = 6;         // the nearest neighbours that can press

static Vec2 push_apart(const Crowd& c, uint32_t i) {
    Vec2 push{0, 0};
    const uint32_t* ids = &c.neighbours[size_t{i} * k_neighbours];
    for (int k = 0; k < std::min<int>(c.neighbour_count[i], k_pushers); ++k) {
        uint32_t j = ids[k];
        Vec2 away = on_ground(c.position[i] - c.position[j]);
        float touching = std::max(room_between(c, i, j) - k_overlap, 0.0f);
        float d2 = length_squared(away);
        if (d2 >= touching * touching) continue;
        float d = std::sqrt(d2);
        Vec2 direction = d > 1e-5f ? away / d : Vec2{i < j ? 1.0f : -1.0f, 0};
        push += direction * ((touching - d) * 0.5f);
    }
    float l = length(push);
    return l > k_push ? push * (k_push / l) : push;
}

// All but the height of the ground where it comes to.
static void move_walker(Crowd& c, const Navmesh& mesh, int thread, uint32_t i) {
    Motion motion =
        next_motion({c.velocity[i], c.heading[i], c.turn_rate[i]}, wish_on(c.under[i], c.chosen[i]), k_tick,
                    c.looks[i] ? c.goal_facing[i] : Vec2{0, 0});
    c.heading[i] = motion.heading;
    c.turn_rate[i] = motion.turn_rate;
    Vec2 v = motion.velocity;
    float speed = length(v);

    Vec3 from = c.position[i];
    Vec2 step = v * k_tick + push_apart(c, i);
    NavPoint to = move_along(mesh, thread, {from, c.polygon[i]}, from + at_height(step, 0));
    Vec2 moved = on_ground(to.position - from);
    // Stopped or turned aside by the border: velocity is what became of it.
    if (length_squared(moved - step) > 1e-8f) {
        Vec2 real = moved / k_tick;
        float r = length(real);
        v = r > speed ? real * (speed / r) : real;
    }
    to.position.y = from.y;
    c.next_position[i] = to.position;
    c.next_velocity[i] = v;
    c.next_polygon[i] = to.polygon;
}

void move(Crowd& c, const City& city, const Navmesh& mesh, Workers& workers) {
    // In the order of places, so that walkers who share ground and mesh find them in the cache.
    auto move_some = [&](size_t begin, size_t end, int thread) {
        Vec3 places[k_together];
        std::optional<GroundHit> hits[k_together];
        for (size_t first = begin; first < end; first += k_together) {
            size_t count = std::min(k_together, end - first);
            for (size_t k = 0; k < count; ++k) {
                uint32_t i = c.sorted[first + k].id;
                move_walker(c, mesh, thread, i);
                places[k] = c.next_position[i];
            }
            ground(city, {places, count}, 0.5f, 1.5f, hits);
            for (size_t k = 0; k < count; ++k) {
                if (!hits[k]) continue;
                uint32_t i = c.sorted[first + k].id;
                c.next_position[i].y = hits[k]->height;
                c.under[i] = *hits[k];
            }
        }
    };
    parallel_for(workers, c.count, 256, std::ref(move_some));
    c.position.swap(c.next_position);
    c.velocity.swap(c.next_velocity);
    c.polygon.swap(c.next_polygon);
}

}  // namespace flaneur
