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

Error damaged(const Replay& replay, const ChunkPlace& chunk, const Error& error) {
    return {replay.recording->path + " " + error.message + ", at byte " + std::to_string(chunk.offset) +
            ". Record it again."};
}

// The key of a chunk that has these bytes; null: it needs none.
Result<const MotionMeans*> key_for(Replay& replay, std::string_view bytes) {
    const std::optional<uint32_t> first = key_of(bytes);
    if (!first) return static_cast<const MotionMeans*>(nullptr);
    const ChunkPlace* chunk = chunk_at(*replay.recording, k_motion_chunk, *first);
    if (!chunk || chunk->first != *first)
        return Error{replay.recording->path + " is damaged: it lacks what was recorded at tick " +
                     std::to_string(*first) + ". Record it again."};
    if (chunk->offset != replay.key_offset) {
        const Result<std::string> of_key = read_chunk(*replay.recording, *chunk);
        if (!of_key) return of_key.error();
        Result<MotionMeans> key = decode_means(*of_key, chunk->first, chunk->ticks, replay.trees);
        if (!key) return damaged(replay, *chunk, key.error());
        replay.key = std::move(*key);
        replay.key_offset = chunk->offset;
    }
    return &replay.key;
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
    const Result<const MotionMeans*> key = key_for(replay, *bytes);
    if (!key) return key.error();
    Result<MotionChunk> motion =
        decode_motion(*bytes, chunk->first, chunk->ticks, replay.trees, *key, *replay.workers);
    if (!motion) return damaged(replay, *chunk, motion.error());
    replay.motion = std::move(*motion);
    replay.offset = chunk->offset;
    return true;
}

Result<bool> seek_columns(Replay& replay, uint32_t tick) {
    const ChunkPlace* chunk = chunk_at(*replay.recording, k_columns_chunk, tick);
    if (!chunk) return false;
    if (chunk->offset == replay.columns_offset) return true;
    const Result<std::string> bytes = read_chunk(*replay.recording, *chunk);
    if (!bytes) return bytes.error();
    Result<ColumnChunk> columns = decode_columns(*bytes, chunk->first, chunk->ticks);
    if (!columns) return damaged(replay, *chunk, columns.error());
    replay.columns = std::move(*columns);
    replay.columns_offset = chunk->offset;
    return true;
}

}  // namespace flaneur
