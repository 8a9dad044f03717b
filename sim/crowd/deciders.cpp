#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/crowd/deciders.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "sim/crowd/places.h"
#include "sim/crowd/velocity-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

using NumberTag = hn::RebindToUnsigned<LaneTag>;

// Those within reach, in the order in which they were come upon.
struct Candidates {
    static constexpr size_t k_room = 64;
    size_t count = 0;
    float distance2[k_room + k_block];
    uint32_t at[k_room + k_block];
};

// Leaves the nearest k_neighbours, in the same order, and returns how far off the last of them is. Each is
// as near as it has nearer ones: so all may be compared side by side.
HWY_INLINE float keep_nearest(Candidates& c) {
    const LaneTag tag;
    const NumberTag number;
    const size_t lanes = hn::Lanes(tag);
    for (size_t k = c.count; k < c.count + lanes; ++k) c.distance2[k] = 1e9f;
    alignas(64) uint32_t nearer[Candidates::k_room + k_block];
    for (size_t k = 0; k < c.count; k += lanes) {
        const auto own = hn::LoadU(tag, c.distance2 + k);
        const auto place = hn::Iota(number, static_cast<uint32_t>(k));
        auto sum = hn::Zero(number);
        for (size_t j = 0; j < c.count; ++j) {
            const auto other = hn::Set(tag, c.distance2[j]);
            const auto before = hn::RebindMask(tag, hn::Lt(hn::Set(number, static_cast<uint32_t>(j)), place));
            const auto less = hn::Or(hn::Lt(other, own), hn::And(hn::Eq(other, own), before));
            sum = hn::Sub(sum, hn::VecFromMask(number, hn::RebindMask(number, less)));
        }
        hn::StoreU(sum, number, nearer + k);
    }
    size_t kept = 0;
    float farthest = 0;
    for (size_t k = 0; k < c.count; ++k) {
        if (nearer[k] >= k_neighbours) continue;
        c.distance2[kept] = c.distance2[k];
        c.at[kept++] = c.at[k];
        farthest = std::max(farthest, c.distance2[k]);
    }
    c.count = kept;
    return farthest;
}

// Calls visit(at, distance2, near) for lanes full of those in the rows whose squares are within `reach` of
// `p`, and a mask of them that are no farther than what `reach2` holds, on this level and not at `me`.
template <class Visit>
HWY_INLINE void for_near_lanes(const CrowdScratch& s, Vec3 p, uint32_t me, float reach,
                               const hn::Vec<LaneTag>& reach2, const Visit& visit) {
    const LaneTag tag;
    const NumberTag number;
    const SeenRows& rows = s.seen;
    const auto x = hn::Set(tag, p.x), y = hn::Set(tag, p.y), z = hn::Set(tag, p.z);
    const auto level = hn::Set(tag, k_other_level);
    for_seen_near(s, p, reach, [&](uint32_t begin, uint32_t end) {
        for (size_t k = begin; k < end; k += hn::Lanes(tag)) {
            const auto off_x = hn::Sub(hn::LoadU(tag, &rows.x[k]), x),
                       off_z = hn::Sub(hn::LoadU(tag, &rows.z[k]), z),
                       off_y = hn::Abs(hn::Sub(hn::LoadU(tag, &rows.y[k]), y));
            const auto distance2 = hn::Add(hn::Mul(off_x, off_x), hn::Mul(off_z, off_z));
            const auto at = hn::Iota(number, static_cast<uint32_t>(k));
            auto near = hn::And(hn::Le(distance2, reach2), hn::Le(off_y, level));
            near = hn::And(near, hn::FirstN(tag, end - k));
            near = hn::And(near, hn::RebindMask(tag, hn::Ne(at, hn::Set(number, me))));
            if (!hn::AllFalse(tag, near)) visit(at, distance2, near);
        }
    });
}

// Through a register: some machines compress into memory a hundred times as slowly. Writes a whole vector.
HWY_INLINE size_t put(hn::Vec<NumberTag> at, hn::Mask<LaneTag> near, uint32_t* to) {
    hn::StoreU(hn::Compress(at, hn::RebindMask(NumberTag(), near)), NumberTag(), to);
    return hn::CountTrue(LaneTag(), near);
}

HWY_INLINE void find_nearest_of(const CrowdScratch& s, uint32_t me, Candidates& found) {
    const LaneTag tag;
    const Vec3 p{s.seen.x[me], s.seen.y[me], s.seen.z[me]};
    auto reach2 = hn::Set(tag, k_neighbour_reach * k_neighbour_reach);
    found.count = 0;
    for_near_lanes(s, p, me, k_neighbour_reach, reach2, [&](auto at, auto distance2, auto near) {
        hn::StoreU(hn::Compress(distance2, near), tag, found.distance2 + found.count);
        found.count += put(at, near, found.at + found.count);
        if (found.count >= Candidates::k_room - k_block) reach2 = hn::Set(tag, keep_nearest(found));
    });
    if (found.count > k_neighbours) keep_nearest(found);
}

