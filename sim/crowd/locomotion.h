// How legs can follow a wished velocity: walkers start, stop, slow down for bends and climbs, turn, and step
// aside or back. Pure, one walker at a time; the crowd's `move` calls it, and so can whoever drives one
// person.
#pragma once

#include "sim/base/footwork.h"
#include "sim/base/vec.h"
#include "sim/ground/ground.h"
#include "sim/ground/surroundings.h"

namespace flaneur {

struct Motion {
    Vec2 velocity;        // m/s
    float heading = 0;    // where the body faces: yaw about +y, 0 = +z, growing towards +x, in [-pi, pi]
    float turn_rate = 0;  // of the heading, rad/s
    Vec2 aim{};           // the way wished for, at the speed that turning leaves: what feet plan by, m/s
    float brakes = 0;     // m/s2, with which it slows down; 0: it does not
    Footwork feet{};
};

// What is left of a wished velocity (m/s) on the ground `under` a walker: uphill, and downhill beyond 10 %,
// speed falls as in Tobler's hiking function (1993), exp(-3.5 |s + 0.05|), with s the rise along the way, but
// no farther than to 0.3, from where on one climbs as on stairs; on
// steps to `stair_pace` times 0.42 of the wish, within 0.5-0.6 m/s, more of a run's (see stair_speed).
Vec2 wish_on(const GroundHit& under, Vec2 wish, float stair_pace = 1);

// The motion `dt` seconds later of one who would like to go at `wish` (m/s).
//
// - Speed follows within 1.5 m/s2, braking within 2.6, both easing in at the end: 90 % of a walk after two
//   steps, a stop in two. Who is to slow down all at once finishes the step first (`feet`, which the gait
//   knows), and brakes so that a body which stops comes to rest over the foot that has come
//   down.
// - Wishes slower than 0.25 m/s do not turn the body: so one steps aside or back. Others do, at 100 deg/s at
//   most, 140 while the inner foot swings, and 50 while the outer one does, in turns that are no bends: it
//   lands beside the inner foot, not on its toes. Who must turn far slows down for it, hardly for
//   what is soon over, in a half turn while walking to 0.15 m/s; who stands turns on the spot, at 97 deg/s.
// - In a bend speed goes with curvature to the power -1/3 (Vieilledent et al. 2001; Hicheur et al. 2005)
//   where it is narrower than 2.5 m, as v^2 times turn rate is what is bounded.
// - In a turn nobody goes off to where no foot stands or is about to (Footwork::beside).
// - One who does not wish to go turns to `look` (unit; (0, 0): nowhere in particular).
//
// Who pushes a pram, whose rear axle is `lever` metres ahead (0: nothing), is less nimble: it turns no faster
// than the axle can roll on, with the body going outward of its heading by 15 degrees at most and the pram
// facing inward by some nine, or, where it hardly goes, as it steps round the axle at 0.3 m/s.
Motion next_motion(const Motion& motion, Vec2 wish, float dt, Vec2 look = {0, 0}, float lever = 0);

inline constexpr float k_axle_to_middle = 0.2f;  // metres, of a pram (CrowdIdentity::ahead)

// Speed over the ground plane, m/s, that one who goes at `speed` on the level has on stairs: 0.5-0.6 of one
// who walks; of one who runs up to 1.1.
float stair_speed(float speed, float stair_pace = 1);

// Metres before steps from which on one who would like to go at `wished` slows down to the speed on them: who
// walks a step or two before, to set the feet.
float braking_way(float wished, float stair_pace = 1);

// The ground that bounds how fast one may go at `place`: that `under` it or steps that its `velocity` leads
// to within braking_way(wished), looked for at the end of that way and half-way.
GroundHit slowing_ground(const Surroundings& around, const GroundHit& under, Vec3 place, Vec2 velocity,
                         float wished, float stair_pace = 1);

}  // namespace flaneur
