// A 64-bit hash of bytes, for state hashes and cache keys. Not cryptographic.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

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

}  // namespace flaneur
