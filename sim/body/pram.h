// How long a pram is.
#pragma once

namespace flaneur {

// Lengths of a pram for a body of scale 1, metres: 0.96 m long from the handle to the front of the wheels,
// 0.55 m wide over all.
inline constexpr float k_pram_behind = 0.30f;  // from the handle to the rear axle
inline constexpr float k_pram_base = 0.56f;    // and from there to the one in front
inline constexpr float k_pram_track = 0.50f;   // between the middles of left and right wheels
inline constexpr float k_pram_rear = 0.14f, k_pram_front = 0.10f;  // radii of wheels
inline constexpr float k_pram_grip = 0.19f;                        // from the middle of the handle to a hand

}  // namespace flaneur