int find_within_here(const CrowdScratch& s, Vec3 place, uint32_t me, float reach, uint32_t* found, int room) {
    size_t count = 0;
    const auto reach2 = hn::Set(LaneTag(), reach * reach);
    for_near_lanes(s, place, me, reach, reach2, [&](auto at, auto, auto near) {
        alignas(64) uint32_t some[k_block];
        const size_t more = std::min(put(at, near, some), static_cast<size_t>(room) - count);
        std::copy_n(some, more, found + count);
        count += more;
    });
    return static_cast<int>(count);
}

void find_nearest_here(const CrowdScratch& s, Deciders& d) {
    Candidates found;
    for (int lane = 0; lane < d.count; ++lane) {
        find_nearest_of(s, d.at[lane], found);
        d.near_count[lane] = static_cast<int>(found.count);
        std::copy_n(found.at, found.count, d.near[lane]);
    }
}

template <class T>
HWY_INLINE V2<T> pair_of(const LaneRow& x, const LaneRow& z, size_t lane) {
    return {row<T>(x.lanes, lane), row<T>(z.lanes, lane)};
}

// One velocity among neighbours: the wish, led to the side where some come the other way, and half-planes.
template <class T>
HWY_INLINE void set_out(Deciders& d, float side, size_t lane) {
    const V2<T> velocity = pair_of<T>(d.velocity_x, d.velocity_z, lane);
    V2<T> wish = pair_of<T>(d.wish_x, d.wish_z, lane);
    const T zero = T(0.0f), one = T(1.0f);
    T oncoming = zero, swerve = zero, clears = zero;
    const T per_speed = one / max(sqrt(dot(wish, wish)), T(1e-3f));
    const V2<T> direction = wish * per_speed;
    for (int k = 0; k < d.rows; ++k) {
        const Meet<T> m = meeting<T>(d.neighbours[k], lane);
        const Plane<T> plane = avoid(m, velocity, T(side));
        auto minds = m.share > zero;
        PlaneRows& rows = d.planes[d.firm + k];
        store(select(minds, plane.normal.x, zero), rows.x.lanes + lane);
        store(select(minds, plane.normal.z, zero), rows.z.lanes + lane);
        store(select(minds, plane.offset, T(k_no_offset)), rows.offset.lanes + lane);
        auto comes = (dot(m.velocity, wish) < zero) & (dot(m.between, wish) > zero);
        oncoming = select(comes, one, oncoming);
        const T ahead = dot(m.between, direction), aside = cross(direction, m.between);
        const T nearing = clamp(zero - dot(m.velocity, direction), zero, one) *
                          clamp(one - ahead * T(1 / k_sees), zero, one) *
                          max(one - abs(aside) * T(1 / k_in_line), zero);
        clears =
            clears + select(ahead > zero, select(aside > T(side * k_usual), zero - nearing, nearing), zero);
        // Who goes the same way ahead, and is slower, is overtaken on the side where there is more room.
        auto is_slower =
            (m.hurry > T(1.0f)) & (ahead > zero) & (abs(aside) < m.radii * T(k_in_front)) & (m.share > zero);
        const T slower = clamp(one - dot(m.velocity, direction) * per_speed, zero, one);
        const T pull = slower * max(one - ahead * T(1 / k_overtakes), zero);
        swerve = swerve + select(is_slower, select(aside > zero, zero - pull, pull), zero);
    }
    // Who makes room for a stream that comes overtakes nobody on its side.
    const T room = row<T>(d.makes_room.lanes, lane);
    swerve = select(swerve * room < zero, zero, swerve) + T(k_makes_room) * room + T(k_clears) * clears;
    // Those who do not get on in a jam give way, ever more, until two streams have sorted themselves.
    const T waited = clamp(row<T>(d.waited.lanes, lane) - T(k_patience), zero, T(2.0f));
    const T aside = oncoming * (T(k_keep_side) + T(k_give_way) * waited) * T(side) +
                    T(k_swerves) * clamp(swerve, zero - one, one);
    wish = wish + V2<T>{zero - wish.z, wish.x} * aside;
    store(wish.x, d.wish_x.lanes + lane);
    store(wish.z, d.wish_z.lanes + lane);
}

void set_out_here(Deciders& d, float side) {
    for (size_t lane = 0; lane < k_block; lane += lane_count()) set_out<Lanes>(d, side, lane);
}

// Returns in which lanes nothing is left; their velocities are not set.
uint32_t choose_here(Deciders& d, int planes) {
    alignas(64) float failed[k_block];
    for (size_t lane = 0; lane < k_block; lane += lane_count()) {
        const V2<Lanes> wish = pair_of<Lanes>(d.wish_x, d.wish_z, lane);
        const auto best = best_within(d.planes, planes, row<Lanes>(d.most.lanes, lane), wish, lane);
        store(best.velocity.x, d.chosen_x.lanes + lane);
        store(best.velocity.z, d.chosen_z.lanes + lane);
        store(best.failed, failed + lane);
    }
    uint32_t lanes = 0;
    for (int lane = 0; lane < k_block; ++lane) lanes |= failed[lane] > 0 ? 1u << lane : 0;
    return lanes;
}

