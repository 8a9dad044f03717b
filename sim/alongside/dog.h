// Dogs on a lead: where their feet are, how they step, and how their bones lie.
//
// A dog is a trunk that goes over the ground plane and four feet that stay where they are put until their
// time in the stride comes. Walk and trot are one rule: each foot has a phase, and how far the fore feet are
// behind the hind feet of their side passes from 0.22 of a stride, a walk in lateral sequence, to 0.5, a trot
// on diagonals (Hildebrand, "Analysis of asymmetrical and symmetrical gaits", American Zoologist 1977; Maes
// et al., "Steady locomotion in dogs: temporal and associated spatial coordination patterns and the effect of
// speed", Journal of Experimental Biology 211, 2008). Speeds count by the Froude number v^2 / (g h) of the
// height of the hip h, by which animals of all sizes move alike: strides of 2.4 h F^0.34, of which a foot
// stands 0.52 F^-0.14 (Alexander & Jayes, "A dynamic similarity hypothesis for the gaits of quadrupedal
// mammals", Journal of Zoology 201, 1983), and a walk becomes a trot about F = 0.5.
#pragma once

#include <array>
#include <cstdint>

#include "sim/base/vec.h"
#include "sim/ground/surroundings.h"
#include "sim/pose/pose.h"

namespace flaneur {

// Square to a way on the ground plane.
inline Vec2 left_of(Vec2 way) { return {way.z, -way.x}; }

// The bones, each from its joint on.
enum DogJoint : uint8_t {
    dog_pelvis,
    dog_loin,
    dog_chest,
    dog_neck,
    dog_head,
    dog_left_ear,
    dog_right_ear,
    dog_tail,  // and two more
    dog_tail_middle,
    dog_tail_end,
    dog_left_arm,  // shoulder to elbow, elbow to wrist, wrist to the ground
    dog_left_forearm,
    dog_left_paw,
    dog_right_arm,
    dog_right_forearm,
    dog_right_paw,
    dog_left_thigh,  // hip to knee, knee to hock, hock to the ground
    dog_left_shank,
    dog_left_hind_paw,
    dog_right_thigh,
    dog_right_shank,
    dog_right_hind_paw,
};
inline constexpr int k_dog_joints = 22;

enum class Breed : uint32_t { terrier, spaniel, shepherd };
inline constexpr int k_breeds = 3;

// One that stands on y = 0, faces +z, its left at +x, its withers 1 high and the middle of its trunk above
// the origin: where its joints are, and where its pads touch the ground, by DogLeg.
enum DogLeg : int { k_fore_left, k_fore_right, k_hind_left, k_hind_right };
struct DogShape {
    float withers = 0.5f;  // metres
    std::array<Vec3, k_dog_joints> joints;
    std::array<Vec3, 4> pads;
    Vec3 collar;          // where a lead is tied, in the bind pose; moves with the neck
    float radius = 0;     // half the width of what others keep clear of
    float half_long = 0;  // from the middle to that of the disks before and behind
};
const DogShape& shape_of(Breed breed);

struct DogFoot {
    Vec3 at{};          // its pad, in the world
    Vec3 from{}, to{};  // of its step, or of the last one
    float share = 1;    // of the step, 1: it stands
    float pace = 0;     // shares a second; 0: as the stride has it
};

struct Dog {
    uint32_t walker = 0, generation = 0;  // whose it is
    Breed breed = Breed::spaniel;
    uint32_t coat = 0;     // which of its colours
    float size = 1;        // of its breed's withers
    Vec3 position{};       // on the ground, below the middle of the trunk
    uint32_t polygon = 0;  // of the mesh there
    Vec2 velocity{};       // m/s
    float heading = 0, turn_rate = 0;
    float phase = 0;                     // of the left hind foot, [0, 1); it stands while below `duty`
    float duty = 0.62f, trots = 0;       // 0 walks .. 1 trots
    float moves = 0;                     // 0 stands .. 1 goes: of all that belongs to going
    float fore = 0, hind = 0;            // heights of the ground that the trunk rides on, smoothed,
    float fore_rate = 0, hind_rate = 0;  // m/s
    float bend = 0;                      // radians that the trunk bends to the left
    float sits = 0;                      // 0..1
    float nose = 0;                      // 0 up .. 1 at the ground
    float gaze = 0, gaze_pitch = 0;      // radians that the head turns to the left, and up
    float wag = 0, wags = 0;             // of the tail: phase, [0, 1), and how much, 0..1
    uint32_t does = 0;                   // DogDoes
    uint32_t since = 0, until = 0;       // ticks
    Vec2 finds{};                        // what it sniffs at
    float side = 1, ahead = 0.4f;        // metres that it likes to be to the left of its owner, and ahead
    DogFoot feet[4];
};

enum class DogDoes : uint32_t { goes, sniffs, waits, sits };

// How it is wanted to move: m/s, on the ground plane, and where it would face while it hardly moves.
struct DogWish {
    Vec2 velocity{};
    float facing = 0;
    bool sits = false;
};

// Metres from the ground to the hip.
float hip_height(const Dog& dog);
inline float withers_of(const Dog& dog) { return shape_of(dog.breed).withers * dog.size; }

// Stands all four feet below it.
void stand_dog(Dog& dog, const Surroundings& around);
// A tick of trunk and feet after its position, velocity and heading were moved.
void step_dog(Dog& dog, const DogWish& wish, const Surroundings& around, float dt);

// Where each joint is and how it is turned against the bind pose.
using DogPose = std::array<JointPose, k_dog_joints>;
DogPose pose_dog(const Dog& dog);
// Where its lead is tied.
Vec3 collar_of(const Dog& dog, const DogPose& pose);
// Where a pad of a posed dog is, for checks.
Vec3 posed_pad(const Dog& dog, const DogPose& pose, DogLeg leg);

}  // namespace flaneur
