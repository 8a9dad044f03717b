// A 64-bit hash of bytes, for state hashes and cache keys. Not cryptographic.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "sim/base/rng.h"

namespace flaneur {

// The hash of `size` bytes continued from `hash`. The same on every little-endian machine.
inline uint64_t hash_bytes(uint64_t hash, const void* data, size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    while (size >= 8) {
        uint64_t word;
        std::memcpy(&word, bytes, 8);
        hash = mix(hash ^ word);
        bytes += 8;
        size -= 8;
    }
    uint64_t tail = size;
    for (size_t i = 0; i < size; ++i) tail = tail << 8 | bytes[i];
    return mix(hash ^ tail);
}

// For files that are read elsewhere, and bytes that come in pieces: FNV-1a,
// http://www.isthe.com/chongo/tech/comp/fnv, slower than hash_bytes(). The sum of bytes, continued from
// `sum`; bytes that differ in one alone never have the same.
inline constexpr uint64_t k_no_bytes = 0xcbf29ce484222325;
inline uint64_t sum_bytes(uint64_t sum, std::string_view bytes) {
    for (const char c : bytes) sum = (sum ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    return sum;
}

}  // namespace flaneur
