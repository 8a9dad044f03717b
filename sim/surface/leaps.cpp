#include "sim/surface/leaps.h"

#include <algorithm>
#include <cmath>

#include "sim/base/rng.h"

namespace flaneur {

namespace {

constexpr float k_likes = 0.5f;              // of the times that a body is overhead
constexpr float k_apart = 0.25f;             // metres between two in the air,
constexpr float k_land_apart = 0.6f;         // and to those who are where one will land
constexpr float k_high[] = {0.3f, 1, 1.7f};  // of the middle's height: feet, middle and head
constexpr float k_plumb = 0.999f;            // cosine of what one may lean who leaves
constexpr size_t k_most_aloft = 16;

// One who is in the air, or is about to be.
struct Aloft {
    Flyer flyer;
    Leap leap;
    float radius = 0;
    int wait = 0;  // ticks until it leaves
};

struct Company {
    Aloft all[k_most_aloft];
    size_t count = 0;
};

int ticks_to_leave(const Leap& leap, float dt) {
    return leap.stage == LeapStage::crouches
               ? static_cast<int>(std::ceil((k_crouch_seconds - leap.seconds) / dt))
               : 0;
}

bool is_apart(const Flyer& a, const Flyer& b, float metres) {
    for (const float s : k_high)
        for (const float t : k_high)
            if (length_squared(a.position + a.up * (s * a.middle) - b.position - b.up * (t * b.middle)) <
                metres * metres)
                return false;
    return true;
}

bool has_room(const SurfaceWalkers& w, size_t i, Vec3 place, float apart) {
    return std::ranges::none_of(w.seen, [&](const SurfaceSeen& s) {
        const float room = s.radius + w.radius[i] + apart;
        return s.walker != i && length_squared(s.position - place) < room * room;
    });
}

std::optional<Leap> way_of(const Compound& c, const Gravity& g, const SurfaceWalkers& w, size_t i,
                           const Company& company, bool to_own, float dt) {
    Company others;
    const auto own_wait = static_cast<int>(std::ceil(k_crouch_seconds / dt));
    auto restart = [&] {
        others = company;
        for (size_t n = 0; n < others.count; ++n)
            for (int t = 0; t < own_wait; ++t) {
                Aloft& other = others.all[n];
                if (--other.wait < 0 && other.leap.stage != LeapStage::none &&
                    fly_on(c, g, other.flyer, other.leap, dt))
                    other.leap.stage = LeapStage::none;
            }
    };
    return plan_leap(c, g, flyer_of(w, i), to_own, dt, [&](const Flyer& f, int t) {
        if (t == 1) restart();
        for (size_t n = 0; n < others.count; ++n) {
            Aloft& other = others.all[n];
            if (other.leap.stage == LeapStage::none) continue;  // seen where it lands
            if (--other.wait < 0 && fly_on(c, g, other.flyer, other.leap, dt))
                other.leap.stage = LeapStage::none;
            if (!is_apart(f, other.flyer, other.radius + w.radius[i] + k_apart)) return false;
        }
        return true;
    });
}

}  // namespace

void ask_leap(SurfaceWalkers& w, size_t i) {
    if (w.leaps[i].stage != LeapStage::none) return;
    w.leaps[i] = {};
    w.leaps[i].stage = LeapStage::gathers;
    w.leaps[i].is_asked = 1;
}

void begin_leaps(const Compound& c, const Gravity& g, SurfaceWalkers& w, uint64_t seed, uint32_t tick,
                 float dt) {
    const size_t count = w.leaps.size();
    if (count == 0 || g.points.empty()) return;
    Company company;
    size_t aloft = 0;
    for (size_t i = 0; i < count; ++i) {
        const Leap& leap = w.leaps[i];
        if (leap.stage != LeapStage::crouches && leap.stage != LeapStage::flies) continue;
        if (aloft++ < k_most_aloft)
            company.all[company.count++] = {flyer_of(w, i), leap, w.radius[i], ticks_to_leave(leap, dt)};
    }
    for (size_t n = 0; n < company.count; ++n)
        if (company.all[n].leap.stage == LeapStage::crouches) company.all[n].leap.seconds = 0;
    bool has_planned = false;  // one a tick: whoever plans next knows of it
    for (size_t i = 0; i < count && aloft < k_most_aloft; ++i) {
        Leap& leap = w.leaps[i];
        if (leap.stage != LeapStage::gathers || w.pace[i] > 0 || w.stands[i] == 0 || has_planned) continue;
        const auto below = surface_below(c, w.position[i] + w.up[i] * 0.2f, w.up[i], 0.4f);
        if (!below || dot(below->normal, w.up[i]) < k_plumb) continue;
        has_planned = true;
        const bool is_asked = leap.is_asked != 0;
        std::optional<Leap> way = way_of(c, g, w, i, company, false, dt);
        if (way && !has_room(w, i, way->place, k_land_apart)) way.reset();
        if (!way && is_asked) {
            // Where it stands nobody comes nearer than they walk past each other.
            way = way_of(c, g, w, i, company, true, dt);
            if (way && !has_room(w, i, way->place, 0)) way.reset();
        }
        if (!way && is_asked) continue;  // perhaps a moment later
        leap = way ? *way : Leap{};
        if (!way) continue;
        leap.stage = LeapStage::crouches;
        leap.seconds = 0;
    }
    if (g.bodies < 2) return;
    const size_t i = tick % count;
    if (w.leaps[i].stage != LeapStage::none || w.leaps_at_will[i] == 0 || i == w.led) return;
    if (random_unit({seed, static_cast<uint32_t>(i), tick, Purpose::spawn}) > k_likes) return;
    if (body_overhead(c, g, flyer_of(w, i))) w.leaps[i].stage = LeapStage::gathers;
}

void go_on_leaping(const Compound& c, const Gravity& g, SurfaceWalkers& w, size_t begin, size_t end,
                   float dt) {
    for (size_t i = begin; i < end; ++i) {
        Leap& leap = w.leaps[i];
        auto enter = [&](LeapStage stage) { leap.stage = stage, leap.seconds = 0; };
        switch (leap.stage) {
            case LeapStage::none:
                break;
            case LeapStage::gathers:
                leap.seconds += dt;
                if (leap.seconds > k_gather_seconds) leap = {};
                break;
            case LeapStage::crouches:
                leap.seconds += dt;
                if (leap.seconds > k_crouch_seconds - 0.5f * dt) enter(LeapStage::flies);
                break;
            case LeapStage::flies: {
                Flyer f = flyer_of(w, i);
                const bool has_landed = fly_on(c, g, f, leap, dt);
                w.position[i] = f.position, w.up[i] = f.up, w.ahead[i] = f.ahead;
                if (has_landed) enter(LeapStage::absorbs);
                break;
            }
            case LeapStage::absorbs:
                leap.seconds += dt;
                if (leap.seconds > k_absorb_seconds) leap = {};
                break;
        }
    }
}

}  // namespace flaneur
