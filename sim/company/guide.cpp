// Where all of a group should be, tick by tick.
#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/base/spans.h"
#include "sim/base/tick.h"
#include "sim/company/kinship.h"
#include "sim/company/meeting.h"
#include "sim/company/shape.h"
#include "sim/company/talk.h"
#include "sim/crowd/places.h"

namespace flaneur {

namespace {

constexpr float k_goes = 0.3f;                            // m/s, of who leads
constexpr float k_parted = 3.5f;                          // metres from where one should be
constexpr uint32_t k_gives_up = 45 * 60;                  // ticks, after which who is parted goes alone
constexpr float k_hastens = 1.25f, k_catches_up = 1.45f;  // times the usual speed, at most,
constexpr float k_fastest = 1.9f, k_child_runs = 2.3f;    // m/s

// What a group is guided by; writes what is of its members alone.
struct Guide {
    Company& company;
    Crowd& c;
    const Navmesh& mesh;
    std::span<const Folk> folk;
    int thread;
    uint32_t tick;
    uint64_t seed;
    Group& g;

    uint32_t member(uint32_t k) const { return g.members[k].index; }
    uint32_t leader() const { return member(g.leader); }
    Vec3 at(uint32_t i) const { return c.motion.position[i]; }
    Vec2 left() const { return {g.ahead.z, -g.ahead.x}; }
    NavPoint from() const { return {at(leader()), c.motion.polygon[leader()]}; }
    Bearing& bearing(uint32_t i) const { return company.bearings[i]; }
    float age(uint32_t i) const { return folk[c.identity.body[i]].age; }
    RandomKey key(uint32_t when) const { return {seed, leader(), when, Purpose::company}; }
};

// Whether who stands there is in the way of who drives. Who leads waits beside the lanes of a crossing.
bool is_among_cars(const Guide& d, NavPoint p) {
    return is_carriageway(surface_of(d.mesh, p.polygon)) &&
           (!has_traffic(d.c.roadway) || is_driven_on(*d.c.roadway.map, on_ground(p.position)));
}

// The place so far from another, or as near to it as ground, kerbs and lanes let one.
NavPoint place_beside(const Guide& d, NavPoint from, Vec2 off) {
    const bool on_road = is_among_cars(d, from);
    NavPoint to = from;
    for (const float share : {1.0f, 0.5f, 0.2f}) {
        to = move_along(d.mesh, d.thread, from, from.position + at_height(off * share, 0));
        if (on_road || !is_among_cars(d, to)) return to;
    }
    return from;
}

// The same of who leads, or will be there; where there is no room beside, behind.
Vec3 spot_beside(const Guide& d, NavPoint from, Vec2 off) {
    constexpr float k_too_near = 0.42f, k_behind = 0.9f;  // metres
    const NavPoint to = place_beside(d, from, off);
    if (length(on_ground(to.position - from.position)) > k_too_near) return to.position;
    return place_beside(d, from, d.g.ahead * -k_behind).position;
}

// Metres to one side of who leads, `most` at most, here and, of one who goes, a little ahead.
float room_beside(const Guide& d, Vec2 side, float most) {
    constexpr float k_on = 0.9f;  // metres
    auto room_at = [&](NavPoint p) {
        return std::max(dot(on_ground(place_beside(d, p, side * most).position - p.position), side), 0.0f);
    };
    const NavPoint here = d.from();
    const float room = room_at(here);
    if (length(d.c.motion.velocity[d.leader()]) < k_goes) return room;
    return std::min(
        room, room_at(move_along(d.mesh, d.thread, here, here.position + at_height(d.g.ahead * k_on, 0))));
}

// Which way they go, without a swing round of all where who leads turns back.
void turn(Guide& d, Vec2 way) {
    constexpr float k_share = 0.44f, k_back = -0.3f;
    if (way == Vec2{}) return;
    if (dot(way, d.g.ahead) < k_back) {
        d.g.ahead = way;
        d.g.mirrored = 1 - d.g.mirrored;
        return;
    }
    d.g.ahead = normalize_or(lerp(d.g.ahead, way, k_share), way);
}

// Strangers to a square metre, where they go.
void look_about(Guide& d) {
    constexpr float k_reach = 2, k_on = 1;  // metres
    const Vec3 middle = d.at(d.leader()) + at_height(d.g.ahead * k_on, 0);
    const CrowdScratch& s = d.c.scratch;
    uint32_t count = 0;
    for_seen_near(s, middle, k_reach, [&](uint32_t begin, uint32_t end) {
        for (uint32_t k = begin; k < end; ++k) {
            const Vec3 off{s.seen.x[k] - middle.x, s.seen.y[k] - middle.y, s.seen.z[k] - middle.z};
            if (length_squared(on_ground(off)) > k_reach * k_reach || std::fabs(off.y) > k_other_level)
                continue;
            count += !are_together(d.c.fellows, s.seen.all[k].id, d.leader());
        }
    });
    d.g.crowded = static_cast<float>(count) / (k_pi * k_reach * k_reach);
}

// Who goes at which side, and how narrow they go.
Shape choose_shape(Guide& d) {
    constexpr float k_margin = 0.2f, k_dear = 3, k_keeps = 0.6f;  // metres
    constexpr float k_thin = 0.6f, k_dense = 1.2f;                // strangers to a square metre
    constexpr float k_narrows = 2 / 15.0f, k_widens = 1 / 15.0f;  // each time
    Group& g = d.g;
    const Shape shapes[] = {walking_shape(g, d.company.bearings, 0, false),
                            walking_shape(g, d.company.bearings, 0, true)};
    const float widest = std::max(shapes[0].left, shapes[0].right) + k_margin;
    const float left = room_beside(d, d.left(), widest), right = room_beside(d, -d.left(), widest);
    float costs[2];
    for (const uint32_t mirrored : {0u, 1u}) {
        const Shape& s = shapes[mirrored];
        costs[mirrored] = k_dear * (std::max(s.left - left, 0.0f) + std::max(s.right - right, 0.0f));
        for (uint32_t k = 0; k < g.count; ++k)
            costs[mirrored] +=
                std::fabs(dot(on_ground(d.at(d.member(k)) - d.at(d.leader())), d.left()) - s.at[k].x);
    }
    if (costs[1 - g.mirrored] + k_keeps < costs[g.mirrored]) g.mirrored = 1 - g.mirrored;
    const Shape& own = shapes[g.mirrored];
    auto lacks = [](float room, float wanted) { return wanted > 0 ? 1 - std::min(room / wanted, 1.0f) : 0; };
    const float wanted = std::max({1.2f * lacks(left, own.left), 1.2f * lacks(right, own.right),
                                   smoothstep(k_thin, k_dense, g.crowded)});
    g.narrow = clamp(g.narrow + clamp(wanted - g.narrow, -k_widens, k_narrows), 0, 1);
    return walking_shape(g, d.company.bearings, g.narrow, g.mirrored != 0);
}

void set_spot(const Guide& d, uint32_t i, Vec3 spot, Vec2 drift, Vec2 facing) {
    Fellow& f = d.c.fellows[i];
    f.spot = spot;
    f.drift = drift;
    f.since = d.tick;
    f.facing = facing;
    const float own = d.c.identity.preferred_speed[i];
    const float far = length(on_ground(spot - d.at(i)));
    f.most = std::max(k_hastens * d.g.speed, own);
    if (far > 1) f.most = std::max(f.most, std::min(k_catches_up * own, k_fastest));
}

// Whether a child may run ahead: not near roads.
bool is_safe_ahead(const Guide& d, float far, NavPoint& to) {
    const NavPoint from = d.from();
    const Vec2 wanted = d.g.ahead * far;
    to = move_along(d.mesh, d.thread, from, from.position + at_height(wanted, 0));
    const NavPoint beyond = move_along(d.mesh, d.thread, to, to.position + at_height(d.g.ahead * 2.5f, 0));
    return length(on_ground(to.position - from.position) - wanted) < 0.1f &&
           !is_carriageway(surface_of(d.mesh, to.polygon)) &&
           !is_carriageway(surface_of(d.mesh, beyond.polygon)) &&
           !is_carriageway(surface_of(d.mesh, from.polygon));
}

// Children of six to ten run some metres ahead now and then, and come back.
bool runs_ahead(const Guide& d, uint32_t i) {
    constexpr float k_youngest = 5.5f, k_oldest = 11, k_far = 4.5f;                     // years; metres
    constexpr float k_least = 3, k_most = 7, k_least_between = 8, k_most_between = 30;  // seconds
    Bearing& b = d.bearing(i);
    if (b.holds != k_nobody || d.age(i) < k_youngest || d.age(i) > k_oldest) return false;
    auto drawn = [&](float least, float most, uint32_t index) {
        return d.tick +
               static_cast<uint32_t>(
                   random_between({d.seed, i, d.tick, Purpose::company}, least, most, index) / k_tick);
    };
    if (b.runs_next == 0) b.runs_next = drawn(0, k_most_between, 2);
    NavPoint to;
    const bool can = d.g.narrow < 0.3f && d.g.waits == 0 && is_safe_ahead(d, k_far, to);
    if (d.tick >= b.runs_until && d.tick >= b.runs_next && can) {
        b.runs_until = drawn(k_least, k_most, 0);
        b.runs_next = b.runs_until + (drawn(k_least_between, k_most_between, 1) - d.tick);
    }
    if (d.tick >= b.runs_until) return false;
    if (!can) {
        b.runs_until = d.tick;
        return false;
    }
    set_spot(d, i, to.position, d.c.motion.velocity[d.leader()], {});
    d.c.fellows[i].most = k_child_runs;
    return true;
}

// So that nobody falls behind: who leads slows down for the slowest, and waits for who is far behind.
void set_pace(Guide& d, float behind, bool is_parted) {
    constexpr float k_little = 0.3f, k_much = 1, k_slowest = 0.5f;  // metres; of the speed
    constexpr float k_waits_from = 2.2f, k_comes_up = 0.9f;         // metres
    constexpr float k_out_of_the_way = 1.8f;                        // from where others are to come in
    constexpr uint32_t k_patience = 10 * 60;                        // ticks
    Group& g = d.g;
    if (behind > k_waits_from && g.waits == 0) g.waits = std::max(d.tick, 1u);
    if (behind < k_comes_up) g.waits = 0;
    if (!is_parted) g.parted_since = k_never;
    if (is_parted && g.parted_since == k_never) g.parted_since = d.tick;
    const uint32_t i = d.leader();
    const bool on_road = is_carriageway(d.c.motion.under[i].kind);
    float share = lerp(1, k_slowest, clamp((behind - k_little) / (k_much - k_little), 0, 1));
    const bool expects = g.expects > 0 && length(on_ground(g.entry.position - d.at(i))) > k_out_of_the_way;
    // Not for ever: whoever leads may be what holds the other up.
    const bool waits = g.waits != 0 && d.tick - g.waits < k_patience;
    if (waits || expects) share = 0;
    if (on_road && !expects) share = std::max(share, 0.75f);
    d.c.fellows[i].pace = std::min(g.speed / d.c.identity.preferred_speed[i], 1.0f) * share;
    d.c.fellows[i].since = d.tick;
}

void walk(Guide& d) {
    const uint32_t lead = d.leader();
    const Vec2 velocity = d.c.motion.velocity[lead];
    const float speed = length(velocity);
    // At a lamp they stand beside where whoever leads will stand: places that went on with it would come to
    // lie beyond the kerb.
    const bool at_kerb = waits_at_kerb(d.c.kerbs, lead);
    const NavPoint from =
        at_kerb ? place_beside(d, d.from(), d.c.kerbs.waits[lead].to - on_ground(d.at(lead))) : d.from();
    turn(d, at_kerb ? faces_over(d.c.kerbs, lead) : speed > k_goes ? velocity / speed : Vec2{});
    const Shape shape = choose_shape(d);
    d.c.fellows[lead].facing = {};
    float behind = 0;
    bool is_parted = false;
    for (uint32_t k = 0; k < d.g.count; ++k) {
        if (k == d.g.leader) continue;
        const uint32_t i = d.member(k);
        if (!at_kerb && speed > k_goes && runs_ahead(d, i)) continue;
        const Vec2 off = d.left() * shape.at[k].x + d.g.ahead * shape.at[k].z;
        const Vec3 spot = spot_beside(d, from, off);
        const bool stands = at_kerb || speed < 0.15f;
        set_spot(d, i, spot, stands ? Vec2{} : velocity, stands ? d.g.ahead : Vec2{});
        const Vec2 to = on_ground(spot - d.at(i));
        const float far = length(to);
        const bool is_away = far > k_parted || std::fabs(spot.y - d.at(i).y) > k_other_level;
        is_parted |= is_away;
        behind = std::max({behind, dot(to, d.g.ahead), is_away ? far : 0.6f * far});
    }
    set_pace(d, behind, is_parted);
}

// Whether all of them can stand there.
bool is_room_for(const Guide& d, const Circle& ring) {
    const NavPoint from = d.from();
    const bool on_road = is_carriageway(surface_of(d.mesh, from.polygon));
    for (uint32_t k = 0; k < d.g.count; ++k) {
        if (k == d.g.leader) continue;
        const NavPoint to = move_along(d.mesh, d.thread, from, at_height(ring.at[k], from.position.y));
        if (length(on_ground(to.position) - ring.at[k]) > 0.08f) return false;
        if (!on_road && is_carriageway(surface_of(d.mesh, to.polygon))) return false;
    }
    return true;
}

bool stand_in_ring(Guide& d) {
    const uint32_t lead = d.leader();
    const Vec2 here = on_ground(d.at(lead));
    Vec2 mean{};
    for (uint32_t k = 0; k < d.g.count; ++k) mean += on_ground(d.at(d.member(k))) - here;
    const float yaw = heading_of(normalize_or(mean, d.g.ahead));
    const bool at_right_angle = random_unit(d.key(d.c.journeys[lead].trip), 3) < 0.35f;
    for (const float degrees : {0.0f, 40.0f, -40.0f, 80.0f, -80.0f, 120.0f, -120.0f, 180.0f}) {
        const Circle ring = ring_of(d.g, d.c, heading_direction(yaw + degrees * k_radians), at_right_angle);
        if (!is_room_for(d, ring)) continue;
        d.g.does = Together::ring;
        d.g.middle = ring.middle;
        for (uint32_t k = 0; k < d.g.count; ++k) {
            const Vec2 facing = normalize_or(ring.middle - ring.at[k], d.g.ahead);
            if (k == d.g.leader) {
                d.c.journeys[lead].facing = d.c.fellows[lead].facing = facing;
                continue;
            }
            const NavPoint to = move_along(d.mesh, d.thread, d.from(), at_height(ring.at[k], d.at(lead).y));
            set_spot(d, d.member(k), to.position, {}, facing);
        }
        return true;
    }
    return false;
}

// Side by side, each turned a little to the middle.
void stand_in_row(Guide& d, Vec2 facing) {
    constexpr float k_inward = 0.3f;
    turn(d, facing);
    d.g.ahead = facing;
    d.g.does = Together::row;
    d.g.middle = facing;
    d.c.fellows[d.leader()].facing = facing;
    choose_shape(d);
    const Shape shape = walking_shape(d.g, d.company.bearings, 0, d.g.mirrored != 0);
    for (uint32_t k = 0; k < d.g.count; ++k) {
        if (k == d.g.leader) continue;
        const Vec3 spot = spot_beside(d, d.from(), d.left() * shape.at[k].x);
        const Vec2 inward = d.left() * (shape.at[k].x > 0 ? -k_inward : k_inward);
        set_spot(d, d.member(k), spot, {}, normalize_or(facing + inward, facing));
    }
}

// Who leads is at its goal: they stand and talk, for longer than one alone would stay.
void stand(Guide& d) {
    constexpr float k_least = 8, k_most = 30, k_stays = 0.7f;  // seconds; of the times
    const uint32_t lead = d.leader();
    Journey& j = d.c.journeys[lead];
    if (d.g.does == Together::walks) {
        const RandomKey key = d.key(j.trip);
        const auto stays = static_cast<uint32_t>(random_between(key, k_least, k_most, 4) / k_tick);
        if (!j.leaves && random_unit(key, 5) < k_stays)
            j.pause_until = std::max(j.pause_until, d.tick + stays);
        const bool looks = j.facing != Vec2{};
        if (looks || !stand_in_ring(d)) stand_in_row(d, looks ? j.facing : d.g.ahead);
    }
    float behind = 0;
    for (uint32_t k = 0; k < d.g.count; ++k) {
        Fellow& f = d.c.fellows[d.member(k)];
        f.since = d.tick;
        if (k == d.g.leader) continue;
        behind = std::max(behind, length(on_ground(f.spot - d.at(d.member(k)))));
    }
    set_pace(d, 0, behind > k_parted);
}

// They are where they are called to.
void sit(Guide& d) {
    for (uint32_t k = 0; k < d.g.count; ++k) set_spot(d, d.member(k), d.at(d.member(k)), {}, {});
    d.g.waits = 0;
    d.g.parted_since = k_never;
}

void guide_group(Guide& d) {
    const uint32_t lead = d.leader();
    if (d.g.does == Together::parts || d.g.does == Together::meets) return;
    if (d.g.does == Together::sits && own_of(d.c.called, lead)) return sit(d);
    look_about(d);
    const Journey& j = d.c.journeys[lead];
    const bool pauses = j.arrived && d.tick < j.pause_until;
    if (d.g.does == Together::sits) d.g.does = Together::walks;
    if (pauses && (d.g.does != Together::walks || length(d.c.motion.velocity[lead]) < k_goes))
        return stand(d);
    d.g.does = Together::walks;
    walk(d);
}

// Who leaves the crowd takes the others along: each goes there and leaves by itself.
void let_leave(Crowd& c, Group& g) {
    constexpr uint32_t k_after = 75;  // ticks
    const Journey lead = c.journeys[g.members[g.leader].index];
    g.does = Together::parts;
    g.speech = Speech::silence;
    for (uint32_t k = 0; k < g.count; ++k) {
        const uint32_t i = g.members[k].index;
        c.fellows[i] = {.group = c.fellows[i].group};
        if (k == g.leader) continue;
        (void)take_away(c.wayfarers, i);
        Journey next;
        next.goal = lead.goal;
        next.facing = c.identity.ahead[i] == 0 ? lead.facing : Vec2{};
        next.stay = {0.2f, 1};
        next.trip = c.journeys[i].trip + 1;
        next.path_due = PathDue::to_goal;
        next.pause_until = lead.pause_until + (k + 1) * k_after;  // one after the other
        next.leaves = true;
        next.door_tries = c.identity.ahead[i] == 0 && c.identity.ahead[g.members[g.leader].index] == 0
                              ? lead.door_tries
                              : uint8_t{0};
        c.journeys[i] = next;
    }
}

bool goes_along(const Crowd& c, uint32_t i) {
    if (c.journeys[i].errand != Errand::by_way) return false;
    const Wayfarer* way = own_of(c.wayfarers, i);
    return way && way->kind == Wayfarer::Kind::along;
}

// Whether it is of the group no more: is gone, or, asked now and then, somebody has sent it elsewhere.
bool has_left(const Crowd& c, const Group& g, uint32_t member, uint32_t tick) {
    const WalkerId id = g.members[member];
    if (!is_there(c, id)) return true;
    if (g.does == Together::parts) return false;
    if (member == g.leader) return c.journeys[id.index].errand != Errand::wander;
    return (tick + g.members[0].index) % k_decision_ticks == 0 && !goes_along(c, id.index);
}

// What has an order of its own: who has left, and who leaves.
void keep_up(Company& company, Crowd& c, std::span<const Folk> folk, Group& g, uint32_t tick) {
    for (uint32_t k = 0; k < g.count;) {
        if (has_left(c, g, k, tick))
            leave_group(company, c, g, k, folk), k = 0;
        else
            ++k;
    }
    if (g.count == 0 || g.does == Together::parts) return;
    const Journey& lead = c.journeys[g.members[g.leader].index];
    if (g.expects > 0 && tick >= g.expects_until) {
        g.expects = 0;
        if (g.count < 2) return end_group(company, c, g, folk);
    }
    if (lead.leaves && lead.arrived && g.expects == 0) return let_leave(c, g);
    if (g.parted_since == k_never || tick - g.parted_since < k_gives_up) return;
    for (uint32_t k = 0; k < g.count; ++k) {
        const uint32_t i = g.members[k].index;
        const float far = length(on_ground(c.fellows[i].spot - c.motion.position[i]));
        if (k == g.leader || far < k_parted) continue;
        g.parted_since = k_never;
        return leave_group(company, c, g, k, folk);
    }
}

}  // namespace

void guide(Company& company, Crowd& c, const Navmesh& mesh, Workers& workers, std::span<const Folk> folk,
           uint32_t tick, uint64_t seed) {
    for (Group& g : company.groups) {
        if (g.count == 0) continue;
        if (g.does == Together::meets)
            meet(company, c, mesh, folk, g, tick, seed);
        else
            keep_up(company, c, folk, g, tick);
        if (g.count > 0) take_turns(g, tick, seed);
    }
    if (company.acquaintances > 0) find_meetings(company, c, mesh, folk, tick, seed);
    parallel_for(workers, company.groups.size(), 16, [&](size_t begin, size_t end, int thread) {
        for (size_t n = begin; n < end; ++n) {
            Group& g = company.groups[n];
            // Before who leads decides.
            if (g.count == 0 || !decides(c, g.members[g.leader].index / k_block, tick + 1)) continue;
            // At every other decision; between them places move on.
            if (tick % (2 * k_decision_ticks) < k_decision_ticks) {
                Guide d{company, c, mesh, folk, thread, tick, seed, g};
                guide_group(d);
            }
            look_at_each_other(company, c, g, tick, seed);
        }
    });
}

}  // namespace flaneur
