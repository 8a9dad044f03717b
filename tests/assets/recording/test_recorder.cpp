#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <iterator>

#include "assets/recording/recorder.h"
#include "assets/recording/replay.h"
#include "tests/assets/recording/moving.h"
#include "tests/folder.h"

namespace flaneur {
namespace {

const BoneTree& grown() {
    static const BoneTree tree = bone_tree_of(standard_body(1.7f));
    return tree;
}

std::vector<PoseBlock> poses_at(uint32_t tick, uint32_t walkers) {
    std::vector<PoseBlock> poses(block_count(walkers));
    for (uint32_t w = 0; w < walkers; ++w) pose_waving(poses, w, grown(), static_cast<float>(tick) / 60);
    return poses;
}

// Who is there, by tree `tree`, and a thing of tree `thing`.
Result<void> record(Recorder& recorder, uint32_t tick, uint32_t walkers, uint32_t tree, uint32_t thing) {
    std::vector<BodyMember> bodies;
    for (uint32_t w = 0; w < walkers; ++w) bodies.push_back({{w, 0, tree, 1}, w});
    const RigidMember car{{1000, 1, thing, 1}, {static_cast<float>(tick) * 0.1f, 0, 3}, Quat{}};
    return add_tick(recorder, tick, poses_at(tick, walkers), bodies, {&car, 1});
}

std::string bytes_in(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

// Everybody whom a replay has at a tick is where it was.
void expect_as_recorded(Replay& replay, uint32_t tick, uint32_t walkers) {
    const Result<bool> has = seek(replay, tick);
    ASSERT_TRUE(has) << has.error().message;
    ASSERT_TRUE(*has) << tick;
    const std::vector<PoseBlock> poses = poses_at(tick, walkers);
    Off off;
    uint32_t seen = 0;
    for (size_t i = 0; i < replay.motion.tracks.size(); ++i) {
        MotionPose pose;
        if (!pose_at(replay.motion, i, replay.trees, tick, pose)) continue;
        const auto id = static_cast<uint32_t>(replay.motion.tracks[i].mover.id);
        if (id == 1000) {
            EXPECT_NEAR(pose.origin.x + pose.places[0].x, static_cast<float>(tick) * 0.1f, 0.0011f);
        } else {
            compare(poses[id / k_block], lane_of(id), pose, off);
        }
        ++seen;
    }
    EXPECT_EQ(seen, walkers + 1);
    EXPECT_LE(off.root, 0.001f + 1e-6f);
    EXPECT_LE(off.place, 0.001f);
    EXPECT_LE(off.turn, 0.5f * k_radians);
}

TEST(Recorder, IsReplayedFromAnyTick) {
    const TestFolder folder;
    std::string first;
    for (const int threads : {1, 3}) {
        const std::string path = folder / ("a" + std::to_string(threads));
        Result<RecorderPtr> recorder = begin_recorder(path, "{}", {.threads = threads});
        ASSERT_TRUE(recorder) << recorder.error().message;
        const uint32_t thing = add_tree(**recorder, rigid_tree()), tree = add_tree(**recorder, grown());
        for (uint32_t tick = 7; tick < 300; ++tick) {
            if (tick >= 120 && tick < 150) continue;
            const uint32_t of = tick < 200 ? tree : add_tree(**recorder, grown());
            ASSERT_TRUE(record(**recorder, tick, 20, of, thing));
        }
        ASSERT_TRUE(add_other(**recorder, chunk_kind("hash"), 0, 300, "abc"));
        const Result<RecorderCount> count = finish_recorder(std::move(*recorder));
        ASSERT_TRUE(count) << count.error().message;
        EXPECT_EQ(count->missed, 0u);
        if (threads == 1) {
            first = bytes_in(path);
            EXPECT_LE(count->bytes, first.size());
        }
        Result<Replay> replay = open_replay(path, 1);
        ASSERT_TRUE(replay) << replay.error().message;
        for (const uint32_t tick : {299u, 7u, 119u, 150u, 54u, 55u, 199u, 200u, 8u})
            expect_as_recorded(*replay, tick, 20);
        for (const uint32_t tick : {0u, 6u, 120u, 149u, 300u, ~0u}) {
            const Result<bool> has = seek(*replay, tick);
            ASSERT_TRUE(has);
            EXPECT_FALSE(*has) << tick;
        }
        EXPECT_EQ(*read_chunk(*replay->recording, *chunk_at(*replay->recording, chunk_kind("hash"), 5)),
                  "abc");
    }
}

TEST(Recorder, WritesTheSameBytesOnAnyNumberOfThreads) {
    const TestFolder folder;
    std::string files[2];
    for (const int n : {0, 1}) {
        const std::string path = folder / std::to_string(n);
        Result<RecorderPtr> recorder = begin_recorder(path, "{}", {.threads = n == 0 ? 1 : 4});
        ASSERT_TRUE(recorder);
        const uint32_t thing = add_tree(**recorder, rigid_tree()), tree = add_tree(**recorder, grown());
        for (uint32_t tick = 0; tick < 100; ++tick) ASSERT_TRUE(record(**recorder, tick, 300, tree, thing));
        ASSERT_TRUE(finish_recorder(std::move(*recorder)));
        files[n] = bytes_in(path);
    }
    EXPECT_EQ(files[0], files[1]);
}

TEST(Recorder, IsReplayedWhileItRecords) {
    const TestFolder folder;
    const std::string path = folder / "a";
    Result<RecorderPtr> recorder = begin_recorder(path, "{}");
    ASSERT_TRUE(recorder);
    const uint32_t thing = add_tree(**recorder, rigid_tree()), tree = add_tree(**recorder, grown());
    Result<Replay> replay = open_replay(path, 1);
    ASSERT_TRUE(replay);
    EXPECT_FALSE(*seek(*replay, 0));
    uint32_t tick = 0;
    while (tick < 2000) {
        ASSERT_TRUE(record(**recorder, tick++, 3, tree, thing));
        ASSERT_TRUE(refresh(*replay->recording));
        const Result<bool> has = seek(*replay, 60);
        ASSERT_TRUE(has) << has.error().message;
        if (*has) break;
    }
    expect_as_recorded(*replay, 60, 3);
}

// A child records, and is killed at some moment: at most what a chunk holds and the one that is being encoded
// are lost.
TEST(Recorder, LosesLittleWhenItIsKilled) {
    const TestFolder folder;
    auto* done = static_cast<std::atomic<uint32_t>*>(
        mmap(nullptr, 4096, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
    ASSERT_NE(done, MAP_FAILED);
    for (uint32_t n = 0; n < 6; ++n) {
        done->store(0);
        const std::string path = folder / std::to_string(n);
        const pid_t child = fork();
        ASSERT_GE(child, 0);
        if (child == 0) {
            Result<RecorderPtr> recorder = begin_recorder(path, "{}");
            const uint32_t thing = add_tree(**recorder, rigid_tree()), tree = add_tree(**recorder, grown());
            for (uint32_t tick = 0; tick < 1'000'000; ++tick) {
                (void)record(**recorder, tick, 4, tree, thing);
                done->store(tick + 1);
            }
            _exit(0);
        }
        const uint32_t at = 100 + static_cast<uint32_t>(random_bits({n, 9}) % 150);
        while (done->load() < at) usleep(200);
        kill(child, SIGKILL);
        waitpid(child, nullptr, 0);
        const uint32_t ticks = done->load();
        Result<Replay> replay = open_replay(path, 1);
        ASSERT_TRUE(replay) << replay.error().message;
        uint32_t last = 0;
        for (const ChunkPlace& chunk : chunks_of(*replay->recording, k_motion_chunk))
            last = chunk.first + chunk.ticks;
        EXPECT_GE(last + 2 * k_chunk_ticks, ticks);
        expect_as_recorded(*replay, last - 1, 4);
    }
    munmap(done, 4096);
}

// Where there is no room left it says so, and what was written before stays.
TEST(Recorder, SaysThatItCannotWrite) {
    EXPECT_FALSE(begin_recorder("/dev/full", "{}"));
    const TestFolder folder;
    const std::string path = folder / "a";
    Result<RecorderPtr> recorder = begin_recorder(path, "{}");
    ASSERT_TRUE(recorder);
    const uint32_t thing = add_tree(**recorder, rigid_tree()), tree = add_tree(**recorder, grown());
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit little{20'000, before.rlim_max};
    signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &little);
    Result<void> done;
    for (uint32_t tick = 0; tick < 2000 && done; ++tick) done = record(**recorder, tick, 5, tree, thing);
    const Result<RecorderCount> finished = finish_recorder(std::move(*recorder));
    setrlimit(RLIMIT_FSIZE, &before);
    signal(SIGXFSZ, SIG_DFL);
    ASSERT_FALSE(done);
    EXPECT_NE(done.error().message.find(path), std::string::npos);
    EXPECT_FALSE(finished);
    Result<Replay> replay = open_replay(path, 1);
    ASSERT_TRUE(replay);
    EXPECT_EQ(replay->recording->left_out, 0u);
    expect_as_recorded(*replay, 60, 5);
}

}  // namespace
}  // namespace flaneur
