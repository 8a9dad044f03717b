#include <algorithm>
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "sim/base/isa.h"
#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/pose/blend.h"
#include "tools/flaneur/bench.h"
#include "tools/flaneur/load.h"

namespace flaneur {

namespace {

constexpr uint32_t k_replayed = 60;  // ticks of the crowd's movement
constexpr size_t k_larger = 16;      // the crowd that no longer fits the caches
// ozz-animation 0.16, 22 joints: sample, local to model, 4 two-bone IK, skinning matrices.
constexpr double k_peer_sse2 = 1482, k_peer_avx512 = 1285;

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
    BlendTree tree;                   // three clips, everyone at a time and with shares of their own
    std::vector<LaneRow> tree_inputs, local_poses;
};

double ns_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count();
}

// The first time fills caches and sets the clock rate; the second is measured.
double pose_ns(Work& work, const Gait& gait) {
    double ns = 0;
    for (int time = 0; time < 2; ++time) {
        auto start = std::chrono::steady_clock::now();
        pose_blocks(gait, 0, gait.blocks.size(), work.poses);
        ns = ns_since(start);
    }
    return ns / static_cast<double>(gait.count);
}

double core_ns(Work& work) { return pose_ns(work, work.walking); }
double full_ns(Work& work) { return pose_ns(work, work.reaching); }
double many_ns(Work& work) { return pose_ns(work, work.many); }

double blend_ns(Work& work) {
    size_t blocks = work.walking.blocks.size();
    double ns = 0;
    for (int time = 0; time < 2; ++time) {
        auto start = std::chrono::steady_clock::now();
        evaluate_blends(work.tree, work.tree_inputs.data(), 0, blocks, work.local_poses.data());
        ns = ns_since(start);
    }
    return ns / static_cast<double>(work.walking.count);
}

double advance_ns(Work& work) {
    work.advancing = work.before;
    uint32_t tick = work.world->tick - k_replayed;
    auto start = std::chrono::steady_clock::now();
    for (const Movement& m : work.movements) {
        RootMotion root{m.position.data(), m.velocity.data(), m.heading.data(), m.turn_rate.data()};
        advance_gait(work.advancing, 0, work.advancing.count, root, work.world->city, work.world->seed,
                     tick++, k_tick);
    }
    return ns_since(start) / static_cast<double>(work.advancing.count * k_replayed);
}

struct Goal {
    std::string_view isa;
    double ns;
};
struct Kernel {
    const char* name;
    double (*ns)(Work&);  // for each walker
    std::vector<Goal> goals;
};

const std::vector<Kernel> k_kernels = {
    {"core", core_ns, {{"sse4", 130}, {"avx2", 80}, {"avx512", 60}}},
    {"core, 16 x walkers", many_ns, {}},
    {"full", full_ns, {{"sse4", 250}, {"avx2", 130}, {"avx512", 100}}},
    {"blend", blend_ns, {{"sse4", 180}, {"avx2", 100}, {"avx512", 70}}},
    {"advance", advance_ns, {}},
};

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

// Walk and run blended by one parameter, that with a third clip by another; all three always count.
void plant_tree(Work& work, uint64_t seed) {
    RandomKey key{seed};
    uint32_t n = 0;
    Skeleton skeleton = humanoid(standard_body(1.7f));
    for (size_t keys : {40, 30, 100}) {
        std::vector<LocalPose> poses(keys);
        for (LocalPose& pose : poses)
            for (int j = 0; j < k_joint_count; ++j)
                pose.rotations.push_back(rotation_x(random_between(key, -0.5f, 0.5f, n++)));
        work.tree.clips.push_back(make_clip(skeleton, poses, 30, true, Curve::linear).value());
    }
    auto mix = [](uint16_t input, uint16_t first) {
        return BlendNode{BlendNode::Kind::grid, Curve::linear, {input, 0}, first, 2, 1};
    };
    auto play = [](uint16_t clip) {
        return BlendNode{BlendNode::Kind::clip, Curve::linear, {clip, 0}, clip, 1, 1};
    };
    work.tree.nodes = {mix(3, 1), mix(4, 3), play(2), play(0), play(1)};
    work.tree.layers = {{}};
    work.tree.inputs = 5;
    size_t blocks = work.walking.blocks.size();
    work.tree_inputs.resize(blocks * work.tree.inputs);
    for (LaneRow& row : work.tree_inputs)
        for (float& value : row.lanes) value = random_between(key, 0, 1, n++);
    work.local_poses.resize(blocks * local_rows(k_joint_count));
}

