#include "sim/company/kinship.h"

#include <algorithm>
#include <cmath>

#include "sim/base/hash.h"
#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/base/spans.h"

namespace flaneur {

float misfit(const Folk& one, const Folk& other, Kin kin) {
    constexpr float k_sex = 8, k_grown = 18, k_generation = 30, k_youngest_parent = 20;  // years
    const float apart = std::fabs(one.age - other.age);
    const bool same = one.woman == other.woman;
    if (one.ahead > 0 && kin != Kin::parent) return k_unfit;  // who pushes a pram leads
    switch (kin) {
        case Kin::spouse:
            if (one.age < k_grown || other.age < k_grown) return k_unfit;
            return apart + (same ? k_unfit : 0);
        case Kin::friends:
            if (one.age < k_never_alone) return k_unfit;
            // The young go with each other, or with who is a generation older.
            if ((one.age < k_grown) != (other.age < k_grown))
                return 15 + std::fabs(apart - k_generation) * 0.5f;
            return apart * (one.age < k_grown ? 3.0f : 1.0f) + (same ? 0 : k_sex);
        case Kin::parent:
            if (one.age < other.age + k_youngest_parent) return k_unfit;
            return std::fabs(apart - k_generation) * 0.5f;
        case Kin::child:
            break;
    }
    if (one.age > 15 || one.age > other.age - k_youngest_parent) return k_unfit;
    return std::fabs(apart - k_generation) * 0.5f;
}

uint32_t draw_size(const Quota& quota, uint32_t least, RandomKey key) {
    float all = 0;
    auto weight = [&](uint32_t size) { return std::max(quota[size - 1], 0.0f) / static_cast<float>(size); };
    for (uint32_t size = least; size <= k_most_company; ++size) all += weight(size);
    float drawn = random_unit(key) * all;
    for (uint32_t size = least; size <= k_most_company; ++size) {
        if (drawn < weight(size)) return size;
        drawn -= weight(size);
    }
    return least;
}

uint64_t hash_company(const Company& company) {
    static_assert(sizeof(Group) == 4 * (8 + 4 + 2 + 5 + 2 + 2 + 4 + 3 + 4 + 5) && sizeof(Bearing) == 4 * 12);
    const uint64_t hash =
        hash_bytes(company.vacant, company.groups.data(), company.groups.size() * sizeof(Group));
    return hash_bytes(hash, company.bearings.data(), company.bearings.size() * sizeof(Bearing));
}

static float age_of(const Crowd& c, std::span<const Folk> folk, uint32_t i) {
    return folk[c.identity.body[i]].age;
}

// Goes along with who leads.
static void come_along(Crowd& c, uint32_t i) {
    c.fellows[i].leads = 0;
    go_by_way(c, {.walker = i, .kind = Wayfarer::Kind::along});
}

static void wander(Crowd& c, uint32_t i) {
    c.fellows[i] = {};
    Journey& j = c.journeys[i];
    const Wayfarer* way = j.errand == Errand::by_way ? own_of(c.wayfarers, i) : nullptr;
    if (!way || way->kind != Wayfarer::Kind::along) return;  // or as somebody has sent it
    (void)take_away(c.wayfarers, i);
    j.errand = Errand::wander;
    j.arrived = false;
    j.pause_until = 0;
    j.path_due = PathDue::to_new_goal;
}

// Whether two go hand in hand who are no child and its parent: some couples do.
static bool hold_as_couple(const Crowd& c, std::span<const Folk> folk, const Group& g, uint64_t seed) {
    constexpr float k_share = 0.3f, k_grown = 18, k_apart = 12;  // years
    if (g.count != 2 || g.expects > 0) return false;
    const uint32_t a = g.members[0].index, b = g.members[1].index;
    const Folk &one = folk[c.identity.body[a]], &other = folk[c.identity.body[b]];
    return one.woman != other.woman && std::min(one.age, other.age) >= k_grown &&
           std::fabs(one.age - other.age) < k_apart && one.ahead == 0 && other.ahead == 0 &&
           random_unit({seed, std::min(a, b), 1, Purpose::company}, 2) < k_share;
}

// A pace nearer to that of the slowest, who hastens a little, and who holds whose hand.
static void settle(Company& company, Crowd& c, std::span<const Folk> folk, Group& g, uint64_t seed) {
    constexpr float k_always = 6, k_share = 0.6f;  // years
    constexpr float k_hastens = 0.35f, k_most_haste = 1.12f;
    float slowest = 9, mean = 0;
    for (uint32_t k = 0; k < g.count; ++k) {
        const float likes = c.identity.preferred_speed[g.members[k].index];
        slowest = std::min(slowest, likes);
        mean += likes / static_cast<float>(g.count);
    }
    g.speed = std::min(lerp(slowest, mean, k_hastens), k_most_haste * slowest);
    for (uint32_t k = 0; k < g.count; ++k) {
        const uint32_t i = g.members[k].index;
        company.bearings[i].holds = k_nobody;
        const float age = age_of(c, folk, i);
        if (age >= k_holds_hands) continue;
        const bool holds = age < k_always || random_unit({seed, i, 1, Purpose::company}) < k_share;
        for (const uint32_t other : {k - 1, k + 1}) {
            if (other >= g.count || !holds) continue;
            const uint32_t adult = g.members[other].index;
            if (age_of(c, folk, adult) > 16 && c.identity.ahead[adult] == 0)
                company.bearings[i].holds = adult;
        }
    }
    if (hold_as_couple(c, folk, g, seed)) company.bearings[g.members[1].index].holds = g.members[0].index;
}

Group& vacant_group(Company& company) {
    auto& all = company.groups;
    auto free = company.vacant > 0 ? std::ranges::find(all, 0u, &Group::count) : all.end();
    if (free == all.end())
        free = all.insert(free, Group{});
    else
        --company.vacant;
    *free = {};
    return *free;
}

Group& begin_group(Company& company, Crowd& c, std::span<const Folk> folk, std::span<const WalkerId> who,
                   uint32_t leader, uint64_t seed) {
    Group& g = vacant_group(company);
    const uint32_t number = number_of(company, g);
    for (const WalkerId id : who) {
        g.members[g.count++] = id;
        company.bearings[id.index] = {};
        c.fellows[id.index] = {.group = number};
    }
    g.leader = leader;
    g.turn_ends = number * 37 % 240;  // not all begin to speak at once
    const uint32_t first = g.members[leader].index;
    g.ahead = heading_direction(c.motion.heading[first]);
    for (uint32_t k = 0; k < g.count; ++k)
        if (k != leader) come_along(c, g.members[k].index);
    c.fellows[first].leads = 1;
    settle(company, c, folk, g, seed);
    return g;
}

void add_member(Company& company, Crowd& c, std::span<const Folk> folk, Group& g, WalkerId who,
                uint64_t seed) {
    // Children beside who leads.
    const bool is_child = age_of(c, folk, who.index) < k_never_alone;
    const uint32_t at = is_child ? g.leader + 1 : g.count;
    for (uint32_t k = g.count; k > at; --k) g.members[k] = g.members[k - 1];
    g.members[at] = who;
    ++g.count;
    company.bearings[who.index] = {};
    c.fellows[who.index] = {.group = number_of(company, g)};
    come_along(c, who.index);
    settle(company, c, folk, g, seed);
}

void end_group(Company& company, Crowd& c, Group& g, std::span<const Folk>) {
    for (uint32_t k = 0; k < g.count; ++k) {
        const WalkerId id = g.members[k];
        if (!is_there(c, id)) continue;
        company.bearings[id.index] = {};
        wander(c, id.index);
    }
    g = {};
    ++company.vacant;
}

void leave_group(Company& company, Crowd& c, Group& g, uint32_t member, std::span<const Folk> folk) {
    const WalkerId id = g.members[member];
    if (is_there(c, id)) {
        company.bearings[id.index] = {};
        wander(c, id.index);
    }
    const bool led = member == g.leader;
    for (uint32_t k = member; k + 1 < g.count; ++k) g.members[k] = g.members[k + 1];
    --g.count;
    if (g.leader > member) --g.leader;
    for (uint32_t k = 0; k < g.count; ++k) {
        Bearing& b = company.bearings[g.members[k].index];
        if (b.holds == id.index) b.holds = k_nobody;
    }
    if (g.count + g.expects < 2 || g.count == 0) return end_group(company, c, g, folk);
    if (g.speaker >= g.count) g.speech = Speech::silence, g.speaker = 0;
    if (!led || g.does == Together::meets) {
        if (led) g.leader = 0;
        return;
    }
    // The oldest leads from now on.
    g.leader = 0;
    for (uint32_t k = 1; k < g.count; ++k)
        if (age_of(c, folk, g.members[k].index) > age_of(c, folk, g.members[g.leader].index)) g.leader = k;
    const uint32_t group = c.fellows[g.members[0].index].group, now = g.members[g.leader].index;
    if (g.does == Together::parts) return;
    wander(c, now);
    c.fellows[now] = {.group = group, .leads = 1};
}

}  // namespace flaneur
