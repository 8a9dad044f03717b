// Who goes with whom of those who are set down.
#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/company/kinship.h"
#include "sim/company/shape.h"
#include "sim/crowd/places.h"

namespace flaneur {

namespace {

constexpr uint32_t k_looks_through = 400;  // walkers, for one whose age fits

// Those who are dealt into groups, one after the other.
struct Dealer {
    std::span<const Folk> folk;
    uint64_t seed;
    std::vector<uint32_t> body;  // by walker
    std::vector<uint8_t> taken;  // 1: is in a group, or alone for good
    const Folk& of(uint32_t i) const { return folk[body[i]]; }
};

// The one who fits best of those who follow, or nobody.
uint32_t find_kin(const Dealer& d, uint32_t first, const Folk& with, Kin kin) {
    uint32_t best = k_nobody;
    float least = k_unfit;
    const auto end = static_cast<uint32_t>(std::min<size_t>(d.body.size(), size_t{first} + k_looks_through));
    for (uint32_t i = first; i < end; ++i) {
        if (d.taken[i] != 0) continue;
        const float unlike = misfit(d.of(i), with, kin);
        if (unlike < least) least = unlike, best = i;
    }
    return best;
}

// The next who is free becomes such a one as `found` is, who becomes what that was: so those of a group are
// near each other, and there are as many of each kind as before.
uint32_t bring_near(Dealer& d, uint32_t first, uint32_t found) {
    uint32_t next = first;
    while (d.taken[next] != 0) ++next;
    std::swap(d.body[next], d.body[found]);
    d.taken[next] = 1;
    return next;
}

struct Dealt {
    std::array<uint32_t, k_most_company> who{};  // as they go abreast
    uint32_t count = 0, leader = 0;
};

// A child is taken along by somebody who could be its parent, and maybe others.
Dealt deal_family(Dealer& d, uint32_t child, uint32_t size) {
    const uint32_t adult = find_kin(d, child + 1, d.of(child), Kin::parent);
    if (adult == k_nobody) return {};
    d.taken[child] = 1;
    Dealt out;
    out.who = {bring_near(d, child + 1, adult), child};
    out.count = 2;
    const Folk parent = d.of(out.who[0]);
    for (; out.count < size; ++out.count) {
        const Kin kin = out.count == 2 ? Kin::spouse : Kin::child;
        const uint32_t found = find_kin(d, child + 1, parent, kin);
        if (found == k_nobody) break;
        out.who[out.count] = bring_near(d, child + 1, found);
    }
    return out;
}

Dealt deal_friends(Dealer& d, uint32_t first, uint32_t size) {
    Dealt out;
    d.taken[first] = 1;
    out.who[0] = first;
    out.count = 1;
    const RandomKey key{d.seed, first, 0, Purpose::company};
    const Kin kin = size == 2 && random_unit(key, 1) < k_couples ? Kin::spouse : Kin::friends;
    const Folk own = d.of(first);
    for (; out.count < size; ++out.count) {
        const uint32_t found = find_kin(d, first + 1, own, kin);
        if (found == k_nobody) break;
        out.who[out.count] = bring_near(d, first + 1, found);
    }
    if (out.count > 2) std::swap(out.who[0], out.who[1]), out.leader = 1;
    return out;
}

// Who walks by itself is no child.
void grow_up(Dealer& d, uint32_t i) {
    constexpr uint32_t k_tries = 64;
    for (uint32_t t = 1; t < k_tries && d.of(i).age < k_never_alone; ++t)
        d.body[i] = draw_walker(d.folk, {d.seed, i, t << 26, Purpose::body}).body;
}

// Where people have been set down, by squares, for who is to stand beside another.
struct Squares {
    static constexpr float k_edge = 2;  // metres
    std::vector<uint32_t> head, next;
    uint32_t mask = 0;

