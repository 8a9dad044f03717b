// A body as rigid segments that hang together by its joints: what falls when one falls.
//
// Masses and their middles are shares of the body's and of the segments' lengths after de Leva ("Adjustments
// to Zatsiorsky-Seluyanov's segment inertia parameters", Journal of Biomechanics 29, 1996, men and women
// alike); each segment turns as hard as a cylinder of its length and breadth does.
#pragma once

#include <array>
#include <cstdint>

#include "sim/base/block.h"
#include "sim/body/body.h"
#include "sim/gait/blocks.h"

namespace flaneur {

enum Segment : uint8_t {
    pelvis,
    belly,
    thorax,  // with the clavicles
    skull,   // with the neck
    left_arm,
    left_forearm,
    left_palm,
    right_arm,
    right_forearm,
    right_palm,
    left_thigh,
    left_shank,
    left_sole,
    right_thigh,
    right_shank,
    right_sole,
};
inline constexpr int k_segment_count = 16;

// How a segment hangs together with others: the joint that it turns about, which segment carries it, and
// where it ends.
struct SegmentShape {
    Joint joint;
    int parent;  // k_no_parent of the pelvis
    Joint end;   // its own joint of those that end in none: skull, palms, soles
};
inline constexpr std::array<SegmentShape, k_segment_count> k_segments = {{
    {hips, k_no_parent, spine},
    {spine, pelvis, chest},
    {chest, belly, neck},
    {neck, thorax, neck},
    {left_upper_arm, thorax, left_lower_arm},
    {left_lower_arm, left_arm, left_hand},
    {left_hand, left_forearm, left_hand},
    {right_upper_arm, thorax, right_lower_arm},
    {right_lower_arm, right_arm, right_hand},
    {right_hand, right_forearm, right_hand},
    {left_upper_leg, pelvis, left_lower_leg},
    {left_lower_leg, left_thigh, left_foot},
    {left_foot, left_shank, left_foot},
    {right_upper_leg, pelvis, right_lower_leg},
    {right_lower_leg, right_thigh, right_foot},
    {right_foot, right_shank, right_foot},
}};
// The segment that each joint goes along with.
inline constexpr std::array<Segment, k_joint_count> k_segment_of = {
    pelvis,       belly,     thorax,      thorax,      skull,         skull,      thorax,     left_arm,
    left_forearm, left_palm, thorax,      right_arm,   right_forearm, right_palm, left_thigh, left_shank,
    left_sole,    left_sole, right_thigh, right_shank, right_sole,    right_sole};

// Balls by which a body touches ground and walls.
inline constexpr int k_ball_count = 23;
inline constexpr std::array<Segment, k_ball_count> k_segment_of_ball = {
    pelvis,        pelvis,     belly,       thorax,      thorax,      thorax,     skull,     left_arm,
    left_forearm,  left_palm,  left_thigh,  left_thigh,  left_shank,  left_sole,  left_sole, right_arm,
    right_forearm, right_palm, right_thigh, right_thigh, right_shank, right_sole, right_sole};
// One body, in the axes of the canonical pose, metres and kilograms.
struct Segments {
    std::array<float, k_segment_count> mass;
    std::array<Vec3, k_segment_count> inertia;  // moments about its own axes, kg m2
    std::array<Vec3, k_segment_count> pivot;    // from its middle to its joint
    std::array<Vec3, k_segment_count> socket;   // from the middle of the one that carries it to its joint
    std::array<Vec3, k_ball_count> ball;        // from its segment's middle
    std::array<float, k_ball_count> radius;
    float whole = 0;  // mass
};

// Kilograms, of a body of usual weight.
float mass_of(const PersonBlock& person, size_t lane);

Segments segments_of(const PersonBlock& person, int lane);

}  // namespace flaneur
