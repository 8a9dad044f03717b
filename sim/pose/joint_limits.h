// What joints and muscles allow.
#pragma once

#include "sim/pose/pose.h"

namespace flaneur {

struct DegreeSpan {
    float low, high;
};

// Ranges of the angles of a joint against its parent, degrees, both sides alike. Legs and arms hang, and
// `bend` carries them forward and `side` outward; trunk, neck and head stand, and bend forward and to their
// left; feet and toes point ahead, and bend up and outward; the inner ends of the clavicles point outward,
// and bend forward and up. `twist` is about the part's own length. Knees and elbows have only a bend, which
// is the whole angle between both bones, negative for a knee that bends as knees do, and a twist.
struct JointLimits {
    DegreeSpan bend, side, twist;
};

// After the American Academy of Orthopaedic Surgeons (Joint Motion, 1965) and Kapandji (The Physiology of the
// Joints), with a few degrees for the ends that only a load reaches: the ankle of one who squats, the hip
// behind a runner.
namespace joint_limits {
inline constexpr JointLimits k_trunk = {{-20, 45}, {-25, 25}, {-30, 30}};
inline constexpr JointLimits k_neck = {{-40, 45}, {-35, 35}, {-60, 60}};
inline constexpr JointLimits k_clavicle = {{-25, 40}, {-15, 45}, {-50, 50}};
inline constexpr JointLimits k_shoulder = {{-60, 180}, {-45, 180}, {-100, 100}};
inline constexpr JointLimits k_elbow = {{-5, 150}, {-180, 180}, {-100, 100}};
inline constexpr JointLimits k_wrist = {{-85, 85}, {-45, 45}, {-100, 100}};
inline constexpr JointLimits k_hip = {{-35, 125}, {-30, 50}, {-50, 50}};
inline constexpr JointLimits k_knee = {{-160, 5}, {-180, 180}, {-40, 40}};
inline constexpr JointLimits k_ankle = {{-55, 40}, {-30, 35}, {-35, 35}};
inline constexpr JointLimits k_toes = {{-45, 85}, {-20, 20}, {-20, 20}};
}  // namespace joint_limits

// The fastest that a hip, knee, ankle or ball of the foot turns against its parent, rad/s: 850 degrees a
// second of a walker, whose knee reaches 430 in steady steps, 1250 of a runner.
inline constexpr float k_fastest_walking = 14.835f, k_fastest_running = 21.817f;

// Poses are found anew each tick, but for the height of the hips; where a plan was poor (a foot left far
// behind by a sudden start, a push) a hip or an ankle may end beyond its range, or two poses in a row differ
// by more than a leg can move in `dt` seconds. Such a leg goes as far and as fast as it can, and its foot is
// late: by millimetres as a rule, by centimetres at worst, and then a planted foot slips. Changes legs of
// `now` in blocks [begin, end); `before` holds the poses of `dt` earlier. The same bits on every instruction
// set.
void restrain_legs(const Gait& gait, size_t begin, size_t end, float dt, const std::vector<PoseBlock>& before,
                   std::vector<PoseBlock>& now);

}  // namespace flaneur
