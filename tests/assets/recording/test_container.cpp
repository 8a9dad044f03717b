#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <thread>

#include "assets/recording/container.h"
#include "sim/base/rng.h"
#include "tests/folder.h"

namespace flaneur {
namespace {

constexpr uint32_t k_some = chunk_kind("some"), k_more = chunk_kind("more");

std::string bytes_in(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

// Of chunk n: some pack well, some not at all, some are empty.
std::string content(uint32_t n) {
    std::string bytes(n % 5 == 0 ? 0 : 20 + n % 90, static_cast<char>(n));
    if (n % 3 == 0)
        for (char& c : bytes)
            c = static_cast<char>(random_bits({n, static_cast<uint32_t>(&c - bytes.data())}));
    return bytes;
}

RecordingWriterPtr begun(const std::string& path, uint32_t chunks) {
    Result<RecordingWriterPtr> writer = begin_recording(path, R"({"scene": "yard"})");
    EXPECT_TRUE(writer);
    for (uint32_t n = 0; n < chunks; ++n)
        EXPECT_TRUE(add_chunk(**writer, n % 2 ? k_more : k_some, n * 10, 20, content(n)));
    return std::move(*writer);
}

// Each chunk is as it was written or is refused in a sentence; says how many were whole.
size_t sound_chunks(const Recording& recording) {
    size_t sound = 0;
    for (const ChunkPlace& chunk : recording.chunks) {
        const Result<std::string> bytes = read_chunk(recording, chunk);
        if (!bytes) {
            EXPECT_NE(bytes.error().message.find("is damaged at byte"), std::string::npos);
            continue;
        }
        EXPECT_EQ(*bytes, chunk.kind == k_head_chunk ? recording.head : content(chunk.first / 10));
        ++sound;
    }
    return sound;
}

TEST(Container, GivesBackWhatWasWritten) {
    const TestFolder folder;
    const std::string path = folder / "a.flr";
    ASSERT_TRUE(finish_recording(begun(path, 31)));
    const Result<RecordingPtr> r = open_recording(path);
    ASSERT_TRUE(r) << r.error().message;
    EXPECT_EQ((*r)->head, R"({"scene": "yard"})");
    EXPECT_TRUE((*r)->is_finished);
    EXPECT_EQ((*r)->left_out, 0u);
    EXPECT_EQ((*r)->chunks.size(), 32u);
    EXPECT_EQ(sound_chunks(**r), 32u);
    EXPECT_EQ(chunks_of(**r, k_some).size(), 16u);
    // Of those that overlap the later one; of a kind that has none of a tick, none.
    EXPECT_EQ(chunk_at(**r, k_some, 0)->first, 0u);
    EXPECT_EQ(chunk_at(**r, k_some, 59)->first, 40u);
    EXPECT_EQ(chunk_at(**r, k_some, 319)->first, 300u);
    EXPECT_EQ(chunk_at(**r, k_some, 320), nullptr);
    EXPECT_EQ(chunk_at(**r, k_more, 9), nullptr);
    EXPECT_EQ(chunk_at(**r, chunk_kind("none"), 9), nullptr);
}

TEST(Container, LeavesOutATailThatWasCutShort) {
    const TestFolder folder;
    const std::string path = folder / "a.flr";
    uint64_t before = 0;
    {
        const RecordingWriterPtr writer = begun(path, 6);
        before = bytes_of(*writer);
        ASSERT_TRUE(add_chunk(*writer, k_some, 60, 20, content(6)));
    }  // and dies
    const std::string bytes = bytes_in(path);
    for (size_t size = before; size <= bytes.size(); ++size) {
        const Result<RecordingPtr> r = open_recording(folder.write("b.flr", bytes.substr(0, size)));
        ASSERT_TRUE(r);
        const bool is_whole = size == bytes.size();
        EXPECT_EQ((*r)->chunks.size(), is_whole ? 8u : 7u);
        EXPECT_EQ((*r)->left_out, is_whole ? 0 : size - before);
        EXPECT_FALSE((*r)->is_finished);
        EXPECT_EQ(sound_chunks(**r), (*r)->chunks.size());
    }
    // As many bytes as there should be, but not all written: a page of zeros, or one that is old.
    for (size_t at = before; at < bytes.size(); ++at) {
        std::string torn = bytes;
        for (size_t i = at; i < torn.size(); ++i) torn[i] = 0;
        if (torn == bytes) continue;
        const Result<RecordingPtr> r = open_recording(folder.write("b.flr", torn));
        ASSERT_TRUE(r);
        EXPECT_EQ((*r)->chunks.size(), 7u);
    }
}

TEST(Container, IsReadWithoutItsIndexToo) {
    const TestFolder folder;
    ASSERT_TRUE(finish_recording(begun(folder / "a.flr", 9)));
    const std::string bytes = bytes_in(folder / "a.flr");
    for (size_t cut = 1; cut < 100; ++cut) {
        const Result<RecordingPtr> r =
            open_recording(folder.write("b.flr", bytes.substr(0, bytes.size() - cut)));
        ASSERT_TRUE(r);
        EXPECT_EQ((*r)->chunks.size(), 10u);
        EXPECT_EQ(sound_chunks(**r), 10u);
    }
}

TEST(Container, RefusesWhatIsNone) {
    const TestFolder folder;
    const auto refusal = [&](const std::string& path) {
        const Result<RecordingPtr> r = open_recording(path);
        return r ? "" : r.error().message;
    };
    EXPECT_NE(refusal(folder / "missing").find("cannot be opened as a file"), std::string::npos);
    EXPECT_NE(refusal(folder.path.string()).find("cannot be opened as a file"), std::string::npos);
    EXPECT_NE(refusal("/dev/zero").find("cannot be opened as a file"), std::string::npos);
    EXPECT_NE(refusal(folder.write("empty", "")).find("is no recording"), std::string::npos);
    EXPECT_NE(refusal(folder.write("text", "What is this, and why is it here?")).find("is no recording"),
              std::string::npos);
    ASSERT_TRUE(finish_recording(begun(folder / "a.flr", 1)));
    std::string later = bytes_in(folder / "a.flr");
    later[8] = 9;
    EXPECT_NE(refusal(folder.write("later", later)).find("format 9"), std::string::npos);
    EXPECT_NE(refusal(folder.write("short", later.replace(8, 1, "\x01").substr(0, 50))).find("cut short"),
              std::string::npos);
    EXPECT_FALSE(begin_recording(folder / "no/such/folder", "{}"));
    const Result<RecordingWriterPtr> full = begin_recording("/dev/full", "{}");
    ASSERT_FALSE(full);
    EXPECT_NE(full.error().message.find("/dev/full"), std::string::npos);
}

TEST(Container, IsReadOrRefusedWhateverIsFlipped) {
    const TestFolder folder;
    ASSERT_TRUE(finish_recording(begun(folder / "a.flr", 12)));
    const std::string bytes = bytes_in(folder / "a.flr");
    int whole = 0, refused = 0;
    for (uint32_t n = 0; n < 300; ++n) {
        std::string broken = bytes;
        for (uint32_t flips = 0; flips <= n % 3; ++flips) {
            const uint64_t draw = random_bits({n, 2, flips});
            broken[draw / 256 % broken.size()] ^= static_cast<char>(1 << draw % 8);
        }
        if (n % 4 == 0) broken.resize(random_bits({n, 3}) % broken.size());
        const Result<RecordingPtr> r = open_recording(folder.write("b.flr", broken));
        if (!r) {
            EXPECT_NE(r.error().message.find("b.flr"), std::string::npos);
            ++refused;
            continue;
        }
        EXPECT_LE(sound_chunks(**r), 13u);
        whole += (*r)->chunks.size() == 13;
    }
    EXPECT_GT(whole, 50);
    EXPECT_GT(refused, 5);
}

TEST(Container, IsReadWhileItGrows) {
    const TestFolder folder;
    const std::string path = folder / "a.flr";
    RecordingWriterPtr writer = begun(path, 0);
    const Result<RecordingPtr> r = open_recording(path);
    ASSERT_TRUE(r);
    std::thread writes([&] {
        for (uint32_t n = 0; n < 2000; ++n) (void)add_chunk(*writer, k_some, n * 10, 10, content(n));
        (void)finish_recording(std::move(writer));
    });
    size_t last = 0, looks = 0;
    while (!(*r)->is_finished && looks < 1'000'000) {
        ASSERT_TRUE(refresh(**r));
        const size_t now = (*r)->chunks.size();
        ASSERT_GE(now, last);
        for (size_t i = last; i < now; ++i) {
            const ChunkPlace& chunk = (*r)->chunks[i];
            const Result<std::string> got = read_chunk(**r, chunk);
            ASSERT_TRUE(got) << got.error().message;
            if (chunk.kind == k_some) {
                ASSERT_EQ(*got, content(chunk.first / 10));
            }
        }
        last = now;
        ++looks;
    }
    writes.join();
    EXPECT_EQ(last, 2001u);
    std::ofstream(path, std::ios::trunc) << "short";
    EXPECT_FALSE(refresh(**r));
}

}  // namespace
}  // namespace flaneur
