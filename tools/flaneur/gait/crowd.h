// A whole crowd watched for a while: what its feet do, whether a joint jumps or bends too far, and how much
// its people differ.
#pragma once

#include "sim/world.h"
#include "tools/flaneur/gait/contact.h"
#include "tools/flaneur/gait/trials.h"

namespace flaneur {

// One walker, looked at after each tick.
struct WalkerWatch {
    StanceWatch feet[2];
    std::vector<Stance> stances;
    std::vector<float> slips;  // metres in a tick, of planted feet
    Quat last[k_joint_count];  // rotations against the parents
    bool seen = false;
    uint32_t not_finite = 0;     // joints, summed over ticks
    uint32_t beyond_limits = 0;  // joints, summed over ticks
    float beyond = 0;            // by how many degrees at worst,
    Joint beyond_joint = hips;   // which
    uint32_t beyond_tick = 0;    // and when
    // Metres by which a bone differs from its length: beyond what the rounding of its ends explains, and with
    // it.
    float bone_error = 0, bone_error_at_all = 0;
    float spin = 0;           // fastest turn of a joint against its parent, degrees a second,
    Joint spin_joint = hips;  // of which,
    uint32_t spin_tick = 0;   // when
    Vec3 spin_place;          // and where

    // Its left leg, for how people differ.
    struct Leg {
        float thigh, knee, ankle, speed;
        bool swinging, steady;  // steady: straight on, on level ground
    };
    std::vector<Leg> legs;
};

// Looks at walker `i` after world.tick ticks.
void watch_walker(WalkerWatch& watch, const World& world, size_t i);

// What all of them come to, with bars.
Report judge_crowd(const std::vector<WalkerWatch>& watches, const World& world);

// Sentences that say where the worst of it can be seen.
std::vector<std::string> worst_places(const std::vector<WalkerWatch>& watches);

}  // namespace flaneur
