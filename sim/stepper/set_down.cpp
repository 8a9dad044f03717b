#include <cmath>
#include <span>

#include "sim/base/rng.h"
#include "sim/stepper/own.h"

namespace flaneur {

namespace {

constexpr float k_set_apart = 1.15f;  // metres, as they are set down

// Stands it at so many metres of its way, if both feet find still ground there.
bool set_down(const Own& o, float along) {
    const WayPoint at = point_on(o.bipeds.ways[o.b.way], along);
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

SetDown set_all_down(std::vector<BipedWay> ways, std::span<const float> likes, bool is_flat,
                     const MovingGround& ground, Gait& gait, uint64_t seed) {
    SetDown made;
    Bipeds& bipeds = made.bipeds;
    bipeds.ways = std::move(ways);
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
        for (float along = least; !stands && along <= most; along += k_step) stands = set_down(o, along);
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

SetDown make_bipeds(std::vector<BipedWay> ways, const std::vector<float>& likes, bool is_flat,
                    const MovingGround& ground, Gait& gait, uint64_t seed) {
    SetDown made = set_all_down(ways, likes, is_flat, ground, gait, seed);
    if (made.placed == likes.size()) return made;
    // They are set down evenly: fewer stand elsewhere, and may not all find room either.
    for (size_t count = made.placed; count > 0; --count) {
        const std::span<const float> some(likes.data(), count);
        made.placed = set_all_down(ways, some, is_flat, ground, gait, seed).placed;
        if (made.placed == count) break;
    }
    return made;
}

}  // namespace flaneur
