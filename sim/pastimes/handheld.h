// Phones in hands: where arms hold them, standing, walking and sitting.
#pragma once

#include "sim/deeds/bend.h"
#include "sim/pastimes/pastimes.h"

namespace flaneur {

// Radians that the head is down of who reads a phone: 25 .. 40 degrees (Lamberg & Muratori, "Cell phones
// change the way we walk", Gait & Posture 35, 2012).
inline constexpr float k_reads_down = 0.56f;
// What is left of the speed of who texts and who calls: 15 .. 30 % and 10 .. 16 % less, by the same.
inline constexpr float k_texting_pace = 0.78f, k_calling_pace = 0.87f;

// Seconds from pocket to use, and back.
inline constexpr float k_takes_out = 0.9f;
// How far it is out at a tick, 0: in the pocket .. 1: in use.
float phone_out(const Pastime& pastime, uint32_t tick);

// The ear on a side, where a hand holds a phone to it: of the palm.
Vec3 ear_of(const BodyPose& pose, Someone who, Side side);
inline constexpr float k_off_ear = 0.026f;  // metres from there to the palm: hair, and half a phone

// Arms, and for who takes a picture the head, by so much, 0..1. `both`: the left hand is free to help;
// `seconds` since it was taken out, for thumbs and gestures.
void hold_phone(BodyPose& pose, Someone who, PhoneUse use, float share, bool both, float seconds);

// Metres of a phone: across, along, and through.
inline constexpr Vec3 k_phone{0.072f, 0.15f, 0.009f};
// Its place in a right hand whose wrist is so: y along it, z out of its screen.
JointPose phone_in_hand(const JointPose& wrist, Someone who);

}  // namespace flaneur
