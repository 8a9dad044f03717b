// One track as bits. Private to assets/recording.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "assets/recording/chain.h"
#include "assets/recording/symbols.h"

namespace flaneur {

// Where one is at its samples: ticks at which it is not as at the tick before. Along the axes of its yaw, and
// places from its origin.
struct SampledTrack {
    int count = 0;
    uint64_t moves = 0;
    std::array<int32_t, 3> origin{};
    uint8_t yaw = 0;
    Vec3 root[k_most_samples];
    Quat turns[k_most_recorded_joints][k_most_samples];
};

// Three curves as waves of a step, and as they will be read.
struct CodedCurves {
    int step = 0;
    int values[3][k_most_samples];
    int counts[3];
    Vec3 read[k_most_samples];
};

struct TrackChain;

// Encodes tracks of trees of so many joints, one after the other.
struct TrackEncoder {
    SampledTrack samples;  // of the one that is to be put
    MotionMeans means;     // of all so far, without `ones`
    uint64_t missed = 0;

    // Bits go to the end of these: steps and means, and all waves but those.
    TrackEncoder(const MotionBound& of, std::string& means_to, std::string& waves_to, size_t joints);
    // By the steps and means that the key has of it; null: it has none.
    void put(const BoneTree& tree, float scale, const uint8_t* steps, const float* usual);
    void finish();

  private:
    void put_root(const Waves& waves);
    void put_joint(const TrackChain& chain, size_t joint, const Waves& waves);
    void put_coded(int at);
    int guess_of(size_t at, float size) const;

    const MotionBound bound;
    const float half_turn;  // sine of half the bound's angle
    BitWriter mean_bits, wave_bits;
    Symbols symbols;
    const uint8_t* key_steps = nullptr;
    const float* key_means = nullptr;
    std::array<int, k_most_recorded_joints + 1> guesses{};  // steps of the track before; the root's first
    CodedCurves coded, other;
    Vec3 curve[k_most_samples];
    Quat turns[k_most_recorded_joints][k_most_samples];   // as they will be read
    Vec3 places[k_most_recorded_joints][k_most_samples];  // the same, from the root
    Vec3 true_places[k_most_recorded_joints][k_most_samples];
};

}  // namespace flaneur
