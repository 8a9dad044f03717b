// People as the command line names them, and what is usual for them.
#pragma once

#include <string>

#include "tools/flaneur/gait/measure/walk.h"
#include "tools/flaneur/options/options.h"

namespace flaneur {

struct Who {
    Sex sex = Sex::man;
    double age = 30;     // years
    uint64_t style = 0;  // draws a manner around the middle one of that age; 0: the middle one itself
};

// "man_30", "woman_8_style_3": for files.
std::string word_of(const Who& who);
// "a man of 30", "a woman of 8, style 3".
std::string name_of(const Who& who);

// Metres. WHO growth reference, 2007, up to 18 years.
double usual_height(const Who& who);
// What such people like on level ground, and their fastest walk, m/s, on legs so many metres long. That is
// where the Froude number is k_run_froude (Alexander 1989, of children too), or what people in their sixties
// and older reach at most (Steffen, Hacker & Mollinger, Physical Therapy 82, 2002).
double liked_speed(const Who& who, double leg);
double fastest_speed(const Who& who, double leg);

// Lets hands do what those of such people do, or the one posture that was asked for. Nothing where neither
// that, a bag nor standing was.
void free_hands(Manner& manner, const Who& who, const GaitOptions& gait);

// The middle manner is even from step to step: the norms are means of many steps.
Manner manner_of(const Who& who);

}  // namespace flaneur
