// Bodies that bend and reach, of people who stand or walk by the gait: changes to a pose of theirs, one
// person at a time. Feet stay where the pose has them.
#pragma once

#include "sim/fall/body_pose.h"

namespace flaneur {

// Whose body it is.
struct Someone {
    const PersonBlock& person;
    int lane;
};
// Sizes, metres.
float leg_of(Someone who);
float forearm_of(Someone who);

// How far one bends down: 0 upright .. 1 squats. The higher the hands, the more it is the trunk that bends,
// and the lower, the more the knees do, as people do who may choose (Burgess-Limerick & Abernethy, "Toward a
// quantitative definition of manual lifting postures", Human Factors 39, 1997).
struct Bend {
    float depth = 0;
    float back = 0;  // metres that hips are farther back, for what hands hold before the feet
};
// Hips go down and back, so that all remains above the feet, the trunk bends ahead, and legs follow.
void bend_down(BodyPose& pose, Someone who, Bend bend);

// Turns the trunk over its three joints: ahead, and to the left about the vertical; radians. All above goes
// along.
void turn_trunk(BodyPose& pose, float ahead, float left);

// Neck and head, as far as these turn, so that the face is to a place; by so much, 0..1.
void look_at(BodyPose& pose, Someone who, Vec3 place, float share);

// A hand's palm: what it touches, what it faces there and where fingers point, unit.
struct Palm {
    Vec3 place, faces, fingers;
};
// Where the wrist of such a hand is, and how it is turned.
JointPose wrist_of(const Palm& palm, Someone who, Side side);
Palm palm_of(const BodyPose& pose, Someone who, Side side);

// An arm from its shoulder to a wrist, as far as it reaches, its elbow to where `elbow` points, in the axes
// of the chest with x outward; by so much, 0..1, of the turns of its joints.
void reach_with_arm(BodyPose& pose, Someone who, Side side, const JointPose& wrist, Vec3 elbow, float share);
// The same for a palm: where the wrist cannot turn so far, the palm is there all the same.
void reach_for(BodyPose& pose, Someone who, Side side, const Palm& palm, Vec3 elbow, float share);
// Metres from the shoulder to a place that are more than `part` of the arm's length; less than 0: it is
// within.
float beyond_reach(const BodyPose& pose, Someone who, Side side, Vec3 wrist, float part);

// Bends and turns the trunk over its three joints until the shoulder is within reach of a wrist, as far as it
// can; by so much, 0..1, and by `most` radians.
void lean_to(BodyPose& pose, Someone who, Side side, Vec3 wrist, float share, float most);
// Brings the thigh of a leg within people's range, and what hangs on it along; by so much, 0..1.
void keep_hip_within(BodyPose& pose, Side side, float share);

// The least depth, to 1, from which both wrists are within `part` of the arms' lengths; 1 where none is.
float depth_to_reach(const BodyPose& stands, Someone who, const Vec3 wrists[2], float back, float part);

// Of a motion whose speed is bell-shaped (Flash & Hogan, "The coordination of arm movements", Journal of
// Neuroscience 5, 1985): the way done at a share of the time, both 0..1.
float bell(float time);

}  // namespace flaneur
