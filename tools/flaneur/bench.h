// What the loads of `flaneur bench` have in common.
#pragma once

#include "sim/world.h"
#include "tools/flaneur/figures.h"
#include "tools/flaneur/options.h"

namespace flaneur {

inline constexpr uint32_t k_warm_up = 60;  // ticks before measuring; people get under way

void add_setting(Figures& figures, const Options& options, const World& world);
// What stages `first` to `last` took in the last tick.
void add_stages(Figures& figures, const World& world, Stage first, Stage last);

// Frames with all that belongs to them. Only in builds with Vulkan.
Result<Figures> bench_frame(const Options& options);

}  // namespace flaneur
