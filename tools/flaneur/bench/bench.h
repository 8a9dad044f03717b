// What the loads of `flaneur bench` have in common.
#pragma once

#include <chrono>
#include <ctime>
#include <functional>

#include "sim/world.h"
#include "tools/flaneur/options/options.h"
#include "tools/flaneur/output/figures.h"

namespace flaneur {

struct Camera;
struct FrameStats;
struct Show;

void add_setting(Figures& figures, const Options& options, const World& world);
// What each stage took in the last tick.
void add_stages(Figures& figures, const World& world);

// Ticks of the simulation alone.
Result<Figures> bench_crowd(const Options& options);
// One frame: a tick, the extraction, and a picture read back. Only in builds with Vulkan.
Result<void> measure_frame(Show& show, const Options& options, const Camera& camera, Figures& figures);
// Frames with all that belongs to them. Only in builds with Vulkan.
Result<Figures> bench_frame(const Options& options);
// Pictures of a window that is at rest and moves, with panels and without. Only in builds with Vulkan.
Result<Figures> bench_window(const Options& options);
// The scene of a renderers' comparison: options.bench_count copies of a character that play its own clip,
// drawn with levels of detail and with every triangle. Prints both; of its figures the names begin with "with
// LOD/" and "every triangle/". Only in builds with Vulkan.
Result<Figures> bench_peers(const Options& options);
void add_counts(Figures& figures, const FrameStats& stats);

inline double ms_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}
// What all threads have worked together: unlike the time that goes by, it is about the same on a busy
// machine.
inline double cpu_ms() { return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }
// Megabytes that the process holds in memory now; 0 where the system does not tell.
double resident_mb();
int core_count();

// Something that `bench pose` measures. `ns` runs it and says what it took for each walker, chain or tree.
// Goals: on SSE4, AVX2 and AVX-512; 0 where there is none.
struct Kernel {
    std::string name;
    std::function<double()> ns;
    double goals[3] = {};
};
// Does `work` four times: the first ones fill caches and set the clock rate, the last is measured and shared
// among `count`.
double ns_each(size_t count, const std::function<void()>& work);
// Three clips blended for so many walkers of 22 joints, each at times and with shares of its own.
Kernel blend_kernel(size_t walkers);
// A tick of the dynamics of people who fall, sixteen of each block of `gait`, whose last block is left out if
// it is not full.
Kernel fall_kernel(const Gait& gait, const std::vector<PoseBlock>& poses, const Surroundings& around);
// A tick of a creature of six legs on a ball: its walker, its feet, and three bones each by FABRIK.
Kernel creature_kernel();
// FABRIK: chains of 4 bones, trees of a spine with two arms, and trees by chance of 64 joints, so many, in 4
// iterations.
std::vector<Kernel> fabrik_kernels(size_t count);

// Ways of inverse kinematics beside each other, on chains and trees. Prints a table.
Result<Figures> bench_ik();

// What a kernel took for each, nanoseconds, repetition by repetition.
void add_kernel(Figures& figures, const std::string& name, const std::vector<double>& ns);

// How fast a city is read and made ready, and nanoseconds that queries for feet, hands and eyes take, on one
// thread. Prints a table beside the goals.
Result<Figures> bench_city(const Options& options);

// The kernels that pose people, on one thread and on each instruction set that the CPU has ("core/avx2").
// Prints a table beside the goals.
Result<Figures> bench_pose(const Options& options);
// The same, and nothing is printed.
struct KernelTime {
    std::string name, isa;
    double median_ns = 0;
};
Result<std::vector<KernelTime>> pose_times(const Options& options);

}  // namespace flaneur
