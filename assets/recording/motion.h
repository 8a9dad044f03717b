// How bodies and things moved, second by second, in few bytes: within a bound at every tick, for any program
// of any version to show without simulating. docs/recording.md has the bytes.
//
// What moves is a tree of bones that keep their lengths, or one joint alone, for what is rigid. A chunk holds
// the tracks of up to k_most_ticks ticks, and can be read with no other but the one that is its key. Of
// each track there is the way of its root, and of each joint the rotation as seen from its parent, as waves
// (waves.h). A joint is measured from where its parent will be read, not from where it was, and aims at where
// its child was: errors do not add up along limbs.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/math.h"
#include "sim/base/parallel_for.h"
#include "sim/base/result.h"
#include "sim/body/body.h"
#include "sim/pose/pose.h"

namespace flaneur {

inline constexpr size_t k_most_recorded_joints = 32;
inline constexpr uint32_t k_most_ticks = 64;  // of a chunk

// Joint 0 is the root, and parents come before children. Offsets are from the parent, metres, in its axes.
struct BoneTree {
    std::vector<uint8_t> parents;  // of joint 0: 0
    std::vector<Vec3> offsets;     // of joint 0: 0
};
BoneTree bone_tree_of(const Body& body);
BoneTree rigid_tree();

// Somebody or something that moves.
struct RecordedMover {
    uint64_t id = 0;    // never twice in a tick
    uint32_t kind = 0;  // the caller's
    uint32_t tree = 0;  // index of its bones'
    float scale = 1;    // of its bones

    friend bool operator==(const RecordedMover&, const RecordedMover&) = default;
};

// Largest errors at any tick: of a root's place, and of each joint's from there; of each joint's rotation.
struct MotionBound {
    float place = 0.001f;           // metres, 1e-4 .. 1
    float turn = 0.5f * k_radians;  // radians, 1e-3 .. 1
};

// What of a PoseBlock bodies follow from.
struct alignas(64) BodyBlock {
    float origin[3][k_block], hips[3][k_block];
    float rotation[k_joint_count][4][k_block];
};
struct BodyMember {
    RecordedMover mover;  // of a tree of k_joint_count joints
    uint32_t walker = 0;
};
struct RigidMember {
    RecordedMover mover;  // of a tree of one joint
    Vec3 place;
    Quat turn;
};

// Consecutive ticks as they were.
struct MotionFrame {
    std::vector<BodyBlock> blocks;
    std::vector<BodyMember> bodies;
    std::vector<RigidMember> things;
};
struct MotionFrames {
    uint32_t first = 0, ticks = 0;
    std::array<MotionFrame, k_most_ticks> frames;  // the first `ticks`
};
// Copies; allocates only where there are more than ever before.
void take_poses(const std::vector<PoseBlock>& poses, std::span<const BodyMember> bodies,
                std::span<const RigidMember> things, MotionFrame& frame);

// How everybody held themselves on average in a chunk, which is the key to others: who stands or sits does so
// later too, and is told by what has changed.
struct MotionMeans {
    struct One {
        uint64_t id = 0;
        uint32_t joints = 0;
        size_t begin = 0;  // into steps, and a third of that into means
    };
    uint32_t first = 0;     // tick of the chunk
    std::vector<One> ones;  // by id
    std::vector<uint8_t> steps;
    std::vector<float> means;
};

struct EncodedMotion {
    std::string bytes;
    // Joints that could not be held to the bound: of bones that change their lengths, or numbers that are not
    // finite.
    uint64_t missed = 0;
    MotionMeans means;
};
// The same bytes on any number of threads. Whoever reads it needs the means of the same `key`; null: none.
EncodedMotion encode_motion(const MotionFrames& frames, std::span<const BoneTree> trees,
                            const MotionBound& bound, const MotionMeans* key, Workers& workers);

// A chunk that was read.
struct MotionTrack {
    RecordedMover mover;
    uint8_t first = 0, ticks = 0;  // from the chunk's first tick
    uint64_t moves = 0;            // bit t: not as the tick before; bit 0 is set
    std::array<int32_t, 3> origin{};
    uint8_t yaw = 0;
    size_t values = 0, counts = 0;  // where its own begin
};
struct MotionChunk {
    uint32_t first = 0, ticks = 0;
    std::vector<MotionTrack> tracks;
    std::vector<float> values;
    std::vector<uint8_t> counts;
};
// The first tick of the chunk whose means are the key to these bytes; none: they need no key.
std::optional<uint32_t> key_of(std::string_view bytes);
// Both refuse, in a sentence without a subject, what encode_motion did not write with these trees and key.
// decode_means() takes a tenth of the time, of bytes that need no key.
Result<MotionMeans> decode_means(std::string_view bytes, uint32_t first, uint32_t ticks,
                                 std::span<const BoneTree> trees);
Result<MotionChunk> decode_motion(std::string_view bytes, uint32_t first, uint32_t ticks,
                                  std::span<const BoneTree> trees, const MotionMeans* key, Workers& workers);

// Where one is at a tick: joints' places from the origin, along the world's axes.
struct MotionPose {
    Vec3 origin;
    std::array<Vec3, k_most_recorded_joints> places;
    std::array<Quat, k_most_recorded_joints> turns;
};
// False where the track is not there at that tick.
bool pose_at(const MotionChunk& motion, size_t track, std::span<const BoneTree> trees, uint32_t tick,
             MotionPose& pose);

// Rigs as bytes, and back; refuses those that are none.
std::string encode_trees(std::span<const BoneTree> trees);
Result<std::vector<BoneTree>> decode_trees(std::string_view bytes);

}  // namespace flaneur
