// Canes and other sticks in a hand that no longer holds them tight, as of one who falls: the grip is in the
// hand, the tip hangs, swings and drags over the ground that is there.
#pragma once

#include <cstdint>

#include "sim/base/vec.h"
#include "sim/ground/surroundings.h"

namespace flaneur {

// The stick of one who has fallen.
struct LooseRod {
    uint32_t walker = 0;
    float length = 0;                  // metres, from grip to tip
    float share = 0;                   // of the way back to how a standing hand holds it, 0..1
    Vec3 grip{}, tip{};                // where its ends are after the last tick,
    Vec3 grip_before{}, tip_before{};  // and after the one before
    Quat turn{};  // how what hangs on it is turned: as the hand that held it, carried along
};

inline constexpr float k_rod_thick = 0.011f;  // metres, half of it

// A tick of one whose grip is where the hand, turned so, has it by now: its tip swings about it as a thin
// rod's does, and loses half of its way along the ground in some 60 ms. Once its owner stands up it comes to
// the direction `way`, unit, from the grip, by `share` (0..1), but not into the ground.
void carry_rod(LooseRod& rod, const Surroundings& around, Vec3 grip, Vec3 way, Quat hand, float share);

}  // namespace flaneur
