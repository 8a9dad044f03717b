// How people stand.
#pragma once

#include "tools/flaneur/gait/measure/measure.h"

namespace flaneur {

// Of one who stands from tick `first` on, while both feet do: the most that the knee of the leg is bent which
// carries 0.6 of the body or more, the mean of the other one's, degrees; means of how far one ankle is ahead
// of the other, millimetres, of how far they are apart, of the body's height, and of how much farther out one
// foot points than the other, and the leg that rests does, degrees.
Quantities measure_stance(const Walk& walk, size_t first);

// Standard deviations over several people of what tells apart how they stand, and of everybody the most that
// a knee which carries is bent.
Quantities measure_stances(const std::vector<Quantities>& people);

}  // namespace flaneur
