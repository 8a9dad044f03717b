// Logs of states come back as they were written, and whatever is no such log is refused in a sentence.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "tools/flaneur/check/state_log.h"

namespace flaneur {
namespace {

constexpr uint32_t k_walkers = 3, k_last = 2;

StateLogHead some_head() {
    return {{"--scene", "corner", "--walkers", "3"},
            k_walkers,
            k_last,
            {{{"who.radius", 'f'}, {"gait.first", 'i'}}, {{"crowd.count", 'u'}}}};
}

StateDigest some_digest(uint16_t tick) { return {uint64_t{tick} << 40 | 7, {tick, 1, 2}, {tick, 3, 4}}; }

const std::vector<uint32_t> k_words = {1, 2, 3, 4, 5, 6, 7};

std::string some_log() {
    char* text = nullptr;
    size_t size = 0;
    FILE* const file = open_memstream(&text, &size);
    StateLogWriter log{file};
    EXPECT_TRUE(write_state_log_head(log, some_head()));
    for (uint16_t tick = 0; tick <= k_last; ++tick) EXPECT_TRUE(write_digest(log, some_digest(tick)));
    EXPECT_TRUE(write_state_words(log, k_words));
    (void)std::fclose(file);
    std::string bytes(text, size);
    std::free(text);
    return bytes;
}

// What comes of reading all of it: "" or the sentence.
std::string read_all(const std::string& bytes, StateLogHead* head = nullptr) {
    FILE* const file = std::tmpfile();
    (void)std::fwrite(bytes.data(), 1, bytes.size(), file);
    (void)std::fflush(file);
    lseek(fileno(file), 0, SEEK_SET);
    StateLogReader log{.from = fileno(file), .name = "a.log"};
    std::string refusal;
    if (Result<void> read = read_state_log_head(log); !read) refusal = read.error().message;
    StateDigest digest;
    for (uint32_t tick = 0; refusal.empty() && tick <= log.head.last; ++tick) {
        if (Result<void> read = read_digest(log, digest); !read) refusal = read.error().message;
        if (head && refusal.empty()) {
            EXPECT_EQ(digest, some_digest(static_cast<uint16_t>(tick)));
        }
    }
    if (refusal.empty()) {
        const Result<std::vector<uint32_t>> words = read_state_words(log);
        if (!words) refusal = words.error().message;
        if (head) {
            EXPECT_EQ(words.value(), k_words);
        }
    }
    (void)std::fclose(file);
    if (head) *head = log.head;
    return refusal;
}

// The log with some of it exchanged, and a sum that is right.
std::string with(const std::string& part, const std::string& instead) {
    std::string log = some_log();
    log.replace(log.find(part), part.size(), instead);
    log.resize(log.size() - sizeof(uint64_t));
    const uint64_t sum = sum_bytes(k_no_bytes, log);
    return log.append(reinterpret_cast<const char*>(&sum), sizeof sum);
}

TEST(StateLog, ComesBackAsItWasWritten) {
    StateLogHead head;
    EXPECT_EQ(read_all(some_log(), &head), "");
    EXPECT_EQ(head.words, some_head().words);
    EXPECT_EQ(head.walkers, k_walkers);
    EXPECT_EQ(head.last, k_last);
    EXPECT_EQ(head.fields.walkers, some_head().fields.walkers);
    EXPECT_EQ(head.fields.crowd, some_head().fields.crowd);
}

TEST(StateLog, CutAnywhereIsRefused) {
    const std::string log = some_log();
    for (size_t size = 0; size < log.size(); ++size) EXPECT_NE(read_all(log.substr(0, size)), "") << size;
    EXPECT_NE(read_all(log.substr(0, log.size() - 1)).find("is damaged: copy it again"), std::string::npos);
}

TEST(StateLog, AnyBitThatFlipsAndBytesThatFollowAreRefused) {
    const std::string log = some_log();
    const size_t first_line = log.find('\n') + 1;
    for (size_t bit = 0; bit < 8 * log.size(); ++bit) {
        std::string flipped = log;
        flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ 1 << bit % 8);
        const std::string said = read_all(flipped);
        EXPECT_NE(said, "") << bit;
        if (bit / 8 >= first_line) {
            EXPECT_NE(said.find("is damaged"), std::string::npos) << bit << said;
        }
    }
    EXPECT_NE(read_all(log + '\0').find("is damaged"), std::string::npos);
    EXPECT_NE(read_all(log + log).find("is damaged"), std::string::npos);
}

// FNV's own test vectors.
TEST(StateLog, ItsSumIsFnv1a) {
    EXPECT_EQ(sum_bytes(k_no_bytes, "a"), 0xaf63dc4c8601ec8cU);
    EXPECT_EQ(sum_bytes(k_no_bytes, "foobar"), 0x85944171f73967e8U);
}

TEST(StateLog, WhatIsNoLogIsRefused) {
    auto refusal = [](const std::string& bytes, const char* why) {
        const std::string said = read_all(bytes);
        EXPECT_NE(said.find(why), std::string::npos) << said;
    };
    refusal("", "begins otherwise");
    refusal(std::string(5000, '\0'), "begins otherwise");
    refusal(with("log 2", "log 1"), "of version 1,");
    refusal(with("log 2\n", "log 2"), "of version");
    refusal(with("walkers 3\n", ""), "does not say how many");
    refusal(with("last 2", "last -2"), "not understood");
    refusal(with("last 2", "last 4000000000"), "not understood");
    refusal(with("walkers 3\n", "walkers 99999999999\n"), "not understood");
    refusal(with("f who", "q who"), "not understood");
    refusal(with("last 2", std::string(200'000, 'a')), "does not end");
    // Counts that nothing follows take no memory.
    refusal(with("walkers 3\n", "walkers 1000000\n"), "cut short");
    refusal(with("last 2", "last 60000000"), "cut short");
}

TEST(StateLog, NamesNothingButAWorld) {
    auto is_refused = [](const std::string& words) {
        return read_all(with("word --walkers\n", words)).find("no world's") != std::string::npos;
    };
    EXPECT_TRUE(is_refused("word --hash-log\nword /tmp/x\n"));
    EXPECT_TRUE(is_refused("word --state-log=/tmp/x\n"));
    EXPECT_TRUE(is_refused("word --trace\n"));
    EXPECT_TRUE(is_refused("word x\nword --walkers\n"));
    EXPECT_FALSE(is_refused("word --walkers\n"));
    EXPECT_EQ(
        world_words({"--threads", "2", "--scene", "corner", "--seconds=3", "--force", "--time", "8:00"}),
        (std::vector<std::string>{"--scene", "corner", "--force", "--time", "8:00"}));
    StateLogHead head = some_head();
    head.words.push_back("a\nb");
    FILE* const file = std::tmpfile();
    StateLogWriter log{file};
    EXPECT_FALSE(write_state_log_head(log, head));
    (void)std::fclose(file);
}

}  // namespace
}  // namespace flaneur
