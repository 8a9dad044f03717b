// The normal walk: mean curves of one gait cycle at natural speed (1.1 to 1.33 m/s), 0 .. 100 percent, 0 at
// initial contact of the same side. Degrees.
//
// Pooled from Winter, The Biomechanics and Motor Control of Human Gait, 1991 (natural cadence), and Fukuchi,
// Fukuchi & Duarte, PeerJ 6:e4640, 2018 (24 young adults, comfortable speed; data CC BY 4.0, doi
// 10.6084/m9.figshare.5722711).
#pragma once

#include <array>

namespace flaneur {

inline constexpr int k_percents = 101;
using Cycle = std::array<double, k_percents>;

struct Reference {
    Cycle thigh, thigh_sd;  // against the vertical, forward +; sd between people
    Cycle knee, knee_sd;    // flexion +
    Cycle ankle, ankle_sd;  // dorsiflexion +
    Cycle foot_pitch;       // toes up +, against the flat foot
    Cycle pelvis_list;      // same side up +, mean 0
    Cycle pelvis_rotation;  // same side forward +, mean 0
};
extern const Reference k_reference;

}  // namespace flaneur
