// What of a world is seen (tools/extract reads just this), as columns of a recording, and back: a world that
// is not stepped looks as the one that was recorded.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/recording/columns.h"
#include "sim/world.h"

namespace flaneur {

// Replaces `tick`, whose memory is used again. `is_exact`: all to the last bit, with these poses and with
// trails; else in steps far below what is seen, and bodies' joints are told elsewhere.
void take_shown(const World& world, const std::vector<PoseBlock>& poses, bool is_exact, ColumnTick& tick);
// The world is as at a tick, counted from the chunk's first; what was shown before is the tick before. What
// the chunk does not have stays as it is. Numbers that no version could mean are left out.
void put_shown(const ColumnChunk& chunk, uint32_t tick, World& world);

}  // namespace flaneur
