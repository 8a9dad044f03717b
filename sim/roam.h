// People who walk all round a compound, with any up, instead of in a city. Each walks on the spot on a level
// stage, where gait and pose know nothing of it: the ground there carries its feet back by what it moves on
// the compound. Its frame sets it onto the surface.
#pragma once

#include <vector>

#include "sim/base/parallel_for.h"
#include "sim/base/result.h"
#include "sim/creature/creature.h"
#include "sim/crowd/crowd.h"
#include "sim/gait/gait.h"
#include "sim/pose/pose.h"
#include "sim/surface/gravity.h"
#include "sim/surface/leaps.h"
#include "sim/surface/surface_walk.h"

namespace flaneur {

struct Roam {
    Compound compound;
    Gravity gravity;                  // by which one leaps
    SurfaceWalkers walkers;           // people as in the crowd, then creatures
    std::vector<Creature> creatures;  // their joints are linkages' places, the first linkages' of the world
    // Where a walker that stands at the origin and faces +z stands and faces.
    struct Frame {
        Vec3 position;
        Quat rotation;
    };
    std::vector<Frame> frames, previous_frames;  // after the last tick and the one before
};

// Sets a crowd that stands on its stage down on a compound, each with the speed that it prefers, and so many
// creatures of a metre and more. Where several bodies pull people leap from one to another; without `gravity`
// the compound is one. Refuses one with nothing to walk on, or without room for all.
Result<Roam> make_roam(Compound compound, const Crowd& crowd, uint32_t creatures, uint64_t seed,
                       Gravity gravity = {});
inline constexpr float k_usual_pull = 6;  // m/s2, on the surface

// One tick: walks on the compound, and tells crowd and feet what their stage does under them.
void step_roam(Roam& roam, Crowd& crowd, Gait& gait, Workers& workers, uint64_t seed, uint32_t tick);

// The creatures' bones as they stand.
Linkages make_bones(const std::vector<Creature>& creatures);

// And after that, on their walkers. `linkages` has one for each of them, first of all.
void step_creatures(Roam& roam, Linkages& linkages, Workers& workers);

// What a leap makes of somebody's joints on the stage, `between` 0, the tick before the last, and 1: trunk
// and arms that wind up and swing, legs that leave the ground last with their toes, hang, and reach for it
// again.
void bend_in_leap(const Roam& roam, size_t walker, float between, std::span<JointPose> joints);

// A joint of a walker that stands at `root` on the stage, with its `heading`, set onto a frame.
JointPose set_onto(const Roam::Frame& frame, Vec3 root, float heading, const JointPose& joint);

}  // namespace flaneur
