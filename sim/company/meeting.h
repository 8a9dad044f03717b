// Acquaintances who come upon each other. Private to sim/company.
#pragma once

#include "sim/company/company.h"

namespace flaneur {

// Two who walk alone, and towards each other, and know each other, see each other at 3.5 to 9 m and stop; and
// who comes by those who talk, and knows one of them, is let into their circle. Settled one after the other.
void find_meetings(Company& company, Crowd& crowd, const Navmesh& mesh, std::span<const Folk> folk,
                   uint32_t tick, uint64_t seed);

// On with a meeting: they come up to each other, greet once more at 1 to 1.5 m, talk for 10 to 60 s, and
// part.
void meet(Company& company, Crowd& crowd, const Navmesh& mesh, std::span<const Folk> folk, Group& group,
          uint32_t tick, uint64_t seed);

}  // namespace flaneur
