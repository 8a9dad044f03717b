#include "assets/recording/replay.h"

#include "assets/recording/recorder.h"

namespace flaneur {

namespace {

// Of chunks that were written since.
Result<void> read_trees(Replay& replay) {
    const std::vector<ChunkPlace> chunks = chunks_of(*replay.recording, k_trees_chunk);
    for (; replay.tree_chunks < chunks.size(); ++replay.tree_chunks) {
        const Result<std::string> bytes = read_chunk(*replay.recording, chunks[replay.tree_chunks]);
        if (!bytes) return bytes.error();
        const Result<std::vector<BoneTree>> trees = decode_trees(*bytes);
        if (!trees) return Error{replay.recording->path + " " + trees.error().message + ". Record it again."};
        replay.trees.insert(replay.trees.end(), trees->begin(), trees->end());
    }
    return {};
}

}  // namespace

Result<Replay> open_replay(const std::string& path, int threads) {
    Result<RecordingPtr> recording = open_recording(path);
    if (!recording) return recording.error();
    Replay replay;
    replay.recording = std::move(*recording);
    replay.workers = make_workers(threads);
    if (Result<void> read = read_trees(replay); !read) return read.error();
    return replay;
}

Result<bool> seek(Replay& replay, uint32_t tick) {
    const ChunkPlace* chunk = chunk_at(*replay.recording, k_motion_chunk, tick);
    if (!chunk) return false;
    if (chunk->offset == replay.offset) return true;
    if (Result<void> read = read_trees(replay); !read) return read.error();
    const Result<std::string> bytes = read_chunk(*replay.recording, *chunk);
    if (!bytes) return bytes.error();
    Result<RecordedMotion> motion =
        decode_motion(*bytes, chunk->first, chunk->ticks, replay.trees, *replay.workers);
    if (!motion)
        return Error{replay.recording->path + " " + motion.error().message + ", at byte " +
                     std::to_string(chunk->offset) + ". Record it again."};
    replay.motion = std::move(*motion);
    replay.offset = chunk->offset;
    return true;
}

}  // namespace flaneur
