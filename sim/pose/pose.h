// From gait to posed bodies: joint curves, forward kinematics and inverse kinematics, sixteen walkers at a
// time.
#pragma once

#include <vector>

#include "sim/gait/gait.h"

namespace flaneur {

// Places and rotations of all joints, along the world's axes. rotation takes the canonical pose's axes to the
// joint's.
struct alignas(64) PoseBlock {
    float origin[3][k_block];  // in the world, near the walker's root
    float position[k_joint_count][3]
                  [k_block];  // from the origin: as exact far out in a city as at its middle
    float rotation[k_joint_count][4][k_block];  // unit quaternions, vector part first
    float rising[k_block];                      // m/s, of the hips
    float sunk[k_block];                        // metres by which they are below where they should be
};

// Poses blocks [begin, end) of `gait` into `poses`, with the widest instruction set that the CPU has, a tick
// of `dt` > 0 seconds after the poses `before`, which may be `poses`. With a foot on the ground hips fall no
// faster than gravity makes them, by 0.95 m/s at most on level ground and 1.4 on steps, and are caught and
// lifted no harder than legs can: where legs are too short for that, heels rise, and then feet leave the
// ground. Runs have wider bounds, leaps none. A pure function of its input, the same bits on every one.
void pose_blocks(const Gait& gait, size_t begin, size_t end, float dt, const std::vector<PoseBlock>& before,
                 std::vector<PoseBlock>& poses);
// The same of people without a past: as high as their legs let them be, and at rest.
void pose_blocks(const Gait& gait, size_t begin, size_t end, std::vector<PoseBlock>& poses);

struct JointPose {
    Vec3 position;  // in the world
    Quat rotation;
};
JointPose joint_pose(const std::vector<PoseBlock>& poses, size_t walker, Joint joint);
// Between two ticks; `between` 0 is `before`, 1 `last`.
JointPose joint_between(const std::vector<PoseBlock>& before, const std::vector<PoseBlock>& last,
                        size_t walker, Joint joint, float between);

// The soles of a planted foot, for checks: heel, ball and tip of the toes in the world.
struct Sole {
    Vec3 heel, ball, tip;
};
Sole sole(const std::vector<PoseBlock>& poses, const Gait& gait, size_t walker, Side side);

}  // namespace flaneur
