// Where walkers want to go: goals, paths, and the velocity along them.
#include <algorithm>
#include <functional>

#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/crowd/crowd.h"
#include "sim/crowd/errand.h"

namespace flaneur {

static constexpr float k_stroll_reach = 150, k_least_stroll = 25;  // metres, from start to goal
static constexpr size_t k_paths_a_tick = 32;
static constexpr float k_corner_touch = 0.1f;   // a corner this near is passed, metres;
static constexpr float k_corner_reach = 0.5f;   // this near it is if the next one is in view,
static constexpr float k_corner_view = 2.5f;    // and so it is this near if one is level with it
static constexpr float k_goal_reach = 0.4f;     // a goal this near is reached
static constexpr float k_far_off = 3.5f;        // from the leg, metres: another way is sought
static constexpr float k_progress = 0.3f;       // metres nearer that count as progress
static constexpr uint32_t k_patience = 3 * 60;  // ticks without progress
static constexpr uint8_t k_most_stuck = 3;      // replans before the goal is given up
static constexpr Stay k_stroll_stay{1.5f, 6};   // at a goal without a name

static bool is_cheap(Surface s) { return s != Surface::road && s != Surface::grass; }

// Takes corners wider by the walker's own measure, so that a crowd does not queue for the same inch. The way
// turns about a corner's inner side, so its outer side is free; the mesh, the kind of ground and a clear view
// along both legs have the last word.
static void widen_corners(Crowd& c, const Navmesh& mesh, int thread, uint32_t i) {
    Vec3* corners = &c.corners[size_t{i} * k_corners];
    Vec3 previous = c.position[i];
    Vec3 before = previous;  // the corner before, as widened
    for (int k = 0; k + 1 < c.corner_count[i]; ++k) {
        Vec3 here = corners[k];
        Vec2 in = normalize_or(on_ground(here - previous), {0, 0});
        Vec2 out = normalize_or(on_ground(corners[k + 1] - here), {0, 0});
        previous = here;
        auto place = nearest(mesh, thread, here, {0.3f, 1.5f, 0.3f});
        if (!place) return;
        Vec2 outward = normalize_or(in - out, {0, 0});  // away from the inner side
        bool cheap = is_cheap(surface_of(mesh, place->polygon));
        for (float shift : {c.lateral[i], c.lateral[i] * 0.4f, 0.1f}) {
            NavPoint moved = move_along(mesh, thread, *place, here + at_height(outward * shift, 0));
            if (cheap && !is_cheap(surface_of(mesh, moved.polygon))) continue;
            if (!is_clear(mesh, before, moved.position) || !is_clear(mesh, moved.position, corners[k + 1])) {
                continue;
            }
            corners[k] = moved.position;
            break;
        }
        before = corners[k];
    }
}

static void choose_goal(Crowd& c, const Navmesh& mesh, int thread, uint32_t i, uint32_t tick, uint64_t seed) {
    constexpr uint32_t k_tries = 6;
    uint32_t trip = ++c.trip[i], home = island(mesh, c.polygon[i]);
    NavPoint here{c.position[i], c.polygon[i]};
    c.goal_facing[i] = {0, 0};
    c.goal_stay[i] = k_stroll_stay;
    if (auto chosen = choose_trip(c.demand, mesh, thread, here, tick, {seed, i, trip, Purpose::errand})) {
        c.goal[i] = chosen->place;
        c.goal_facing[i] = chosen->facing;
        c.goal_stay[i] = stay_at(chosen->kind);
        return;
    }
    float farthest = -1;
    for (uint32_t t = 0; t < k_tries; ++t) {
        RandomKey key{seed, i, trip, Purpose::destination};
        NavPoint p =
            random_place_near(mesh, on_ground(c.position[i]), k_stroll_reach, random_unit(key, t * 3),
                              random_unit(key, t * 3 + 1), random_unit(key, t * 3 + 2));
        if (island(mesh, p.polygon) != home) continue;
        float d = length(on_ground(p.position - c.position[i]));
        if (d <= farthest) continue;
        farthest = d;
        c.goal[i] = p;
        if (d >= k_least_stroll) break;
    }
    if (farthest < 0) c.goal[i] = {c.position[i], c.polygon[i]};
}

static void begin_leg(Crowd& c, uint32_t i, uint32_t tick) {
    c.leg_start[i] = on_ground(c.position[i]);
    c.closest[i] = 1e9f;
    c.closest_tick[i] = tick;
}

void plan_path(Crowd& c, const Navmesh& mesh, int thread, uint32_t i, uint32_t tick, uint64_t seed) {
    if (c.path_due[i] == static_cast<uint8_t>(PathDue::new_goal)) choose_goal(c, mesh, thread, i, tick, seed);
    Vec3* corners = &c.corners[size_t{i} * k_corners];
    int n = find_path(mesh, thread, {c.position[i], c.polygon[i]}, c.goal[i], corners, k_corners);
    c.corner[i] = 0;
    c.corner_count[i] = static_cast<uint8_t>(n);
    c.path_due[i] = static_cast<uint8_t>(PathDue::no);
    widen_corners(c, mesh, thread, i);
    begin_leg(c, i, tick);
}

// At the end of the way: the goal, or as far as the path reached.
static void arrive(Crowd& c, uint32_t i, uint32_t tick, uint64_t seed) {
    c.stuck[i] = 0;
    if (length(on_ground(c.goal[i].position - c.position[i])) > 2 * k_goal_reach &&
        c.errand[i] == Errand::wander) {
        c.path_due[i] = static_cast<uint8_t>(PathDue::same_goal);
        // A way that got no nearer will not next time either.
        if (length(on_ground(c.position[i]) - c.leg_start[i]) < 1)
            c.path_due[i] = static_cast<uint8_t>(PathDue::new_goal);
        return;
    }
    if (c.errand[i] == Errand::arrive) return;
    float pause =
        random_between({seed, i, c.trip[i], Purpose::pause}, c.goal_stay[i].least, c.goal_stay[i].most);
    c.pause_until[i] = tick + static_cast<uint32_t>(pause / k_tick);
    c.path_due[i] = static_cast<uint8_t>(PathDue::new_goal);
}

static float distance_to_segment(Vec2 p, Vec2 a, Vec2 b) {
    Vec2 ab = b - a;
    float t = clamp(dot(p - a, ab) / std::max(length_squared(ab), 1e-9f), 0, 1);
    return length(a + ab * t - p);
}

static Vec2 follow_path(Crowd& c, const Navmesh& mesh, uint32_t i, uint32_t tick, uint64_t seed) {
    const Vec3* corners = &c.corners[size_t{i} * k_corners];
    Vec2 p = on_ground(c.position[i]);
    while (c.corner[i] < c.corner_count[i]) {
        Vec2 here = on_ground(corners[c.corner[i]]), to = here - p;
        float distance = length(to);
        bool last = c.corner[i] + 1 == c.corner_count[i];
        bool passed = distance < (last ? k_goal_reach : k_corner_touch);
        if (!last && !passed && distance < k_corner_view) {
            // Near or level with the corner, seen along the way that leaves it, and the next one in view.
            Vec3 next = corners[c.corner[i] + 1];
            Vec2 in = normalize_or(here - c.leg_start[i], {0, 0}),
                 out = normalize_or(on_ground(next) - here, {0, 0});
            bool level = dot(in + out, to) <= 0 && dot(out, to) <= 0.3f;
            passed = (level || distance < k_corner_reach) && is_clear(mesh, c.position[i], next);
        }
        if (!passed) {
            if (distance < c.closest[i] - k_progress) {
                if (c.closest[i] < 1e8f) {  // else a leg has only begun
                    c.stuck[i] = 0;
                    if (c.jam[i] > 0) --c.jam[i];
                }
                c.closest[i] = distance;
                c.closest_tick[i] = tick;
            }
            float off = distance_to_segment(p, c.leg_start[i], here);
            if (tick - c.closest_tick[i] > k_patience || off > k_far_off) {
                // Who only cannot get to a place where somebody stands is in no jam.
                bool at_goal = last && distance < k_corner_view;
                if (!at_goal && c.jam[i] < k_most_jam) ++c.jam[i];
                bool give_up = ++c.stuck[i] > k_most_stuck && c.errand[i] == Errand::wander;
                c.path_due[i] = static_cast<uint8_t>(give_up ? PathDue::new_goal : PathDue::same_goal);
                c.closest_tick[i] = tick;
                if (give_up) c.stuck[i] = 0;
            }
            float speed = c.preferred_speed[i];
            if (last) speed = std::min(speed, distance / 0.7f);
            return to * (speed / std::max(distance, 1e-4f));
        }
        ++c.corner[i];
        if (last) {
            arrive(c, i, tick, seed);
        } else {
            c.leg_start[i] = here;
            c.closest[i] = 1e9f;
            c.closest_tick[i] = tick;
        }
    }
    return {0, 0};
}

void think(Crowd& c, const City&, const Navmesh& mesh, Workers& workers, uint32_t tick, uint64_t seed) {
    // Paths, for the first walkers due from where the last tick stopped.
    c.requests.clear();
    uint32_t last = c.next_path;
    for (uint32_t k = 0; k < c.count && c.requests.size() < k_paths_a_tick; ++k) {
        uint32_t i = c.next_path + k < c.count ? c.next_path + k : c.next_path + k - c.count;
        if (c.path_due[i] == static_cast<uint8_t>(PathDue::no) || tick < c.pause_until[i]) continue;
        c.requests.push_back(i);
        last = i + 1 < c.count ? i + 1 : 0;
    }
    c.next_path = last;
    auto plan_some = [&](size_t begin, size_t end, int thread) {
        for (size_t r = begin; r < end; ++r) plan_path(c, mesh, thread, c.requests[r], tick, seed);
    };
    parallel_for(workers, c.requests.size(), 1, std::ref(plan_some));

    uint32_t phase = tick % k_decision_ticks;
    size_t due = (c.count + k_decision_ticks - 1 - phase) / k_decision_ticks;
    auto follow_some = [&](size_t begin, size_t end, int) {
        for (size_t k = begin; k < end; ++k) {
            auto i = static_cast<uint32_t>(k * k_decision_ticks + phase);
            c.looks[i] = tick < c.pause_until[i];
            c.wanted[i] = c.looks[i] ? Vec2{0, 0} : follow_path(c, mesh, i, tick, seed);
        }
    };
    parallel_for(workers, due, 256, std::ref(follow_some));
}

}  // namespace flaneur
