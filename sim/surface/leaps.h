// Who of the walkers on a compound leaps from body to body, and when.
#pragma once

#include "sim/surface/surface_walk.h"

namespace flaneur {

inline Flyer flyer_of(const SurfaceWalkers& w, size_t walker) {
    return {w.position[walker], w.up[walker], w.ahead[walker], w.middle[walker]};
}

// Asks for a leap of one who walks: onto another body where one is in reach overhead, else up and down.
void ask_leap(SurfaceWalkers& walkers, size_t walker);

// After look_round() and before they walk: one walker a tick looks up, and now and then decides to leap; who
// gathered and stands crouches as soon as a way is found that nobody else's
// leads across and at whose end there is room, and else walks on. All in order, on one thread.
void begin_leaps(const Compound& compound, const Gravity& gravity, SurfaceWalkers& walkers, uint64_t seed,
                 uint32_t tick, float dt);

// A tick of the leaps of walkers [begin, end).
void go_on_leaping(const Compound& compound, const Gravity& gravity, SurfaceWalkers& walkers, size_t begin,
                   size_t end, float dt);

}  // namespace flaneur
