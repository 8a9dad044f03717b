// The bars of a grown man at 1.3 m/s carried over to people of any age, sex and size, and to other speeds.
//
// What is similar in two bodies is equal where lengths are counted in legs, times in sqrt(leg / g) and speeds
// in sqrt(g leg) (Hof, Gait & Posture 4, 1996): so a bar of a length grows with the leg, one of a cadence
// with its inverse root, and what is fast for a child is what is fast for its leg. A bar that changes with
// speed is moved as the mean of people is, and keeps its width. Where there are norms of an age of its own
// (children: Lythgo 2011; seventy and older: Hollman 2011), these are taken instead: mean and two standard
// deviations.
#pragma once

#include "tools/flaneur/gait/bars.h"
#include "tools/flaneur/gait/people/who.h"

namespace flaneur {

inline constexpr double k_norm_leg = 0.9;  // metres, of the people of 1.70 m that the norms are of
inline constexpr double k_slope = 8;       // percent

// A speed in sqrt(g leg), the root of its Froude number.
double pace_of(double speed, double leg);

enum class Trial { level, usual, turn, bends, stairs_up, stairs_down, slope_up, slope_down, kerb };

// What somebody with a leg of so many metres is held to, at a speed in m/s. Trial::usual is level ground at
// the speed that one likes, where one starts and stops too. A style of one's own is held to what no body does
// otherwise alone: contact, acceleration, jerk, and what joints can.
std::vector<Bar> bars_of(const Who& who, double leg, Trial trial, double speed);

}  // namespace flaneur
