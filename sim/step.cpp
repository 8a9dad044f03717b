#include <algorithm>

#include "sim/alongside/alongside.h"
#include "sim/base/spans.h"
#include "sim/base/zone.h"
#include "sim/gait/hands.h"
#include "sim/gait/pram.h"
#include "sim/hands/holds.h"
#include "sim/pastimes/pastimes.h"
#include "sim/pose/cane.h"
#include "sim/pose/joint_limits.h"
#include "sim/pose/pram.h"
#include "sim/stepper/gaze.h"
#include "sim/stepping.h"
#include "sim/world.h"

namespace flaneur {

namespace {

constexpr size_t k_blocks_a_chunk = 4;

template <class Work>
void timed(World& world, Stage stage, const Work& work) {
    const auto number = static_cast<size_t>(stage);
    FLANEUR_ZONE(k_stage_names[number].data(), world.stage_ms[number]);
    work();
}

PastimeTick pastime_tick(World& w) {
    // Who minds somebody who has fallen, is with others or has something along does nothing else.
    auto is_free = [](const World& world, uint32_t i) {
        return is_by_itself(world, i) && !own_of(world.bystanders.all, i) &&
               !group_of(world.company, world.crowd, i) && !companion_of(world, i) &&
               world.gait.blocks[i / k_block].jump[i % k_block] == 0;
    };
    auto is_bus_near = [](const World& world, Vec3 stop) {
        constexpr float k_near = 26, k_slow = 6;  // metres, m/s
        const Vehicles& all = world.vehicles;
        for (uint32_t n = 0; n < all.all.size(); ++n) {
            const Vehicle& v = all.all[n];
            const bool takes_people = v.kind == VehicleKind::bus || v.kind == VehicleKind::tram;
            const Vec3 at = all.places[first_section(all, n)].middle;
            if (takes_people && is_there(v) && v.speed < k_slow && length(on_ground(at - stop)) < k_near)
                return true;
        }
        return false;
    };
    // All of a group that stands together, if none of it is otherwise engaged.
    auto led_by = [](const World& world, uint32_t i) {
        constexpr float k_near = 4;  // metres
        Party party;
        const Group* g = group_of(world.company, world.crowd, i);
        if (!g || g->members[g->leader].index != i || g->expects > 0 ||
            (g->does != Together::ring && g->does != Together::row))
            return party;
        for (uint32_t k = 0; k < g->count; ++k) {
            const WalkerId id = g->members[k];
            const uint32_t m = id.index;
            if (!is_there(world.crowd, id) || !is_by_itself(world, m) || own_of(world.bystanders.all, m) ||
                own_of(world.crowd.called, m) || companion_of(world, m) ||
                world.gait.blocks[m / k_block].jump[m % k_block] != 0 ||
                length(world.crowd.motion.position[m] - world.crowd.motion.position[i]) > k_near)
                return Party{};
            party.who[party.count++] = m;
        }
        return party;
    };
    auto heeds = [](const World& world, uint32_t i) {
        if (!group_of(world.company, world.crowd, i)) return k_nobody;
        const Bearing& b = world.company.bearings[i];
        return b.gazes != 0 ? b.whom : k_nobody;
    };
    auto age_of = [](const World& world, uint32_t i) { return world.folk[world.crowd.identity.body[i]].age; };
    return {*w.pastimes, w.crowd, w.gait,  *w.navmesh,  w.around, w.poses, w.seed,
            w.tick,      w,       is_free, is_bus_near, age_of,   led_by,  heeds};
}

constexpr uint32_t k_ticks_between_counts = 6;

// For traces: whose path is due, and who does not get on.
void count_journeys(const World& w) {
    if (!is_tracing() || w.tick % k_ticks_between_counts != 0) return;
    uint32_t due = 0, stuck = 0;
    for (uint32_t i = 0; i < w.crowd.count; ++i) {
        const Journey& journey = w.crowd.journeys[i];
        due += journey.path_due != PathDue::no;
        stuck += journey.stuck > 0;
    }
    trace_counter("paths due", due);
    trace_counter("people who do not get on", stuck);
}

// Calls work(first, last) for each run in [begin, end) of those that are in.
template <class In, class Work>
void for_runs(size_t begin, size_t end, const In& is_in, const Work& work) {
    for (size_t i = begin; i < end; ++i) {
        size_t first = i;
        while (i < end && is_in(i)) ++i;
        if (i > first) work(first, i);
    }
}

void add_idles(World& w) {
    want_idles(w.idles, w.gait);
    advance_plays(w.idles, k_tick);
    auto is_near = [&](size_t play) { return w.crowd.at_once[w.idles.plays[play].walker / k_block] == 1; };
    parallel_for(*w.workers, w.idles.plays.size(), k_blocks_a_chunk * k_block,
                 [&](size_t begin, size_t end, int) {
                     for_runs(begin, end, is_near,
                              [&](size_t first, size_t last) { apply_plays(w.idles, first, last, w.poses); });
                 });
}

// Calls work(block, seconds) on the workers for each block whose walkers step in this tick.
template <class Work>
void for_due_blocks(World& w, const Work& work) {
    parallel_for(*w.workers, block_count(w.crowd.count), k_blocks_a_chunk,
                 [&](size_t begin, size_t end, int) {
                     for (size_t block = begin; block < end; ++block)
                         if (const uint32_t ticks = ticks_due(w.crowd, block, w.tick))
                             work(block, static_cast<float>(ticks) * k_tick);
                 });
}

void step_gait(World& w) {
    CrowdMotion& m = w.crowd.motion;
    RootMotion root{m.position.data(),  m.velocity.data(), m.heading.data(),
                    m.turn_rate.data(), m.wish.data(),     m.brakes.data()};
    auto step_some = [&](size_t first, size_t last, const Surroundings& around, float dt, bool is_afar) {
        if (is_afar) {
            advance_gait_afar(w.gait, first, last, root, around, w.seed, w.tick, dt);
        } else {
            advance_gait(w.gait, first, last, root, around, w.seed, w.tick, dt);
            reach_for_walls(w.gait, first, last, root, around, w.seed, w.tick, dt);
        }
        advance_holds(w.gait, first, last, root, w.seed, w.tick, dt);
        for (size_t i = first; i < last; ++i) m.feet[i] = footwork(w.gait, i, m.position[i]);
    };
    for_due_blocks(w, [&](size_t block, float dt) {
        const size_t begin = block * k_block, end = std::min<size_t>(w.crowd.count, begin + k_block);
        const bool is_afar = w.crowd.at_once[block] > 1;
        const Span own = span_of(w.crowd.passages, begin, end);
        auto is_by_itself = [&](size_t i) {
            return own.begin < own.end && passage_by_door(w.crowd, static_cast<uint32_t>(i));
        };
        auto there = [&](size_t i) {
            return is_there(w.crowd, static_cast<uint32_t>(i)) && !is_by_itself(i) &&
                   !is_led(w.crowd, static_cast<uint32_t>(i));
        };
        for_runs(begin, end, there,
                 [&](size_t first, size_t last) { step_some(first, last, w.around, dt, is_afar); });
        for (size_t k = own.begin; k < own.end; ++k) {
            const Passage& passage = w.crowd.passages[k];
            if (!is_by_door(passage)) continue;
            const Indoors indoors{w.around, passage.door};
            step_some(passage.walker, passage.walker + 1, surroundings_of(indoors), dt, is_afar);
        }
    });
}

void hold_items(World& w, size_t block, float dt) {
    const size_t first = block * k_block, last = first + k_block;
    const Span canes = canes_of(w.gait, first, last), prams = prams_of(w.gait, first, last);
    hold_canes(w.gait, canes.begin, canes.end, dt, w.previous_poses, w.poses);
    hold_prams(w.gait, prams.begin, prams.end, dt, w.previous_poses, w.poses);
}

void step_pose(World& w) {
    w.previous_poses.swap(w.poses);
    w.previous_trails.swap(w.trails);
    for_due_blocks(w, [&](size_t block, float dt) {
        pose_blocks(w.gait, block, block + 1, dt, w.previous_poses, w.poses);
        restrain_legs(w.gait, block, block + 1, dt, w.previous_poses, w.poses);
    });
    add_idles(w);
    for_due_blocks(w, [&](size_t block, float dt) {
        hold_items(w, block, dt);
        pose_pastimes(pastime_tick(w), block * k_block, (block + 1) * k_block);
    });
    if (is_on(w.company))
        pose_company(w.company, w.crowd, w.gait, *w.workers, w.tick, w.seed, w.previous_poses, w.poses);
    mind_falls(w);
    step_falls(w);
    pose_bystanders(w);
    pose_alongside(w);
    if (w.stepping) turn_heads(w.stepping->bipeds, w.poses);
    for_due_blocks(w, [&](size_t block, float dt) {
        advance_trails(w.previous_poses, w.poses, block, block + 1, dt, w.previous_trails, w.trails);
        if (w.crowd.at_once[block] == 1) return;
        // Until they step again both are the same.
        w.previous_poses[block] = w.poses[block];
        w.previous_trails[block] = w.trails[block];
    });
}

// Gait and pose, and the end of the tick.
void step_bodies(World& w) {
    timed(w, Stage::gait, [&] {
        step_gait(w);
        if (is_on(w.company)) bear_themselves(w.company, w.crowd, w.gait, *w.workers, w.tick, w.seed);
    });
    timed(w, Stage::pose, [&] {
        step_pose(w);
        step_linkages(w.linkages, *w.workers, w.tick);
        step_figures(w.figures, w.seed, w.tick);
        step_deeds(w.deeds, w.seed, w.tick);
        lead_movers(w.deeds, w.movers);
        if (w.roam) step_creatures(*w.roam, w.linkages, *w.workers);
        step_herd(w);
    });
    ++w.tick;
}

}  // namespace

// Who comes gets a body, and who is gone has none.
static void come_and_go(World& w) {
    if (is_on(w.company) && w.tick % k_decision_ticks == 0) await_others(w.company, w.coming);
    come_and_go(w.coming, w.crowd, w.around, *w.navmesh, *w.workers, w.folk, w.tick, w.seed);
    for (const uint32_t walker : w.coming.gone) end_body(w, walker);
    if (is_on(w.company)) join_arrivals(w.company, w.crowd, w.coming, w.folk, w.tick, w.seed);
    for (const uint32_t walker : w.coming.arrivals) start_body(w, walker);
}

void drive_crowd(World& w) {
    keep_herd(w);
    timed(w, Stage::come, [&] { come_and_go(w); });
    look_on(w.crowd, *w.workers, w.tick);
    decide_pastimes(pastime_tick(w));
    for (const Pastime& p : w.pastimes->all)
        if (p.with == p.walker && p.what == Staying::sits && p.phase != StayPhase::over)
            let_sit(w.company, w.crowd, p.walker);
    timed(w, Stage::think, [&] { think(w.crowd, *w.navmesh, *w.workers, w.tick, w.seed); });
    timed(w, Stage::neighbours, [&] { find_neighbours(w.crowd, *w.workers, w.tick); });
    timed(w, Stage::steer, [&] { steer(w.crowd, *w.navmesh, *w.workers, w.tick); });
    timed(w, Stage::move, [&] {
        move(w.crowd, w.around, *w.navmesh, *w.workers, w.tick);
        step_vehicles(w.vehicles, w.crowd, w.tick, w.seed);
        if (is_on(w.company)) guide(w.company, w.crowd, *w.navmesh, *w.workers, w.folk, w.tick, w.seed);
    });
}

void drive_roam(World& w) {
    timed(w, Stage::move, [&] { step_roam(*w.roam, w.crowd, w.gait, *w.workers, w.seed, w.tick); });
}

static void give_planned_pushes(World& w) {
    for (const PlannedPush& planned : w.pushes) {
        if (planned.tick != w.tick) continue;
        for (const WalkerId id : w.crowd.slots.living)
            if (planned.walker == k_everybody || planned.walker == id.index)
                (void)push(w, id, planned.impulse);
    }
}

void step(World& w) {
    FLANEUR_ZONE("tick");
    give_planned_pushes(w);
    step_movers(w.movers, w.tick);
    if (!w.roam) step_balls(w);
    think_alongside(w);
    w.drive(w);
    move_alongside(w);
    if (w.stepping) step_those_who_step(w);
    step_bodies(w);
    count_journeys(w);
}

}  // namespace flaneur
