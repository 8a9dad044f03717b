// What commands put into recordings beside recorder.h's chunks; each is of one tick.
#pragma once

#include <cstdint>

#include "assets/recording/container.h"
#include "sim/crowd/walker_id.h"

namespace flaneur {

inline constexpr uint32_t k_hash_chunk = chunk_kind("hash");    // u64: hash_world()
inline constexpr uint32_t k_state_chunk = chunk_kind("stat");   // save_state(), of inputs
inline constexpr uint32_t k_change_chunk = chunk_kind("chng");  // the same, after what came from outside

// Of a body's track: the slot, and whose turn it is there.
constexpr uint64_t body_id(WalkerId id) { return uint64_t{id.generation} << 32 | id.index; }
constexpr WalkerId walker_of(uint64_t id) {
    return {static_cast<uint32_t>(id), static_cast<uint32_t>(id >> 32)};
}

}  // namespace flaneur
