#include <algorithm>
#include <chrono>
#include <cstdio>

#include "sim/base/isa.h"
#include "sim/base/math.h"
#include "sim/pose/joint_limits.h"
#include "tools/flaneur/bench/bench.h"
#include "tools/flaneur/load/load.h"

namespace flaneur {

namespace {

constexpr uint32_t k_replayed = 12;  // ticks of the crowd's movement
constexpr size_t k_larger = 16;      // the crowd that no longer fits the caches

// What the crowd told the gait in one tick.
struct Movement {
    std::vector<Vec3> position;
    std::vector<Vec2> velocity;
    std::vector<float> heading, turn_rate;
};

// What the kernels are given: a crowd under way, as the world left it, and variations of it.
struct Work {
    const World* world = nullptr;
    Gait before;                      // the first of the movements
    std::vector<Movement> movements;  // of k_replayed ticks
    Gait walking, reaching;           // everyone as they are; everyone with both hands on a wall
    Gait many;                        // `walking` k_larger times over
    Gait advancing;                   // scratch
    std::vector<PoseBlock> poses;     // scratch
    std::vector<TrailBlock> trails;   // scratch
};

double pose_ns(Work& work, const Gait& gait) {
    return ns_each(gait.count,
                   [&] { pose_blocks(gait, 0, gait.blocks.size(), k_tick, work.poses, work.poses); });
}

double limit_ns(Work& work) {
    const World& w = *work.world;
    work.poses = w.poses;
    return ns_each(w.gait.count, [&] {
        restrain_legs(w.gait, 0, w.gait.blocks.size(), k_tick, w.previous_poses, work.poses);
    });
}

double trail_ns(Work& work) {
    const World& w = *work.world;
    work.trails.resize(w.trails.size());
    return ns_each(w.gait.count, [&] {
        advance_trails(w.previous_poses, w.poses, 0, w.poses.size(), k_tick, w.previous_trails, work.trails);
    });
}

double advance_ns(Work& work) {
    return ns_each(work.before.count * k_replayed, [&] {
        work.advancing = work.before;
        uint32_t tick = work.world->tick - k_replayed;
        for (const Movement& m : work.movements) {
            RootMotion root{m.position.data(), m.velocity.data(), m.heading.data(), m.turn_rate.data()};
            advance_gait(work.advancing, 0, work.advancing.count, root, work.world->around, work.world->seed,
                         tick++, k_tick);
        }
    });
}

std::vector<Kernel> kernels_of(Work& work) {
    size_t walkers = work.walking.count;
    std::vector<Kernel> kernels = {
        {"core", [&] { return pose_ns(work, work.walking); }, {130, 80, 60}},
        {"core, 16 x walkers", [&] { return pose_ns(work, work.many); }},
        {"full", [&] { return pose_ns(work, work.reaching); }, {250, 130, 100}},
        {"joint speeds", [&] { return limit_ns(work); }},
        {"trails", [&] { return trail_ns(work); }},
        {"advance", [&] { return advance_ns(work); }},
        blend_kernel(walkers),
        fall_kernel(work.walking, work.world->poses, work.world->around),
        creature_kernel(),
    };
    for (Kernel& kernel : fabrik_kernels(walkers)) kernels.push_back(std::move(kernel));
    return kernels;
}

// Both hands on walls beside the walker, and the head turned.
void reach(Gait& gait) {
    for (size_t b = 0; b < gait.blocks.size(); ++b) {
        GaitBlock& g = gait.blocks[b];
        for (size_t lane = 0; lane < k_block; ++lane) {
            Vec2 ahead = heading_direction(g.heading[lane]);
            Vec2 left{ahead.z, -ahead.x};
            g.look[lane] = 0.6f;
            for (Side side : {k_left, k_right}) {
                HandBlock& hand = g.hands[side];
                Vec2 out = side == k_left ? left : left * -1.0f;
                Vec2 palm = Vec2{g.x[lane], g.z[lane]} + out * 0.45f + ahead * 0.2f;
                hand.x[lane] = palm.x;
                hand.y[lane] = g.base[lane] + 0.75f * gait.people[b].joints[neck][1][lane];
                hand.z[lane] = palm.z;
                hand.normal_x[lane] = -out.x;
                hand.normal_z[lane] = -out.z;
                hand.reach[lane] = 1;
            }
        }
    }
}

Work make_work(World& world, uint32_t warm_up) {
    Work work;
    work.world = &world;
    for (uint32_t i = 0; i < warm_up; ++i) step(world);
    work.before = world.gait;
    for (uint32_t i = 0; i < k_replayed; ++i) {
        step(world);
        const Crowd& crowd = world.crowd;
        work.movements.push_back(
            {crowd.motion.position, crowd.motion.velocity, crowd.motion.heading, crowd.motion.turn_rate});
    }
    work.walking = work.reaching = world.gait;
    reach(work.reaching);
    work.many.count = world.gait.count * k_larger;
    for (size_t i = 0; i < k_larger; ++i) {
        work.many.blocks.insert(work.many.blocks.end(), world.gait.blocks.begin(), world.gait.blocks.end());
        work.many.people.insert(work.many.people.end(), world.gait.people.begin(), world.gait.people.end());
    }
    work.poses.resize(work.many.blocks.size());
    return work;
}

// Nanoseconds of each repetition, by kernel and instruction set.
using Samples = std::vector<std::vector<std::vector<double>>>;

// Kernels and instruction sets take turns, so that a change of the clock rate or a busy neighbour meets all.
Samples measure(const std::vector<Kernel>& kernels, const std::vector<std::string_view>& isas,
                uint32_t repetitions) {
    Samples samples(kernels.size(), std::vector<std::vector<double>>(isas.size()));
    for (uint32_t r = 0; r < repetitions; ++r) {
        for (size_t i = 0; i < isas.size(); ++i) {
            (void)use_isa(isas[i]);
            for (size_t k = 0; k < kernels.size(); ++k) samples[k][i].push_back(kernels[k].ns());
        }
    }
    (void)use_isa("best");
    return samples;
}

std::vector<std::string_view> measured_isas() {
    std::vector<std::string_view> isas = isa_names();
    if (isas.size() > 1) std::erase(isas, "scalar");  // for tests
    return isas;
}

double median(const std::vector<double>& values) { return quantile(values, 0.5); }
double least(const std::vector<double>& values) { return *std::min_element(values.begin(), values.end()); }

double goal_of(const Kernel& kernel, std::string_view isa) {
    return isa == "sse4"     ? kernel.goals[0]
           : isa == "avx2"   ? kernel.goals[1]
           : isa == "avx512" ? kernel.goals[2]
                             : 0;
}

void print(const std::vector<Kernel>& kernels, const Samples& samples,
           const std::vector<std::string_view>& isas) {
    std::printf("\n%-20s", "ns, median (least)");
    for (std::string_view isa : isas) std::printf(" %15s", std::string(isa).c_str());
    std::printf("   goals");
    for (size_t k = 0; k < samples.size(); ++k) {
        std::printf("\n%-20s", kernels[k].name.c_str());
        for (const auto& ns : samples[k]) std::printf(" %7.1f (%5.1f)", median(ns), least(ns));
        std::printf("  ");
        for (std::string_view isa : isas) {
            if (double goal = goal_of(kernels[k], isa); goal > 0) std::printf(" %3.0f", goal);
        }
    }
    std::printf("\n\n16 x walkers against 1 x, goal 1.40:");
    for (size_t i = 0; i < isas.size(); ++i)
        std::printf(" %.2f", median(samples[1][i]) / median(samples[0][i]));
    std::printf("\n");
}

}  // namespace

double ns_each(size_t count, const std::function<void()>& work) {
    double ns = 0;
    for (int time = 0; time < 4; ++time) {
        auto start = std::chrono::steady_clock::now();
        work();
        ns = std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count();
    }
    return ns / static_cast<double>(count);
}

Result<std::vector<KernelTime>> pose_times(const Options& options) {
    Result<Loaded> loaded = load(options);
    if (!loaded) return loaded.error();
    Work work = make_work(*loaded->world, options.warm_up);
    const std::vector<Kernel> kernels = kernels_of(work);
    const std::vector<std::string_view> isas = measured_isas();
    const Samples samples = measure(kernels, isas, options.bench_frames);
    std::vector<KernelTime> times;
    for (size_t k = 0; k < kernels.size(); ++k)
        for (size_t i = 0; i < isas.size(); ++i)
            times.push_back({kernels[k].name, std::string(isas[i]), median(samples[k][i])});
    return times;
}

void add_kernel(Figures& figures, const std::string& name, const std::vector<double>& ns) {
    Series& series = figures.series.emplace_back();
    series.name = name;
    series.unit = "ns";
    for (double each : ns) series.ms.push_back(each * 1e-6);
}

Result<Figures> bench_pose(const Options& options) {
    if (options.scene.walkers == 0) return Error{"bench pose needs someone to pose: --walkers 1 or more."};
    Result<Loaded> loaded = load(options);
    if (!loaded) return loaded.error();
    Work work = make_work(*loaded->world, options.warm_up);
    std::vector<Kernel> kernels = kernels_of(work);
    std::vector<std::string_view> isas = measured_isas();
    Samples samples = measure(kernels, isas, options.bench_frames);

    Figures figures;
    figures.setting = {{"city", city_name(options.scene)},
                       {"walkers", static_cast<int64_t>(work.walking.count)},
                       {"threads", 1},
                       {"measured", options.bench_frames}};
    print_figures(figures);
    print(kernels, samples, isas);
    for (size_t k = 0; k < samples.size(); ++k)
        for (size_t i = 0; i < isas.size(); ++i)
            add_kernel(figures, kernels[k].name + "/" + std::string(isas[i]), samples[k][i]);
    return figures;
}

}  // namespace flaneur
