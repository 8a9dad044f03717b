// Who does what, where, and for how long.
#include <algorithm>
#include <cmath>

#include "sim/base/hash.h"
#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/base/spans.h"
#include "sim/base/tick.h"
#include "sim/ground/grid.h"
#include "sim/pastimes/choose.h"
#include "sim/pastimes/handheld.h"
#include "sim/pastimes/haste.h"
#include "sim/pastimes/seated.h"

namespace flaneur {

namespace {

constexpr uint32_t k_every = 30;      // ticks between two looks at what somebody could do
constexpr uint32_t k_gives_up = 900;  // ticks until one who does not get to its place leaves it
constexpr float k_index_cell = 8;     // metres
constexpr float k_before_edge = 0.42f;
constexpr float k_feet_treads = 1.5f;  // treads from the edge of a seat on steps to where one stands

uint32_t ticks_of(float seconds) { return static_cast<uint32_t>(seconds / k_tick); }

PlaceIndex index_of(std::vector<Vec2> places) {
    PlaceIndex index;
    Vec2 low{1e9f, 1e9f}, high{-1e9f, -1e9f};
    for (const Vec2 p : places) {
        low = {std::min(low.x, p.x), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.z, p.z)};
    }
    if (places.empty()) low = high = {};
    index.grid = make_grid(low, high, k_index_cell);
    fill_grid(index.grid, static_cast<uint32_t>(places.size()), [&](uint32_t i, auto visit) {
        const Vec2 off = places[i] - index.grid.origin;
        const int x = grid_column(off.x, index.grid.cell, index.grid.width),
                  z = grid_column(off.z, index.grid.cell, index.grid.height);
        visit(static_cast<size_t>(z) * static_cast<size_t>(index.grid.width) + static_cast<size_t>(x));
    });
    index.places = std::move(places);
    return index;
}

// Seconds from the beginning of a phase to its end.
float lasts(Staying what) {
    switch (what) {
        case Staying::sits:
            return k_sits_down;
        case Staying::leans:
            return k_leans_back;
        case Staying::leans_out:
            return k_leans_out;
        case Staying::photographs:
            return 0.3f;
        default:
            return 0;
    }
}
// How long one remembers that it did so, and does not do it again.
float remembers(Staying what) {
    return what == Staying::glances ? 6.0f : what == Staying::marvels ? 20.0f : 60.0f;
}

void enter(const PastimeTick& t, Pastime& p, StayPhase phase) {
    p.phase = phase;
    p.began = t.tick;
}

// Of the speed that it likes.
float pace_of(const Pastime& p, uint32_t tick, float usual) {
    float pace = pace_of(p.haste, usual);
    if (p.phone != PhoneUse::none && tick < p.phone_until)
        pace *= p.phone == PhoneUse::texts ? k_texting_pace : p.phone == PhoneUse::calls ? k_calling_pace : 1;
    constexpr float k_slower = 0.15f;  // m/s, of who glances at a window
    if (p.what == Staying::glances && p.phase == StayPhase::stays)
        pace = std::min(pace, std::max(usual - k_slower, 0.5f * usual) / usual);
    return pace;
}
void keep_pace(const PastimeTick& t, Pastime& p) {
    float& speed = t.crowd.identity.preferred_speed[p.walker];
    const float usual = p.usual_speed > 0 ? p.usual_speed : speed;
    const float pace = pace_of(p, t.tick, usual);
    speed = pace != 1 ? usual * pace : usual;
    p.usual_speed = pace != 1 ? usual : 0;
}

void let_go_of_phone(Pastime& p) {
    p.phone = PhoneUse::none;
    p.phone_began = p.phone_until = 0;
}

// Stands where it wanted to, and as it wanted to.
bool is_in_place(const PastimeTick& t, const Pastime& p) {
    constexpr float k_near = 0.16f, k_nearly = 0.34f, k_still = 0.1f, k_turned = 0.2f;
    constexpr uint32_t k_waits = 240;  // ticks, until nearly is near enough
    const CrowdMotion& m = t.crowd.motion;
    const float off = length(p.to - on_ground(m.position[p.walker]));
    const float turned = std::fabs(wrap_angle(m.heading[p.walker] - heading_of(p.facing)));
    const bool is_near = off < k_near || (off < k_nearly && t.tick - p.began > k_waits);
    return is_near && length(m.velocity[p.walker]) < k_still && turned < k_turned &&
           t.gait.blocks[p.walker / k_block].standing[p.walker % k_block] != 0;
}

Someone someone(const PastimeTick& t, uint32_t i) {
    return {t.gait.people[i / k_block], static_cast<int>(i % k_block)};
}

SatAs sat_as(const PastimeTick& t, const Pastime& p) {
    const PersonBlock& person = t.gait.people[p.walker / k_block];
    SatAs how = sat_as(p.posture, t.pastimes.places.seats[p.place], has_robe(person, p.walker % k_block));
    how.turned = p.turned;
    return how;
}

// From now on nobody moves it.
void stay_put(const PastimeTick& t, const Pastime& p) {
    call(t.crowd, {p.walker, on_ground(t.crowd.motion.position[p.walker]), p.facing, 0});
}

// On steps nothing but others' eyes keeps them off one's back, a tread or two behind the feet.
void keep_others_off(Crowd& crowd, const Pastimes& all, const Pastime& p, bool sits) {
    constexpr float k_behind_edge = 0.15f;  // metres
    if (p.what != Staying::sits) return;
    const Seat& seat = all.places.seats[p.place];
    if (seat.tread <= 0) return;
    const auto at = take_away(crowd.beside, p.walker);
    if (sits)
        crowd.beside.insert(
            at, GoesBeside{p.walker, seat.facing * -(k_feet_treads * seat.tread + k_behind_edge)});
}

void begin(const PastimeTick& t, Pastime& p) {
    enter(t, p, StayPhase::begins);
    if (p.what == Staying::sits || p.what == Staying::leans || p.what == Staying::leans_out) stay_put(t, p);
    if (p.what == Staying::sits) {
        const Seat& seat = t.pastimes.places.seats[p.place];
        keep_others_off(t.crowd, t.pastimes, p, true);
        p.now = p.before = seated_pose(someone(t, p.walker), seat, sat_as(t, p), t.around);
        p.posture_began = t.tick;
    }
    if (p.what == Staying::leans_out) p.now = body_pose_of(t.poses, p.walker);
    if (p.what == Staying::photographs) {
        p.phone = PhoneUse::photographs;
        p.phone_began = t.tick, p.phone_until = p.until;
    }
}

// Who sits shifts now and then.
void shift(const PastimeTick& t, Pastime& p) {
    constexpr float k_least = 20, k_most = 60;  // seconds (Fruin, "Pedestrian Planning and Design", 1971)
    const RandomKey key{t.seed, p.walker, p.posture_began, Purpose::pastime};
    if (t.tick < p.posture_began + ticks_of(random_between(key, k_least, k_most, 40))) return;
    p.posture = static_cast<uint32_t>(random_bits(key, 41));
    p.posture_began = t.tick;
    p.before = p.now;
    p.now = seated_pose(someone(t, p.walker), t.pastimes.places.seats[p.place], sat_as(t, p), t.around);
}

// Whom it looks at for a while: the nearest who passes before it.
void look_about(const PastimeTick& t, Pastime& p) {
    constexpr float k_sees = 7, k_passes = 0.4f;  // metres; m/s
    if (t.tick < p.looks_until) return;
    const RandomKey key{t.seed, p.walker, t.tick, Purpose::pastime};
    p.looks_until = t.tick + ticks_of(random_between(key, 1.5f, 5, 42));
    p.whom = k_nobody;
    if (random_unit(key, 43) < 0.35f) return;
    const CrowdMotion& m = t.crowd.motion;
    float nearest = k_sees;
    for (const WalkerId id : t.crowd.slots.living) {
        const Vec2 way = on_ground(m.position[id.index] - m.position[p.walker]);
        const float far = length(way);
        if (far >= nearest || far < 0.8f || dot(way, p.facing) < 0.25f * far) continue;
        if (length(m.velocity[id.index]) < k_passes) continue;
        nearest = far, p.whom = id.index;
    }
}

// Those it goes with, or else who passes.
void look_at_company(const PastimeTick& t, Pastime& p) {
    const uint32_t whom = p.with == k_nobody ? k_nobody : t.heeds(t.world, p.walker);
    if (whom == k_nobody) return look_about(t, p);
    p.whom = whom;
    p.looks_until = t.tick;
}

bool is_seated_with(const Pastime& p) {
    return p.what == Staying::sits && p.with != k_nobody && p.phase != StayPhase::over;
}

// One of those who sit together gets up, or does not get to its seat: all do.
void raise_others(Pastimes& all, const Pastime& p) {
    if (!is_seated_with(p)) return;
    Pastime* lead = own_of(all.all, p.with);
    if (lead && is_seated_with(*lead)) lead->until = 0;
}

// Whether it is still on its way and none of the others stay.
bool follows_who_leads(const PastimeTick& t, Pastime& p) {
    const Pastime* lead = own_of(t.pastimes.all, p.with);
    const bool stays = lead && is_seated_with(*lead) && lead->with == p.with &&
                       lead->phase != StayPhase::ends && t.tick < lead->until;
    if (!stays) p.until = std::min(p.until, t.tick);
    return !stays && p.phase == StayPhase::comes;
}

// Whether what it did at a place is over.
void end_stay(const PastimeTick& t, Pastime& p) {
    if (p.what != Staying::glances) call_off(t.crowd, p.walker);
    raise_others(t.pastimes, p);
    keep_others_off(t.crowd, t.pastimes, p, false);
    enter(t, p, StayPhase::over);
    p.until = t.tick + ticks_of(remembers(p.what));
    p.whom = k_nobody;
    if (p.what == Staying::photographs) let_go_of_phone(p);
}

void go_on_staying(const PastimeTick& t, Pastime& p) {
    const float since = static_cast<float>(t.tick - p.began) * k_tick;
    if (is_seated_with(p) && follows_who_leads(t, p)) return end_stay(t, p);
    switch (p.phase) {
        case StayPhase::comes:
            if (t.tick - p.began > k_gives_up || !own_of(t.crowd.called, p.walker)) return end_stay(t, p);
            if (is_in_place(t, p)) begin(t, p);
            return;
        case StayPhase::begins:
            if (since >= lasts(p.what)) enter(t, p, StayPhase::stays);
            return;
        case StayPhase::stays:
            if (t.tick >= p.until) {
                // Both hands are needed to get up.
                if (p.phone != PhoneUse::none)
                    p.phone_until = std::min(p.phone_until, t.tick + ticks_of(k_takes_out));
                if (p.phone == PhoneUse::none || t.tick >= p.phone_until || p.what == Staying::photographs)
                    enter(t, p, StayPhase::ends);
                return;
            }
            if (p.what == Staying::sits) shift(t, p);
            if (p.what == Staying::sits || p.what == Staying::leans) look_at_company(t, p);
            if (p.what == Staying::leans_out) look_out(t, p);
            return;
        case StayPhase::ends:
            if (since >= lasts(p.what)) end_stay(t, p);
            return;
        case StayPhase::over:
            return;
    }
}

bool is_over(const Pastime& p, uint32_t tick) {
    const bool stays = p.what != Staying::nowhere && (p.phase != StayPhase::over || tick < p.until);
    return !stays && p.phone == PhoneUse::none && p.heed == 0 && p.usual_speed == 0 &&
           p.haste == Haste::usual;
}

void count_places(Pastimes& all) {
    std::ranges::fill(all.at_seat, 0u);
    std::ranges::fill(all.at_window, 0u);
    std::ranges::fill(all.at_service, 0u);
    std::ranges::fill(all.at_railing, 0u);
    for (const Pastime& p : all.all) {
        if (p.phase == StayPhase::over) continue;
        if (p.what == Staying::sits) ++all.at_seat[p.place];
        if (p.what == Staying::looks) ++all.at_window[p.place];
        if (p.what == Staying::queues) ++all.at_service[p.place];
        if (p.what == Staying::leans_out) ++all.at_railing[p.place];
    }
}

// Finds the place that one is at among others; false: it is not there any more.
template <class Place>
bool keep_place(Pastime& p, Staying what, const std::vector<Place>& from, const std::vector<Place>& to,
                Vec3 Place::*at) {
    if (p.what != what) return true;
    const auto found = std::ranges::find(to, from[p.place].*at, at);
    p.place = static_cast<uint32_t>(found - to.begin());
    return found != to.end();
}

}  // namespace

