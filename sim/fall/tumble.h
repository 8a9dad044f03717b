// Bodies that fall: rigid segments, joints with their limits and muscles, balls that meet ground and walls.
// Position-based dynamics in short steps, one pass in each (Mueller, Macklin, Chentanez, Jeschke & Kim,
// "Detailed rigid body simulation with extended position based dynamics", Computer Graphics Forum 39, 2020),
// sixteen bodies side by side, with the widest instruction set that the CPU has; the same bits on every one.
#pragma once

#include <cstdint>

#include "sim/base/block.h"
#include "sim/base/vec.h"
#include "sim/fall/segments.h"

namespace flaneur {

// What sixteen bodies are.
struct alignas(64) TumbleShapes {
    float lightness[k_segment_count][k_block];  // 1/kg
    float ease[k_segment_count][3][k_block];    // 1/(kg m2), about the segment's axes
    float pivot[k_segment_count][3][k_block], socket[k_segment_count][3][k_block];  // see Segments
    float ball[k_ball_count][3][k_block], radius[k_ball_count][k_block];
};

// How they move. Segments' middles are in the world, metres, from an origin of the caller's near the body.
struct alignas(64) TumbleBlock {
    float place[k_segment_count][3][k_block];
    float rotation[k_segment_count][4][k_block];  // unit quaternions, vector part first
    float velocity[k_segment_count][3][k_block];  // m/s
    float spin[k_segment_count][3][k_block];      // rad/s, about the world's axes
};

// What muscles do, of each joint against the segment that carries it; the pelvis' go unread.
struct alignas(64) TumbleAims {
    float turn[k_segment_count][4][k_block];  // that it is drawn to
    float haste[k_segment_count][k_block];  // rad/s: it would swing about that so fast if nothing hung on it
    float drag[k_segment_count][k_block];   // 1/s, by which its turning is slowed down
};

// What each ball may meet in a tick: ground and wall as planes, through places where `along` the normal, unit
// and out of it, is `offset`. One that is in it at the beginning comes out at k_comes_out m/s.
struct alignas(64) TumblePlanes {
    float normal[k_ball_count][3][k_block], offset[k_ball_count][k_block];
    float wall[k_ball_count][3][k_block], wall_offset[k_ball_count][k_block];
    int32_t has_walls = 0;
};
inline constexpr float k_meets_nothing = -1e6f;  // as an offset: there is none

inline constexpr float k_comes_out = 0.8f;
inline constexpr float k_grip = 0.7f;      // friction of clothes, skin and soles on ground and walls
inline constexpr int k_tumble_steps = 20;  // in a tick

// One tick of `dt` seconds.
void tumble(const TumbleShapes& shapes, const TumbleAims& aims, const TumblePlanes& planes, float dt,
            TumbleBlock& block);

// Lane `lane` as such a body, at rest where it is.
void set_shape(TumbleShapes& shapes, int lane, const Segments& segments);

// What one lane has, joules: of motion, and of height over 0.
float energy_of(const TumbleBlock& block, const Segments& segments, int lane);

// Slows the lane down until it has no more than `most` joules; what it has. Limits of joints and ground are
// kept by moving what is beyond them, and where they are at odds that would keep a body in motion for ever.
float keep_energy(TumbleBlock& block, const Segments& segments, int lane, float most);

}  // namespace flaneur
