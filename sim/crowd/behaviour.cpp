// Where walkers want to go: goals, paths, and the velocity along them.
#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/base/planar.h"
#include "sim/base/rng.h"
#include "sim/base/spans.h"
#include "sim/crowd/crowd.h"
#include "sim/crowd/errand.h"

namespace flaneur {

static constexpr float k_stroll_reach = 150, k_least_stroll = 25;  // metres, from start to goal
static constexpr size_t k_paths_a_tick = 32;                       // at least, and
static constexpr uint32_t k_for_each_path = 4096;                  // one for so many walkers
static constexpr uint32_t k_traffic_ticks = 20 * 60;  // how often it is looked at where people crowd,
static constexpr float k_traffic_share = 1 / 300.0f;  // and what of it is put in a tick: all in five seconds
static constexpr float k_corner_touch = 0.1f;         // a corner this near is gone round, metres,
static constexpr uint32_t k_rounds = 90;              // for so many ticks, and then is passed;
static constexpr float k_corner_reach = 0.5f;         // this near it is if the next one is in view,
static constexpr float k_corner_view = 2.5f;          // and so it is this near if one is level with it
static constexpr float k_goal_reach = 0.4f;           // a goal this near is reached
static constexpr float k_threshold_reach = 0.2f;      // and a threshold
static constexpr float k_far_off = 3.5f;              // from the stretch, metres: another path is sought
static constexpr float k_progress = 0.3f;             // metres nearer that count as progress
static constexpr uint32_t k_patience = 3 * 60;        // ticks without progress
static constexpr uint8_t k_most_stuck = 3;            // replans before the goal is given up
static constexpr int k_widened = 2;                   // corners ahead that are widened
static constexpr float k_least_onward = 0.8f;         // cosine between the ways to it and to the corner
static constexpr uint32_t k_blocked = 16;             // ticks without progress: is the corner in view?
static constexpr uint32_t k_waits = 30;               // ticks without progress: others are at the corner,
static constexpr float k_turns = 0.3f;                // where the way turns by some 35 degrees at least
static constexpr float k_held_up = 110;               // ticks without progress after which one hurries,
static constexpr uint32_t k_hurries = 10 * 60;        // for so many ticks
static constexpr float k_own_half = 0.45f;     // of the room from a corner to the border across from it
static constexpr uint32_t k_lifts = 5 * 60;    // ticks that one with a pram insists before it is lifted,
static constexpr uint32_t k_insist = 40 * 60;  // ticks that one insists, at most,
static constexpr float k_past = 3;             // and metres that it gets on
static constexpr float k_haste = 1.1f;         // times the preferred speed, at most, of one who gets out of
static constexpr float k_least_haste = 0.3f;   // others' way; m/s
static constexpr float k_back_within = 2;      // metres ahead, in which one comes back from the road
static constexpr float k_course = 3;           // metres ahead, of a course
static constexpr uint32_t k_retry = 60;        // ticks until a path that was not there is sought again
static constexpr float k_back_ahead = 0.4f;    // seconds
static constexpr uint8_t k_door_tries = 4;     // until one leaves where it stands
static constexpr float k_by_door = 1.1f;       // m/s, at most, of one who goes through a door
static constexpr float k_door_ahead = 0.4f;    // metres, that it looks ahead
static constexpr float k_for_others = 0.5f;    // of the pace, below which one rather waits for others
static constexpr float k_stands_for_them = 0.2f;  // and as good as stands
static constexpr Stay k_stroll_stay{1.5f, 6};     // at a goal without a name

static bool is_cheap(Surface s) { return s != Surface::road && s != Surface::grass; }

static std::optional<NavPoint> place_of_corner(const Navmesh& mesh, int thread, Vec3 corner) {
    return nearest(mesh, thread, corner, {0.3f, 1.5f, 0.3f});
}

// Takes corner k of a path, which is at `place`, elsewhere, or less far so; the mesh, the kind of ground and
// a clear view along both stretches have the last word. `in`: the way that led to it.
static void shift_corner(Crowd& c, const Navmesh& mesh, int thread, uint32_t i, int k, NavPoint place,
                         Vec2 in, Vec2 by) {
    const Journey& j = c.journeys[i];
    Vec3* corners = &c.corners[size_t{i} * k_corners];
    Vec3& corner = corners[k];
    const Vec3 here = k > j.corner ? corners[k - 1] : c.motion.position[i], next = corners[k + 1];
    const bool cheap = is_cheap(surface_of(mesh, place.polygon));
    for (float share : {1.0f, 0.4f, 0.1f}) {
        const Vec3 wanted = corner + at_height(by * share, 0);
        const NavPoint moved = move_along(mesh, thread, place, wanted, by_of(c, i));
        const Vec2 way = on_ground(moved.position - here);
        if (dot(way, in) < k_least_onward * length(way)) continue;
        if (cheap && !is_cheap(surface_of(mesh, moved.polygon))) continue;
        if (!is_clear(mesh, here, moved.position) || !is_clear(mesh, moved.position, next)) continue;
        corner = moved.position;
        return;
    }
}

// The path turns about a corner's inner side: which way its outer side is, that is free.
static Vec2 outward_of(Vec2 in, Vec2 out) { return normalize_or(in - out, {0, 0}); }

// Takes the next of the corners ahead wider by the walker's own measure, so that a crowd does not queue for
// the same inch.
static void widen_corner(Crowd& c, const Navmesh& mesh, int thread, uint32_t i, int k) {
    Journey& j = c.journeys[i];
    if (k + 1 >= j.corner_count) return;
    const Vec3* corners = &c.corners[size_t{i} * k_corners];
    const Vec3 corner = corners[k];
    const Vec2 in = normalize_or(on_ground(corner) - j.turned_at, {0, 0}),
               out = normalize_or(on_ground(corners[k + 1] - corner), {0, 0});
    const Vec2 outward = outward_of(in, out);
    j.turned_at = on_ground(corner);
    const auto place = place_of_corner(mesh, thread, corner);
    if (!place) return;
    // Of a narrow place one's own half: who comes from the other side turns about its other border.
    const float lateral = c.identity.lateral[i];
    const NavPoint across =
        move_along(mesh, thread, *place, corner + at_height(outward * (2 * lateral), 0), by_of(c, i));
    const float most = k_own_half * length(on_ground(across.position - corner));
    shift_corner(c, mesh, thread, i, k, *place, in, outward * std::min(lateral, most));
}

// Others are at the corner ahead: it is taken as far out as one is, in one's own lane.
static void keep_lane_at_corner(Crowd& c, const Navmesh& mesh, int thread, uint32_t i) {
    Journey& j = c.journeys[i];
    const Vec3* corners = &c.corners[size_t{i} * k_corners];
    const Vec2 here = on_ground(c.motion.position[i]), corner = on_ground(corners[j.corner]),
               in = normalize_or(corner - j.stretch_start, {0, 0}),
               out = normalize_or(on_ground(corners[j.corner + 1]) - corner, {0, 0});
    const Vec2 outward = outward_of(in, out);
    const float across = cross(outward, in);
    if (std::fabs(across) < k_turns) return;
    const Vec2 by = outward * (cross(here - corner, in) / across);
    if (const auto place = place_of_corner(mesh, thread, corners[j.corner]))
        shift_corner(c, mesh, thread, i, j.corner, *place, in, by);
    j.closest = length(on_ground(corners[j.corner]) - here);
}

static void choose_goal(Crowd& c, const Navmesh& mesh, int thread, uint32_t i, uint32_t tick, uint64_t seed) {
    constexpr uint32_t k_tries = 6;
    Journey& j = c.journeys[i];
    j.arrived = j.leaves = false;
    j.door_tries = 0;
    const uint32_t trip = ++j.trip;
    NavPoint here{c.motion.position[i], c.motion.polygon[i]};
    j.facing = {0, 0};
    j.stay = k_stroll_stay;
    if (auto chosen =
            choose_trip(c.demand, mesh, thread, here, by_of(c, i), tick, {seed, i, trip, Purpose::errand})) {
        j.goal = chosen->place;
        // Not to what is there, with a pram between.
        if (c.identity.ahead[i] == 0) j.facing = chosen->facing;
        j.stay = stay_at(chosen->kind, chosen->leaves);
        j.leaves = chosen->leaves;
        // Nor through it.
        if (j.leaves && is_entrance(chosen->kind) && c.identity.ahead[i] == 0) j.door_tries = k_door_tries;
        return;
    }
    float farthest = -1;
    for (uint32_t t = 0; t < k_tries; ++t) {
        RandomKey key{seed, i, trip, Purpose::destination};
        NavPoint p = random_place_near(mesh, thread, on_ground(c.motion.position[i]), k_stroll_reach,
                                       random_unit(key, t * 3), random_unit(key, t * 3 + 1),
                                       random_unit(key, t * 3 + 2));
        if (!are_joined(mesh, here.polygon, p.polygon, by_of(c, i))) continue;
        if (minds_lamps(c.kerbs) && surface_of(mesh, p.polygon) == Surface::crossing) continue;
        if (has_traffic(c.roadway) && is_driven_on(*c.roadway.map, on_ground(p.position))) continue;
        float d = length(on_ground(p.position - c.motion.position[i]));
        if (d <= farthest) continue;
        farthest = d;
        j.goal = p;
        if (d >= k_least_stroll) break;
    }
    if (farthest < 0) j.goal = {c.motion.position[i], c.motion.polygon[i]};
}

static void begin_stretch(Journey& j, Vec2 from, uint32_t tick) {
    j.stretch_start = from;
    j.closest = 1e9f;
    j.closest_tick = tick;
}

void plan_path(Crowd& c, const Navmesh& mesh, int thread, uint32_t i, uint32_t tick, uint64_t seed) {
    Journey& j = c.journeys[i];
    if (j.path_due == PathDue::to_new_goal) choose_goal(c, mesh, thread, i, tick, seed);
    Vec3* corners = &c.corners[size_t{i} * k_corners];
    NavPoint here{c.motion.position[i], c.motion.polygon[i]};
    int n = find_path(mesh, c.traffic, thread, here, j.goal, corners, k_corners, by_of(c, i));
    j.corner = 0;
    j.corner_count = static_cast<uint8_t>(n);
    j.path_start = j.turned_at = on_ground(here.position);
    begin_stretch(j, j.path_start, tick);
    if (n == 0) {  // the goal or the walker is nowhere: later again
        if (j.errand == Errand::wander) j.path_due = PathDue::to_new_goal;
        j.pause_until = tick + k_retry;
        return;
    }
    j.path_due = PathDue::no;
    for (int k = 0; k < k_widened; ++k) widen_corner(c, mesh, thread, i, k);
}

// Stands at its goal, or as near as it gets.
static void arrive(const Crowd& c, Journey& j, uint32_t i, uint32_t tick, uint64_t seed) {
    j.arrived = true;
    j.stuck = 0;
    j.insists_since = k_never;
    j.corner = j.corner_count;
    if (j.errand != Errand::wander) return;
    float pause =
        random_between({seed, i, j.trip, Purpose::pause}, j.stay.least, j.stay.most) * c.identity.linger[i];
    j.pause_until = tick + static_cast<uint32_t>(pause / k_tick);
    j.path_due = PathDue::to_new_goal;
}

// A pram is there before who pushes it, and who leaves by a door gets right before it.
static float goal_reach(const Crowd& c, uint32_t i) {
    return c.journeys[i].door_tries > 0 ? k_threshold_reach : k_goal_reach + c.identity.ahead[i];
}

// At the end of the path: the goal, or as far as a path of bounded length reached.
static void end_path(const Crowd& c, Journey& j, uint32_t i, uint32_t tick, uint64_t seed) {
    Vec2 p = on_ground(c.motion.position[i]);
    if (length(on_ground(j.goal.position) - p) <= 2 * goal_reach(c, i)) return arrive(c, j, i, tick, seed);
    j.path_due = PathDue::to_goal;
    if (length(p - j.path_start) >= 1) return;
    // A path that got no nearer will not next time either.
    if (j.errand == Errand::wander) j.path_due = PathDue::to_new_goal;
    j.pause_until = tick + k_retry;
}

// Whether only those who stand there can keep it from its goal.
static bool is_at_goal(const Journey& j, Vec2 p) {
    return length(on_ground(j.goal.position) - p) < k_corner_view;
}

// Others stand where it would pass, or it has strayed: another path, right of way, or another goal.
static void get_unstuck(const Crowd& c, Journey& j, uint32_t i, Vec2 p, bool at_goal, uint32_t tick,
                        uint64_t seed) {
    j.closest_tick = tick;
    j.path_due = PathDue::to_goal;
    ++j.stuck;
    // Who only cannot get to a place where somebody stands is in nobody's way.
    if (!at_goal && j.insists_since == k_never) j.insists_since = tick, j.insists_from = p;
    if (j.stuck <= k_most_stuck) return;
    j.stuck = 0;
    if (at_goal) {
        j.path_due = PathDue::no;
        arrive(c, j, i, tick, seed);
    } else if (j.errand == Errand::wander) {
        j.path_due = PathDue::to_new_goal;
    }
}

// On from a corner to the next one.
static void go_on(Crowd& c, const Navmesh& mesh, int thread, uint32_t i, Vec2 corner, uint32_t tick) {
    Journey& j = c.journeys[i];
    begin_stretch(j, corner, tick);
    widen_corner(c, mesh, thread, i, j.corner + k_widened - 1);
    // A path of bounded length that ends before its goal is found on while the last stretch is walked.
    const bool last = j.corner + 1 == j.corner_count;
    const Vec3 end = c.corners[size_t{i} * k_corners + j.corner];
    if (last && length(on_ground(j.goal.position - end)) > 2 * goal_reach(c, i) && j.path_due == PathDue::no)
        j.path_due = PathDue::to_goal;
}

// From where a corner is touched to its outer side.
static Vec2 way_round(const Crowd& c, uint32_t i) {
    constexpr float k_off = 0.3f, k_speed = 0.5f;  // metres; m/s
    const Journey& j = c.journeys[i];
    const Vec3* corners = &c.corners[size_t{i} * k_corners + j.corner];
    const Vec2 corner = on_ground(corners[0]), in = normalize_or(corner - j.stretch_start, {0, 0}),
               out = normalize_or(on_ground(corners[1]) - corner, {0, 0}),
               aim = corner + outward_of(in, out) * k_off;
    return normalize_or(aim - on_ground(c.motion.position[i]), {0, 0}) * k_speed;
}

Vec2 follow_path(Crowd& c, const Navmesh& mesh, int thread, uint32_t i, uint32_t tick, uint64_t seed) {
    Journey& j = c.journeys[i];
    const Vec3* corners = &c.corners[size_t{i} * k_corners];
    Vec2 p = on_ground(c.motion.position[i]);
    bool is_past = length(p - j.insists_from) > k_past;
    if (j.insists_since != k_never && (is_past || tick - j.insists_since > k_insist))
        j.insists_since = k_never;
    while (j.corner < j.corner_count) {
        Vec2 here = on_ground(corners[j.corner]), to = here - p;
        float distance = length(to);
        bool last = j.corner + 1 == j.corner_count;
        bool passed = last && distance < goal_reach(c, i);
        if (!last && distance < k_corner_view) {
            // Near or level with the corner, seen along the stretch that leaves it, and the next one in view.
            Vec3 next = corners[j.corner + 1];
            Vec2 in = normalize_or(here - j.stretch_start, {0, 0}),
                 out = normalize_or(on_ground(next) - here, {0, 0});
            bool level = dot(in + out, to) <= 0 && dot(out, to) <= 0.3f;
            passed = (level || distance < k_corner_reach) && is_clear(mesh, c.motion.position[i], next);
            passed = passed || (distance < k_corner_touch && tick - j.closest_tick > k_rounds);
        }
        if (!passed) {
            if (distance < j.closest - k_progress) {
                // Else a stretch has only begun, or it is shoved to and fro by those who stand at its goal.
                if (j.closest < 1e8f && !is_at_goal(j, p)) j.stuck = 0;
                j.closest = distance;
                j.closest_tick = tick;
            }
            const uint32_t since = tick - j.closest_tick;
            auto has_come_to = [&](uint32_t ticks) {
                return since >= ticks && since < ticks + k_decision_ticks;
            };
            if (static_cast<float>(since) > k_held_up * c.identity.patience[i])
                j.hurries_until = tick + k_hurries;
            // Pushed aside to where something stands between: round it. A path from here would be no other.
            if (has_come_to(k_blocked) && j.path_due == PathDue::no &&
                length(p - j.path_start) > k_progress &&
                !is_clear(mesh, c.motion.position[i], corners[j.corner]))
                j.path_due = PathDue::to_goal;
            if (!last && has_come_to(k_waits)) {
                keep_lane_at_corner(c, mesh, thread, i);
                here = on_ground(corners[j.corner]), to = here - p, distance = length(to);
            }
            const Vec2 beside = lerp(j.stretch_start, here, closest_on(j.stretch_start, here, p));
            const float off = length(beside - p);
            if ((since > k_patience || off > k_far_off) && j.path_due == PathDue::no) {
                get_unstuck(c, j, i, p, is_at_goal(j, p), tick, seed);
            }
            // At the corner, but on the side from where the border hides the next one: out and round it.
            if (!last && distance < k_corner_touch) return way_round(c, i);
            float speed = c.identity.preferred_speed[i];
            if (last) speed = std::min(speed, distance / 0.7f);
            // Others stand at the corner: on past them, not back to where it was to be turned.
            if (!last && distance < k_corner_view && tick - j.closest_tick > k_waits) {
                const Vec2 on = normalize_or(on_ground(corners[j.corner + 1]) - p, {0, 0});
                return normalize_or(to / std::max(distance, 1e-4f) + on, on) * speed;
            }
            // Pushed off the kerb: back to where the way leads, not along it on the road.
            if (c.motion.under[i].kind == Surface::road && distance > k_back_within) {
                const Vec2 along = normalize_or(here - j.stretch_start, {0, 0});
                return normalize_or(beside + along * k_back_within - p, {0, 0}) * speed;
            }
            return to * (speed / std::max(distance, 1e-4f));
        }
        ++j.corner;
        if (last) {
            end_path(c, j, i, tick, seed);
        } else {
            go_on(c, mesh, thread, i, here, tick);
        }
    }
    return {0, 0};
}

// Straight back onto the mesh, whatever the errand: to where it is near as one goes on.
static Vec2 go_back(Crowd& c, const Navmesh& mesh, int thread, uint32_t i) {
    const Vec3 at = c.motion.position[i], ahead = at + at_height(c.motion.velocity[i] * k_back_ahead, 0);
    if (const auto place = nearest(mesh, thread, ahead)) c.way_back[i] = *place;
    const Vec2 to = on_ground(c.way_back[i].position - at);
    return normalize_or(to, {0, 0}) * c.identity.preferred_speed[i];
}

// Straight through a door.
static Vec2 go_through(const Crowd& c, uint32_t i, const Passage& passage) {
    const Door& door = passage.door;
    const Vec2 here = on_ground(c.motion.position[i]);
    const float on = passage.kind == Passage::Kind::out ? k_door_ahead : -k_door_ahead;
    const Vec2 aim = on_ground(door.at) + door.way * (depth_in(door, here) + on);
    return normalize_or(aim - here, {0, 0}) * std::min(c.identity.preferred_speed[i], k_by_door);
}

namespace {
// See CrowdDecision.
struct Onward {
    Vec2 course, aim;
};
}  // namespace

// Of one who goes `way`.
static Onward onward(const Crowd& c, uint32_t i, Vec2 way) {
    const Vec2 course = normalize_or(way, {0, 0});
    return {course, on_ground(c.motion.position[i]) + course * k_course};
}

static Onward onward_by_path(const Crowd& c, uint32_t i) {
    const Journey& j = c.journeys[i];
    const Vec3* corners = &c.corners[size_t{i} * k_corners];
    const Vec2 here = on_ground(c.motion.position[i]);
    Vec2 at = here, aim = here;
    float left = k_course;
    for (int k = j.corner; k < j.corner_count && left > 0; ++k) {
        const Vec2 way = on_ground(corners[k]) - at;
        const float far = length(way);
        at += far > left ? way * (left / far) : way;
        left -= far;
        if (k == j.corner) aim = at;
    }
    return {normalize_or(at - here, {0, 0}), aim};
}

// Whether it is about to step in the way of somebody who drives.
static bool lets_pass(const Crowd& c, uint32_t i, uint32_t tick) {
    constexpr float k_at_corner = 0.4f, k_brisk = 1.1f;  // metres; times the usual speed
    const Journey& j = c.journeys[i];
    const Vec3* corners = &c.corners[size_t{i} * k_corners];
    int k = j.corner;
    Vec2 way = on_ground(corners[k] - c.motion.position[i]);
    if (length(way) < k_at_corner && k + 1 < j.corner_count)
        way = on_ground(corners[++k] - c.motion.position[i]);
    const Walking walking{c.motion.position[i], normalize_or(way, {0, 0}),
                          c.identity.preferred_speed[i] * k_brisk,
                          c.identity.ahead[i] > 0 ? c.identity.ahead[i] + k_pram_reach : 0, tick};
    return must_let_pass(c.roadway, walking);
}

// Along its path; or it waits for a lamp or for who drives, and is not held up by it.
static WayWish go_by_path(Crowd& c, const Navmesh& mesh, int thread, uint32_t i, uint32_t tick,
                          uint64_t seed) {
    Journey& j = c.journeys[i];
    Heed heed;
    // Who leads others goes as they can, and is not held up by them where it waits.
    const float pace = c.fellows.empty() || c.fellows[i].leads == 0 ? 1 : c.fellows[i].pace;
    if (pace < k_stands_for_them) j.closest_tick = tick;
    if (minds_lamps(c.kerbs)) {
        const float ahead = c.identity.ahead[i];
        const PathGoer goer{.at = c.motion.position[i],
                            .velocity = c.motion.velocity[i],
                            .path = {&c.corners[size_t{i} * k_corners + j.corner],
                                     static_cast<size_t>(j.corner_count - j.corner)},
                            .usual = c.identity.preferred_speed[i] * std::max(pace, k_for_others),
                            .ahead = ahead > 0 ? ahead + k_pram_reach : 0,
                            .trip = j.trip};
        heed = heed_lamp(c.kerbs, i, goer, tick, seed);
    }
    const bool has_path = j.corner < j.corner_count;
    const bool is_let = has_traffic(c.roadway) && !heed.waits && has_path && lets_pass(c, i, tick);
    if (has_traffic(c.roadway)) c.scratch.lets_pass[i] = is_let;
    if (!heed.waits && !is_let)
        return {follow_path(c, mesh, thread, i, tick, seed) * (heed.pace * pace), true};
    j.closest = 1e9f;
    j.closest_tick = tick;
    j.insists_since = k_never;
    // Who drives sees by its course that it wants to get over.
    if (is_let) return {{}, true};
    c.decision.looks[i] = heed.stands && c.identity.ahead[i] == 0;
    return {heed.wanted, false};
}

static void decide_where_to(Crowd& c, const Navmesh& mesh, int thread, uint32_t i, uint32_t tick,
                            uint64_t seed) {
    Journey& j = c.journeys[i];
    const bool is_beside = c.way_back[i].polygon != 0, is_driven = i == c.driven.walker;
    const bool lies = is_down(c, i);
    const Called* called = c.called.empty() ? nullptr : own_of(c.called, i);
    if (is_driven || lies || called) j.closest_tick = tick;  // who is led by hand is not held up
    const bool waits = tick < j.pause_until;
    const bool goes_on = is_beside || is_driven || lies || called;  // whatever the errand
    c.decision.looks[i] = waits && !goes_on && j.arrived;
    if (has_traffic(c.roadway)) c.scratch.lets_pass[i] = 0;
    WayWish wish{{0, 0}, false};
    const Passage* passage = is_beside ? passage_by_door(c, i) : nullptr;
    if (lies)
        wish.wanted = {};
    else if (passage)
        wish.wanted = go_through(c, i, *passage);
    else if (is_beside)
        wish.wanted = go_back(c, mesh, thread, i);
    else if (is_driven)
        wish.wanted = c.driven.wish;
    else if (called)
        wish.wanted = go_where_called(c, *called);
    else if (j.errand == Errand::by_way)
        wish = wish_by_way(c, mesh, thread, i, tick, seed);
    else if (!waits)
        wish = go_by_path(c, mesh, thread, i, tick, seed);
    if (minds_lamps(c.kerbs) && (goes_on || waits || j.errand == Errand::by_way)) leave_kerb(c.kerbs, i);
    if (called) c.decision.looks[i] = wish.wanted == Vec2{};
    if (!c.downed.empty() && !lies && !passage) wish.wanted = round_who_lies(c, mesh, i, wish.wanted);
    if (has_traffic(c.roadway) && !lies && !passage)
        wish.wanted = round_vehicles(c.roadway, c.motion.position[i], wish.wanted, c.identity.radius[i]);
    c.decision.wanted[i] = wish.wanted;
    const Onward on = wish.is_by_path ? onward_by_path(c, i) : onward(c, i, wish.wanted);
    c.decision.course[i] = on.course;
    c.decision.aim[i] = on.aim;
    const float to_make_way = std::max(c.identity.preferred_speed[i], k_least_haste) * k_haste;
    // As fast as it wants to, who flees or hastens.
    const float most = std::max(to_make_way, length(wish.wanted));
    c.scratch.intents[i] = {.wanted = wish.wanted,
                            .most = is_driven ? k_fastest_driven : most,
                            .waited = static_cast<float>(tick - j.closest_tick) * k_tick,
                            .insists = j.insists_since,
                            .hurries = tick < j.hurries_until,
                            .room = c.identity.room[i],
                            .is_beside = is_beside,
                            .by_door = passage != nullptr,
                            .lifts = j.insists_since != k_never && tick - j.insists_since > k_lifts,
                            .staggers = wish.staggers};
}

// How full it is, of every polygon: half of what it was and half of what it is, so that nobody turns about
// for one who passes. Rather smaller places count with what lies about them.
static void watch_traffic(Crowd& c, const Navmesh& mesh) {
    constexpr float k_least_area = 12;  // square metres
    constexpr float k_worth = 1.05f;
    Traffic& t = c.traffic;
    std::fill(t.coming.begin(), t.coming.end(), 0.0f);
    for (const WalkerId id : c.slots.living) t.coming[number_of(mesh, c.motion.polygon[id.index])] += 1;
    for (size_t p = 0; p < t.coming.size(); ++p) {
        const float now = slowness(t.coming[p] / std::max(t.areas[p], k_least_area)),
                    times = 0.5f * (now + t.slow[p]);
        t.coming[p] = times < k_worth ? 1 : times;
    }
    begin(t, mesh);
}

void think(Crowd& c, const Navmesh& mesh, Workers& workers, uint32_t tick, uint64_t seed) {
    if (tick % k_traffic_ticks == 0 && tick > 0) watch_traffic(c, mesh);
    go_on(c.traffic, mesh, k_traffic_share);
    // Paths, for the first walkers due from where the last tick stopped.
    c.scratch.requests.clear();
    uint32_t last = c.next_path;
    const size_t most = std::max<size_t>(k_paths_a_tick, c.count / k_for_each_path);
    for (uint32_t k = 0; k < c.count && c.scratch.requests.size() < most; ++k) {
        uint32_t i = c.next_path + k < c.count ? c.next_path + k : c.next_path + k - c.count;
        const Journey& j = c.journeys[i];
        if (j.path_due == PathDue::no || tick < j.pause_until || !is_there(c, i)) continue;
        if (i == c.driven.walker || (j.leaves && j.arrived) || is_down(c, i)) continue;
        if (!c.called.empty() && own_of(c.called, i)) continue;
        c.scratch.requests.push_back(i);
        last = i + 1 < c.count ? i + 1 : 0;
    }
    c.next_path = last;
    auto plan_some = [&](size_t begin, size_t end, int thread) {
        for (size_t r = begin; r < end; ++r) plan_path(c, mesh, thread, c.scratch.requests[r], tick, seed);
    };
    parallel_for(workers, c.scratch.requests.size(), 1, plan_some);

    parallel_for(workers, block_count(c.count), 16, [&](size_t begin, size_t end, int thread) {
        for (size_t block = begin; block < end; ++block) {
            if (!decides(c, block, tick)) continue;
            const size_t past = std::min<size_t>(c.count, (block + 1) * k_block);
            for (auto i = static_cast<uint32_t>(block * k_block); i < past; ++i)
                if (is_there(c, i)) decide_where_to(c, mesh, thread, i, tick, seed);
        }
    });
    if (minds_lamps(c.kerbs)) give_spots(c.kerbs, c.count, tick);
}

}  // namespace flaneur
