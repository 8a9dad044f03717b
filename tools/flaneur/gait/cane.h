// What a cane does on the ground, and the arm that holds it.
#pragma once

#include "tools/flaneur/gait/bars.h"

namespace flaneur {

// From tick `first` on, of the tip and the arm as they are drawn; empty for who has no cane. The tip stands
// while it moves slower than 0.03 m/s for a tenth of a second or longer, wherever that is: how far it then
// moves, and how far it is from the ground; else how deep it is under it. In how much of the left foot's
// stances it does not stand on the ground. How bent the elbow is as the tip comes down, on average, and at
// most. How much nearer than 60 mm the cane comes to the bones of a leg.
Quantities measure_cane(const Walk& walk, size_t first);

// Beyond this speed, m/s, that body runs, and no cane helps.
double fastest_with_cane(const Body& body);

// Of level ground, and of slopes and steps, where the tip comes down later and the elbow bends more.
std::vector<Bar> cane_bars(bool is_level);

}  // namespace flaneur