void set_places(Pastimes& all, const PastimePlaces& places, const Navmesh& mesh, Crowd& crowd) {
    for (Pastime& p : all.all) {
        if (p.phase == StayPhase::over) continue;
        const bool stays =
            keep_place(p, Staying::sits, all.places.seats, places.seats, &Seat::edge) &&
            keep_place(p, Staying::looks, all.places.windows, places.windows, &ShopWindow::at) &&
            keep_place(p, Staying::queues, all.places.services, places.services, &Service::at) &&
            keep_place(p, Staying::leans_out, all.places.railings, places.railings, &Railing::at);
        if (stays) continue;
        call_off(crowd, p.walker);
        if (p.what == Staying::sits) (void)take_away(crowd.beside, p.walker);
        p.phase = StayPhase::over;
        p.until = 0;
    }
    all.places = places;
    std::vector<Vec2> at;
    auto take = [&](const auto& list, auto place) {
        at.clear();
        at.reserve(list.size());
        for (const auto& item : list) at.push_back(on_ground(item.*place));
        return index_of(at);
    };
    all.seats = take(places.seats, &Seat::edge);
    all.windows = take(places.windows, &ShopWindow::at);
    all.services = take(places.services, &Service::at);
    all.railings = take(places.railings, &Railing::at);
    all.sights = index_of({});
    std::vector<Vec2> sights, doors;
    sights.reserve(places.sights.size()), doors.reserve(places.doors.size());
    for (const Vec3 p : places.sights) sights.push_back(on_ground(p));
    for (const Vec3 p : places.doors) doors.push_back(on_ground(p));
    all.sights = index_of(std::move(sights)), all.doors = index_of(std::move(doors));
    all.before_seat.assign(places.seats.size(), {});
    for (size_t s = 0; s < places.seats.size(); ++s) {
        const Seat& seat = places.seats[s];
        // On steps one stands where the feet will be.
        const float off = seat.tread > 0 ? k_feet_treads * seat.tread : k_before_edge;
        const Vec3 before = seat.edge + at_height(seat.facing * off, -0.4f);
        const auto place = nearest(mesh, 0, before, {0.4f, 0.8f, 0.4f});
        // Not beside the seat, nor so far off that feet do not get there.
        if (place && std::fabs(cross(on_ground(place->position - before), seat.facing)) < 0.12f)
            all.before_seat[s] = *place;
    }
    all.at_seat.assign(places.seats.size(), 0);
    all.at_window.assign(places.windows.size(), 0);
    all.at_service.assign(places.services.size(), 0);
    all.at_railing.assign(places.railings.size(), 0);
    all.room.clear();
    all.room.reserve(places.services.size());
    for (const Service& service : places.services) all.room.push_back(room_in_line(service, mesh));
}

