// A file that grows while something goes on, chunk by chunk, and can be read meanwhile: what is whole counts,
// what a kill cut short is left out. docs/recording.md has the bytes.
//
// A chunk has a kind, the ticks that it tells of, and bytes whose meaning is the kind's. The first is the
// head: JSON. Readers go by a chunk's kind and leave out those that they do not know.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/result.h"

namespace flaneur {

constexpr uint32_t chunk_kind(const char (&name)[5]) {
    uint32_t kind = 0;
    for (int i = 3; i >= 0; --i) kind = kind << 8 | static_cast<unsigned char>(name[i]);
    return kind;
}
inline constexpr uint32_t k_head_chunk = chunk_kind("head");
inline constexpr uint32_t k_index_chunk = chunk_kind("indx");  // the container's own
inline constexpr uint32_t k_most_chunk_bytes = 256u << 20;     // once unpacked

struct ChunkPlace {
    uint64_t offset = 0;  // in the file, of its header
    uint32_t kind = 0;
    uint32_t first = 0, ticks = 0;
    uint32_t stored = 0, whole = 0;  // bytes in the file, and once unpacked
    uint64_t sum = 0;                // of those in the file
};

struct RecordingWriter;
struct RecordingWriterDelete {
    void operator()(RecordingWriter*) const;  // closes the file as it is, to be read without an index
};
using RecordingWriterPtr = std::unique_ptr<RecordingWriter, RecordingWriterDelete>;

// Begins a file, over what may be there. Refuses, in a sentence, what cannot be written.
Result<RecordingWriterPtr> begin_recording(const std::string& path, std::string_view head);
// With one write, so that a kill leaves it out whole, or at most its tail. Of each kind first ticks never go
// back. Where it fails the file is as it was before. At most k_most_chunk_bytes.
Result<void> add_chunk(RecordingWriter& writer, uint32_t kind, uint32_t first, uint32_t ticks,
                       std::string_view bytes);
// Adds the index, by which a long file opens at once.
Result<void> finish_recording(RecordingWriterPtr writer);
uint64_t bytes_of(const RecordingWriter& writer);  // so far

struct Recording {
    std::string path;
    int file = -1;
    std::string head;
    std::vector<ChunkPlace> chunks;  // by kind, then by first tick
    uint64_t end = 0;                // of the last chunk that is whole
    uint64_t left_out = 0;           // bytes behind it, that are none: cut short, or being written
    bool is_finished = false;        // the writer was done

    Recording() = default;
    Recording(const Recording&) = delete;
    Recording& operator=(const Recording&) = delete;
    ~Recording();
};
using RecordingPtr = std::unique_ptr<Recording>;

// Refuses, in a sentence, what is no recording, is of a later format, or has no head.
Result<RecordingPtr> open_recording(const std::string& path);
// Looks for chunks that came since.
Result<void> refresh(Recording& recording);
// Its bytes; refuses, in a sentence, what is not as it was written. From any number of threads.
Result<std::string> read_chunk(const Recording& recording, const ChunkPlace& chunk);
// The chunk of a kind that has a tick; null: there is none.
const ChunkPlace* chunk_at(const Recording& recording, uint32_t kind, uint32_t tick);
// All of a kind.
std::vector<ChunkPlace> chunks_of(const Recording& recording, uint32_t kind);

}  // namespace flaneur
