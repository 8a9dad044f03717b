// What else of a world is seen than bodies by their joints: columns of numbers by name, tick by tick. Readers
// leave out names that they do not know and keep what they have of names that are not there, so that
// versions which show more or less than the one that wrote can show what both know.
// docs/recording.md has the bytes.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/result.h"

namespace flaneur {

inline constexpr float k_bits = -1;

// A tick's own. Names stay where they are for as long as anybody asks. Memory is used again.
struct ColumnTick {
    struct Part {
        std::string_view name;
        float step = 0;  // of floats, in which they are told; k_bits: as they are; 0: whole numbers
        uint32_t items = 0, words = 0;  // items, of so many words each
        size_t begin = 0;               // into `words`
    };
    std::vector<Part> parts;
    std::vector<uint32_t> words;
};
inline void clear(ColumnTick& tick) { tick.parts.clear(), tick.words.clear(); }

// Consecutive ticks; each name once in each.
std::string encode_columns(std::span<const ColumnTick> ticks);

// A chunk that was read.
struct ColumnChunk {
    struct Column {
        uint32_t words = 0;           // of an item
        float step = 0;               // as ColumnTick::Part has it
        std::vector<uint32_t> items;  // at each tick; k_no_items: the column is not there
        size_t begin = 0;             // into `values`
    };
    uint32_t first = 0, ticks = 0;
    std::map<std::string, Column, std::less<>> columns;
    std::vector<uint32_t> values;
};
inline constexpr uint32_t k_no_items = ~0u;
// A word of an item at a tick, which is counted from the chunk's first.
inline uint32_t value_of(const ColumnChunk& chunk, const ColumnChunk::Column& c, uint32_t tick, uint32_t item,
                         uint32_t word) {
    return chunk.values[c.begin + (size_t{item} * c.words + word) * chunk.ticks + tick];
}
// Refuses, in a sentence without a subject, what encode_columns() did not write.
Result<ColumnChunk> decode_columns(std::string_view bytes, uint32_t first, uint32_t ticks);

}  // namespace flaneur
