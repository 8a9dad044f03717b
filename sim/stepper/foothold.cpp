#include "sim/stepper/foothold.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"

namespace flaneur {

namespace {

constexpr float k_up = 0.31f, k_down = 0.3f;  // legs, that a foot is set above or below the other one
constexpr float k_longest = 0.9f;             // legs, between two feet, less what height takes of it
constexpr float k_least_beside = 0.085f, k_least_before = 0.3f;  // metres between ankles, of a leg of 0.9 m
constexpr float k_crosses = 0.02f;            // metres that feet may come beyond each other's line
constexpr float k_progress = 0.1f;            // metres, the least worth a step, off the place wanted
constexpr float k_near = 0.06f;               // metres that a sole may be off the ground in places
constexpr float k_on_it = 0.02f;              // metres that a place may be off what bears it
constexpr uint32_t k_stays[] = {20, 45, 90};  // ticks, for which the ground has to stay
constexpr float k_alike = 0.02f;              // metres, that two things are off each other's way by then
constexpr float k_alike_high = 0.006f;        // and up or down of it
constexpr float k_leaves = 0.22f;             // legs, that it may be off by then

// Whether one stands at a place of the ground, below nothing.
bool is_free(const StandingOn& on, Vec3 at) {
    constexpr float k_room = 1.7f;  // metres
    const auto hit = ground_at(on.around, at, k_room, k_near);
    return hit && is_walked(hit->kind) && hit->height < at.y + k_near;
}

bool is_walked_under(const StandingOn& on, const Seeker& who, const FootPlace& place) {
    const Vec2 ahead = heading_direction(place.yaw);
    const float slope =
        -(place.normal.x * ahead.x + place.normal.z * ahead.z) / std::max(place.normal.y, 0.2f);
    for (const float along : {-who.size.heel, 0.0f, who.size.ball}) {
        const Vec3 at = place.position + at_height(ahead * along, slope * along);
        if (!is_free(on, at)) return false;
    }
    return true;
}

// A stiff sole lies on the highest of what is below it; none where heel and toes would be on different
// levels.
std::optional<FootPlace> laid_on(const StandingOn& on, const Seeker& who, FootPlace place) {
    constexpr float k_most = 0.018f, k_uneven = 0.012f;  // metres up or down; between what is below it
    const Vec2 ahead = heading_direction(place.yaw);
    const float slope =
        -(place.normal.x * ahead.x + place.normal.z * ahead.z) / std::max(place.normal.y, 0.2f);
    float least = k_most, most = -k_most;
    for (const float along : {-who.size.heel, 0.0f, who.size.ball, who.size.tip}) {
        const Vec3 at = place.position + at_height(ahead * along, slope * along);
        const auto hit = ground_at(on.around, at, k_near, k_near);
        if (!hit) continue;
        least = std::min(least, at.y - hit->height), most = std::max(most, at.y - hit->height);
    }
    if (most - least > k_uneven) return std::nullopt;
    place.position.y -= clamp(least, -k_most, k_most);
    return place;
}

uint32_t mover_under(const StandingOn& on, Vec3 at) {
    const auto hit = mover_below(*on.ground.movers, at, 0.05f, 0.1f);
    return hit && std::fabs(hit->point.y - at.y) <= k_on_it ? hit->mover : k_still_ground;
}

// Where it will be in so many ticks.
Vec3 later(const StandingOn& on, const Foothold& own, uint32_t ticks) {
    if (own.mover == k_still_ground) return own.place;
    const Mover& mover = on.ground.movers->all[own.mover];
    if (mover.kind == Mover::Kind::led) return to_world(on.ground.movers->places[own.mover], own.place);
    return to_world(placement_at(mover, on.tick + ticks), own.place);
}

// Whether a sole lies on one thing, or on things that go alike.
bool is_of_one(const StandingOn& on, const Seeker& who, const FootPlace& place, const Foothold& hold) {
    const Movers& movers = *on.ground.movers;
    const Vec2 ahead = heading_direction(place.yaw);
    const float slope =
        -(place.normal.x * ahead.x + place.normal.z * ahead.z) / std::max(place.normal.y, 0.2f);
    for (const float along : {-who.size.heel, who.size.ball, who.size.tip}) {
        const Vec3 at = place.position + at_height(ahead * along, slope * along);
        const uint32_t mover = mover_under(on, at);
        if (mover == hold.mover) continue;
        auto owned = [&](uint32_t by) {
            Foothold own{by, at};
            if (by != k_still_ground) own.place = to_own(movers.places[by], at);
            return own;
        };
        const Foothold there = owned(mover), here = owned(hold.mover);
        for (const uint32_t ticks : k_stays) {
            const Vec3 off = later(on, there, ticks) - later(on, here, ticks);
            if (length(off) > k_alike || std::fabs(off.y) > k_alike_high) return false;
        }
    }
    return true;
}

bool stays(const StandingOn& on, const Seeker& who, const Foothold& hold) {
    if (hold.mover == who.other.mover || !who.has_other) return true;
    const Vec3 from = in_world(*on.ground.movers, hold).place - in_world(*on.ground.movers, who.other).place;
    for (const uint32_t ticks : k_stays) {
        const Vec3 then = later(on, hold, ticks) - later(on, who.other, ticks);
        if (length(then - from) > k_leaves * who.leg) return false;
    }
    return true;
}

bool suits(const StandingOn& on, const Seeker& who, const FootPlace& place) {
    if (!is_walked_under(on, who, place)) return false;
    if (!who.has_other) return true;
    for (size_t n = 0; n < who.others.size(); ++n)
        if (n / 3 != who.own && length(on_ground(place.position) - who.others[n]) < who.apart) return false;
    const Vec3 way = place.position - who.other_now.place;
    const Vec2 flat = on_ground(way);
    if (way.y > k_up * who.leg || way.y < -k_down * who.leg) return false;
    if (length(flat) > (k_longest - 0.4f * std::fabs(way.y) / who.leg) * who.leg) return false;
    if (who.is_flat) return true;
    const float outward = who.side == k_left ? 1.0f : -1.0f, scale = who.leg / 0.9f;
    const Vec2 left{who.facing.z, -who.facing.x};
    const float beside = outward * dot(flat, left), before = std::fabs(dot(flat, who.facing));
    if (before < k_least_before * scale) return beside >= k_least_beside * scale;
    return beside >= -k_crosses * scale;
}

}  // namespace

Foothold bound(const StandingOn& on, const FootPlace& place) {
    Foothold hold{k_still_ground, place.position, place.yaw, place.normal};
    const uint32_t mover = mover_under(on, place.position);
    if (mover == k_still_ground) return hold;
    const Placement& frame = on.ground.movers->places[mover];
    const Vec3 ahead = rotate(frame.turn, {0, 0, 1});
    hold.mover = mover;
    hold.place = to_own(frame, place.position);
    hold.yaw = wrap_angle(place.yaw - heading_of(on_ground(ahead)));
    hold.normal = rotate(conjugate(frame.turn), place.normal);
    return hold;
}

Foothold in_world(const Movers& movers, const Foothold& own) {
    if (own.mover == k_still_ground) return own;
    const Placement& frame = movers.places[own.mover];
    const Vec3 ahead = rotate(frame.turn, {0, 0, 1});
    return {k_still_ground, to_world(frame, own.place), wrap_angle(own.yaw + heading_of(on_ground(ahead))),
            rotate(frame.turn, own.normal)};
}

bool are_parting(const StandingOn& on, const Foothold& a, const Foothold& b, float leg) {
    constexpr uint32_t k_soon = 60;                      // ticks
    constexpr float k_parts = 0.16f, k_too_far = 0.92f;  // legs
    const Vec3 now = in_world(*on.ground.movers, a).place - in_world(*on.ground.movers, b).place,
               then = later(on, a, k_soon) - later(on, b, k_soon);
    return length(now) > k_too_far * leg || length(then) - length(now) > k_parts * leg;
}

std::optional<Vec3> ray_down(const StandingOn& on, Vec2 at, float height, float leg) {
    const Vec3 from = at_height(at, height);
    auto found = [&](float up, float down) -> std::optional<Vec3> {
        const auto hit = ground_at(on.around, from, up, down);
        if (!hit || !is_walked(hit->kind)) return std::nullopt;
        return Vec3{at.x, hit->height, at.z};
    };
    auto is_near = [&](float y) { return y <= height + k_up * leg && y >= height - k_down * leg; };
    const auto whole = found(k_ray_above, k_ray_below);
    if (whole && is_near(whole->y)) return whole;
    // Below what one walks under.
    constexpr float k_head_room = 1.8f;
    if (!whole || whole->y < height + k_head_room) return std::nullopt;
    return found(k_up * leg, k_down * leg);
}

std::optional<Foothold> foothold_at(const StandingOn& on, const Seeker& who, Vec3 wanted, float yaw) {
    const Footing found =
        find_footing(on.around, {wanted, yaw, {0, 1, 0}}, who.size, who.side == k_left ? 1.0f : -1.0f);
    if (!found.found || !found.whole) return std::nullopt;
    const std::optional<FootPlace> laid = laid_on(on, who, found.place);
    if (!laid || !suits(on, who, *laid)) return std::nullopt;
    const FootPlace& place = *laid;
    const Foothold hold = bound(on, place);
    // Neither on a thing nor on the ground: between some.
    if (hold.mover == k_still_ground && !ground_at(*on.ground.ground, place.position, k_on_it, k_on_it))
        return std::nullopt;
    if (!is_of_one(on, who, place, hold) || !stays(on, who, hold)) return std::nullopt;
    return hold;
}

std::optional<Foothold> foothold_near(const StandingOn& on, const Seeker& who, Vec2 wanted, float yaw) {
    const float height = who.other_now.place.y;
    if (const auto met = ray_down(on, wanted, height, who.leg))
        if (const auto hold = foothold_at(on, who, *met, yaw)) return hold;
    constexpr int k_rings = 11, k_ways = 12;
    constexpr float k_apart = 0.07f;  // metres between rings
    const Vec2 left{who.ahead.z, -who.ahead.x};
    for (int ring = 1; ring <= k_rings; ++ring)
        for (int n = 0; n < k_ways; ++n) {
            // Ahead first, then by turns to both sides.
            const int turn = n % 2 == 0 ? n / 2 : -(n + 1) / 2;
            const SinCos at = sin_cos(2 * k_pi * static_cast<float>(turn) / k_ways);
            if (who.is_flat && std::fabs(at.sine) > 1e-3f) continue;
            const float out = k_apart * static_cast<float>(ring) * who.leg / 0.9f;
            const Vec2 place = wanted + (who.ahead * at.cosine + left * at.sine) * out;
            if (who.has_other && !who.gathers &&
                dot(place - on_ground(who.at.place), who.ahead) < k_progress * who.leg)
                continue;
            const auto met = ray_down(on, place, height, who.leg);
            if (!met) continue;
            const auto hold = foothold_at(on, who, *met, yaw);
            if (!hold) continue;
            const Vec3 now = in_world(*on.ground.movers, *hold).place;
            if (who.has_other && !who.gathers &&
                dot(on_ground(now - who.at.place), who.ahead) < k_progress * who.leg)
                continue;
            return hold;
        }
    return std::nullopt;
}

}  // namespace flaneur
