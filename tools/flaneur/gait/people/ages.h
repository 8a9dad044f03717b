// Norms of children, and of people of seventy and older, over the pace.
#pragma once

#include <string_view>

#include "tools/flaneur/gait/bars.h"
#include "tools/flaneur/gait/people/who.h"

namespace flaneur {

inline bool is_child(const Who& who) { return who.age < 18; }
inline bool is_old(const Who& who) { return who.age >= 70; }

// How the mean of grown people changes with the pace (see pace_of): stance and double support, percent, and
// cadence in any unit.
struct GrownTrend {
    double (*stance)(double pace);
    double (*double_support)(double pace);
    double (*cadence)(double pace);
};

// Stance, double support, cadence, step length and (of children) step width, after measurements of their age;
// none for others.
std::vector<Bar> bars_of_age(const Who& who, double leg, double pace, const GrownTrend& trend);

// Whether a bar of grown people is asked of somebody of that age: not where the age has one of its own, and
// of the old neither the curves of the young nor how upright these are.
bool is_asked_of_age(const Who& who, std::string_view quantity);
// What it is of the old where the difference is known: hips reach less far back, ankles push off less
// (Kerrigan et al., Arch Phys Med Rehabil 79, 1998).
void carry_to_age(const Who& who, Bar& bar);

}  // namespace flaneur
