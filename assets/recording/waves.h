// What motion is made of within a chunk: the ways in which a thin free beam of so many samples bends (the
// eigenvectors of squared second differences; Demmler & Reinsch, Numerische Mathematik 24, 1975). The first
// two are a constant and a straight line. They need a seventh less numbers than cosines do of people who
// walk, as they do not ask of a curve to be level where the chunk ends. Private to assets/recording.
#pragma once

#include <vector>

namespace flaneur {

inline constexpr int k_most_samples = 64;

// values[wave * samples + sample]; each wave is of length 1 and square to the others.
struct Waves {
    int samples = 0;
    std::vector<float> values;

    const float* of(int wave) const { return values.data() + wave * samples; }
};

// For 1 .. k_most_samples; made when first asked for, on any thread.
const Waves& waves_of(int samples);

}  // namespace flaneur
