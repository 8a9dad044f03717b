// A walk as a row of pictures, or as a film.
#pragma once

#include "sim/base/result.h"
#include "sim/body/manner.h"
#include "tools/flaneur/options/options.h"

namespace flaneur {

// Draws twelve equidistant moments of the walk that `options.gait` asks for, side by side, into
// options.gait.strip: of what tells most of it, or from the first to the last that are asked for. One of the
// built-in people, `height` metres tall, walks at `speed` m/s in that manner; or twelve of them, each in
// their own, are seen at the first moment. The camera keeps beside them, or ahead. A film has all from the
// first moment to the last, of twelve side by side, at full speed. Only in builds with Vulkan.
Result<void> draw_strip(const Options& options, double height, double speed, const Manner& manner);

}  // namespace flaneur
