#include "sim/pastimes/choose.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/base/spans.h"
#include "sim/base/tick.h"
#include "sim/pastimes/haste.h"

namespace flaneur {

namespace {

uint32_t ticks_of(float seconds) { return static_cast<uint32_t>(seconds / k_tick); }

bool is_any_near(const PlaceIndex& index, Vec2 at, float reach) {
    bool is = false;
    for_near(index, at, reach, [&](uint32_t, float) { is = true; });
    return is;
}

bool has_own_phone(const Candidate& c) { return c.person.free_hands[c.lane] == 1; }
// What it did, if it still remembers that, or a new one.
Pastime& pastime_of(const PastimeTick& t, uint32_t walker) {
    std::vector<Pastime>& all = t.pastimes.all;
    if (Pastime* own = own_of(all, walker)) return *own;
    Pastime p;
    p.walker = walker;
    return *all.insert(take_away(all, walker), p);
}

}  // namespace

Candidate candidate(const PastimeTick& t, uint32_t i) {
    const CrowdMotion& m = t.crowd.motion;
    const Journey& j = t.crowd.journeys[i];
    const uint32_t left = t.tick < j.pause_until ? j.pause_until - t.tick : 0;
    return {i,
            m.position[i],
            m.velocity[i],
            length(m.velocity[i]),
            j.arrived && left > 0,
            static_cast<float>(left) * k_tick,
            {t.seed, i, j.trip, Purpose::pastime},
            t.gait.people[i / k_block],
            i % k_block};
}

bool has_free_hands(const Candidate& c) { return c.person.free_hands[c.lane] == 3; }
bool is_laden(const PastimeTick& t, const Candidate& c) {
    return static_cast<Bag>(c.person.bag[c.lane]) != Bag::none || own_of(t.gait.canes, c.walker) ||
           t.crowd.identity.ahead[c.walker] > 0;
}

Pastime& send(const PastimeTick& t, const Candidate& c, Staying what, Vec2 to, Vec2 facing, float seconds) {
    constexpr float k_comes = 3;  // seconds to the place, about
    Pastime& p = pastime_of(t, c.walker);
    p.what = what;
    p.phase = StayPhase::comes;
    p.began = t.tick;
    p.until = t.tick + ticks_of(seconds + k_comes);
    p.to = to, p.facing = facing;
    p.whom = k_nobody, p.looks_until = 0;
    p.with = k_nobody, p.turned = 0;
    p.posture = static_cast<uint32_t>(random_bits(c.key, 50));
    const float usual = p.usual_speed > 0 ? p.usual_speed : t.crowd.identity.preferred_speed[c.walker];
    call(t.crowd, {c.walker, to, facing, std::min(usual, 1.2f)});
    return p;
}

namespace {

// Whether somebody leans or will lean there.
bool is_leant_on(const Pastimes& all, Vec2 to) {
    constexpr float k_apart = 0.8f;  // metres
    return std::ranges::any_of(all.all, [&](const Pastime& p) {
        return p.what == Staying::leans && p.phase != StayPhase::over && length(p.to - to) < k_apart;
    });
}

bool leans(const PastimeTick& t, const Candidate& c) {
    constexpr float k_reach = 2.6f, k_before_doors = 1.7f, k_off = 0.48f, k_least_stay = 5;
    constexpr float k_beside = 0.16f;  // metres, by which the mesh may keep one farther off
    const float share = t.pastimes.shares.leaning;
    if (share <= 0 || !c.has_stopped || c.stays < k_least_stay) return false;
    if (random_unit(c.key, 5) >= share || is_laden(t, c)) return false;
    const float h = c.person.height[c.lane];
    const auto wall = closest_wall(t.around, c.at + Vec3{0, 0.55f * h, 0}, k_reach);
    if (!wall) return false;
    // As broad as a back, upright from the hips to the shoulders.
    const Vec2 out = on_ground(wall->normal), along{-out.z, out.x};
    for (const float aside : {-0.22f, 0.0f, 0.22f})
        for (const float up : {0.45f, 0.8f}) {
            const Vec3 from = Vec3{wall->point.x, c.at.y + up * h, wall->point.z} +
                              at_height(out * 0.2f + along * aside, 0);
            const auto there = closest_wall(t.around, from, 0.5f);
            if (!there || std::fabs(there->distance - 0.2f) > 0.01f ||
                dot(on_ground(there->normal), out) < 0.999f)
                return false;
        }
    const Vec3 to = Vec3{wall->point.x, c.at.y, wall->point.z} + at_height(out * k_off, 0);
    const auto place = nearest(t.mesh, 0, to, {0.2f, 0.5f, 0.2f});
    if (!place || length(on_ground(place->position - to)) > k_beside) return false;
    if (is_any_near(t.pastimes.doors, on_ground(to), k_before_doors) ||
        is_leant_on(t.pastimes, on_ground(to)) || !is_clear(t.mesh, c.at, place->position))
        return false;
    Pastime& p =
        send(t, c, Staying::leans, on_ground(place->position), out, random_between(c.key, 20, 120, 6));
    p.at = wall->point;
    return true;
}

bool minds_windows(const PastimeTick& t, const Candidate& c) {
    constexpr float k_sees = 3.4f, k_least_speed = 0.6f, k_stops = 0.035f, k_glances = 0.15f;
    constexpr float k_off = 1, k_beside = 0.45f, k_least = 5, k_most = 30;  // metres, seconds
    const float share = t.pastimes.shares.windows;
    if (share <= 0 || c.has_stopped || c.speed < k_least_speed) return false;
    bool does = false;
    for_near(t.pastimes.windows, on_ground(c.at), k_sees, [&](uint32_t w, float) {
        const ShopWindow& window = t.pastimes.places.windows[w];
        const Vec2 off = on_ground(c.at - window.at), along{-window.out.z, window.out.x};
        if (does || dot(off, window.out) < 0.3f || std::fabs(window.at.y - c.at.y) > 1.2f) return;
        // Comes up to it, or is before it, not past it.
        const float past = dot(off, along) * dot(c.velocity, along);
        if (past > 0 && std::fabs(dot(off, along)) > 0.5f * window.width) return;
        RandomKey key = c.key;
        key.when = w;
        const float u = random_unit(key, 7);
        if (u < k_stops * share && t.pastimes.at_window[w] < 2 && t.crowd.identity.ahead[c.walker] == 0) {
            const float aside = (u < 0.5f * k_stops * share ? k_beside : -k_beside) + 0.001f;
            const Vec3 to = window.at + at_height(window.out * k_off + along * aside, 0);
            const auto place = nearest(t.mesh, 0, to, {0.15f, 0.6f, 0.15f});
            if (!place || !is_clear(t.mesh, c.at, place->position)) return;
            Pastime& p = send(t, c, Staying::looks, on_ground(place->position), -window.out,
                              random_between(key, k_least, k_most, 8));
            p.place = w;
            p.at = window.at + at_height(along * (0.5f * aside), 0.55f * c.person.height[c.lane]);
            ++t.pastimes.at_window[w];
            does = true;
        } else if (u < (k_stops + k_glances) * share) {
            Pastime& p = pastime_of(t, c.walker);
            p.what = Staying::glances, p.phase = StayPhase::stays, p.place = w;
            p.began = t.tick, p.until = t.tick + ticks_of(random_between(key, 1.2f, 2.8f, 9));
            p.at = window.at + Vec3{0, 0.8f * c.person.height[c.lane], 0};
            does = true;
        }
    });
    return does;
}

bool lines_up(const PastimeTick& t, const Candidate& c) {
    constexpr float k_sees = 6, k_patience = 600;  // metres; seconds
    constexpr uint32_t k_least_room = 3;
    Pastimes& all = t.pastimes;
    if (all.shares.queues <= 0 || t.crowd.identity.ahead[c.walker] > 0) return false;
    uint32_t best = k_nobody;
    for_near(all.services, on_ground(c.at), k_sees, [&](uint32_t s, float) {
        const Service& service = all.places.services[s];
        RandomKey key = c.key;
        key.when = s + 4096 * c.key.when;
        if (best != k_nobody || random_unit(key, 30) >= all.shares.queues) return;
        if (all.room[s] < k_least_room || all.at_service[s] >= all.room[s]) return;
        if (std::fabs(service.at.y - c.at.y) > 1 || !is_clear(t.mesh, c.at, service.at)) return;
        best = s;
    });
    if (best == k_nobody) return false;
    const Service& service = all.places.services[best];
    join_line(t, send(t, c, Staying::queues, on_ground(service.at), service.facing, k_patience), best);
    ++all.at_service[best];
    return true;
}

// Where it comes to stand if it stops now.
NavPoint soon_at(const PastimeTick& t, const Candidate& c) {
    constexpr float k_soon = 0.6f;  // seconds
    const NavPoint from{c.at, t.crowd.motion.polygon[c.walker]};
    return move_along(t.mesh, 0, from, c.at + at_height(c.velocity * k_soon, 0));
}

// Stops where it is soon, and turns to something worth a picture.
bool takes_picture(const PastimeTick& t, const Candidate& c) {
    constexpr float k_nearest = 6, k_farthest = 22, k_least = 6, k_most = 11;  // metres, seconds
    if (t.crowd.identity.ahead[c.walker] > 0 || (!has_free_hands(c) && !has_own_phone(c))) return false;
    const Vec2 here = on_ground(c.at);
    uint32_t sight = k_nobody;
    float nearest_far = k_farthest;
    for_near(t.pastimes.sights, here, k_farthest, [&](uint32_t s, float far) {
        const Vec2 way = t.pastimes.sights.places[s] - here;
        const bool sees = dot(way, heading_direction(t.crowd.motion.heading[c.walker])) > 0.2f * far;
        if (far > k_nearest && far < nearest_far && sees) nearest_far = far, sight = s;
    });
    if (sight == k_nobody) return false;
    const NavPoint to = soon_at(t, c);
    const Vec3 what = t.pastimes.places.sights[sight];
    Pastime& p =
        send(t, c, Staying::photographs, on_ground(to.position),
             normalize_or(on_ground(what - to.position), {0, 1}), random_between(c.key, k_least, k_most, 12));
    p.at = what + Vec3{0, 1.6f, 0};
    return true;
}

// Who is a stranger stops now and then, and looks up at a house ahead.
bool looks_up(const PastimeTick& t, const Candidate& c) {
    constexpr float k_nearest = 3, k_farthest = 14, k_high = 3, k_least_speed = 0.5f;  // metres, m/s
    constexpr float k_now = 0.03f, k_least = 4, k_most = 9;  // of the times one thinks of it; seconds
    constexpr float k_up = 0.7f, k_youngest = 13;            // metres for each metre away; years
    const float share = t.pastimes.shares.tourists;
    if (share <= 0 || c.has_stopped || c.speed < k_least_speed) return false;
    RandomKey key = c.key;
    key.when = 0;
    if (random_unit(key, 60) >= share || t.crowd.identity.ahead[c.walker] > 0) return false;
    key.when = t.tick;
    if (random_unit(key, 61) >= k_now || t.age_of(t.world, c.walker) < k_youngest) return false;
    const Vec2 way = c.velocity / c.speed;
    const Vec3 eyes = c.at + Vec3{0, 0.93f * c.person.height[c.lane], 0};
    const auto wall = closest_wall(t.around, eyes + at_height(way * 6, 0), 9);
    if (!wall) return false;
    const Vec2 off = on_ground(wall->point - c.at);
    const float far = length(off);
    if (far < k_nearest || far > k_farthest || dot(off, way) < 0.25f * far) return false;
    if (!closest_wall(t.around, {wall->point.x, c.at.y + k_high, wall->point.z}, 0.5f)) return false;
    const NavPoint to = soon_at(t, c);
    const Surface kind = surface_of(t.mesh, to.polygon);
    if (is_carriageway(kind)) return false;
    Pastime& p = send(t, c, Staying::marvels, on_ground(to.position),
                      normalize_or(on_ground(wall->point - to.position), way),
                      random_between(key, k_least, k_most, 62));
    p.at = {wall->point.x, eyes.y + k_up * far, wall->point.z};
    return true;
}

// A phone is used for most of one of the stretches of time that everybody has.
void uses_phone(const PastimeTick& t, const Candidate& c, const Pastime* own) {
    constexpr uint32_t k_stretch_ticks = 45 * 60, k_least_ticks = 6 * 60;
    constexpr float k_used = 0.87f;  // of a stretch, on average
    const float share = t.pastimes.shares.phones;
    if (share <= 0 || (own && own->phone != PhoneUse::none)) return;
    if (!has_free_hands(c) && !has_own_phone(c)) return;
    if (own_of(t.gait.canes, c.walker) || t.crowd.identity.ahead[c.walker] > 0) return;
    RandomKey key = c.key;
    key.when = 0;
    const auto late = static_cast<uint32_t>(random_unit(key, 20) * static_cast<float>(k_stretch_ticks));
    const uint32_t time = t.tick + late, stretch = time / k_stretch_ticks, in = time % k_stretch_ticks;
    key.when = stretch;
    if (random_unit(key, 21) >= share / k_used) return;
    const float kind = random_unit(key, 22);
    const auto from = static_cast<uint32_t>(random_unit(key, 23) * 360),
               to = k_stretch_ticks - static_cast<uint32_t>(random_unit(key, 24) * 360);
    if (in < from || in + k_least_ticks > to) return;
    const bool is_free = !own || own->what == Staying::nowhere;
    if (kind > 0.8f && is_free && takes_picture(t, c)) return;
    Pastime& p = pastime_of(t, c.walker);
    p.phone = kind < 0.68f || p.what == Staying::sits ? PhoneUse::texts : PhoneUse::calls;
    p.phone_began = t.tick;
    p.phone_until = t.tick + (to - in);
}

}  // namespace

bool has_robe(const PersonBlock& person, size_t lane) {
    return person.postures[static_cast<size_t>(Posture::pockets)][lane] == 0;
}

void consider(const PastimeTick& t, uint32_t i) {
    const Pastime* own = own_of(t.pastimes.all, i);
    if (!t.is_free(t.world, i)) {
        if (t.pastimes.shares.sitting > 0 && !own) sit_together(t, i);
        return;
    }
    if (own_of(t.crowd.called, i) && !own) return;
    const Candidate c = candidate(t, i);
    const Journey& j = t.crowd.journeys[i];
    const Haste haste = own ? own->haste : haste_of(t, i);
    if (!own && haste != Haste::usual) {
        Pastime& begun = pastime_of(t, i);
        begun.haste = haste;
        own = &begun;
    }
    const bool is_late = haste == Haste::hurries || haste == Haste::runs;
    const bool may_stay = (!own || own->what == Staying::nowhere) && !is_late;
    const bool goes_about = j.errand == Errand::wander && !(j.leaves && j.arrived) && t.tick > 0 &&
                            !waits_at_kerb(t.crowd.kerbs, i);
    if (may_stay && goes_about && (!own || own->phone == PhoneUse::none)) {
        if (sits_down(t, c) || leans_out(t, c) || leans(t, c) || lines_up(t, c) || minds_windows(t, c) ||
            looks_up(t, c))
            return;
    }
    const bool may_use = !own || own->phase == StayPhase::stays || own->phase == StayPhase::over ||
                         own->what == Staying::nowhere;
    if (own && (own->what == Staying::photographs || own->what == Staying::marvels)) return;
    if (may_use && haste != Haste::runs) uses_phone(t, c, own);
}

}  // namespace flaneur
