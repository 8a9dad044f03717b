// Who speaks, who looks at whom, and what heads and hands do with it. Private to sim/company.
#pragma once

#include "sim/company/company.h"

namespace flaneur {

// By turns of 2 to 6 s; now and then all laugh, or nobody says anything.
void take_turns(Group& group, uint32_t tick, uint64_t seed);

// Heads turn to who speaks, of those who walk in glances of 0.7 to 1.5 s and by 43 degrees at most (20 to 45:
// Moussaid 2010); of those who stand nearly always.
void look_at_each_other(Company& company, const Crowd& crowd, const Group& group, uint32_t tick,
                        uint64_t seed);

// Radians by which the head of a member nods, down, or is thrown back as it laughs, in that tick.
float nod_of(const Group& group, uint32_t member, uint32_t tick, uint64_t seed);

// Whether one who meets another raises a hand, rather than the chin.
bool waves(const Group& group, uint32_t member, uint64_t seed);

// Whether a member that speaks has that hand before the body in that tick, and where from there it moves,
// metres in the axes of the chest.
bool gestures(const Group& group, const Crowd& crowd, uint32_t member, Side side, uint32_t tick,
              uint64_t seed);
Vec3 beat_of(const Group& group, Side side, float height, uint32_t tick, uint64_t seed);

}  // namespace flaneur
