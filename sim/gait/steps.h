// One foot's step: when it is due, where it goes, and its way there.
#pragma once

#include <optional>

#include "sim/base/rng.h"
#include "sim/gait/footing.h"
#include "sim/gait/gait.h"

namespace flaneur {

// Velocity is expected to follow the wish with so many m/s2, and at most so much of what is left, 1/s: as
// next_motion of sim/crowd/locomotion.h does it.
inline constexpr float k_reaction = 2.5f, k_gentle = 6;

// One walker in this tick: what moves it, what it is, what it walks on. What its gait makes of that is lane
// `lane` of the block that goes along with it.
struct Stepper {
    const PersonBlock& person;
    int lane;
    const Surroundings& around;
    Vec3 root;  // on the ground
    Vec2 velocity{}, wish{};
    float heading, turn_rate = 0;
    float brakes = k_reaction;  // m/s2
    Vec2 facing;                // of the heading
    float leg_length;           // metres
    float dt = 0;
    RandomKey chance{};    // of this tick
    bool replans = false;  // looks at the landing place anew in this tick
    bool glances = false;  // chooses anew what to look at in this tick
};

inline constexpr float k_standing_speed = 0.08f;  // m/s; who is slower stands
inline constexpr float k_goes = 0.1f;             // m/s, of a wish that turns the body
inline constexpr float k_home_twist = 0.55f;      // radians; a standing foot turned farther steps,
inline constexpr float k_turn_ahead = 0.4f;       // foreseen for so many seconds
inline constexpr float k_least_swing = 0.7f;      // of the frequency, at which a swing advances at least
inline constexpr float k_longest_jump = 1.8f;     // metres from the root to ground on the far side

// A number that moves to another one by at most `step`.
inline void approach(float& v, float target, float step) { v += clamp(target - v, -step, step); }

inline bool wishes_to_go(const Stepper& s) { return length_squared(s.wish) > k_goes * k_goes; }
// The way that the body still goes if it stops.
Vec2 stopping_way(const Stepper& s);
// The velocity in so many seconds, as it is expected to follow the wish.
Vec2 expected_velocity(const Stepper& s, float seconds);

// Where the foot would stand beside a root at `root` that faces `heading`.
FootPlace home(const GaitBlock& gait, const PersonBlock& person, int lane, Side side, Vec3 root,
               float heading);

// How far a foot is from home.
struct Misfit {
    float distance = 0, twist = 0;  // metres, radians
    float behind = 0;               // metres, along the velocity or the wish
    // Metres across the velocity or the wish.
    float aside() const { return std::sqrt(std::max(distance * distance - behind * behind, 0.0f)); }
    float unasked = 0;  // metres from the place for which the ground has offered this one to home
    // Over 1: a standing walker steps.
    float amount(float slack) const;
};

// The foot that one who stands on stairs with the feet on two treads is to set beside the other one: that
// which is farther from the body.
std::optional<Side> astride(const GaitBlock& gait, const Stepper& s);
// Whether the ground has no better place for a foot of one who stands than where it is: then it is not asked
// to step any more.
bool stays(GaitBlock& gait, const Stepper& s, Side side);
// Toe-off. `frequency` is of the cycle, 1/s; the swing takes `seconds`. False if there is nothing to land on
// but a jump would reach ground.
bool lift_off(GaitBlock& gait, const Stepper& s, Side side, float seconds, float frequency);
// A tick of the swing with `seconds` left: the landing place follows what the walker does, and what the
// ground says to it.
void swing(GaitBlock& gait, const Stepper& s, Side side, float seconds, float frequency);
void touch_down(GaitBlock& gait, const Stepper& s, Side side);
// Sets a foot down at home at once.
void replant(GaitBlock& gait, const Stepper& s, Side side);
// Turns a planted foot about its ball by what the body's turn exceeds its leg's twist.
void pivot(GaitBlock& gait, const Stepper& s, Side side);

}  // namespace flaneur
