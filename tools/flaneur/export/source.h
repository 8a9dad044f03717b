// What is exported of: a world that is simulated, or shown as it was recorded, tick by tick.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tools/flaneur/load/load.h"
#include "tools/flaneur/recording/playing.h"

namespace flaneur {

struct ExportSource {
    Loaded loaded;
    PlayingPtr playing;            // null: it is simulated
    uint32_t first = 0, last = 0;  // ticks that are asked for
};

// Of a recording its part that is asked for, of a scene that part of its run, or the first 10 s. Refuses, in
// a sentence, what cannot be loaded, and seconds that a recording does not have.
Result<ExportSource> open_source(const Options& options);

// Calls `take` with the world after each of those ticks.
Result<void> for_each_tick(ExportSource& source, const std::function<Result<void>(const World&)>& take);

// Refuses, in a sentence, where one of those asked for was not there. `seen` are all who were, rising.
Result<void> check_seen(const Options& options, const std::vector<uint32_t>& seen);

}  // namespace flaneur