    uint32_t cell(Vec2 p, int x = 0, int z = 0) const {
        const auto column = static_cast<uint32_t>(static_cast<int>(std::floor(p.x / k_edge)) + x),
                   row = static_cast<uint32_t>(static_cast<int>(std::floor(p.z / k_edge)) + z);
        return static_cast<uint32_t>(mix(uint64_t{column} << 32 | row)) & mask;
    }
    void add(const Crowd& c, uint32_t i) {
        uint32_t& first = head[cell(on_ground(c.motion.position[i]))];
        next[i] = first;
        first = i;
    }
    void take_out(const Crowd& c, uint32_t i) {
        uint32_t* at = &head[cell(on_ground(c.motion.position[i]))];
        while (*at != i) at = &next[*at];
        *at = next[i];
    }
};

Squares squares_of(const Crowd& c) {
    Squares s;
    s.mask = 1023;
    while (s.mask < c.count) s.mask = 2 * s.mask + 1;
    s.head.assign(size_t{s.mask} + 1, k_nobody);
    s.next.assign(c.count, k_nobody);
    for (uint32_t i = 0; i < c.count; ++i) s.add(c, i);
    return s;
}

bool has_room_at(const Crowd& c, const Squares& s, Vec3 p, uint32_t walker) {
    constexpr float k_apart = 0.06f;  // metres between bodies
    for (int z = -1; z <= 1; ++z)
        for (int x = -1; x <= 1; ++x)
            for (uint32_t i = s.head[s.cell(on_ground(p), x, z)]; i != k_nobody; i = s.next[i]) {
                const float apart = c.identity.radius[i] + c.identity.radius[walker] + k_apart +
                                    (c.identity.ahead[i] > 0 ? c.identity.ahead[i] + k_pram_radius : 0);
                const Vec3 off = c.motion.position[i] - p;
                if (i != walker && length_squared(on_ground(off)) < apart * apart &&
                    std::fabs(off.y) < k_other_level)
                    return false;
            }
    return true;
}

// Beside who leads, or behind, where there is room; else it stays where it is, and comes there.
void stand_beside(Crowd& c, Squares& squares, const Surroundings& around, const Navmesh& mesh, uint32_t i,
                  uint32_t leader, Vec2 beside) {
    CrowdMotion& m = c.motion;
    const Vec2 ahead = heading_direction(m.heading[leader]), left{ahead.z, -ahead.x};
    const NavPoint from{m.position[leader], m.polygon[leader]};
    const bool is_on_road = surface_of(mesh, from.polygon) == Surface::road;
    const Vec2 places[] = {beside,         {-beside.x, beside.z}, {beside.x, -0.9f}, {-beside.x, -0.9f},
                           {0, -0.95f},    {0.75f, -0.2f},        {-0.75f, -0.2f},   {0, -1.9f},
                           {0.75f, -1.8f}, {-0.75f, -1.8f}};
    for (const Vec2 p : places) {
        const Vec2 wanted = on_ground(from.position) + left * p.x + ahead * p.z;
        NavPoint to = move_along(mesh, 0, from, at_height(wanted, from.position.y));
        if (length(on_ground(to.position) - wanted) > 0.05f) continue;
        if (!is_on_road && surface_of(mesh, to.polygon) == Surface::road) continue;
        const auto hit = ground_at(around, to.position, 1, 2);
        if (!hit) continue;
        to.position.y = hit->height;
        if (!has_room_at(c, squares, to.position, i)) continue;
        squares.take_out(c, i);
        m.position[i] = to.position;
        m.polygon[i] = to.polygon;
        m.under[i] = *hit;
        m.filed[i] = filed_at(to.position);
        squares.add(c, i);
        break;
    }
    m.heading[i] = m.heading[leader];
}

}  // namespace

void make_room(Company& company, Crowd& c, uint32_t capacity) {
    company.bearings.resize(capacity);
    c.fellows.resize(capacity);
    company.groups.reserve(capacity + 1);
    c.called.reserve(capacity);
    c.wayfarers.reserve(capacity);
}

void end_company(Company& company, Crowd& c) {
    company.groups.clear();
    company.bearings.clear();
    c.fellows.clear();
}

void form_groups(Company& company, Crowd& c, const Surroundings& around, const Navmesh& mesh,
                 std::span<const Folk> folk, uint64_t seed) {
    make_room(company, c, c.capacity);
    if (!has_groups(company.shares)) return;
    Dealer d{folk, seed, {c.identity.body.begin(), c.identity.body.begin() + c.count}, {}};
    d.taken.assign(c.count, 0);
    std::vector<Dealt> all;
    all.reserve(c.count / 2 + 1);
    Quota quota = company.shares;
    const float whole = quota[0] + quota[1] + quota[2] + quota[3];
    for (float& share : quota) share *= static_cast<float>(c.count) / whole;
    auto keep = [&](const Dealt& dealt) {
        if (dealt.count == 0) return;
        quota[dealt.count - 1] -= static_cast<float>(dealt.count);
        if (dealt.count > 1) all.push_back(dealt);
    };
    for (uint32_t i = 0; i < c.count; ++i)
        if (d.taken[i] == 0 && d.of(i).age < k_never_alone)
            keep(deal_family(d, i, draw_size(quota, 2, {seed, i, 0, Purpose::company})));
    for (uint32_t i = 0; i < c.count; ++i) {
        if (d.taken[i] != 0) continue;
        if (d.of(i).age < k_never_alone) grow_up(d, i);
        const uint32_t size = draw_size(quota, 1, {seed, i, 0, Purpose::company});
        if (size > 1) keep(deal_friends(d, i, size));
        if (d.taken[i] == 0) quota[0] -= 1;
        d.taken[i] = 1;
    }
    for (uint32_t i = 0; i < c.count; ++i)
        if (d.body[i] != c.identity.body[i])
            become(c, i, draw_walker_as(folk, d.body[i], {seed, i, 0, Purpose::body}));
    Squares squares = squares_of(c);
    for (const Dealt& dealt : all) {
        std::array<WalkerId, k_most_company> who{};
        for (uint32_t k = 0; k < dealt.count; ++k) who[k] = {dealt.who[k], c.slots.generation[dealt.who[k]]};
        Group& g = begin_group(company, c, folk, {who.data(), dealt.count}, dealt.leader, seed);
        const Shape shape = walking_shape(g, company.bearings, 0, false);
        for (uint32_t k = 0; k < g.count; ++k)
            if (k != g.leader)
                stand_beside(c, squares, around, mesh, g.members[k].index, g.members[g.leader].index,
                             shape.at[k]);
    }
    c.scratch.is_ordered = false;
}

}  // namespace flaneur
