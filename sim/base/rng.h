// Random numbers by key, not by sequence: the same (seed, walker, when, purpose) gives the same number on any
// thread in any order.
#pragma once

#include <cstdint>

namespace flaneur {

// What a random number is for. Two uses that could meet on one (seed, walker, when) take different purposes.
enum class Purpose : uint32_t {
    body,
    style,
    look,
    spawn,
    destination,
    lateral,
    pause,
    colour,
    accessory,
    city,
    tree,
    touch,
    errand,
    first_step,
    step,
    hold,
    coming,
    way,
    personality,
    fall,
    lamp,
    company,
    along,
    pastime,
    vehicle
};

// splitmix64's finalizer: a bijection of 64-bit numbers whose output bits each depend on every input bit.
constexpr uint64_t mix(uint64_t x) {
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

struct RandomKey {
    uint64_t seed = 0;
    uint32_t walker = 0;
    uint32_t when = 0;  // a tick, or a trip, an attempt, a mood: whatever counts for the purpose
    Purpose purpose = Purpose::body;
};

// 64 random bits; `index` numbers several draws under one key.
constexpr uint64_t random_bits(RandomKey key, uint32_t index = 0) {
    uint64_t h = mix(key.seed);
    h = mix(h ^ (uint64_t{key.walker} << 32 | key.when));
    return mix(h ^ (uint64_t{static_cast<uint32_t>(key.purpose)} << 32 | index));
}

// Uniform in [0, 1), a multiple of 2^-24.
constexpr float random_unit(RandomKey key, uint32_t index = 0) {
    return static_cast<float>(random_bits(key, index) >> 40) * (1.0f / 16777216.0f);
}

// Uniform in [low, high).
constexpr float random_between(RandomKey key, float low, float high, uint32_t index = 0) {
    return low + (high - low) * random_unit(key, index);
}

// Nearly normal, mean 0, standard deviation 1, within +-3.46: the sum of twelve uniforms (no libm).
constexpr float random_normal(RandomKey key, uint32_t index = 0) {
    float sum = -6;
    for (uint32_t i = 0; i < 12; ++i) sum += random_unit(key, index * 12 + i);
    return sum;
}

}  // namespace flaneur
