// One lane of sixteen bodies that fall.
#pragma once

#include "sim/fall/tumble.h"

namespace flaneur {

inline Vec3 row_of(const float (&rows)[3][k_block], int lane) {
    return {rows[0][lane], rows[1][lane], rows[2][lane]};
}
inline Quat turn_of(const float (&rows)[4][k_block], int lane) {
    return {rows[0][lane], rows[1][lane], rows[2][lane], rows[3][lane]};
}
inline void set_row(float (&rows)[3][k_block], int lane, Vec3 v) {
    rows[0][lane] = v.x, rows[1][lane] = v.y, rows[2][lane] = v.z;
}
inline void set_row(float (&rows)[4][k_block], int lane, Quat q) {
    rows[0][lane] = q.x, rows[1][lane] = q.y, rows[2][lane] = q.z, rows[3][lane] = q.w;
}

// The middle of a ball and how it moves, m/s, in a block whose places are from `origin`.
struct BallMotion {
    Vec3 place, velocity;
};
inline BallMotion ball_motion(const TumbleBlock& block, const TumbleShapes& shapes, int ball, int lane,
                              Vec3 origin = {}) {
    const Segment s = k_segment_of_ball[ball];
    const Vec3 arm = rotate(turn_of(block.rotation[s], lane), row_of(shapes.ball[ball], lane));
    return {origin + row_of(block.place[s], lane) + arm,
            row_of(block.velocity[s], lane) + cross(row_of(block.spin[s], lane), arm)};
}

// Slows a body down to `share` of how it moves.
inline void calm(TumbleBlock& block, int lane, float share) {
    for (int s = 0; s < k_segment_count; ++s)
        for (int i = 0; i < 3; ++i) {
            block.velocity[s][i][lane] *= share;
            block.spin[s][i][lane] *= share;
        }
}

}  // namespace flaneur
