// Shows a recording in a world that was made from its scene, from any tick: of motion by writing over what is
// seen of the world, of inputs by simulating from the state before.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "assets/recording/head.h"
#include "assets/recording/replay.h"
#include "sim/world.h"

namespace flaneur {

struct Playing {
    RecordingHead head;
    Replay replay;
    uint32_t first = 0, last = 0;   // ticks that it has
    std::optional<uint32_t> shown;  // the tick that the world is at, if it is as recorded
    std::optional<Error> failed;    // what could not be shown
    std::vector<uint32_t> before;   // who was in a slot: generation; k_nobody: nobody
    bool has_trails = false;        // they need not be found from poses
};
using PlayingPtr = std::unique_ptr<Playing>;

// Refuses, in a sentence, what open_replay() does, what another version recorded as inputs, and what holds no
// tick.
Result<PlayingPtr> open_playing(const std::string& path, int threads);
// Looks for ticks that came since.
Result<void> look_again(Playing& playing);
// The world is as at that tick, and the tick before is known, if it was recorded. Refuses, in a sentence,
// what is damaged, a tick that is not there, and a world that has become another.
Result<void> show_tick(Playing& playing, World& world, uint32_t tick);
// The hash of a tick's state, if it was recorded.
Result<std::optional<uint64_t>> hash_at(const Recording& recording, uint32_t tick);

}  // namespace flaneur
