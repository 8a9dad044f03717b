// Shows what recorder.h recorded, from any tick, also while it is still being written.
#pragma once

#include <string>
#include <vector>

#include "assets/recording/columns.h"
#include "assets/recording/container.h"
#include "assets/recording/motion.h"

namespace flaneur {

struct Replay {
    RecordingPtr recording;  // refresh() it to see more
    WorkersPtr workers;
    size_t tree_chunks = 0;  // that were read
    std::vector<BoneTree> trees;
    MotionChunk motion;  // of the chunk that was asked for last
    MotionMeans key;
    uint64_t key_offset = 0;  // where its chunk lies; 0: none was read
    uint64_t offset = 0;      // where that one lies; 0: none was
    ColumnChunk columns;      // the same of columns
    uint64_t columns_offset = 0;
};

// On so many threads; 0: one a core. Refuses, in a sentence, what open_recording() does, and those
// whose trees are damaged.
Result<Replay> open_replay(const std::string& path, int threads = 0);
// Makes `motion` have that tick, for pose_at(replay.motion, track, replay.trees, tick, ..): false where
// nothing was recorded of it. Refuses, in a sentence, what is damaged.
Result<bool> seek(Replay& replay, uint32_t tick);
// The same of `columns`.
Result<bool> seek_columns(Replay& replay, uint32_t tick);

}  // namespace flaneur
