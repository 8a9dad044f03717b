// How people step. Each foot has a phase of its own: it stands where it landed until its time in the cycle
// comes, or until its place is out of reach, then swings to a place planned on the real ground. While a
// walker walks, the phases advance with the distance walked, half a cycle apart: the rhythmic case of the
// same rules by which one who stands takes a step aside, catches a push or turns on the spot. Sixteen walkers
// lie side by side in a block.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/base/vec.h"
#include "sim/city/city.h"
#include "sim/gait/manner.h"
#include "sim/pose/body.h"

namespace flaneur {

inline constexpr int k_block = 16;  // walkers in a block
enum Side : int { k_left = 0, k_right = 1 };

constexpr size_t block_count(size_t walkers) { return (walkers + k_block - 1) / k_block; }

// One foot of each walker of a block. A foot's place is the point of the ground below its ankle when it is
// flat, a yaw about +y, and the ground's normal (whose y follows from its length).
struct FootBlock {
    struct Place {
        float x[k_block], y[k_block], z[k_block], yaw[k_block], normal_x[k_block], normal_z[k_block];
    };
    Place from;               // where it stands, or stood before this swing
    Place to;                 // where it stands, or will land
    float obstacle[k_block];  // metres that the swing must rise above the line between both, for kerbs on its
                              // way
    float phase[k_block];     // of this foot, [0, 1), 0 at its contact; it stands while below `duty`
    float forefoot[k_block];  // 0: comes down on the heel .. 1: on the ball, as on stairs and in a run
    int32_t swinging[k_block];  // 1 from toe-off to contact
    // The gait's own.
    Place goal;                                  // what `to` moves to, the ground's last word
    float wished_x[k_block], wished_z[k_block];  // the place for which `goal` was found
    float wished_yaw[k_block];
};

// What a hand reaches for.
struct HandBlock {
    float x[k_block], y[k_block], z[k_block];    // where the palm rests, in the world
    float normal_x[k_block], normal_z[k_block];  // out of the wall, horizontal, unit
    float reach[k_block];                        // 0: hangs and swings .. 1: rests there
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
    float amplitude[k_block];  // 0 standing .. 1 walking: scales all that belongs to walking alone
    float running[k_block];    // 0 walking .. 1 running
    float course[k_block];     // cosine between the way walked and the heading: 1 ahead, 0 aside, -1 back
    float rise[k_block];       // metres climbed for each metre walked, smoothed
    float lift[k_block];       // metres that a jump carries the body and both feet above their ways
    float crouch[k_block];     // metres that the pelvis sinks, before and after a jump
    float base[k_block];       // smoothed height of the ground that the pelvis rides on
    float base_velocity[k_block];
    float look[k_block];        // yaw of the head against the body
    int32_t standing[k_block];  // 1: both feet down and the phases at rest
    float frequency[k_block];   // cycles a second
    int32_t first[k_block];     // Side that leaves first as soon as the other leg carries the body, or -1
    float tread[k_block];       // metres from step to step of the stairs underfoot, 0: none
    float jump[k_block];        // seconds since a jump began, 0: none
    float flight[k_block];      // seconds that it is in the air, 0 until the feet leave
    FootBlock feet[2];
    HandBlock hands[2];
};

// What makes one walker's body and manner, constant over its life. Sizes are the body's joints, scaled.
struct alignas(64) PersonBlock {
    float joints[k_joint_count][3][k_block];  // canonical places, metres
    float heel[k_block], toe[k_block];        // see Body
    float stride[k_block];                    // factor on step length
    float lead[k_block];                      // factor on how far ahead of the body a foot lands
    float arm_swing[k_block];                 // factor
    float sway[k_block];                      // factor on pelvic movements
    float toe_out[k_block];                   // radians
    float step_width[k_block];                // metres between the lines of both feet
    float lean[k_block];                      // of the trunk, forward +, radians
    float carriage[k_block];                  // arms away from the body, radians
    float crouch[k_block];                    // metres that the pelvis is lower than in the normal walk
};

struct Gait {
    size_t count = 0;
    std::vector<GaitBlock> blocks;
    std::vector<PersonBlock> people;
};

// What the crowd tells the gait, one value a walker.
struct RootMotion {
    const Vec3* position;    // on the ground
    const Vec2* velocity;    // m/s
    const float* heading;    // yaw about +y, 0 faces +z
    const float* turn_rate;  // rad/s
    // m/s, what the walker would like its velocity to be: feet land and heads look where it leads. Null: the
    // velocity as it is.
    const Vec2* wish = nullptr;
};

// Walkers standing on both feet. `bodies[body[i]] * scale[i]` is walker i's, and so is `manner[i]`; without
// manners they are drawn from (seed, i).
void start_gait(Gait& gait, size_t count, const std::vector<Body>& bodies, const uint32_t* body,
                const float* scale, const RootMotion& root, const City& city, uint64_t seed,
                const Manner* manner = nullptr);

// One tick of `dt` seconds for walkers [begin, end): phase, toe-offs, contacts and where the swinging feet
// will land.
void advance_gait(Gait& gait, size_t begin, size_t end, const RootMotion& root, const City& city,
                  uint64_t seed, uint32_t tick, float dt);

// Jumps, over a gap or up a ledge say: crouch, flight with both feet, crouch, up again; nothing while a jump
// is under way. Whoever moves the root goes on as before. Walkers also jump by themselves where the next step
// finds no ground, or one more than 0.45 m higher, but ground within 1.3 m.
void jump(Gait& gait, size_t walker);
inline constexpr float k_jump_crouch = 0.34f;  // seconds from its beginning until the feet leave, at least

// The ground under a walker's feet turns by `yaw` about the vertical through `pivot`, then moves by `by`, and
// takes the feet along: on a lift, a ferry, a turntable. Not the root, which is the caller's.
void carry_feet(Gait& gait, size_t walker, Vec3 pivot, float yaw, Vec3 by);

// Metres of one stride (two steps) at speed `v` > 0 for a leg of length `leg`.
float stride_length(float v, float leg);
// Share of the cycle that a foot stands at walking speed `v`.
float duty_factor(float v);
// Strides a second and share of the cycle that a foot stands of a run: 160 steps a minute and 40 % at 3.1
// m/s (Novacheck 1998).
float run_frequency(float v, float leg);
float run_duty(float v);

}  // namespace flaneur
