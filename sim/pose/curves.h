// Bodies whose limbs follow four targets on curves, as in "The Walker Report": see sim/limbs/limbs.h. Another
// way to pose those who walk; what they do is the gait's.
#pragma once

#include <vector>

#include "sim/ground/surroundings.h"
#include "sim/limbs/limbs.h"
#include "sim/pose/pose.h"

namespace flaneur {

// How far sixteen walkers have come on the curves, and where their feet are. Places are in the world, metres.
struct alignas(64) LimbClock {
    float time[k_block];     // of the curves, in units: [0, 2)
    float still[k_block];    // 0: feet go by the curves .. 1: they stand where the gait has them
    float rest[k_block];     // the same of the body above them
    int32_t first[k_block];  // Side that comes to stand first
    struct Foot {
        float x[k_block], z[k_block], yaw[k_block];  // on the ground, below the ankle
        float aim_x[k_block], aim_z[k_block];        // where the curve had it
    } feet[2];
};

// Of everybody as they walk or stand now.
void start_clocks(const Gait& gait, const LimbCurves& how, std::vector<LimbClock>& clocks);

// Blocks [begin, end) a tick of `dt` seconds later. Time goes on by as much as brings the foot on the ground
// back as far as the body goes, so that it stays where it is in the world; where a body goes aside it follows
// from 0.2 m off its curve on. Who stands takes the raised foot down, and sets both where the gait has them.
// Clocks of who has come from elsewhere begin anew.
void advance_clocks(const Gait& gait, size_t begin, size_t end, const LimbCurves& how, float dt,
                    std::vector<LimbClock>& clocks);

// Poses blocks [begin, end) of `gait` into `poses`: feet level, on the ground that a ray from 1 m above to 9
// m below finds, or as far over it as the curves raise them; hands from where they hang; hips at one height,
// from which both feet are in reach. Who stands is posed as in `whole`. The same bits on every instruction
// set.
void pose_by_curves(const Gait& gait, size_t begin, size_t end, const LimbCurves& how,
                    const std::vector<LimbClock>& clocks, const Surroundings& around,
                    const std::vector<PoseBlock>& whole, std::vector<PoseBlock>& poses);

// Where a walker's four targets are: soles of left and right, wrists of left and right. A target out of reach
// is pointed at.
struct PlacedTargets {
    Vec3 feet[2], hands[2];
};
PlacedTargets targets_of(const Gait& gait, size_t walker, const LimbCurves& how,
                         const std::vector<LimbClock>& clocks, const Surroundings& around,
                         const std::vector<PoseBlock>& poses);

}  // namespace flaneur
