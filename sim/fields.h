// The fields of a world's state by name, for checks that say what differs between two runs:
// "gait.left.phase". They are all that hash_world covers, and go by the same lists: sim/crowd/values-inl.h,
// sim/row_names-inl.h, and one of arrays in fields.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/world.h"

namespace flaneur {

// One number, of each walker or of the crowd as a whole.
struct StateField {
    std::string name;
    // 'f' float, 'i' int32_t, 'u' uint32_t and what is smaller, 'h' the hash of a list. In capitals: of some
    // walkers only, k_absent of the others.
    char kind = 'f';

    friend bool operator==(const StateField&, const StateField&) = default;
};
inline constexpr uint32_t k_absent = ~0u;

// Those of each walker, in the order of the stages of a tick; then the crowd's. The same for as long as it
// has somebody, and for each world that is made alike.
struct StateFields {
    std::vector<StateField> walkers, crowd;
};
StateFields state_fields(const World& world);

// The whole state in some bytes. Of two states that differ in a field, or of a walker, the digests of it are
// the same once in 65,536; `hash` is hash_world's.
struct StateDigest {
    uint64_t hash = 0;
    std::vector<uint16_t> fields;   // in the order of state_fields(), of everybody
    std::vector<uint16_t> walkers;  // by number, of all fields of theirs

    friend bool operator==(const StateDigest&, const StateDigest&) = default;
};
// Memory is used again.
void digest_state(const World& world, StateDigest& digest);

// All values, as bits: walker by walker its fields, then the crowd's. Of an empty slot k_absent.
std::vector<uint32_t> state_words(const World& world);

// "1.5", "-3", "none".
std::string told_word(const StateField& field, uint32_t word);

}  // namespace flaneur