template <class T>
HWY_INLINE void keep_headway(Deciders& d, size_t lane) {
    const V2<T> v = pair_of<T>(d.chosen_x, d.chosen_z, lane);
    const T speed = sqrt(dot(v, v)), slow = T(1e-4f), one = T(1.0f);
    const V2<T> direction = v * (one / max(speed, slow));
    T most = T(1e9f);
    for (int k = 0; k < d.rows; ++k)
        most = min(most, headway_speed(meeting<T>(d.neighbours[k], lane), direction));
    const V2<T> kept = v * select(speed < slow, T(0.0f), min(one, most / max(speed, slow)));
    store(kept.x, d.chosen_x.lanes + lane);
    store(kept.z, d.chosen_z.lanes + lane);
}

void keep_headway_here(Deciders& d) {
    for (size_t lane = 0; lane < k_block; lane += lane_count()) keep_headway<Lanes>(d, lane);
}

static Meet<float> meeting(const Meeting& m) {
    return {
        {m.between.x, m.between.z}, {m.velocity.x, m.velocity.z}, m.radii, m.share, m.hurry, m.swath, m.pace};
}

Plane<float> avoid_one(const Meeting& m, Vec2 velocity, float side) {
    return avoid(meeting(m), {velocity.x, velocity.z}, side);
}

float headway_of_one(const Meeting& m, Vec2 direction) {
    return headway_speed(meeting(m), {direction.x, direction.z});
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flaneur {

namespace kernel = HWY_NAMESPACE;

HWY_EXPORT(find_nearest_here);
HWY_EXPORT(find_within_here);
HWY_EXPORT(set_out_here);
HWY_EXPORT(choose_here);
HWY_EXPORT(keep_headway_here);

void find_nearest(const CrowdScratch& scratch, Deciders& deciders) {
    HWY_DYNAMIC_DISPATCH(find_nearest_here)(scratch, deciders);
}

int find_within(const CrowdScratch& scratch, Vec3 place, uint32_t me, float reach, uint32_t* found,
                int room) {
    return HWY_DYNAMIC_DISPATCH(find_within_here)(scratch, place, me, reach, found, room);
}

// Planes for prams, after the neighbours'; returns how many rows there are.
static int add_prams(Deciders& d, float side) {
    int used[k_block], rows = d.firm + d.rows;
    std::fill_n(used, k_block, rows);
    for (int k = 0; k < d.pram_count; ++k) {
        const Meeting& m = d.prams[k];
        int& at = used[m.lane];
        if (at == k_most_planes) continue;
        if (at == rows) {
            for (int lane = 0; lane < k_block; ++lane) set_plane(d.planes[at], lane, k_no_plane);
            ++rows;
        }
        const auto plane =
            kernel::avoid_one(m, {d.velocity_x.lanes[m.lane], d.velocity_z.lanes[m.lane]}, side);
        set_plane(d.planes[at++], m.lane, {{plane.normal.x, plane.normal.z}, plane.offset});
    }
    return rows;
}

// Where planes leave nothing, that which breaks them least.
static void make_the_best(Deciders& d, int rows, int lane) {
    HalfPlane planes[k_most_planes];
    int count = 0, firm = 0;
    for (int k = 0; k < rows; ++k) {
        if (k == d.firm) firm = count;
        const PlaneRows& row = d.planes[k];
        if (row.offset.lanes[lane] == k_no_offset) continue;
        planes[count++] = {{row.x.lanes[lane], row.z.lanes[lane]}, row.offset.lanes[lane]};
    }
    if (rows == d.firm) firm = count;
    const Vec2 v =
        best_velocity(planes, count, firm, d.most.lanes[lane], {d.wish_x.lanes[lane], d.wish_z.lanes[lane]});
    d.chosen_x.lanes[lane] = v.x;
    d.chosen_z.lanes[lane] = v.z;
}

// As keep_headway, for the prams of a lane.
static void keep_off_prams(Deciders& d) {
    for (int k = 0; k < d.pram_count; ++k) {
        const Meeting& m = d.prams[k];
        float &x = d.chosen_x.lanes[m.lane], &z = d.chosen_z.lanes[m.lane];
        const float speed = length(Vec2{x, z});
        if (speed < 1e-4f) continue;
        const float share = std::min(1.0f, kernel::headway_of_one(m, Vec2{x, z} / speed) / speed);
        x *= share, z *= share;
    }
}

void choose_velocities(Deciders& d, float side) {
    HWY_DYNAMIC_DISPATCH(set_out_here)(d, side);
    const int rows = add_prams(d, side);
    const uint32_t failed = HWY_DYNAMIC_DISPATCH(choose_here)(d, rows);
    for (int lane = 0; lane < d.count; ++lane)
        if (failed >> lane & 1) make_the_best(d, rows, lane);
    HWY_DYNAMIC_DISPATCH(keep_headway_here)(d);
    keep_off_prams(d);
}

}  // namespace flaneur
#endif
