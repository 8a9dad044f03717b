// libFuzzer's target for recordings: any bytes are a file, and the bytes of a chunk, that is read or refused.
// The sums of a file's chunks would let the fuzzer see little of what is in them.
#include <cmath>
#include <cstdlib>
#include <string_view>

#include "assets/recording/head.h"
#include "assets/recording/recorder.h"
#include "assets/recording/replay.h"
#include "tests/folder.h"

namespace {

using namespace flaneur;

void look(const MotionChunk& motion, std::span<const BoneTree> trees) {
    MotionPose pose;
    for (size_t i = 0; i < motion.tracks.size(); ++i)
        for (uint32_t t = 0; t < motion.ticks; t += 7)
            if (pose_at(motion, i, trees, motion.first + t, pose) && !std::isfinite(pose.origin.x))
                std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const TestFolder folder;
    static const WorkersPtr workers = make_workers(1);
    static const BoneTree trees[] = {bone_tree_of(standard_body(1.7f)), rigid_tree()};
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    if (bytes.starts_with("flanrec")) {
        Result<Replay> replay = open_replay(folder.write("fuzz.flr", bytes), 1);
        if (!replay) return 0;
        for (const ChunkPlace& chunk : chunks_of(*replay->recording, k_motion_chunk)) {
            const Result<bool> has = seek(*replay, chunk.first);
            if (has && *has) look(replay->motion, replay->trees);
        }
        for (const ChunkPlace& chunk : chunks_of(*replay->recording, k_columns_chunk))
            (void)seek_columns(*replay, chunk.first);
        (void)parse_recording_head("fuzz.flr", replay->recording->head);
        return 0;
    }
    if (const Result<ColumnChunk> columns = decode_columns(bytes, 5, 48))
        for (const auto& [name, column] : columns->columns)
            for (uint32_t t = 0; t < columns->ticks; ++t)
                if (column.items[t] != k_no_items && column.items[t] > 0 && column.words > 0)
                    (void)value_of(*columns, column, t, column.items[t] - 1, column.words - 1);
    if (const Result<std::vector<BoneTree>> read = decode_trees(bytes))
        for (const BoneTree& tree : *read)
            for (size_t j = 1; j < tree.parents.size(); ++j)
                if (tree.parents[j] >= j) std::abort();
    const Result<MotionMeans> means = decode_means(bytes, 5, 48, trees);
    const Result<MotionChunk> motion = decode_motion(bytes, 5, 48, trees, nullptr, *workers);
    if (motion) look(*motion, trees);
    if (!means) return 0;
    // The same chunk as one that has itself as its key.
    std::string keyed(bytes);
    keyed.replace(4, 4, std::string("\x05\0\0\0", 4));
    if (const Result<MotionChunk> other = decode_motion(keyed, 5, 48, trees, &*means, *workers))
        look(*other, trees);
    return 0;
}
