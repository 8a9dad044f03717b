#include <gtest/gtest.h>

#include <limits>
#include <memory>

#include "assets/cities.h"
#include "assets/recording/motion.h"
#include "sim/world.h"
#include "tests/assets/recording/moving.h"

namespace flaneur {
namespace {

constexpr MotionBound k_bound;

EncodedMotion encoded(const MotionFrames& frames, std::span<const BoneTree> trees, int threads = 1,
                      const MotionBound& bound = k_bound, const MotionMeans* key = nullptr) {
    const WorkersPtr workers = make_workers(threads);
    return encode_motion(frames, trees, bound, key, *workers);
}
Result<MotionChunk> decoded(const std::string& bytes, const MotionFrames& frames,
                            std::span<const BoneTree> trees, const MotionMeans* key = nullptr) {
    const WorkersPtr workers = make_workers(1);
    return decode_motion(bytes, frames.first, frames.ticks, trees, key, *workers);
}

// So many walkers who wave for `ticks`; those that `is_there` at a tick.
template <class IsThere>
std::unique_ptr<MotionFrames> waving(uint32_t walkers, uint32_t ticks, const BoneTree& tree,
                                     std::vector<std::vector<PoseBlock>>& poses, const IsThere& is_there) {
    auto frames = std::make_unique<MotionFrames>();
    frames->first = 1000;
    frames->ticks = ticks;
    poses.assign(ticks, std::vector<PoseBlock>(block_count(walkers)));
    for (uint32_t t = 0; t < ticks; ++t) {
        std::vector<BodyMember> bodies;
        for (uint32_t w = walkers; w-- > 0;) {
            pose_waving(poses[t], w, tree, static_cast<float>(t) / 60);
            if (is_there(w, t)) bodies.push_back({{w * uint64_t{5'000'000'007}, w % 3, 0, 1}, w});
        }
        take_poses(poses[t], bodies, {}, frames->frames[t]);
    }
    return frames;
}
constexpr auto k_always = [](uint32_t, uint32_t) { return true; };

void expect_within(const Off& off, const MotionBound& bound) {
    EXPECT_LE(off.root, bound.place + 1e-6f);
    EXPECT_LE(off.place, bound.place);
    EXPECT_LE(off.turn, bound.turn);
}

// The real thing: people of a district, some of whom are pushed and fall; from tick to tick, chunk by chunk.
// Of people in a block, 48 ticks from tick 1000 on, each against the block that it was.
template <class Was>
Off off_of(const MotionChunk& motion, const std::vector<BoneTree>& trees, uint32_t people, const Was& was) {
    Off off;
    MotionPose pose;
    for (uint32_t i = 0; i < people; ++i)
        for (uint32_t t = 0; t < 48; ++t)
            if (pose_at(motion, i, trees, 1000 + t, pose)) compare(was(t), static_cast<int>(i), pose, off);
    return off;
}

TEST(Motion, OfACrowdIsWithinTheBoundAtEveryTick) {
    const auto city = std::make_shared<const City>(generate_district({1, 1}));
    WorldOptions options;
    options.destinations = city->destinations;
    options.walkers = 60;
    options.groups = {1, 1, 1, 0};
    options.threads = 2;
    auto made = make_world(std::shared_ptr<const Ground>(city, &city->ground), options);
    ASSERT_TRUE(made) << made.error().message;
    World& world = **made;
    for (int tick = 0; tick < 240; ++tick) step(world);
    for (uint32_t w = 0; w < 8; ++w)
        (void)push(world, {w, world.crowd.slots.generation[w]}, {150.0f - 20 * static_cast<float>(w), 60});
    std::vector<BoneTree> trees;
    for (uint32_t w = 0; w < world.crowd.count; ++w) {
        Body body;
        for (size_t j = 0; j < k_joint_count; ++j)
            for (int axis = 0; axis < 3; ++axis)
                (&body.joints[j].x)[axis] = world.gait.people[w / k_block].joints[j][axis][lane_of(w)];
        trees.push_back(bone_tree_of(body));
    }
    size_t bytes = 0, seen = 0;
    bool falls = false;
    auto frames = std::make_unique<MotionFrames>();
    MotionMeans first;
    for (int chunk = 0; chunk < 4; ++chunk) {
        frames->first = world.tick;
        frames->ticks = 48;
        std::vector<std::vector<PoseBlock>> poses;
        for (uint32_t t = 0; t < frames->ticks; ++t) {
            std::vector<BodyMember> bodies;
            for (uint32_t w = 0; w < world.crowd.count; ++w)
                if (is_there(world.crowd, w)) bodies.push_back({{w, 0, w, 1}, w});
            poses.push_back(world.poses);
            take_poses(world.poses, bodies, {}, frames->frames[t]);
            falls |= has_fallen(world, {0, world.crowd.slots.generation[0]});
            step(world);
        }
        const MotionMeans* key = chunk > 0 ? &first : nullptr;
        const EncodedMotion e = encoded(*frames, trees, 2, k_bound, key);
        EXPECT_EQ(e.missed, 0u);
        bytes += e.bytes.size();
        const Result<MotionChunk> motion = decoded(e.bytes, *frames, trees, key);
        if (chunk == 0) first = e.means;
        ASSERT_TRUE(motion) << motion.error().message;
        Off off;
        MotionPose pose;
        for (size_t i = 0; i < motion->tracks.size(); ++i)
            for (uint32_t t = 0; t < frames->ticks; ++t) {
                const auto walker = static_cast<uint32_t>(motion->tracks[i].mover.id);
                if (!pose_at(*motion, i, trees, frames->first + t, pose)) continue;
                compare(poses[t][walker / k_block], lane_of(walker), pose, off);
                ++seen;
            }
        expect_within(off, k_bound);
    }
    EXPECT_TRUE(falls);
    EXPECT_GT(seen, 60u * 4 * 40);
    // Against 620 where there are a thousand: so few teach the coder less.
    EXPECT_LT(static_cast<double>(bytes) / static_cast<double>(seen) * 60, 850);
}

TEST(Motion, ComesAndGoes) {
    const std::vector<BoneTree> trees = {bone_tree_of(standard_body(1.7f))};
    std::vector<std::vector<PoseBlock>> poses;
    const auto is_there = [](uint32_t w, uint32_t t) { return (t / (w % 7 + 1) + w) % 3 != 0; };
    for (const uint32_t ticks : {1u, 2u, 3u, 31u, 64u}) {
        const auto frames = waving(21, ticks, trees[0], poses, is_there);
        const EncodedMotion e = encoded(*frames, trees);
        EXPECT_EQ(e.missed, 0u);
        const Result<MotionChunk> motion = decoded(e.bytes, *frames, trees);
        ASSERT_TRUE(motion) << motion.error().message;
        Off off;
        std::vector<int> seen(21 * ticks);
        for (size_t i = 0; i < motion->tracks.size(); ++i)
            for (uint32_t t = 0; t < ticks; ++t) {
                MotionPose pose;
                if (!pose_at(*motion, i, trees, 1000 + t, pose)) continue;
                const auto w = static_cast<uint32_t>(motion->tracks[i].mover.id / 5'000'000'007);
                EXPECT_EQ(motion->tracks[i].mover.kind, w % 3);
                compare(poses[t][w / k_block], lane_of(w), pose, off);
                ++seen[w * ticks + t];
            }
        expect_within(off, k_bound);
        for (uint32_t w = 0; w < 21; ++w)
            for (uint32_t t = 0; t < ticks; ++t) EXPECT_EQ(seen[w * ticks + t], is_there(w, t) ? 1 : 0);
    }
}

TEST(Motion, IsWithinOtherBoundsToo) {
    const std::vector<BoneTree> trees = {bone_tree_of(standard_body(1.2f))};
    std::vector<std::vector<PoseBlock>> poses;
    const auto frames = waving(5, 48, trees[0], poses, k_always);
    size_t last = ~size_t{0};
    for (const MotionBound& bound : {MotionBound{0.0005f, 0.004f}, k_bound, MotionBound{0.01f, 0.05f}}) {
        const EncodedMotion e = encoded(*frames, trees, 1, bound);
        EXPECT_EQ(e.missed, 0u);
        EXPECT_LT(e.bytes.size(), last);
        last = e.bytes.size();
        const Result<MotionChunk> motion = decoded(e.bytes, *frames, trees);
        ASSERT_TRUE(motion);
        const Off off =
            off_of(*motion, trees, 5, [&](uint32_t t) -> const PoseBlock& { return poses[t][0]; });
        expect_within(off, bound);
    }
}

TEST(Motion, OfNobodyIsNothing) {
    auto frames = std::make_unique<MotionFrames>();
    for (const uint32_t ticks : {0u, 1u, 48u}) {
        frames->ticks = ticks;
        const EncodedMotion e = encoded(*frames, {});
        EXPECT_LT(e.bytes.size(), 16u);
        const Result<MotionChunk> motion = decoded(e.bytes, *frames, {});
        ASSERT_TRUE(motion);
        EXPECT_TRUE(motion->tracks.empty());
    }
}

// Those afar are posed every eighth tick alone, and who does not move is held in a few bytes.
TEST(Motion, OfThoseWhoHardlyMoveCostsLittle) {
    const std::vector<BoneTree> trees = {bone_tree_of(standard_body(1.7f))};
    std::vector<std::vector<PoseBlock>> poses;
    const auto frames = waving(16, 48, trees[0], poses, k_always);
    const size_t all = encoded(*frames, trees).bytes.size();
    for (uint32_t t = 0; t < 48; ++t) frames->frames[t].blocks = frames->frames[t / 8 * 8].blocks;
    const EncodedMotion eighth = encoded(*frames, trees);
    EXPECT_LT(eighth.bytes.size() * 4, all * 3);
    const Result<MotionChunk> motion = decoded(eighth.bytes, *frames, trees);
    ASSERT_TRUE(motion);
    Off off = off_of(*motion, trees, 16, [&](uint32_t t) -> const PoseBlock& { return poses[t / 8 * 8][0]; });
    expect_within(off, k_bound);
    for (uint32_t t = 0; t < 48; ++t) frames->frames[t].blocks = frames->frames[0].blocks;
    const EncodedMotion still = encoded(*frames, trees);
    EXPECT_LT(still.bytes.size() * 4, all);
    const EncodedMotion later = encoded(*frames, trees, 1, k_bound, &still.means);
    EXPECT_EQ(key_of(later.bytes), std::optional<uint32_t>(1000));
    constexpr size_t k_told = 43 * 16;  // ids, ticks and origins, which pack well
    EXPECT_LT((later.bytes.size() - k_told) * 4, still.bytes.size() - k_told);
    EXPECT_FALSE(decoded(later.bytes, *frames, trees));
    const Result<MotionMeans> means = decode_means(still.bytes, 1000, 48, trees);
    ASSERT_TRUE(means);
    EXPECT_FALSE(decode_means(later.bytes, 1000, 48, trees));
    const Result<MotionChunk> read = decoded(later.bytes, *frames, trees, &*means);
    ASSERT_TRUE(read) << read.error().message;
    MotionPose pose;
    for (uint32_t i = 0; i < 16; ++i)
        if (pose_at(*read, i, trees, 1047, pose)) compare(poses[0][0], static_cast<int>(i), pose, off);
    expect_within(off, k_bound);
}

// Things, of which there are more than go into a group.
std::unique_ptr<MotionFrames> driving(uint32_t things) {
    auto frames = std::make_unique<MotionFrames>();
    frames->ticks = 48;
    for (uint32_t t = 0; t < 48; ++t) {
        std::vector<RigidMember> members;
        for (uint32_t i = 0; i < things; ++i) {
            const float time = static_cast<float>(t) / 60, speed = static_cast<float>(i % 17);
            members.push_back({{i, 7, 0, 1},
                               {speed * time, 0.5f, static_cast<float>(i) + time * time},
                               rotation_y(speed * time * 0.4f) * rotation_x(0.1f * time)});
        }
        take_poses({}, {}, members, frames->frames[t]);
    }
    return frames;
}

TEST(Motion, OfThingsIsWithinTheBoundAndTheSameOnAnyNumberOfThreads) {
    const std::vector<BoneTree> trees = {rigid_tree()};
    const auto frames = driving(600);
    const EncodedMotion one = encoded(*frames, trees, 1);
    EXPECT_EQ(one.missed, 0u);
    EXPECT_EQ(one.bytes, encoded(*frames, trees, 2).bytes);
    EXPECT_EQ(one.bytes, encoded(*frames, trees, 5).bytes);
    const Result<MotionChunk> motion = decoded(one.bytes, *frames, trees);
    ASSERT_TRUE(motion);
    ASSERT_EQ(motion->tracks.size(), 600u);
    for (uint32_t i = 0; i < 600; ++i)
        for (uint32_t t = 0; t < 48; ++t) {
            MotionPose pose;
            ASSERT_TRUE(pose_at(*motion, i, trees, t, pose));
            const RigidMember& thing = frames->frames[t].things[i];
            EXPECT_LE(length(pose.origin + pose.places[0] - thing.place), k_bound.place * 1.05f);
            EXPECT_LE(angle_between(thing.turn, pose.turns[0]), k_bound.turn);
        }
}

TEST(Motion, OfNumbersThatAreNoneIsCountedAndHarmsNobodyElse) {
    const std::vector<BoneTree> trees = {bone_tree_of(standard_body(1.7f))};
    std::vector<std::vector<PoseBlock>> poses;
    const auto frames = waving(3, 48, trees[0], poses, k_always);
    const float odd[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                         1e30f};
    for (int i = 0; i < 3; ++i) {
        frames->frames[10 + i].blocks[0].hips[i][1] = odd[i];
        frames->frames[20 + i].blocks[0].rotation[left_hand][i][1] = odd[i];
    }
    const EncodedMotion e = encoded(*frames, trees);
    const Result<MotionChunk> motion = decoded(e.bytes, *frames, trees);
    ASSERT_TRUE(motion);
    Off off;
    MotionPose pose;
    for (const uint32_t i : {0u, 2u})
        for (uint32_t t = 0; t < 48; ++t)
            if (pose_at(*motion, i, trees, 1000 + t, pose))
                compare(poses[t][0], static_cast<int>(i), pose, off);
    expect_within(off, k_bound);
}

// What a file's sums would let nobody see: any bytes are motion or are refused.
TEST(Motion, OfBrokenBytesIsReadOrRefused) {
    const std::vector<BoneTree> trees = {bone_tree_of(standard_body(1.7f))};
    std::vector<std::vector<PoseBlock>> poses;
    const auto frames = waving(9, 20, trees[0], poses, [](uint32_t w, uint32_t t) { return t >= w; });
    const std::string bytes = encoded(*frames, trees).bytes;
    int refused = 0;
    for (uint32_t n = 0; n < 600; ++n) {
        std::string broken = bytes;
        for (uint32_t flips = 0; flips <= n % 4; ++flips) {
            const uint64_t draw = random_bits({n, 0, flips});
            // Half of them into the table before the waves.
            broken[draw / 256 % (n % 2 == 0 ? broken.size() : 500)] ^= static_cast<char>(draw % 255 + 1);
        }
        if (n % 5 == 0) broken.resize(random_bits({n, 1}) % broken.size());
        const Result<MotionChunk> motion = decoded(broken, *frames, trees);
        refused += !motion;
        MotionPose pose;
        if (motion)
            for (size_t i = 0; i < motion->tracks.size(); ++i)
                for (uint32_t t = 0; t < 20; ++t) (void)pose_at(*motion, i, trees, 1000 + t, pose);
    }
    EXPECT_GT(refused, 100);
    EXPECT_LT(refused, 600);
}

TEST(Motion, HasRigsThatComeBack) {
    const std::vector<BoneTree> trees = {bone_tree_of(standard_body(1.7f)), rigid_tree(),
                                         bone_tree_of(standard_body(1.1f))};
    const std::string bytes = encode_trees(trees);
    const Result<std::vector<BoneTree>> read = decode_trees(bytes);
    ASSERT_TRUE(read);
    ASSERT_EQ(read->size(), 3u);
    for (size_t r = 0; r < 3; ++r) {
        EXPECT_EQ((*read)[r].parents, trees[r].parents);
        EXPECT_TRUE((*read)[r].offsets == trees[r].offsets);
    }
    EXPECT_FALSE(decode_trees(bytes.substr(0, bytes.size() - 1)));
    EXPECT_FALSE(decode_trees(bytes + "x"));
    std::string broken = bytes;
    broken[5] = 1;  // joint 1 hangs on itself
    EXPECT_FALSE(decode_trees(broken));
}

}  // namespace
}  // namespace flaneur
