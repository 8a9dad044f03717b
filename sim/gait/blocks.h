// What the gait keeps of sixteen walkers side by side, and what the pose reads of it.
//
// Places are in the world, metres. Yaws are about +y, 0 faces +z, growing towards +x. Phases count cycles.
#pragma once

#include <cstdint>

#include "sim/base/block.h"
#include "sim/body/body.h"
#include "sim/body/manner.h"

namespace flaneur {

// Where one foot of each walker stands: the point of the ground below its ankle when it is flat, a yaw about
// +y, and the ground's normal (whose y follows from its length).
struct FootPlaces {
    float x[k_block], y[k_block], z[k_block], yaw[k_block], normal_x[k_block], normal_z[k_block];
};

// One foot of each walker of a block.
struct FootBlock {
    FootPlaces from;          // where it stands, or stood before this swing
    FootPlaces to;            // where it stands, or will land
    float obstacle[k_block];  // metres that the swing must rise above the line between both, for kerbs on its
                              // way
    float round[k_block];     // metres to the left, by which the swing goes round the other foot
    float edge[k_block];      // how the swing passes the edge of a step: see SwingEnds in curves/swing-inl.h
    float phase[k_block];     // of this foot, [0, 1), 0 at its contact; it stands while below `duty`
    float pivots[k_block];    // 0: rests .. 1: turns on its ball, heel up
    float forefoot[k_block];  // 0: comes down on the heel .. 1: on the ball, as on stairs and in a run
    int32_t swinging[k_block];  // 1 from toe-off to contact
    // The gait's own.
    float rate[k_block];                         // at which the phase of a swing advances, 1/s
    FootPlaces goal;                             // what `to` moves to, the ground's last word
    float wished_x[k_block], wished_z[k_block];  // the place for which `goal` was found
    float wished_yaw[k_block];
    float goal_round[k_block];  // what `round` moves to
    float beside[k_block];      // metres outside of its line that this step lands
    // How one who stands has taken its place beside the other: metres ahead and outward, and radians outward,
    // of where a walk would set it down. 0 of one who walks.
    float stance_ahead[k_block], stance_out[k_block], stance_turn[k_block];
};

// What a hand reaches for.
struct HandBlock {
    float x[k_block], y[k_block], z[k_block];    // where the palm rests, in the world
    float normal_x[k_block], normal_z[k_block];  // out of the wall, horizontal, unit
    float reach[k_block];                        // 0: hangs and swings .. 1: rests there
};

// What a place that a hand has on its own body moves with.
enum class HoldAnchor { chest, pelvis, ground };

// A hand on its own body, or on something that goes along with it; see holds.h.
struct HoldBlock {
    // Of the wrist, in the axes of what it moves with: from the shoulder joint in those of the chest, from
    // the hips in those of the pelvis, from the root on GaitBlock::base in those of the heading.
    float x[k_block], y[k_block], z[k_block];
    float anchor[k_block];  // HoldAnchor
    float elbow[k_block];   // tangent of half the yaw that the elbow's plane has while the arm hangs
    // The forearm's turn about its length and the same turn again of the hand against it, the sine of half of
    // it; then the hand's bend, x and z of a quaternion without y. By as much as it holds.
    float twist[k_block], bend[k_block], side[k_block];
    float weight[k_block];  // 0: hangs and swings .. 1: rests there
    // The gait's own.
    float share[k_block];     // of the time from one to the other
    int32_t kind[k_block];    // Hold that it has or lets go of,
    int32_t wanted[k_block];  // and that it is to have
};

// State of the gait, and what the pose reads.
struct alignas(64) GaitBlock {
    // Copied from the crowd each tick.
    float x[k_block], z[k_block];  // root on the ground plane
    float heading[k_block];        // yaw of the body
    // The gait's own.
    float phase[k_block];      // of pelvis and arms, [0, 1): the left foot's, or half a cycle from the right
                               // foot's, and between both where these differ
    float duty[k_block];       // share of the cycle that a foot stands
    float load[k_block];       // share of the body that the left leg carries
    float load_rate[k_block];  // how fast it changes, 1/s
    float amplitude[k_block];  // 0 standing .. 1 walking: scales all that belongs to walking alone
    float running[k_block];    // 0 walking .. 1 running
    float pace[k_block];       // speed over sqrt(g leg), smoothed: by it amplitudes grow
    float step[k_block];       // length of a step over that of the leg, smoothed
    float course[k_block];     // cosine between the way walked and the heading: 1 ahead, 0 aside, -1 back
    float forward[k_block];    // m/s, along the heading
    float push[k_block];       // what speeds the body up, ahead, over gravity, smoothed,
    float drive[k_block];      // and smoothed again, so that nothing that goes by it begins with a jerk
    float bank[k_block];       // what turns it, to the left, over gravity, smoothed
    float rise[k_block];       // metres climbed for each metre walked, smoothed
    float climb[k_block];      // 0 .. 1: how far it is about climbing stairs, over several of them
    float lift[k_block];       // metres that a jump carries the body and both feet above their ways
    float crouch[k_block];     // metres that the pelvis sinks, before and after a jump
    float base[k_block];       // smoothed height of the ground that the pelvis rides on
    float base_velocity[k_block];
    float sink[k_block];  // metres that the pelvis stays below its way, for legs to reach
    float sink_velocity[k_block];
    float breath[k_block];   // breaths drawn, counted round
    float inhaled[k_block];  // -1: breathed out .. 1: in
    float tilt_ahead[k_block],
        tilt_aside[k_block];    // radians that one who stands or reels sways ahead, to the left
    float look[k_block];        // yaw of the head against the body
    float interest[k_block];    // the same of what it would look at
    int32_t standing[k_block];  // 1: both feet down and the phases at rest
    float frequency[k_block];   // cycles a second
    float quicker[k_block];     // share by which this step is
    int32_t first[k_block];     // Side that leaves first as soon as the other leg carries the body, or -1
    int32_t relaxed[k_block];   // Side of the leg that rests while the other one stands, or -1: they walk
    int32_t restless[k_block];  // Side of a foot that is to stand elsewhere now, or -1
    float tread[k_block];       // metres from step to step of the stairs underfoot, 0: none
    float jump[k_block];        // seconds since a jump began, 0: none
    float flight[k_block];      // seconds that it is in the air, 0 until the feet leave
    FootBlock feet[2];
    HandBlock hands[2];
    HoldBlock holds[2];
    int32_t posture[k_block];       // Posture of both hands
    int32_t next_posture[k_block];  // tick from which on another one may be chosen
    int32_t doing[k_block];         // 0: stood as one was chosen last .. 1: walked
};

// What makes one walker's body and manner, constant over its life. Sizes are the body's joints, scaled.
struct alignas(64) PersonBlock {
    float joints[k_joint_count][3][k_block];  // canonical places, metres
    float heel[k_block], toe[k_block];        // see Body
    float stride[k_block];                    // factor on step length
    float lead[k_block];                      // factor on how far ahead of the body a foot lands
    float arm_swing[2][k_block];              // factor, left and right
    float sway[k_block];                      // factor on pelvic movements
    float strike[k_block];                    // see Manner
    float clearance[k_block];                 // metres that its feet swing higher
    float linger[k_block];                    // see Manner
    float toe_out[k_block];                   // radians
    float step_width[k_block];                // metres between the lines of both feet
    // Of one who stands: metres between the ankles, from one foot ahead to the other, and radians that the
    // foot of the relaxed leg points farther out.
    float stance_width[k_block], stance_ahead[k_block], stance_turn[k_block];
    float lean[k_block];        // of the trunk, forward +, radians
    float stoop[k_block];       // of the chest over the pelvis, forward +, radians
    float carriage[k_block];    // arms away from the body, radians
    float elbow[2][k_block];    // radians that each elbow is bent beyond the middle
    float crouch[k_block];      // metres that the pelvis is lower than in the normal walk
    float unevenness[k_block];  // see Manner: share of a step's time,
    float stray[k_block];       // and metres beside its line
    float limp[k_block];        // see Manner
    float reel[k_block];        // see Manner
    float curiosity[k_block];   // see Manner
    float touches[k_block];     // see Manner
    float height[k_block];
    float girth[4][k_block];                   // see Girth, in its order
    float postures[k_posture_count][k_block];  // see Manner; those that wear and bags leave
    int32_t free_hands[k_block];               // 1: the left one, 2: the right one, 3: both
    int32_t bag[k_block];                      // Bag
};

}  // namespace flaneur