void set_shares(Pastimes& all, const PastimeShares& shares, Crowd& crowd) {
    all.shares = shares;
    if (!is_any(shares)) return;
    const size_t most = std::min<size_t>(crowd.capacity, 256 + crowd.capacity / 2);
    all.all.reserve(most);
    crowd.called.reserve(std::max(crowd.called.capacity(), most));
    crowd.beside.reserve(std::max(crowd.beside.capacity(), most));
}

void forget_pastime(Pastimes& all, Crowd& crowd, uint32_t walker) {
    const Pastime* p = own_of(all.all, walker);
    if (!p) return;
    if (p->usual_speed > 0) crowd.identity.preferred_speed[walker] = p->usual_speed;
    raise_others(all, *p);
    if (p->phase != StayPhase::over) keep_others_off(crowd, all, *p, false);
    (void)take_away(all.all, walker);
}

bool is_staying(const Pastimes& all, uint32_t walker) {
    if (all.all.empty()) return false;
    const Pastime* p = own_of(all.all, walker);
    return p && p->what != Staying::nowhere && p->what != Staying::glances && p->phase != StayPhase::over;
}

void decide_pastimes(const PastimeTick& t) {
    Pastimes& all = t.pastimes;
    if (!is_any(all.shares) && all.all.empty()) return;
    for (size_t k = 0; k < all.all.size();) {
        const uint32_t i = all.all[k].walker;
        // Who has fallen has other things to do.
        if (is_there(t.crowd, i) && !is_down(t.crowd, i)) {
            ++k;
            continue;
        }
        if (is_there(t.crowd, i)) call_off(t.crowd, i);
        forget_pastime(all, t.crowd, i);
    }
    for (Pastime& p : all.all) {
        if (p.phone != PhoneUse::none && t.tick >= p.phone_until) let_go_of_phone(p);
        if (p.what != Staying::nowhere) go_on_staying(t, p);
        if (p.what == Staying::queues && p.phase != StayPhase::over) move_up(t, p);
        keep_pace(t, p);
    }
    std::erase_if(all.all, [&](const Pastime& p) { return is_over(p, t.tick); });
    count_places(all);
    for (uint32_t i = t.tick % k_every; i < t.crowd.count; i += k_every) {
        // Another trip is gone at another pace.
        if (Pastime* own = own_of(all.all, i))
            own->haste = t.is_free(t.world, i) ? haste_of(t, i) : Haste::usual;
        if (is_there(t.crowd, i) && all.all.size() < all.all.capacity()) consider(t, i);
    }
}

uint64_t hash_pastimes(const Pastimes& all) {
    uint64_t hash = all.all.size();
    for (const Pastime& p : all.all) hash = hash_bytes(hash, &p, sizeof p);
    return hash;
}

}  // namespace flaneur
