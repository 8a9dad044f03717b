// A whole crowd watched for a while: what its feet do, whether a joint jumps or bends too far, and how much
// its people differ.
#pragma once

#include "sim/world.h"
#include "tools/flaneur/gait/measure/contact.h"
#include "tools/flaneur/gait/trials.h"

namespace flaneur {

// Degrees a second against the parent; a faster joint has jumped. The second is of legs of those who run:
// they are let go as fast as a sprinter's knees do, and a degree in a tick more is rounding.
inline constexpr float k_jump = 900, k_jump_running = 1260;

// One joint of one walker, over its ticks.
struct JointWatch {
    Quat last;       // rotation against the parent
    float spin = 0;  // fastest turn of it, degrees a second, but for what runners' legs may,
    uint32_t spin_tick = 0;
    uint32_t jumps = 0;  // ticks in which it jumped
    float beyond = 0;    // most degrees beyond its limits,
    uint32_t beyond_tick = 0;
    uint32_t outside = 0;  // ticks in which it was
};

// What is worst about one walker, and the tick in which it was.
enum Worst : int {
    worst_drift,      // of a planted foot, mm
    worst_below,      // of a planted foot, mm under the ground
    worst_above,      // of a planted foot, mm over it
    worst_slowing,    // of the root, m/s2
    worst_head_rise,  // up or down, of one who walks on level ground, m/s
    worst_head_step,  // the same on any other ground
    worst_fall,       // of the pelvis while a foot stands, m/s2 down
    worst_low,        // of the pelvis of one who walks or stands, below its upright height over the lower
                      // foot, or over where that is about to land, percent of that height
    worst_beside,     // of the pelvis to one side of both feet, beyond what the turn leans it, mm
    worst_shoes,      // that one shoe stands in the other, mm
    worst_passing,    // that one goes through the other that stands, mm
    worst_count
};
struct WorstKind {
    const char* name;
    float goal;  // that nobody should be beyond
};
inline constexpr WorstKind k_worst[worst_count] = {{"drift_max.mm", 10},
                                                   {"penetration_max.mm", 20},
                                                   {"float_max.mm", 30},
                                                   {"root_slowing_max.m_s2", 3.5f},
                                                   {"head_rise_max.m_s", 1},
                                                   {"head_rise_steps_max.m_s", 1.6f},
                                                   {"pelvis_fall_max.m_s2", 9.81f},
                                                   {"pelvis_low_max.percent", 20},
                                                   {"feet_beside_max.mm", 150},
                                                   {"shoes_overlap_max.mm", 25},
                                                   {"shoes_passing_max.mm", 25}};
struct WorstWatch {
    float most = 0;
    uint32_t tick = 0;
};

// Those who are in one slot, one after another, looked at after each tick.
struct WalkerWatch {
    StanceWatch feet[2];
    std::vector<Stance> stances;
    std::vector<float> slips;  // metres in a tick, of planted feet
    JointWatch joints[k_joint_count];
    WorstWatch worst[worst_count];
    uint32_t generation = 0;  // of the one who is there
    // Its last ticks.
    Vec2 velocity;
    float head = 0, pelvis[2] = {};  // heights, metres
    uint32_t ticks = 0;
    bool seen = false;        // whether `last` of the joints is of the tick before
    uint32_t not_finite = 0;  // ticks
    WorstWatch bone_error;    // metres by which a bone differs from its length

    // Its left leg, for how people differ.
    struct Leg {
        float thigh, knee, ankle, speed;
        bool swinging, steady;  // steady: straight on, on level ground
    };
    std::vector<Leg> legs;
};

// Looks at walker `i`, if there is one, after world.tick ticks.
void watch_walker(WalkerWatch& watch, const World& world, size_t i);

// What all of them come to, with bars, in the city of that name.
Report judge_crowd(const std::vector<WalkerWatch>& watches, const World& world, const std::string& city);

// A line for each joint that jumped and each that was beyond its limits, how often, and for each of
// k_worst: who can be seen doing the worst of it when.
std::vector<std::string> worst_places(const std::vector<WalkerWatch>& watches);

}  // namespace flaneur