Work make_work(World& world) {
    Work work;
    work.world = &world;
    for (uint32_t i = 0; i < k_warm_up; ++i) step(world);
    work.before = world.gait;
    for (uint32_t i = 0; i < k_replayed; ++i) {
        step(world);
        const Crowd& crowd = world.crowd;
        work.movements.push_back({crowd.position, crowd.velocity, crowd.heading, crowd.turn_rate});
    }
    work.walking = work.reaching = world.gait;
    reach(work.reaching);
    work.many.count = world.gait.count * k_larger;
    for (size_t i = 0; i < k_larger; ++i) {
        work.many.blocks.insert(work.many.blocks.end(), world.gait.blocks.begin(), world.gait.blocks.end());
        work.many.people.insert(work.many.people.end(), world.gait.people.begin(), world.gait.people.end());
    }
    work.poses.resize(work.many.blocks.size());
    plant_tree(work, world.seed);
    return work;
}

// Nanoseconds of each repetition, by kernel and instruction set.
using Samples = std::vector<std::vector<std::vector<double>>>;

// Kernels and instruction sets take turns, so that a change of the clock rate or a busy neighbour meets all.
Samples measure(Work& work, const std::vector<std::string_view>& isas, uint32_t repetitions) {
    Samples samples(k_kernels.size(), std::vector<std::vector<double>>(isas.size()));
    for (uint32_t r = 0; r < repetitions; ++r) {
        for (size_t i = 0; i < isas.size(); ++i) {
            (void)use_isa(isas[i]);
            for (size_t k = 0; k < k_kernels.size(); ++k) samples[k][i].push_back(k_kernels[k].ns(work));
        }
    }
    (void)use_isa("best");
    return samples;
}

double median(const std::vector<double>& values) { return quantile(values, 0.5); }
double least(const std::vector<double>& values) { return *std::min_element(values.begin(), values.end()); }

double goal_of(const Kernel& kernel, std::string_view isa) {
    for (const Goal& goal : kernel.goals) {
        if (goal.isa == isa) return goal.ns;
    }
    return 0;
}

void print(const Samples& samples, const std::vector<std::string_view>& isas) {
    std::printf("\n%-20s", "ns, median (least)");
    for (std::string_view isa : isas) std::printf(" %15.*s", static_cast<int>(isa.size()), isa.data());
    for (std::string_view isa : isas)
        std::printf(" %9s", (isa == isas.front() ? "goal " + std::string(isa) : std::string(isa)).c_str());
    std::printf("\n");
    for (size_t k = 0; k < samples.size(); ++k) {
        std::printf("%-20s", k_kernels[k].name);
        for (const auto& ns : samples[k]) std::printf(" %7.1f (%5.1f)", median(ns), least(ns));
        for (std::string_view isa : isas) {
            double goal = goal_of(k_kernels[k], isa);
            if (goal > 0) {
                std::printf(" %9.0f", goal);
            } else {
                std::printf(" %9s", "-");
            }
        }
        std::printf("\n");
    }
    std::printf("ozz-animation 0.16, its like of core with matrices: %.0f (SSE2), %.0f (AVX-512)\n",
                k_peer_sse2, k_peer_avx512);
    std::printf("core, 16 times the walkers against once:");
    for (size_t i = 0; i < isas.size(); ++i)
        std::printf(" %.2f", median(samples[1][i]) / median(samples[0][i]));
    std::printf(" (goal 1.40)\n");
}

std::string as_json(const Figures& figures, const Samples& samples,
                    const std::vector<std::string_view>& isas) {
    nlohmann::ordered_json json;
    for (const auto& [name, value] : figures.setting) json["setting"][name] = value;
    json["kernels"] = nlohmann::ordered_json::array();
    for (size_t k = 0; k < samples.size(); ++k) {
        for (size_t i = 0; i < isas.size(); ++i) {
            nlohmann::ordered_json row = {{"name", k_kernels[k].name},
                                          {"isa", isas[i]},
                                          {"median_ns", median(samples[k][i])},
                                          {"least_ns", least(samples[k][i])}};
            double goal = goal_of(k_kernels[k], isas[i]);
            if (goal > 0) row["goal_ns"] = goal;
            json["kernels"].push_back(row);
        }
    }
    return json.dump(2) + "\n";
}

}  // namespace

Result<std::string> bench_pose(const Options& options) {
    if (options.scene.walkers == 0) return Error{"bench pose needs someone to pose: --walkers 1 or more."};
    Result<Loaded> loaded = load(options);
    if (!loaded) return loaded.error();
    Work work = make_work(*loaded->world);
    std::vector<std::string_view> isas = isa_names();
    if (isas.size() > 1) std::erase(isas, "scalar");  // for tests
    Samples samples = measure(work, isas, options.bench_frames);

    Figures figures;
    add_setting(figures, options, *loaded->world);
    print_figures(figures);
    print(samples, isas);
    return as_json(figures, samples, isas);
}

}  // namespace flaneur
