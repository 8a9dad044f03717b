// Recorded motion: poses at even times, quantised, and the way from one to the next.
//
// A pose is one row of whole numbers, so that a sample is a weighted sum of few rows: two for a straight way,
// four for a curve, and a blend of clips is the sum of their samples. Signs are settled when the clip is
// made: each joint's rotations lie on the side of its rotation at rest, and neighbours in time on one side.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/animation/skeleton.h"

namespace flaneur {

enum class Curve : uint8_t {
    linear,  // straight from key to key
    cubic,   // Catmull-Rom: through every key, smooth there
};

// One pose of one character.
struct LocalPose {
    std::vector<Quat> rotations;  // by joint, against its parent
    Vec3 offset;                  // of joint 0 from its place at rest, metres
};

// Sixteen numbers of a row.
struct alignas(32) KeyPiece {
    int16_t values[16];
};

inline constexpr float k_rotation_unit = 1 / 32767.0f;  // angles are off by 0.0035 degrees at the most
inline constexpr float k_offset_unit = 1 / 4096.0f;     // metres: offsets reach 7.99 m and are off by 0.13 mm

struct Clip {
    uint32_t joints = 0;
    uint32_t keys = 0;
    bool loops = false;  // from the last key on to the first
    Curve curve = Curve::linear;
    float duration = 0;  // seconds, the way back to the first key included where it loops
    // A row a key, local_rows(joints) long; one before the first and two after the last say how the curve
    // goes on.
    std::vector<KeyPiece> rows;
};

// Keys at even times, 1 / rate seconds apart. Refuses an empty clip, more than 100,000 keys, poses of another
// skeleton, numbers that are not finite and ways that are too far.
Result<Clip> make_clip(const Skeleton& skeleton, const std::vector<LocalPose>& keys, float rate, bool loops,
                       Curve curve);

// The same poses as differences to `reference`: what an additive layer adds. Refuses like make_clip.
Result<Clip> make_additive_clip(const Skeleton& skeleton, std::vector<LocalPose> keys,
                                const LocalPose& reference, float rate, bool loops, Curve curve);

// The pose at `phase`, counted in durations: 0 at the first key. Where the clip does not loop it stays at its
// ends.
LocalPose sample(const Clip& clip, float phase);

}  // namespace flaneur
