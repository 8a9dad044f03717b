#include "assets/recording/columns.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "assets/recording/bytes.h"

namespace flaneur {

namespace {

constexpr uint32_t k_most_columns = 4096;
constexpr size_t k_longest_name = 200;

// Steps as whole numbers, so that what hardly moves hardly changes.
uint32_t told(uint32_t word, float step) {
    if (step <= 0) return word;
    const float steps = std::round(std::bit_cast<float>(word) / step);
    constexpr float k_most = 2e9f;
    return std::isfinite(steps)
               ? static_cast<uint32_t>(static_cast<int32_t>(std::clamp(steps, -k_most, k_most)))
               : 0;
}

uint32_t untold(uint32_t value, float step) {
    if (step <= 0) return value;
    return std::bit_cast<uint32_t>(static_cast<float>(static_cast<int32_t>(value)) * step);
}

// Small numbers of either sign are small ones without.
uint32_t folded(uint32_t difference) { return difference << 1 ^ (0u - (difference >> 31)); }
uint32_t unfolded(uint32_t value) { return value >> 1 ^ (0u - (value & 1)); }

// One name through all ticks; null where it is not there.
struct Row {
    std::string_view name;
    float step = 0;
    uint32_t words = 0, most = 0;  // items at most
    std::vector<const ColumnTick::Part*> parts;
};

std::vector<Row> rows_of(std::span<const ColumnTick> ticks) {
    std::vector<Row> rows;
    for (size_t t = 0; t < ticks.size(); ++t) {
        size_t guess = 0;  // names mostly come in the same order
        for (const ColumnTick::Part& part : ticks[t].parts) {
            if (guess >= rows.size() || rows[guess].name != part.name)
                guess = static_cast<size_t>(std::ranges::find(rows, part.name, &Row::name) - rows.begin());
            if (guess == rows.size())
                rows.push_back({part.name, part.step, part.words, 0,
                                std::vector<const ColumnTick::Part*>(ticks.size())});
            Row& row = rows[guess++];
            row.parts[t] = &part;
            row.most = std::max(row.most, part.items);
        }
    }
    return rows;
}

// Where there is no item its words are as they were.
void put_values(const Row& row, std::span<const ColumnTick> ticks, std::string& bytes) {
    const size_t lanes = size_t{row.most} * row.words, count = lanes * ticks.size(), begin = bytes.size();
    bytes.resize(begin + 4 * count);
    char* const planes = bytes.data() + begin;
    for (size_t lane = 0; lane < lanes; ++lane) {
        uint32_t last = 0;
        for (size_t t = 0; t < ticks.size(); ++t) {
            const ColumnTick::Part* part = row.parts[t];
            uint32_t now = last;
            if (part && lane < size_t{part->items} * part->words)
                now = told(ticks[t].words[part->begin + lane], row.step);
            const uint32_t value = folded(now - last);
            last = now;
            for (size_t plane = 0; plane < 4; ++plane)
                planes[plane * count + lane * ticks.size() + t] = static_cast<char>(value >> 8 * plane);
        }
    }
}

void take_values(std::string_view planes, ColumnChunk& chunk, const ColumnChunk::Column& c) {
    const size_t count = planes.size() / 4;
    uint32_t last = 0;
    for (size_t i = 0; i < count; ++i) {
        if (i % chunk.ticks == 0) last = 0;
        uint32_t value = 0;
        for (size_t plane = 0; plane < 4; ++plane)
            value |= static_cast<uint32_t>(static_cast<unsigned char>(planes[plane * count + i]))
                     << 8 * plane;
        last += unfolded(value);
        chunk.values[c.begin + i] = untold(last, c.step);
    }
}

const Error k_damaged{"is damaged: its columns do not fit together"};

}  // namespace

std::string encode_columns(std::span<const ColumnTick> ticks) {
    const std::vector<Row> rows = rows_of(ticks);
    std::string bytes;
    put_number(bytes, static_cast<uint32_t>(rows.size()));
    for (const Row& row : rows) {
        put_number(bytes, static_cast<uint8_t>(row.name.size()));
        bytes += row.name;
        put_number(bytes, row.step);
        put_number(bytes, row.words);
        for (const ColumnTick::Part* part : row.parts) put_number(bytes, part ? part->items : k_no_items);
    }
    for (const Row& row : rows) put_values(row, ticks, bytes);
    return bytes;
}

Result<ColumnChunk> decode_columns(std::string_view bytes, uint32_t first, uint32_t ticks) {
    ColumnChunk chunk{first, ticks, {}, {}};
    uint32_t count = 0;
    if (!take_number(bytes, count) || count > k_most_columns || ticks == 0) return k_damaged;
    std::vector<std::pair<ColumnChunk::Column*, size_t>> order;  // and how many values
    size_t values = 0;
    for (uint32_t k = 0; k < count; ++k) {
        uint8_t length = 0;
        ColumnChunk::Column c;
        if (!take_number(bytes, length) || length > k_longest_name || bytes.size() < length) return k_damaged;
        const std::string name(bytes.substr(0, length));
        bytes.remove_prefix(length);
        if (!take_number(bytes, c.step) || !take_number(bytes, c.words)) return k_damaged;
        if (!(c.step >= 0 || c.step == k_bits)) return k_damaged;
        if (bytes.size() / 4 < ticks) return k_damaged;
        c.items.resize(ticks);
        uint64_t most = 0;
        for (uint32_t& items : c.items) {
            take_number(bytes, items);
            if (items != k_no_items) most = std::max<uint64_t>(most, items);
        }
        // Believed only as far as bytes follow, four of each.
        const uint64_t lanes = most * c.words;
        if (most > 0 && (c.words == 0 || lanes / most != c.words || lanes > bytes.size() / 4 / ticks))
            return k_damaged;
        c.begin = values;
        values += lanes * ticks;
        if (values > bytes.size() / 4) return k_damaged;
        const auto [at, is_new] = chunk.columns.emplace(name, std::move(c));
        if (!is_new) return k_damaged;
        order.emplace_back(&at->second, lanes * ticks);
    }
    if (bytes.size() != values * 4) return k_damaged;
    chunk.values.resize(values);
    for (const auto& [column, own] : order) {
        take_values(bytes.substr(0, own * 4), chunk, *column);
        bytes.remove_prefix(own * 4);
    }
    return chunk;
}

}  // namespace flaneur
