#include <gtest/gtest.h>

#include <bit>

#include "assets/recording/columns.h"

namespace flaneur {
namespace {

// Of two names, the second of which comes late and grows.
std::vector<ColumnTick> some_ticks() {
    std::vector<ColumnTick> ticks(5);
    for (uint32_t t = 0; t < 5; ++t) {
        ColumnTick& tick = ticks[t];
        tick.parts.push_back({"places", 1.0f / 64, 3, 2, 0});
        for (uint32_t k = 0; k < 6; ++k)
            tick.words.push_back(std::bit_cast<uint32_t>(0.013f * static_cast<float>(t * k) - 1));
        if (t < 2) continue;
        tick.parts.push_back({"who", 0, t, 1, tick.words.size()});
        for (uint32_t k = 0; k < t; ++k) tick.words.push_back(0xfffffff0u + 7 * k);
        tick.parts.push_back({"exact", k_bits, 1, 1, tick.words.size()});
        tick.words.push_back(std::bit_cast<uint32_t>(-0.1f * static_cast<float>(t)));
    }
    return ticks;
}

TEST(Columns, AreReadAsTheyWereWritten) {
    const std::vector<ColumnTick> ticks = some_ticks();
    const Result<ColumnChunk> read = decode_columns(encode_columns(ticks), 40, 5);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->first, 40u);
    const ColumnChunk::Column &places = read->columns.at("places"), &who = read->columns.at("who"),
                              &exact = read->columns.at("exact");
    EXPECT_EQ(who.items, (std::vector<uint32_t>{k_no_items, k_no_items, 2, 3, 4}));
    for (uint32_t t = 0; t < 5; ++t)
        for (uint32_t k = 0; k < 6; ++k)
            EXPECT_NEAR(std::bit_cast<float>(value_of(*read, places, t, k / 2, k % 2)),
                        0.013f * static_cast<float>(t * k) - 1, 0.5f / 64 + 1e-6f);
    for (uint32_t t = 2; t < 5; ++t) {
        for (uint32_t k = 0; k < t; ++k) EXPECT_EQ(value_of(*read, who, t, k, 0), 0xfffffff0u + 7 * k);
        EXPECT_EQ(value_of(*read, exact, t, 0, 0), std::bit_cast<uint32_t>(-0.1f * static_cast<float>(t)));
    }
}

TEST(Columns, RefuseWhatIsCutShortOrTooMuch) {
    const std::string bytes = encode_columns(some_ticks());
    for (size_t size = 0; size < bytes.size(); ++size)
        EXPECT_FALSE(decode_columns(std::string_view(bytes).substr(0, size), 0, 5)) << size;
    EXPECT_FALSE(decode_columns(bytes + "x", 0, 5));
    EXPECT_FALSE(decode_columns(bytes, 0, 4));
    // So many items that nothing could hold them.
    std::string many = bytes;
    many.replace(4 + 1 + 6 + 4, 4, std::string("\xff\xff\xff\x7f", 4));
    EXPECT_FALSE(decode_columns(many, 0, 5));
}

}  // namespace
}  // namespace flaneur
