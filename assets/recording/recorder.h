// Records how bodies and things move while something else simulates: the caller's thread copies, one of the
// recorder's own encodes and writes, chunk by chunk. replay.h shows what was recorded.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "assets/recording/columns.h"
#include "assets/recording/motion.h"

namespace flaneur {

// Half a second at 60 Hz: a kill loses less than that, and what is being encoded.
inline constexpr uint32_t k_chunk_ticks = 30;
inline constexpr uint32_t k_chunks_to_a_key = 8;
inline constexpr uint32_t k_trees_chunk = 0x65657274;    // "tree": encode_trees() of those that are new
inline constexpr uint32_t k_motion_chunk = 0x69746f6d;   // "moti": encode_motion()
inline constexpr uint32_t k_columns_chunk = 0x736c6f63;  // "cols": encode_columns()

struct RecorderOptions {
    MotionBound bound{};
    int threads = 2;  // that encode
};

struct RecorderCount {
    uint64_t bytes = 0;   // written
    uint64_t waits = 0;   // times that the caller waited for what was not yet encoded
    uint64_t missed = 0;  // joints that could not be held to the bound: see encode_motion()
};

struct Recorder;
struct RecorderDelete {
    void operator()(Recorder*) const;  // leaves the file as it is, without what is not yet written
};
using RecorderPtr = std::unique_ptr<Recorder, RecorderDelete>;

// Begins a file whose head is this JSON. Refuses, in a sentence, what cannot be written.
Result<RecorderPtr> begin_recorder(const std::string& path, std::string_view head,
                                   const RecorderOptions& options = {});
// Its index, for movers of ticks that come.
uint32_t add_tree(Recorder& recorder, const BoneTree& tree);
// Each tick once, in order; ticks may be left out, and nothing is there then. Holds two chunks at most, and
// waits while both are full. Fails where an earlier one could not be written.
Result<void> add_tick(Recorder& recorder, uint32_t tick, const std::vector<PoseBlock>& poses,
                      std::span<const BodyMember> bodies, std::span<const RigidMember> things);
// The same with columns, which are swapped for others whose memory may be used again. Either all ticks have
// some, or none.
Result<void> add_tick(Recorder& recorder, uint32_t tick, const std::vector<PoseBlock>& poses,
                      std::span<const BodyMember> bodies, std::span<const RigidMember> things,
                      ColumnTick& columns);
// A chunk of another kind, at once; from the thread that adds ticks.
Result<void> add_other(Recorder& recorder, uint32_t kind, uint32_t first, uint32_t ticks,
                       std::string_view bytes);
RecorderCount count_of(const Recorder& recorder);
// Writes what is left, and the index.
Result<RecorderCount> finish_recorder(RecorderPtr recorder);

}  // namespace flaneur
