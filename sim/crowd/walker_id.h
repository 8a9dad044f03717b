#pragma once

#include <cstdint>

namespace flaneur {

// Names one walker, and after it is gone nobody else in its world.
struct WalkerId {
    uint32_t index = ~0u;     // of its slot, below the capacity; taken again when the walker is gone
    uint32_t generation = 0;  // how often the slot was left before

    friend bool operator==(WalkerId, WalkerId) = default;
};

}  // namespace flaneur
