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
using Curve = std::array<double, k_percents>;

struct Reference {
    Curve thigh, thigh_sd;  // against the vertical, forward +; sd between people
    Curve knee, knee_sd;    // flexion +
    Curve ankle, ankle_sd;  // dorsiflexion +
    Curve foot_pitch;       // toes up +, against the flat foot
    Curve pelvis_list;      // same side up +, mean 0
    Curve pelvis_rotation;  // same side forward +, mean 0
};
extern const Reference k_reference;

}  // namespace flaneur
