#include <cmath>
#include <span>
#include <utility>

#include "sim/base/rng.h"
#include "sim/stepper/own.h"

namespace flaneur {

namespace {

constexpr float k_set_apart = 1.15f;  // metres, as they are set down

// Stands it at so many metres of its way, if both feet find still ground there.
bool set_down(const Own& o, float along, std::span<const Vec2> others) {
    constexpr float k_off_others = 0.7f;  // metres
    const WayPoint at = point_on(o.bipeds.ways[o.b.way], along);
    for (const Vec2 other : others)
        if (length(other - at.place) < k_off_others) return false;
    o.b.along = along;
    o.b.point = o.b.body = at.place;
    o.b.ahead = at.ahead;
    o.b.heading = heading_of(at.ahead);
    for (const Side side : {k_left, k_right}) {
        const Vec2 place = beside(o, at.place, side);
        const auto hit = ground_at(o.on.around, at_height(place, 0), k_ray_above, k_ray_below);
        if (!hit || !is_walked(hit->kind)) return false;
        Seeker who = seeker(o, side);
        who.has_other = false;
        const auto hold = foothold_at(o.on, who, {place.x, hit->height, place.z}, yaw_of(o, side, 0));
        if (!hold || hold->mover != k_still_ground) return false;
        if (length(on_ground(hold->place) - place) > 0.1f) return false;
        o.b.feet[side] = *hold;
    }
    return std::fabs(o.b.feet[0].place.y - o.b.feet[1].place.y) < 0.02f;
}

SetDown set_all_down(std::vector<BipedWay> ways, std::span<const uint32_t> walkers,
                     std::span<const float> likes, bool is_flat, const MovingGround& ground, Gait& gait,
                     uint64_t seed, std::span<const Vec2> others) {
    SetDown made;
    Bipeds& bipeds = made.bipeds;
    bipeds.ways = std::move(ways);
    bipeds.walkers.assign(walkers.begin(), walkers.end());
    bipeds.room.assign(likes.size(), k_all_room);
    bipeds.aside.assign(likes.size(), 0.0f);
    bipeds.is_flat = is_flat;
    bipeds.all.resize(likes.size());
    bipeds.was_along.resize(likes.size());
    bipeds.was_lead.resize(likes.size());
    bipeds.was_feet.resize(3 * likes.size());
    const Surroundings around = surroundings_of(ground);
    const StandingOn on{ground, around, 0};
    std::vector<float> last(bipeds.ways.size(), -1e9f), first(bipeds.ways.size(), 0);
    for (size_t i = 0; i < likes.size(); ++i) {
        Biped& b = bipeds.all[i];
        const size_t n_ways = bipeds.ways.size();
        b.way = static_cast<uint32_t>(i % n_ways);
        b.likes = likes[i];
        const Own o = own_of(bipeds, i, gait, on);
        const float whole = bipeds.ways[b.way].along.back();
        const size_t on_this = (likes.size() - b.way + n_ways - 1) / n_ways, before = i / n_ways;
        // In turns, and those of other ways elsewhere on theirs.
        const float share = static_cast<float>(before) + 0.4f * random_unit({seed, 0, 0, Purpose::spawn}),
                    apart = static_cast<float>(b.way) / static_cast<float>(n_ways);
        const float even = whole * (share / static_cast<float>(on_this) + 0.9f * apart);
        constexpr float k_step = 0.2f;
        const float least = last[b.way] < 0 ? even : std::max(even, last[b.way] + k_set_apart);
        const float most = last[b.way] < 0 ? even + whole : first[b.way] + whole - k_set_apart;
        bool stands = false;
        for (float along = least; !stands && along <= most; along += k_step)
            stands = set_down(o, along, others);
        if (!stands) break;
        if (last[b.way] < 0) first[b.way] = b.along;
        last[b.way] = b.along;
        ++made.placed;
        write_feet(o);
        o.g.x[o.lane] = b.body.x, o.g.z[o.lane] = b.body.z, o.g.heading[o.lane] = b.heading;
        o.g.base[o.lane] = b.feet[0].place.y;
        o.g.base_velocity[o.lane] = 0;
        o.g.standing[o.lane] = 1;
        b.reach = reach_of(o, 0);
        look_for_places(o);
    }
    return made;
}

}  // namespace

SetDown make_bipeds(std::vector<BipedWay> ways, std::span<const uint32_t> walkers,
                    std::span<const float> likes, bool is_flat, const MovingGround& ground, Gait& gait,
                    uint64_t seed, std::span<const Vec2> others) {
    auto set_down = [&](size_t count) {
        return set_all_down(ways, walkers.first(count), likes.first(count), is_flat, ground, gait, seed,
                            others);
    };
    SetDown made = set_down(likes.size());
    if (made.placed == likes.size()) return made;
    // They are set down evenly: fewer stand elsewhere, and may not all find room either.
    for (size_t count = made.placed; count > 0; --count) {
        made.placed = set_down(count).placed;
        if (made.placed == count) break;
    }
    return made;
}

// Metres along a way of its nearest place to which one comes straight on level ground from where one stands,
// or else of the nearest.
static float way_back(const BipedWay& way, const Surroundings& around, Vec3 from) {
    constexpr float k_apart = 0.25f, k_level = 0.2f, k_head_room = 3;  // metres
    // And not below stairs or bridges that the way goes over.
    auto is_level = [&](Vec2 place) {
        const auto hit = ground_at(around, at_height(place, from.y), k_head_room, k_level);
        return hit && is_walked(hit->kind) && hit->height < from.y + k_level;
    };
    float best = nearest_along(way, on_ground(from)), least = 1e9f;
    for (float along = 0; along < way.along.back(); along += k_apart) {
        const Vec2 to = point_on(way, along).place - on_ground(from);
        const float far = length(to);
        bool is_clear = far < least;
        for (float on = far; is_clear && on > 0; on -= k_apart)
            is_clear = is_level(on_ground(from) + to * (on / far));
        if (is_clear) least = far, best = along;
    }
    return best;
}

void go_on_standing(Bipeds& bipeds, size_t i, Vec2 body, float heading, const MovingGround& ground,
                    Gait& gait, uint32_t tick) {
    const Surroundings around = surroundings_of(ground);
    const StandingOn on{ground, around, tick};
    Biped& b = bipeds.all[i];
    const Own o = own_of(bipeds, i, gait, on);
    b.is_down = 0;
    b.body = b.point = body;
    b.along = way_back(bipeds.ways[b.way], around, at_height(body, o.g.base[o.lane]));
    b.aside = 0;
    b.heading = heading;
    b.ahead = heading_direction(heading);
    b.velocity = {};
    b.speed = b.turn_rate = b.due = 0;
    b.waits = 0;
    b.kept = 0;
    b.reels = 0;
    b.swings = k_both_down;
    for (const Side side : {k_left, k_right})
        b.feet[side] = bound(on, get_place(o.g.feet[side].from, o.lane));
    o.g.standing[o.lane] = 1;
    b.reach = reach_of(o, 0);
    look_for_places(o);
}

void shove(Bipeds& bipeds, size_t i, Vec2 change, const Gait& gait) {
    const uint32_t walker = bipeds.walkers[i];
    const float leg = gait.people[walker / k_block].joints[left_upper_leg][1][walker % k_block];
    constexpr float k_reels = 0.9f, k_least = 0.3f;  // seconds; m/s, less is answered at ankles and hips
    Biped& b = bipeds.all[i];
    b.velocity += change;
    if (length(change) < k_least) return;
    b.point += change / std::sqrt(k_gravity / leg);
    b.reels = k_reels;
}

}  // namespace flaneur
