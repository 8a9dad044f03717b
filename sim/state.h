// A world's whole state as bytes, and back: all that its next tick depends on. Ground, mesh, bodies, clips
// and where people want to go are not in it; they are the world's for good, and states of it share them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sim/base/result.h"
#include "sim/world.h"

namespace flaneur {

// Replaces `bytes`, whose memory is used again: kept from call to call, it grows no more. Of 2000 walkers
// some 4 MB, in about a millisecond. Beside no step of the world. What is constant for as long as nobody
// comes or goes lies first, at the same places each time.
void save_state(const World& world, std::vector<std::byte>& bytes);

// Takes a world back, or on, to a state of its own. The tick before is not part of a state: until the next
// step everybody is as if he had stood still. Refuses, with a sentence and the world as it was, what is no
// state, one of another world (another seed, ground, capacity, other bodies or clips, walking elsewhere), and
// bytes that are cut short or too many; for the rest they are trusted.
Result<void> load_state(World& world, std::span<const std::byte> bytes);

// Bodies, linkages and things are at the tick before where they are now, as if they had stood still.
// Vehicles, balls and figures are not in this: they say so of themselves.
void forget_previous(World& world);

// Of what a state's world and the one that it is loaded into have to have in common.
uint64_t state_mark(const World& world);

// The tick of a state; none of bytes that are no state.
std::optional<uint32_t> tick_of_state(std::span<const std::byte> bytes);

}  // namespace flaneur
