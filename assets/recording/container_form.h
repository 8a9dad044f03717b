// The bytes of a recording's frame. Private to assets/recording.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "assets/recording/bytes.h"
#include "assets/recording/container.h"
#include "sim/base/hash.h"

namespace flaneur {

inline constexpr std::string_view k_recording_magic = "flanrec\n", k_recording_end = "flanend\n";
inline constexpr uint32_t k_recording_format = 1;
inline constexpr size_t k_file_head = 16, k_chunk_head = 48, k_file_tail = 16, k_index_entry = 36;
inline constexpr uint32_t k_chunk_mark = chunk_kind("CHNK");

inline uint64_t sum_of(std::string_view bytes) { return hash_bytes(0, bytes.data(), bytes.size()); }

// What a chunk is, as its head and the index have it.
inline void put_chunk(std::string& bytes, const ChunkPlace& chunk) {
    put_number(bytes, chunk.kind);
    put_number(bytes, chunk.first);
    put_number(bytes, chunk.ticks);
    put_number(bytes, chunk.stored);
    put_number(bytes, chunk.whole);
    put_number(bytes, chunk.sum);
}
// False where there are too few bytes, or sizes that no chunk has.
inline bool take_chunk(std::string_view& bytes, ChunkPlace& chunk) {
    return take_number(bytes, chunk.kind) && take_number(bytes, chunk.first) &&
           take_number(bytes, chunk.ticks) && take_number(bytes, chunk.stored) &&
           take_number(bytes, chunk.whole) && take_number(bytes, chunk.sum) &&
           chunk.whole <= k_most_chunk_bytes && chunk.stored <= chunk.whole;
}

inline std::string chunk_head(const ChunkPlace& chunk) {
    std::string bytes;
    put_number(bytes, k_chunk_mark);
    put_chunk(bytes, chunk);
    put_number(bytes, chunk.offset);
    put_number(bytes, sum_of(bytes));
    return bytes;
}

// None where there is no chunk at `offset`.
inline std::optional<ChunkPlace> read_chunk_head(std::string_view bytes, uint64_t offset) {
    ChunkPlace chunk;
    uint32_t mark = 0;
    uint64_t sum = 0;
    const uint64_t true_sum = sum_of(bytes.substr(0, k_chunk_head - 8));
    if (!take_number(bytes, mark) || !take_chunk(bytes, chunk) || !take_number(bytes, chunk.offset) ||
        !take_number(bytes, sum))
        return {};
    if (mark != k_chunk_mark || sum != true_sum || chunk.offset != offset) return {};
    return chunk;
}

}  // namespace flaneur
