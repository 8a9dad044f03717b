// Key poses of who climbs over a low wall, and the curves between. Private to sim/deeds.
#pragma once

#include <array>

#include "sim/base/vec.h"

namespace flaneur {

// One moment: places from the middle of the wall's foot, x to the left of the way, y up, z along it, metres;
// angles in radians.
enum ClimbChannel : size_t {
    c_time,
    c_hips,                // three
    c_yaw = c_hips + 3,    // of the hips, to the left
    c_pitch,               // of the hips, ahead
    c_bow,                 // of the trunk against them, ahead
    c_tilt,                // of the hips, to the left
    c_foot,                // three of each ankle
    c_free = c_foot + 6,   // of each foot: 0 as the gait stands .. 1 hangs
    c_splay = c_free + 2,  // of each knee: 0 ahead .. 1 outward
    c_hand = c_splay + 2,  // three of each palm
    c_hold = c_hand + 6,   // of each hand: 0 hangs .. 1 is there
    c_point = c_hold + 2,  // of the fingers of each, yaw to the left of the way
    k_channels = c_point + 2
};
using ClimbKey = std::array<float, k_channels>;
constexpr size_t k_most_keys = 16;
struct ClimbKeys {
    std::array<ClimbKey, k_most_keys> all;
    size_t count = 0;
};

struct ClimbSizes {
    float k;             // of a grown person's height
    float leg, seat;     // metres; seat: of hips over what one sits on
    float half, height;  // of the wall: half its thickness
    float ankle;         // how high it is
};
// How one stands before and after, in the wall's frame.
struct ClimbStances {
    Vec3 hips[2], ankles[2][2];  // before and behind, left and right
};

inline Vec3 get(const ClimbKey& key, size_t channel) {
    return {key[channel], key[channel + 1], key[channel + 2]};
}

// Leading with the left leg, the right hand on the wall.
ClimbKeys keys_to_step(const ClimbSizes& s, const ClimbStances& st);
// Leading with the right leg; turned to the left, astride.
ClimbKeys keys_to_sit(const ClimbSizes& s, const ClimbStances& st);

// Monotone cubic curves through the keys (Fritsch & Carlson, SIAM Journal on Numerical Analysis 17, 1980):
// nothing leaves the span of two keys, and what is alike in two of them does not move between.
ClimbKey at_time(const ClimbKeys& keys, float time);

}  // namespace flaneur
