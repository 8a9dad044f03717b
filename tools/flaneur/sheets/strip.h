// A walk as a row of pictures.
#pragma once

#include "sim/base/result.h"
#include "sim/gait/manner.h"
#include "tools/flaneur/options/options.h"

namespace flaneur {

// Draws twelve equidistant moments of one stride, or of a turn, of the walk that `options.gait` asks for,
// side by side, into options.gait.strip. One of the built-in people, `height` metres tall, walks at `speed`
// m/s in that manner; the camera keeps beside it, or ahead of it. Only in builds with Vulkan.
Result<void> draw_strip(const Options& options, double height, double speed, const Manner& manner);

}  // namespace flaneur
