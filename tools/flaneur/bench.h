// What the loads of `flaneur bench` have in common.
#pragma once

#include "sim/world.h"
#include "tools/flaneur/figures.h"
#include "tools/flaneur/options.h"

namespace flaneur {

inline constexpr uint32_t k_warm_up = 60;  // ticks before measuring; people get under way

void add_setting(Figures& figures, const Options& options, const World& world);
// What each stage took in the last tick.
void add_stages(Figures& figures, const World& world);

// Frames with all that belongs to them. Only in builds with Vulkan.
Result<Figures> bench_frame(const Options& options);

// The kernels that pose people, on one thread and on each instruction set that the CPU has. Prints a table
// beside the goals and gives it as JSON: {"setting": {..}, "kernels": [{"name", "isa", "median_ns",
// "least_ns", "goal_ns"}]}.
Result<std::string> bench_pose(const Options& options);

}  // namespace flaneur
