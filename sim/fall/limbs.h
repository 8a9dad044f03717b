// Arms, legs, neck and trunk of one body that are set anew, on top of a pose.
#pragma once

#include "sim/fall/balance.h"
#include "sim/fall/body_pose.h"

namespace flaneur {

// Bends the knee and turns the leg by the shortest way until the ankle comes to `ankle`, as far as the leg
// reaches; the foot keeps its turn in the world.
void reach_with_leg(BodyPose& pose, const PersonBlock& person, int lane, Side side, Vec3 ankle);

// Bends the elbow and turns the arm by the shortest way until the middle of the palm comes to `palm`, as far
// as the arm reaches; the hand goes along with the forearm. False if it does not reach.
bool reach_with_arm(BodyPose& pose, const PersonBlock& person, int lane, Side side, Vec3 palm);
// An arm by where its palm is, how far its elbow is turned about the line there from the shoulder, radians,
// from where it is usual, outward and behind, and how its bones are turned against such ones that have the
// elbow's hinge for their x.
struct ArmWay {
    Vec3 palm{};
    float turn = 0;
    std::array<Quat, 3> against{};  // upper arm, forearm, hand
};
ArmWay arm_way(const BodyPose& pose, const PersonBlock& person, int lane, Side side);
// Between two, 0..1, but for the palm, which is at `palm`, or as near as the arm reaches. Nothing jumps,
// whatever both are.
void set_arm(BodyPose& pose, const PersonBlock& person, int lane, Side side, const ArmWay& from,
             const ArmWay& to, float t, Vec3 palm);
// Turns the elbow about the line from shoulder to palm to where it is no more than so many radians from where
// it was in the pose before.
void keep_elbow(BodyPose& pose, const BodyPose& before, const PersonBlock& person, int lane, Side side,
                float most);
struct ArmPlaces {
    Vec3 shoulder, elbow, palm;
};
ArmPlaces arm_places(const BodyPose& pose, const PersonBlock& person, int lane, Side side);
// The palm at `palm`, or as near as the arm reaches, and the elbow on the side of the place `elbow`; bones
// are turned about themselves as they are against that.
void place_arm(BodyPose& pose, const PersonBlock& person, int lane, Side side, Vec3 palm, Vec3 elbow);
// Brings an arm, against the chest, by `part` of the way to where it is in `to`.
void blend_arm(BodyPose& pose, const BodyPose& to, Side side, float part);
// Where the middle of the palm is, and how far it can be from the shoulder.
Vec3 palm_of(const BodyPose& pose, const PersonBlock& person, int lane, Side side);
float reach_of_arm(const PersonBlock& person, int lane);

// Turns shank and foot about the knee, `angle` radians farther than they are bent.
void fold_knee(BodyPose& pose, Side side, float angle);
// Turns the foot about the ankle by so many radians, toes down.
void turn_foot(BodyPose& pose, Side side, float angle);

// Radians of yaw, to the left, and of pitch, up.
struct HeadTurn {
    float yaw = 0, pitch = 0;
};
// Where the head would turn, against the chest, to look at a place of the world: as far as a neck goes.
HeadTurn turn_to_look(const BodyPose& pose, const PersonBlock& person, int lane, Vec3 place);
// Turns neck and head there, by `part` of the way from where they are.
void turn_head(BodyPose& pose, HeadTurn gaze, float part);

// Trunk, head and arms turned by as many radians as the sway leans, along it on the ground plane; the head
// half of that, since eyes stay level; and arms lifted outward and somewhat ahead, but the right one of who
// holds a cane stays as it is.
void sway_pose(BodyPose& pose, const TrunkSway& sway, bool has_cane);
// Leans the trunk ahead by so many radians from the hips up, the head with half of it. Arms hang on.
void lean_trunk(BodyPose& pose, float angle);

// The chest of one who lies and breathes, `seconds` after it came to lie, and how its head moves a little;
// 16 breaths a minute. `depth`: 1: as one who rests.
void breathe(BodyPose& pose, float seconds, float depth);

}  // namespace flaneur
