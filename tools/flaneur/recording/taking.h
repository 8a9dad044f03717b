// Records a world while a command runs it (--record): how all moved, or what it began with and what came from
// outside; a hash of its state each second either way. docs/recording.md tells of both.
#pragma once

#include <memory>

#include "sim/base/result.h"
#include "sim/world.h"
#include "tools/flaneur/options/options.h"

namespace flaneur {

inline constexpr uint32_t k_hash_ticks = 60;     // from one hash to the next,
inline constexpr uint32_t k_state_ticks = 1800;  // and of inputs from one state to the next

struct Taking;
struct TakingDelete {
    void operator()(Taking*) const;  // finishes the file as far as it can be
};
using TakingPtr = std::unique_ptr<Taking, TakingDelete>;

// Null where none is asked for. Begins with the tick that the world is at. Refuses what cannot be written,
// and inputs of a world that goes by where it is looked at from.
Result<TakingPtr> begin_taking(const Options& options, const World& world);
// After each tick. A tick that was recorded already, of a window that went back, is left out. False where it
// cannot go on: finish_taking() tells why.
bool take(Taking& taking, const World& world);
// The world was changed after its last tick by other than ticks. What inputs cannot tell (other ground, other
// people, a past that was changed) ends them, and is told by finish_taking().
void note_change(Taking& taking, const World& world);
// Null: nothing was recorded. Says on stderr what it came to.
Result<void> finish_taking(TakingPtr taking);

}  // namespace flaneur
