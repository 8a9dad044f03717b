// One biped in one tick, and what follows from where it is. Private to sim/stepper.
#pragma once

#include "sim/base/math.h"
#include "sim/stepper/foothold.h"

namespace flaneur {

inline constexpr uint32_t k_both_down = 2;  // Biped::swings

// One of them in this tick.
struct Own {
    const Bipeds& bipeds;
    Biped& b;
    size_t number;  // among the bipeds
    GaitBlock& g;
    const PersonBlock& p;
    int lane;
    const StandingOn& on;
    float leg;

    float scale() const { return leg / 0.9f; }
    bool is_driven() const { return bipeds.orders.driven == number; }
    Vec2 facing() const { return heading_direction(b.heading); }
    Side other(Side side) const { return side == k_left ? k_right : k_left; }
    Foothold now(Side side) const { return in_world(*on.ground.movers, b.feet[side]); }
};

Own own_of(Bipeds& bipeds, size_t number, Gait& gait, const StandingOn& on);

inline float outward(Side side) { return side == k_left ? 1.0f : -1.0f; }

// Of one who goes at `speed`, m/s: metres of a step, of the reach, and seconds of a step that rises so far.
float step_of(const Own& o, float speed);
float reach_of(const Own& o, float speed);
float seconds_of(const Own& o, float speed, float rise);

// Where a foot would stand for a point at `point`, and how it would be turned in so many seconds.
Vec2 beside(const Own& o, Vec2 point, Side side);
float yaw_of(const Own& o, Side side, float seconds);
// Metres that ankle or ball, whichever is farther, is off there; a foot ahead of its place is not off by
// that.
float off(const Own& o, Side side, Vec2 place);
Seeker seeker(const Own& o, Side side);

// Says where both are wanted, and whether there is ground.
void look_for_places(const Own& o);
// Tells the gait where both are and go.
void write_feet(const Own& o);

// Hands go along ropes that are beside the body and within an arm's length, on them to the tick.
void hold_rails(const Own& o);

}  // namespace flaneur
