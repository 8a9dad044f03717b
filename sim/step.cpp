#include "sim/base/zone.h"
#include "sim/gait/hands.h"
#include "sim/hands/holds.h"
#include "sim/pose/cane.h"
#include "sim/pose/joint_limits.h"
#include "sim/pose/pram.h"
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

void add_idles(World& w) {
    want_idles(w.idles, w.gait);
    advance_plays(w.idles, k_tick);
    parallel_for(*w.workers, w.idles.plays.size(), k_blocks_a_chunk * k_block,
                 [&](size_t begin, size_t end, int) { apply_plays(w.idles, begin, end, w.poses); });
}

// Calls work(first, last) for each run of slots of [begin, end) that all have a walker.
template <class Work>
void for_those_there(const Crowd& crowd, size_t begin, size_t end, const Work& work) {
    auto there = [&](size_t i) { return i < crowd.count && is_there(crowd, static_cast<uint32_t>(i)); };
    for (size_t i = begin; i < end; ++i) {
        size_t first = i;
        while (i < end && there(i)) ++i;
        if (i > first) work(first, i);
    }
}

// Gait and pose, and the end of the tick.
void step_bodies(World& w) {
    timed(w, Stage::gait, [&] {
        CrowdMotion& m = w.crowd.motion;
        RootMotion root{m.position.data(),  m.velocity.data(), m.heading.data(),
                        m.turn_rate.data(), m.wish.data(),     m.brakes.data()};
        parallel_for(*w.workers, w.crowd.count, k_blocks_a_chunk * k_block,
                     [&](size_t begin, size_t end, int) {
                         for_those_there(w.crowd, begin, end, [&](size_t first, size_t last) {
                             advance_gait(w.gait, first, last, root, w.around, w.seed, w.tick, k_tick);
                             reach_for_walls(w.gait, first, last, root, w.around, w.seed, w.tick, k_tick);
                             advance_holds(w.gait, first, last, root, w.seed, w.tick, k_tick);
                             for (size_t i = first; i < last; ++i)
                                 m.feet[i] = footwork(w.gait, i, m.position[i]);
                         });
                     });
    });
    timed(w, Stage::pose, [&] {
        w.previous_poses.swap(w.poses);
        parallel_for(*w.workers, w.gait.blocks.size(), k_blocks_a_chunk, [&](size_t begin, size_t end, int) {
            pose_blocks(w.gait, begin, end, k_tick, w.previous_poses, w.poses);
            restrain_legs(w.gait, begin, end, k_tick, w.previous_poses, w.poses);
        });
        add_idles(w);
        parallel_for(*w.workers, w.gait.canes.size(), k_blocks_a_chunk * k_block,
                     [&](size_t begin, size_t end, int) {
                         hold_canes(w.gait, begin, end, k_tick, w.previous_poses, w.poses);
                     });
        hold_prams(w.gait, 0, w.gait.prams.size(), k_tick, w.previous_poses, w.poses);
        w.previous_trails.swap(w.trails);
        parallel_for(*w.workers, w.poses.size(), k_blocks_a_chunk, [&](size_t begin, size_t end, int) {
            advance_trails(w.previous_poses, w.poses, begin, end, k_tick, w.previous_trails, w.trails);
        });
    });
    ++w.tick;
}

}  // namespace

void drive_crowd(World& w) {
    timed(w, Stage::think, [&] { think(w.crowd, *w.navmesh, *w.workers, w.tick, w.seed); });
    timed(w, Stage::neighbours, [&] { find_neighbours(w.crowd, *w.workers, w.tick); });
    timed(w, Stage::steer, [&] { steer(w.crowd, *w.navmesh, *w.workers, w.tick); });
    timed(w, Stage::move, [&] { move(w.crowd, w.around, *w.navmesh, *w.workers); });
}

void drive_roam(World& w) {
    timed(w, Stage::move, [&] { step_roam(*w.roam, w.crowd, w.gait, *w.workers, w.seed, w.tick); });
}

void step(World& w) {
    FLANEUR_ZONE("tick");
    w.drive(w);
    step_bodies(w);
    count_journeys(w);
}

}  // namespace flaneur
