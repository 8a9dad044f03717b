// Bodies that sit. Hips go to the seat, feet to the ground before it, hands to thighs or into the lap; who is
// too small for that lets the legs hang.
#pragma once

#include "sim/deeds/bend.h"
#include "sim/ground/surroundings.h"
#include "sim/pastimes/places.h"

namespace flaneur {

// One foot, flat unless it is pitched: where its ankle is, its yaw, and radians that the toes are down.
struct FootAt {
    Vec3 ankle;
    float yaw = 0, down = 0;
};

// How one sits.
enum class SatTrunk : uint32_t { back, upright, ahead };
enum class SatLegs : uint32_t { flat, apart, stretched, crossed };
enum class SatHands : uint32_t { thighs, lap };
struct SatAs {
    SatTrunk trunk = SatTrunk::upright;
    SatLegs legs = SatLegs::flat;
    SatHands hands = SatHands::thighs;
    float turned = 0;  // radians to the left that the chest is turned on the hips
};
// By 32 random bits; `sits_closed`: in a skirt, or a child whose legs hang.
SatAs sat_as(uint32_t posture, const Seat& seat, bool has_robe);
// Seconds that it takes to sit down or to get up, of which hips move 1.8 (Schenkman et al., "Whole-body
// movements during rising to standing from sitting", Physical Therapy 70, 1990), after or before both feet
// have stepped.
inline constexpr float k_sits_down = 2.5f, k_hips_move = 1.8f;

// Metres from the hip joints down to what one sits on.
float seat_of(Someone who);

// The body of who has sat down, at rest, its feet on the ground that is there.
BodyPose seated_pose(Someone who, const Seat& seat, SatAs how, const Surroundings& around);
FootAt foot_of(const BodyPose& pose, Someone who, Side side);

// Hip, knee and ankle of a leg by where its foot is, the knee to the side of `pole`.
void set_leg(BodyPose& pose, Someone who, Side side, const FootAt& foot, Vec3 pole);
// Lowers the hips until no leg is longer than `straightest` of its length, nearly 1, by so much of it: knees
// that come nearer to that snap.
void keep_knees_bent(BodyPose& pose, Someone who, const FootAt (&feet)[2], float straightest, float share);
// Unit: where the knee of a leg is off the line from hip to ankle.
Vec3 knee_of(const BodyPose& pose, Someone who, Side side);

// `seconds` after it has begun to sit down, 0 .. k_sits_down: between the pose in which it stands, with its
// feet where `stands` says, and the one in which it will sit.
BodyPose sitting_down(const BodyPose& standing, const FootAt (&stands)[2], const BodyPose& seated,
                      Someone who, float seconds);
// `share` of the way between two ways to sit, 0..1: feet are lifted.
BodyPose sitting_otherwise(const BodyPose& from, const BodyPose& to, Someone who, float share);

}  // namespace flaneur
