// What feet do on the ground: whether they slide, sink or hover.
#pragma once

#include <optional>

#include "tools/flaneur/gait/measure/measure.h"

namespace flaneur {

// One foot's time on the ground, watched from contact to toe-off. Heel and ball each rest from the tick at
// which they are within 2 mm of the ground until they leave it. A foot whose resting points all move has
// drifted; one that turns about heel or ball has not, and is counted anew when the other point leaves the
// ground.
struct Stance {
    float drift = 0;  // the farthest over the ground that a resting point came from where it began to
                      // rest, metres
    float below = 0;  // the deepest that heel, ball or tip were under the ground, metres
    float above = 0;  // the highest that the lowest of them was over it, metres
};
struct StanceWatch {
    bool standing = false;
    bool resting[2] = {};
    Vec3 anchor[2];  // heel, ball
    Vec3 last[2];
    float slip = 0;  // metres that the slower one of heel and ball moved in the last tick, while standing
    Stance stance;
};
// Looks at the foot once a tick. Returns the stance that has just ended, if one has.
std::optional<Stance> watch_stance(StanceWatch& watch, const FootInstant& foot);

// Over strides: drift of the flat foot (ankle 15 to 30 %, ball 15 to 45 % of the cycle) and of its resting
// points over the whole stance, slip, penetration, float, how high the ball of the flat foot is over the
// ground under it, and Zhang et al.'s skating measure (Mode-adaptive neural networks, ACM TOG 2018) on the
// flat foot.
Quantities measure_contact(const Walk& walk, const std::vector<MeasuredStride>& strides);

}  // namespace flaneur
