#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sim/alongside/alongside.h"
#include "sim/base/math.h"
#include "sim/base/spans.h"
#include "sim/pastimes/pastimes.h"
#include "tools/flaneur/city/check.h"
#include "tools/flaneur/city/check_life.h"
#include "tools/flaneur/city/check_standing.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/console/ending.h"

namespace flaneur {

namespace {

constexpr uint32_t k_look_ticks = 15;
constexpr uint32_t k_stuck_ticks = 60 * 60;
constexpr float k_still = 1;        // metres; who stays within them does not get on
constexpr float k_wall = 0.1f;      // metres; nearer to a wall one is in it
constexpr float k_walking = 0.2f;   // m/s
constexpr float k_close = 0.75f;    // metres
constexpr float k_at_crossing = 3;  // metres
constexpr size_t k_most_places = 5;
constexpr double k_most_outside = 0.01;  // of all, who find no room to come in

// What one walker has come to.
struct Watch {
    Vec2 anchor;
    uint32_t since = 0;
    bool in_wall = false, lost = false, stuck = false;
};

bool is_by_crossing(const City& city, Vec3 p) {
    for (float reach : {k_at_crossing * 0.5f, k_at_crossing}) {
        for (int k = 0; k < 8; ++k) {
            Vec2 way = heading_direction(static_cast<float>(k) * (k_pi / 4) - k_pi);
            auto hit = ground_at(city.ground, p + at_height(way * reach, 0), 0.5f, 0.5f);
            if (hit && hit->kind == Surface::crossing) return true;
        }
    }
    return false;
}

// Whether one stands or sits where it is because it wants to, with others, at a bench, before who plays.
bool stays(const World& w, uint32_t i) {
    if (is_staying(*w.pastimes, i) || own_of(w.crowd.called, i)) return true;
    if (w.alongside &&
        std::ranges::any_of(w.alongside->players, [&](const Player& p) { return p.walker == i; }))
        return true;
    const Group* group = group_of(w.company, w.crowd, i);
    if (!group) return false;
    // Who listens or looks at something keeps the others there.
    const uint32_t leader = group->members[group->leader].index;
    return group->does != Together::walks || is_staying(*w.pastimes, leader) ||
           own_of(w.crowd.called, leader);
}

// Whether one waits for a lamp, or with others for theirs.
bool waits_for_green(const World& w, uint32_t i) {
    const Group* group = group_of(w.company, w.crowd, i);
    return waits_at_kerb(w.crowd.kerbs, group ? group->members[group->leader].index : i);
}

// Why one does not get on.
std::string cause(const World& w, uint32_t i) {
    const Crowd& c = w.crowd;
    std::string does = company_words(w.company, c, w.folk, i);
    if (const std::string along(told_along(w, i)); !along.empty()) does += (does.empty() ? "" : ", ") + along;
    if (!does.empty()) does = ", " + does;
    for (WalkerId other : c.slots.living)
        if (other.index != i &&
            length(on_ground(c.motion.position[other.index] - c.motion.position[i])) < k_close)
            return "stuck among others" + does;
    if (c.journeys[i].path_due != PathDue::no) return "waits for a way" + does;
    return (c.journeys[i].corner >= c.journeys[i].corner_count ? "has no way" : "stuck by itself") + does;
}

}  // namespace

Result<std::vector<Finding>> check_crowd(World& world, const City& city, double seconds) {
    Crowd& c = world.crowd;
    Coming& coming = world.coming;
    const uint32_t walkers = c.count;
    std::vector<Watch> watches(c.capacity);
    for (uint32_t i = 0; i < c.count; ++i) watches[i].anchor = on_ground(c.motion.position[i]);
    Finding in_wall{"walkers in a wall", 0, 0, false, {}}, lost{"walkers off the ground", 0, 0, false, {}},
        stuck{"walkers stuck for a minute", 0, 0, false, {}},
        on_road{"walking on roads off crossings, %", 0, 5, false, {}},
        overlap{"deepest overlap of two walkers, m", 0, 0.05, false, {}},
        outside{"wait outside for room to come in", 0, std::max(1.0, walkers * k_most_outside), false, {}};
    auto count = [&](bool& counted, Finding& finding, uint32_t i, const std::string& why) {
        if (counted) return;
        counted = true;
        ++finding.value;
        if (finding.where.size() >= k_most_places) return;
        char text[128];
        Vec3 p = c.motion.position[i];
        std::snprintf(text, sizeof text, "%.1f,%.1f,%.1f %u %s", static_cast<double>(p.x),
                      static_cast<double>(p.y), static_cast<double>(p.z), i, why.c_str());
        finding.where.emplace_back(text);
    };
    const bool lives = is_lively(world);
    LifeTally tally;
    StandingTally standing;
    size_t walking = 0, roads = 0;
    auto ticks = static_cast<uint32_t>(seconds / static_cast<double>(k_tick));
    for (uint32_t tick = 0; tick < ticks; ++tick) {
        if (lives) {
            step(world);
        } else {
            come_and_go(coming, c, world.around, *world.navmesh, *world.workers, world.folk, tick,
                        world.seed);
            step_crowd(c, world.around, *world.navmesh, *world.workers, tick, world.seed);
        }
        for (const uint32_t i : coming.arrivals)
            watches[i] = {.anchor = on_ground(c.motion.position[i]), .since = tick};
        if (is_stopping()) return interrupted();
        if (lives) look_at_standing(world, standing);
        overlap.value = std::max(overlap.value, static_cast<double>(deepest_overlap(c)));
        if (tick % k_look_ticks != 0) continue;
        if (lives) look_at_life(world, tally);
        if (tick % 600 == 0) show_progress("walking " + std::to_string(tick / 60) + " s");
        for (uint32_t i = 0; i < c.count; ++i) {
            if (!is_there(c, i) || is_led(c, i)) continue;  // nobody leads them here
            Watch& watch = watches[i];
            Vec3 p = c.motion.position[i];
            auto under = ground_at(city.ground, p, 0.3f, 0.5f);
            const bool passes = is_in_doorway(c, i);
            if (!passes && (!under || std::fabs(under->height - p.y) > 0.02f))
                count(watch.lost, lost, i, under ? "in the air" : "no ground");
            if (!passes && closest_wall(city.ground, p + Vec3{0, 1, 0}, k_wall))
                count(watch.in_wall, in_wall, i, "");
            if (tick < c.journeys[i].pause_until || stays(world, i) ||
                length(on_ground(p) - watch.anchor) > k_still) {
                watch.anchor = on_ground(p);
                watch.since = tick;
            } else if (waits_for_green(world, i)) {
                // Red does not count; it is green once in 90 s.
                watch.since = std::min(watch.since + k_look_ticks, tick);
            }
            if (tick - watch.since > k_stuck_ticks) count(watch.stuck, stuck, i, cause(world, i));
            if (length(c.motion.velocity[i]) < k_walking || !under) continue;
            ++walking;
            bool off = under->kind == Surface::road && !is_by_crossing(city, p);
            roads += off;
            if (off && on_road.where.size() < k_most_places && tick % 3600 == 0 && tick > 0) {
                bool counted = false;
                double value = on_road.value;
                count(counted, on_road, i, "");
                on_road.value = value;
            }
        }
    }
    clear_progress();
    on_road.value = walking ? 100 * static_cast<double>(roads) / static_cast<double>(walking) : 0;
    outside.value = waiting(coming);
    std::vector<Finding> findings{in_wall, lost, on_road, overlap};
    if (comes_and_goes(coming, c)) findings.push_back(outside);
    if (ticks > k_stuck_ticks) findings.insert(findings.begin() + 2, stuck);  // else nobody could be
    if (lives)
        for (std::vector<Finding> more : {life_findings(world, tally), standing_findings(standing)})
            std::ranges::move(more, std::back_inserter(findings));
    return findings;
}

}  // namespace flaneur
