// Heads that sway: who is seen from above goes from side to side with each stride, and a little faster and
// slower with each step.
#pragma once

#include <cstddef>
#include <vector>

namespace flaneur {

// Where somebody was at a time, metres.
struct SeenAt {
    double time = 0, x = 0, z = 0;
    double weight = 0;  // seconds that it stands for
};

// Takes out of somebody's spots, which are in the order of time, what goes to and fro across the way at the
// rate of strides, and along it at twice that. Recognised within 3 s at a time, by a sine of 0.5 to 1.3 Hz
// that is half or more of all that leaves the way, 0.6 to 8 cm to a side, of one who goes at 0.25 m/s or
// more: heads sway by 2 to 5 cm where people walk and by more where they shuffle, at 0.7 to 1 Hz and less
// (Liu, Song & Zhang 2009, Physica A 388; Hoogendoorn & Daamen 2005, Transportation Science 39). Says in how
// many of them. Spots more than 0.15 s apart tell nothing of it.
size_t take_out_sway(std::vector<SeenAt>& spots);

}  // namespace flaneur
