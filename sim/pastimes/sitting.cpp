// Who sits down where, alone or with others.
#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/base/math.h"
#include "sim/base/spans.h"
#include "sim/pastimes/choose.h"

namespace flaneur {

namespace {

// Whether nobody has that seat and one gets there from `at`. Flights are looked up and down.
bool is_free_seat(const PastimeTick& t, uint32_t s, Vec3 at) {
    const Pastimes& all = t.pastimes;
    const NavPoint& before = all.before_seat[s];
    if (all.at_seat[s] > 0 || before.polygon == 0) return false;
    const float most = all.places.seats[s].tread > 0 ? 3 : 0.6f;
    return std::fabs(before.position.y - at.y) < most;
}

// The nearest free seat, an end of a bench first.
uint32_t seat_near(const PastimeTick& t, const Candidate& c, float reach) {
    const Pastimes& all = t.pastimes;
    const std::vector<Seat>& seats = all.places.seats;
    uint32_t best = k_nobody;
    float least = reach;
    auto is_taken = [&](size_t s, uint32_t bench) {
        return s >= seats.size() || seats[s].bench != bench || all.at_seat[s] > 0;
    };
    for_near(all.seats, on_ground(c.at), reach, [&](uint32_t s, float far) {
        if (!is_free_seat(t, s, c.at)) return;
        const uint32_t bench = seats[s].bench;
        if (seats[s].rank > 0 && !(is_taken(s + 1, bench) && is_taken(size_t{s} - 1, bench))) return;
        if (far < least && is_clear(t.mesh, c.at, all.before_seat[s].position)) least = far, best = s;
    });
    return best;
}

constexpr float k_stops_within = 6;  // metres: one who has stopped looks for a seat

// The first of `count` free seats side by side, the nearest such, or k_nobody.
uint32_t seats_near(const PastimeTick& t, Vec3 at, uint32_t count) {
    constexpr float k_beside = 0.9f, k_alike = 0.85f;  // metres; cosine between where they face
    const std::vector<Seat>& seats = t.pastimes.places.seats;
    uint32_t best = k_nobody;
    float least = k_stops_within;
    for_near(t.pastimes.seats, on_ground(at), k_stops_within, [&](uint32_t s, float far) {
        if (far >= least || s + count > seats.size()) return;
        for (uint32_t k = s; k < s + count; ++k) {
            if (!is_free_seat(t, k, at)) return;
            if (k > s &&
                (seats[k].bench != seats[s].bench || length(seats[k].edge - seats[k - 1].edge) > k_beside ||
                 dot(seats[k].facing, seats[k - 1].facing) < k_alike))
                return;
            if (!is_clear(t.mesh, at, t.pastimes.before_seat[k].position)) return;
        }
        least = far, best = s;
    });
    return best;
}

bool can_sit(const PastimeTick& t, const Candidate& c) {
    constexpr float k_least_leg = 0.42f;  // metres
    return !is_laden(t, c) && has_free_hands(c) && c.person.joints[left_upper_leg][1][c.lane] >= k_least_leg;
}

// Seconds that one sits.
float sits_for(const PastimeTick& t, const Candidate& c) {
    constexpr float k_least = 120, k_most = 900;  // (Whyte 1980)
    const float u = random_unit(c.key, 3);
    return (k_least + (k_most - k_least) * u * u) * t.crowd.identity.linger[c.walker];
}

void take_seat(const PastimeTick& t, Pastime& p, uint32_t s) {
    p.place = s;
    ++t.pastimes.at_seat[s];
}

// Sets them in the order in which they sit, along `along`: as they come, but that each child is beside
// somebody grown.
void seat_in_order(const PastimeTick& t, Party& party, Vec2 along) {
    constexpr float k_grown = 14;  // years
    auto far = [&](uint32_t i) { return dot(on_ground(t.crowd.motion.position[i]), along); };
    auto is_child = [&](uint32_t i) { return t.age_of(t.world, i) < k_grown; };
    uint32_t children = 0;
    for (uint32_t n = 0; n < party.count; ++n) {
        children += is_child(party.who[n]);
        for (uint32_t k = n; k > 0 && far(party.who[k]) < far(party.who[k - 1]); --k)
            std::swap(party.who[k], party.who[k - 1]);
    }
    if (children == 0 || children == party.count || party.count < 3) return;
    // Whichever of both are fewer go inside.
    Party inner, outer;
    const bool children_inside = 2 * children <= party.count;
    for (uint32_t k = 0; k < party.count; ++k) {
        Party& to = is_child(party.who[k]) == children_inside ? inner : outer;
        to.who[to.count++] = party.who[k];
    }
    const uint32_t before = outer.count / 2;
    for (uint32_t k = 0; k < party.count; ++k)
        party.who[k] = k < before                 ? outer.who[k]
                       : k < before + inner.count ? inner.who[k - before]
                                                  : outer.who[k - inner.count];
}

}  // namespace

bool sits_down(const PastimeTick& t, const Candidate& c) {
    constexpr float k_passes_within = 3.5f, k_of_passers = 0.1f;
    const float share = t.pastimes.shares.sitting;
    if (share <= 0 || t.pastimes.places.seats.empty()) return false;
    if (random_unit(c.key, c.has_stopped ? 1u : 2u) >= share * (c.has_stopped ? 1 : k_of_passers))
        return false;
    if (!can_sit(t, c)) return false;
    const uint32_t s = seat_near(t, c, c.has_stopped ? k_stops_within : k_passes_within);
    if (s == k_nobody) return false;
    const Vec2 to = on_ground(t.pastimes.before_seat[s].position);
    take_seat(t, send(t, c, Staying::sits, to, t.pastimes.places.seats[s].facing, sits_for(t, c)), s);
    return true;
}

void sit_together(const PastimeTick& t, uint32_t lead) {
    constexpr float k_turns = 0.2f;  // radians, to those beside one
    const Candidate c = candidate(t, lead);
    if (!c.has_stopped || t.crowd.journeys[lead].leaves) return;
    if (random_unit(c.key, 1) >= t.pastimes.shares.sitting) return;
    Party party = t.led_by(t.world, lead);
    if (party.count < 2 || t.pastimes.all.size() + party.count > t.pastimes.all.capacity()) return;
    for (uint32_t k = 0; k < party.count; ++k)
        if (!can_sit(t, candidate(t, party.who[k])) || own_of(t.pastimes.all, party.who[k])) return;
    const uint32_t s = seats_near(t, c.at, party.count);
    if (s == k_nobody) return;
    const std::vector<Seat>& seats = t.pastimes.places.seats;
    const uint32_t end = s + party.count - 1;
    seat_in_order(t, party, normalize_or(on_ground(seats[end].edge - seats[s].edge), {1, 0}));
    const float seconds = sits_for(t, c);
    const Vec2 middle = on_ground(lerp(seats[s].edge, seats[end].edge, 0.5f));
    for (uint32_t k = 0; k < party.count; ++k) {
        const Seat& seat = seats[s + k];
        Pastime& p = send(t, candidate(t, party.who[k]), Staying::sits,
                          on_ground(t.pastimes.before_seat[s + k].position), seat.facing, seconds);
        take_seat(t, p, s + k);
        p.with = lead;
        const Vec2 left{seat.facing.z, -seat.facing.x};
        const float aside = dot(middle - on_ground(seat.edge), left);
        p.turned = std::fabs(aside) < 0.1f ? 0 : aside > 0 ? k_turns : -k_turns;
    }
}

}  // namespace flaneur
