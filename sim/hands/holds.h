// Hands that have nothing to reach for: in pockets, on hips and straps, one in the other. And those of
// whoever carries a bag.
//
// A hold is a place for the wrist that goes along with the body, and how elbow, forearm and hand are turned
// there. To add one, say for the handle of something that is pushed: a row of k_shapes in holds.cpp, and
// set_hold each tick for the walkers who have it, whose Manner::postures are all 0.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sim/gait/gait.h"

namespace flaneur {

// What one hand has. The upper or outer one of two hands that meet is `over`, the other `under`.
enum class Hold : int32_t {
    none,
    pocket,
    hip,
    clasp_over,
    clasp_under,
    behind_over,
    behind_under,
    fold_over,
    fold_under,
    across,      // on the other arm
    bag_strap,   // across the chest, from this side's shoulder
    pack_strap,  // of a backpack
    handle,      // both hands on a bar ahead of the body
    tells,       // before the belly, palm up and inward, as of one who speaks
    waves,       // beside the head, palm ahead
};
inline constexpr int k_hold_count = 15;

// One tick of `dt` seconds of one hand's way to `wanted`, or away from what it has where that is another:
// some `time` seconds, slowly at both ends, round the body. `moved` metres are added to its place, in the
// axes that it is in (see HoldBlock).
void set_hold(GaitBlock& gait, const PersonBlock& person, int lane, Side side, Hold wanted, float time,
              float dt, Vec3 moved = {});

// One tick of `dt` seconds for the hands of walkers [begin, end); comes after reach_for_walls. Who stands
// takes another posture every 10 to 40 s, by its Manner::postures and chance (seed, walker, tick), and lets
// go as it is about to walk; who walks no faster than usual on even ground may have a hand in a pocket or on
// a strap. Hands on walls, canes and phones hold nothing.
void advance_holds(Gait& gait, size_t begin, size_t end, const RootMotion& root, uint64_t seed, uint32_t tick,
                   float dt);

}  // namespace flaneur
