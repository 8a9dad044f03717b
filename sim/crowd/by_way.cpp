// Ways to go without an errand: after somebody, with somebody, away from somebody, by rays, along circles.
#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/base/spans.h"
#include "sim/crowd/crowd.h"
#include "sim/crowd/errand.h"
#include "sim/crowd/places.h"
#include "sim/ways/rays.h"

namespace flaneur {

static constexpr float k_hastens = 1.25f, k_flees = 1.5f;  // times the preferred speed, at most
static constexpr float k_catches_up = 1.5f;                // seconds, to be as near as one likes
static constexpr float k_stale = 1.5f;  // metres that who is followed has gone from where the path leads
static constexpr uint32_t k_asks_again = 60;  // ticks from the last progress on, for a path to who is near
static constexpr float k_comes_up = 0.6f;     // of the distance at which one waits, when it goes on
static constexpr float k_keeps_on = 0.6f;  // of what a clear way is worth, so that nobody dithers in a corner
static constexpr float k_safe = 1.3f;      // of the range, to which one flees
static constexpr float k_turns_on_foot = 1.6f, k_turns_with_pram = 0.7f;  // radians a second
static constexpr float k_goes_off = 0.3f;     // metres that others and its legs take it off a circle
static constexpr float k_least_going = 0.3f;  // m/s

namespace {

// One who decides, and what by.
struct Goer {
    Crowd& c;
    const Navmesh& mesh;
    int thread;
    uint32_t i, tick;
    uint64_t seed;
    Wayfarer& way;

