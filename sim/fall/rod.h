// Canes and other sticks that a hand has let go of, or drags along: two ends a fixed way apart, with their
// weight, above the ground that is there.
#pragma once

#include <cstdint>

#include "sim/base/vec.h"
#include "sim/ground/surroundings.h"

namespace flaneur {

// The stick of one who has fallen.
struct LooseRod {
    uint32_t walker = 0;
    uint32_t held = 0;                 // 1: a hand has its grip again
    float share = 0;                   // of the way back into the hand, 0..1
    float length = 0;                  // metres, from grip to tip
    Vec3 grip{}, tip{};                // where its ends are after the last tick,
    Vec3 grip_before{}, tip_before{};  // and after the one before
    Quat turn{};  // how what hangs on it is turned: as the hand that held it, carried along
};

// Carries its turn along from where it lay to where it lies.
void turn_rod(LooseRod& rod, Vec3 was);

inline constexpr float k_rod_thick = 0.011f;  // metres, half of it

// A tick of one that falls, lies or rolls to rest: both ends fall, keep their way apart, stay on the ground
// and lose half of their way along it in some 60 ms.
void step_rod(LooseRod& rod, const Surroundings& around, float dt);
// A tick of one whose grip is brought to `grip`: its tip trails after it over the ground.
void drag_rod(LooseRod& rod, const Surroundings& around, Vec3 grip);
// Turns its tip there, unit, but not into the ground.
void point_rod(LooseRod& rod, const Surroundings& around, Vec3 way);

}  // namespace flaneur
