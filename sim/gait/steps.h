// One foot's step: when it is due, where it goes, and its way there.
#pragma once

#include "sim/gait/footing.h"
#include "sim/gait/gait.h"

namespace flaneur {

// One walker in this tick.
struct Stepper {
    GaitBlock& gait;
    const PersonBlock& person;
    int lane;
    const City& city;
    Vec3 root;  // on the ground
    Vec2 velocity, wish;
    float heading, turn_rate;
    Vec2 facing;  // of the heading
    float leg;    // metres
    float dt;
    bool replans;  // looks at the landing place anew in this tick
};

inline constexpr float k_longest_jump = 1.8f;  // metres from the root to ground on the far side

// Where the foot would stand beside a root at `root` that faces `heading`.
Place home(const PersonBlock& person, int lane, Side side, Vec3 root, float heading);

// How far a foot is from home.
struct Misfit {
    float distance = 0, twist = 0;  // metres, radians
    float behind = 0;               // metres, along the velocity or the wish
    // Over 1: a standing walker steps.
    float amount(float slack) const;
};
Misfit misfit(const Stepper& s, Side side);

// Toe-off. `frequency` is of the cycle, 1/s; the swing takes `seconds`. False if there is nothing to land on
// but a jump would reach ground.
bool lift_off(const Stepper& s, Side side, float seconds, float frequency);
// A tick of the swing with `seconds` left: the landing place follows what the walker does, and what the
// ground says to it.
void swing(const Stepper& s, Side side, float seconds, float frequency);
void touch_down(const Stepper& s, Side side);
// Sets a foot down at home at once.
void replant(const Stepper& s, Side side);
// Turns a planted foot about its ball by what the body's turn exceeds its leg's twist.
void pivot(const Stepper& s, Side side);

}  // namespace flaneur