    Vec3 at() const { return c.motion.position[i]; }
    float speed() const { return c.identity.preferred_speed[i]; }
    float ahead() const { return c.identity.ahead[i]; }
    // Until it decides again.
    float seconds() const {
        return static_cast<float>(std::max<uint32_t>(c.at_once[i / k_block], k_decision_ticks)) * k_tick;
    }
    float clear_way(float yaw, float reach) const {
        return flaneur::clear_way(c, mesh, thread, i, yaw, reach);
    }
};

}  // namespace

// Each way that one is led has chances of its own.
static RandomKey key_of(const Goer& g, uint32_t when) {
    return {mix(g.seed ^ g.c.journeys[g.i].trip), g.i, when, Purpose::way};
}

// Whether nothing turns one aside who goes `way`: nor steps, with wheels.
static bool comes_along(const Crowd& c, const Navmesh& mesh, int thread, uint32_t i, Vec2 way) {
    constexpr float k_aside = 0.05f;  // metres
    const Vec3 from = c.motion.position[i];
    const NavPoint to =
        move_along(mesh, thread, {from, c.motion.polygon[i]}, from + at_height(way, 0), by_of(c, i));
    return length(on_ground(to.position - from) - way) <= k_aside;
}

float clear_way(const Crowd& c, const Navmesh& mesh, int thread, uint32_t i, float yaw, float reach) {
    constexpr float k_first = 0.3f;  // metres
    const Vec3 from = c.motion.position[i];
    const Vec2 direction = heading_direction(yaw);
    const float ahead = c.identity.ahead[i], front = ahead > 0 ? ahead + k_pram_reach : 0;
    // Who stands on a border meets it at once.
    if (!comes_along(c, mesh, thread, i, direction * std::max(k_first, front))) return 0;
    const auto border = first_border(mesh, from, from + at_height(direction * (reach + front), 0));
    if (!border) return reach;
    const Vec2 inward = inward_of(*border);
    const float way = dot(on_ground(border->a - from), inward) / std::min(dot(direction, inward), -1e-3f);
    return std::max(way - front, 0.0f);
}

// Whether one comes there straight on, with a pram as well.
static bool is_clear_to(const Goer& g, Vec3 there) {
    if (!is_clear(g.mesh, g.at(), there)) return false;
    if (g.ahead() == 0) return true;
    const Vec2 to_pram = heading_direction(g.c.motion.heading[g.i]) * g.ahead();
    return is_clear(g.mesh, g.at() + at_height(to_pram, 0), there) &&
           comes_along(g.c, g.mesh, g.thread, g.i, on_ground(there - g.at()));
}

// As fast as brings one, or its pram, from `far` to `range` metres behind who goes with `velocity` that way.
static float following_speed(const Goer& g, float far, Vec2 direction, Vec2 velocity) {
    const float speed = dot(velocity, direction) + (far - g.ahead() - g.way.range) / k_catches_up;
    return clamp(speed, 0, k_hastens * g.speed());
}

static WayWish follow(const Goer& g) {
    const uint32_t whom = g.way.whom.index;
    const Vec3 there = g.c.motion.position[whom];
    const Vec2 to = on_ground(there - g.at());
    const float far = length(to);
    Journey& j = g.c.journeys[g.i];
    if (std::fabs(there.y - g.at().y) < k_other_level && is_clear_to(g, there)) {
        j.corner = j.corner_count = 0;
        j.path_due = PathDue::no;
        const Vec2 direction = normalize_or(to, {0, 0});
        return {direction * following_speed(g, far, direction, g.c.motion.velocity[whom]), false};
    }
    // At the end of one that did not bring him into view he does not ask at every turn.
    const bool is_over = j.corner >= j.corner_count && g.tick - j.closest_tick > k_asks_again;
    const bool is_stale = is_over || length(on_ground(j.goal.position - there)) > k_stale;
    if (is_stale && j.path_due == PathDue::no && g.tick >= j.pause_until) {
        j.goal = {there, g.c.motion.polygon[whom]};
        j.path_due = PathDue::to_goal;
    }
    const Vec2 along = follow_path(g.c, g.mesh, g.thread, g.i, g.tick, g.seed);
    return {along * (far > 2 * g.way.range ? k_hastens : 1.0f), true};
}

static WayWish lead(const Goer& g) {
    const float behind = length(g.c.motion.position[g.way.whom.index] - g.at());
    if (behind > g.way.range) g.way.waits = 1;
    if (behind < k_comes_up * g.way.range) g.way.waits = 0;
    Journey& j = g.c.journeys[g.i];
    if (g.way.waits || j.arrived) return {};
    return {follow_path(g.c, g.mesh, g.thread, g.i, g.tick, g.seed), true};
}

static WayWish flee(const Goer& g) {
    const Vec2 from = on_ground(g.at() - g.c.motion.position[g.way.whom.index]);
    const float far = length(from);
    if (far < g.way.range) g.way.waits = 0;
    if (far >= k_safe * g.way.range) g.way.waits = 1;  // it stands where it is safe
    if (g.way.waits) return {};
    // As nearly straight away as is free for long, on the way that it goes already if that is about as good.
    const float away = heading_of(normalize_or(from, heading_direction(g.c.motion.heading[g.i])));
    float best = -1, chosen = away;
    auto take = [&](float degrees) {
        const float yaw = away + degrees * k_radians;
        const float clear = g.clear_way(yaw, k_ray_aside) / k_ray_aside;
        const float keeps = k_keeps_on * dot(heading_direction(yaw), heading_direction(g.way.bearing));
        const float good = clear * (1.2f + sin_cos(degrees * k_radians).cosine + keeps);
        if (good > best) best = good, chosen = yaw;
    };
    for (int k = -11; k <= 12; ++k) take(15 * static_cast<float>(k));
    g.way.bearing = wrap_angle(chosen);
    return {heading_direction(chosen) * (k_flees * g.speed()), false};
}

// By how many degrees one turns whose ray ahead meets something after `ahead` metres.
static float turn_away(const Goer& g, float ahead) {
    const float reach = g.c.march.how.ray_aside;
    auto clear = [&](float degrees) { return g.clear_way(g.way.bearing + degrees * k_radians, reach); };
    const auto free = free_way(clear, reach, key_of(g, ++g.way.turns));
    return free ? *free : longest_way(clear, ahead);
}

static WayWish ramble(const Goer& g) {
    March& march = g.c.march;
    const bool marches = is_on(march);
    if (marches && is_turning(march.turns[g.i])) {
        g.way.bearing = turn_on(march.turns[g.i], g.seconds());
        return {heading_direction(g.way.bearing) * march.pace[g.i], false};
    }
    const float ahead = g.clear_way(g.way.bearing, march.how.ray_ahead);
    if (ahead < march.how.ray_ahead) {
        const float turn = turn_away(g, ahead);
        if (!marches)
            g.way.bearing = wrap_angle(g.way.bearing + turn * k_radians);
        else if (turn != 0)
            march.turns[g.i] = begin_turn(march.how, g.way.bearing, turn);
    }
    return {heading_direction(g.way.bearing) * (marches ? march.pace[g.i] : g.speed()), false};
}

Strider strider_of(const Crowd& c, uint32_t i) {
    const float ahead = c.identity.ahead[i];
    return {.speed = c.identity.preferred_speed[i],
            .radius = ahead > 0 ? ahead + k_pram_radius : c.identity.radius[i],
            .turns = ahead > 0 ? k_turns_with_pram : k_turns_on_foot,
            .goes_off = k_goes_off};
}

// Along its circle; where others or its own legs have taken it off there, or the platform has changed, along
// another one, from where it is.
static WayWish stagger(const Goer& g, float seconds) {
    const Strider who = strider_of(g.c, g.i);
    const Vec2 velocity = g.c.motion.velocity[g.i];
    const float speed = length(velocity);
    const float heading = speed > k_least_going ? heading_of(velocity / speed) : g.c.motion.heading[g.i];
    const Vec2 way =
        stride_on(g.way.platform, who, g.way.stride, on_ground(g.at()), heading, seconds, key_of(g, 0));
    return {way * who.speed, false, true};
}

// As fast as brings one there who is so far from a place that moves on, or stands. Near one of these it will
// do where one `stands`: one does not step back for every little that others moved one, nor press into them.
static Vec2 wish_to_spot(const Fellow& f, Vec2 to, bool stands) {
    constexpr float k_catches_up_in = 1.1f, k_slows = 1.6f;                  // seconds; 1/s
    constexpr float k_there = 0.1f, k_near_it = 0.28f, k_turns_back = 1.8f;  // metres
    constexpr float k_least = 0.2f;  // of the speed, of one who is too far ahead
    const float drift = length(f.drift), far = length(to);
    if (drift < k_least_going)
        return far < (stands ? k_near_it : k_there) ? Vec2{} : to * (std::min(f.most, k_slows * far) / far);
    Vec2 wish = f.drift + to / k_catches_up_in;
    const Vec2 way = f.drift / drift;
    if (far < k_turns_back) wish += way * std::max(k_least * drift - dot(wish, way), 0.0f);
    const float speed = length(wish);
    return speed > f.most ? wish * (f.most / speed) : wish;
}

// With those one goes with: straight to where one should be among them, or by the best way.
static WayWish along(const Goer& g) {
    const Fellow& f = g.c.fellows[g.i];
    Journey& j = g.c.journeys[g.i];
    if (f.most <= 0) return {};  // nobody has told it yet
    j.facing = f.facing;
    const float passed = static_cast<float>(g.tick - f.since) * k_tick;
    const Vec3 there = f.spot + at_height(f.drift * passed, 0);
    const Vec2 to = on_ground(there - g.at());
    if (std::fabs(there.y - g.at().y) < k_other_level && is_clear_to(g, f.spot)) {
        j.corner = j.corner_count = 0;
        j.path_due = PathDue::no;
        constexpr float k_slow = 0.1f;  // m/s
        const bool stands = g.c.decision.looks[g.i] != 0 || length(g.c.motion.velocity[g.i]) < k_slow;
        const Vec2 wish = wish_to_spot(f, to, stands);
        g.c.decision.looks[g.i] = wish == Vec2{} && f.facing != Vec2{};
        return {wish, false};
    }
    const bool is_over = j.corner >= j.corner_count && g.tick - j.closest_tick > k_asks_again;
    const bool is_stale = is_over || length(on_ground(j.goal.position - f.spot)) > 2 * k_stale;
    if (is_stale && j.path_due == PathDue::no && g.tick >= j.pause_until) {
        if (const auto place = nearest(g.mesh, g.thread, f.spot)) {
            j.goal = *place;
            j.path_due = PathDue::to_goal;
        }
    }
    const Vec2 way = follow_path(g.c, g.mesh, g.thread, g.i, g.tick, g.seed);
    return {way * (f.most / std::max(g.speed(), k_least_going)), true};
}

static WayWish wish_of(const Goer& g) {
    switch (g.way.kind) {
        case Wayfarer::Kind::follow:
            return follow(g);
        case Wayfarer::Kind::lead:
            return lead(g);
        case Wayfarer::Kind::flee:
            return flee(g);
        case Wayfarer::Kind::ramble:
            return ramble(g);
        case Wayfarer::Kind::is_led:
            return {g.c.motion.wish[g.i], false};
        case Wayfarer::Kind::along:
            return along(g);
        case Wayfarer::Kind::stagger:
            break;
    }
    return stagger(g, g.seconds());
}

// Who goes by no path has nothing to be held up on, but those who would catch up and stand before others:
// they get a claim as well, or two who come towards each other would stand there for good.
static void insist(Crowd& c, uint32_t i, Vec2 wanted, bool goes_along, uint32_t tick) {
    constexpr float k_goes = 0.5f, k_slow = 0.2f;       // m/s
    constexpr uint32_t k_patience = 90, k_most = 1200;  // ticks
    Journey& j = c.journeys[i];
    const bool is_held = goes_along && length(wanted) > k_goes && length(c.motion.velocity[i]) < k_slow;
    const uint32_t since = tick - j.closest_tick;
    if (!is_held || since > k_most) {
        j.closest_tick = tick;
        j.insists_since = k_never;
    } else if (since > k_patience && j.insists_since == k_never) {
        j.insists_since = tick;
        j.insists_from = on_ground(c.motion.position[i]);
    }
}

WayWish wish_by_way(Crowd& c, const Navmesh& mesh, int thread, uint32_t i, uint32_t tick, uint64_t seed) {
    Wayfarer* way = own_of(c.wayfarers, i);
    if (!way) return {};
    const Goer g{c, mesh, thread, i, tick, seed, *way};
    const WalkerId whom = g.way.whom;
    const bool is_by_whom = g.way.kind <= Wayfarer::Kind::flee, is_gone = is_by_whom && !is_there(c, whom);
    const WayWish wish = is_gone ? WayWish{} : wish_of(g);
    if (!wish.is_by_path) insist(c, i, wish.wanted, way->kind == Wayfarer::Kind::along, tick);
    return wish;
}

Vec2 go_where_called(const Crowd& c, const Called& called) {
    constexpr float k_there = 0.1f, k_slows = 1.6f;  // metres; 1/s
    const Vec2 way = called.to - on_ground(c.motion.position[called.walker]);
    const float far = length(way);
    if (far < k_there || called.speed == 0) return {};
    return way * (std::min(called.speed, k_slows * far) / far);
}

Vec2 round_who_lies(const Crowd& c, const Navmesh& mesh, uint32_t i, Vec2 wanted) {
    constexpr float k_sees = 4.5f, k_broad = 0.4f, k_beside = 0.2f, k_clear = 0.12f,
                    k_least = 0.05f;  // metres; m/s
    const float speed = length(wanted);
    if (speed < k_least) return wanted;
    const Vec3 here = c.motion.position[i];
    const Called* called = c.called.empty() ? nullptr : own_of(c.called, i);
    const float sees = called ? std::min(k_sees, length(called->to - on_ground(here))) : k_sees;
    const Vec2 way = wanted / speed;
    const float half = c.identity.ahead[i] > 0 ? k_pram_radius : c.identity.radius[i];
    const float room = half + (called ? k_beside : k_broad);
    // Of the nearest that is in the way: its ends, and how far aside they are.
    float nearest_on = sees;
    Vec2 ends[2];
    bool is_any = false;
    for (const Downed& down : c.downed) {
        const Vec3 hips = c.motion.position[down.walker];
        const Vec2 to = on_ground(hips - here);
        if (down.walker == i || std::fabs(hips.y - here.y) > k_other_level) continue;
        if (length_squared(to) > (sees + k_lying_reach) * (sees + k_lying_reach)) continue;
        const Vec2 a = to + down.across, b = to + down.along;
        const float aside_a = cross(way, a), aside_b = cross(way, b);
        if (std::min(aside_a, aside_b) > room || std::max(aside_a, aside_b) < -room) continue;
        // Where along the way the line between both ends is least aside.
        const float across = aside_a - aside_b;
        const float t = std::fabs(across) > 1e-4f   ? std::min(std::max(aside_a / across, 0.0f), 1.0f)
                        : dot(way, a) < dot(way, b) ? 0.0f
                                                    : 1.0f;
        const float on = dot(way, a) + t * (dot(way, b) - dot(way, a));
        if (on < 0 || on > nearest_on + (called ? 0 : room)) continue;
        nearest_on = on;
        ends[0] = a, ends[1] = b;
        is_any = true;
    }
    if (!is_any) return wanted;
    Vec2 best = wanted;
    float least = 1e9f;
    for (const float side : {1.0f, -1.0f}) {
        // Beyond the end that is farthest out on that side.
        const Vec2 end = side * cross(way, ends[0]) > side * cross(way, ends[1]) ? ends[0] : ends[1];
        const Vec2 out{-way.z * side, way.x * side};
        const Vec2 aim = end + out * (room + k_clear);
        const float turn = -dot(normalize_or(aim, way), way);
        if (turn >= least || !is_clear(mesh, here, here + at_height(aim, 0))) continue;
        least = turn;
        best = normalize_or(aim, way) * speed;
    }
    return best;
}

}  // namespace flaneur
