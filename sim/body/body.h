// The humanoid: 22 joints, and the proportions of one body. Everything that walks is mapped onto it.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "sim/base/vec.h"
#include "sim/body/wear.h"

namespace flaneur {

// Parents come before children. `upper_leg` is the hip joint, `foot` the ankle, `toes` the ball of the foot,
// `upper_arm` the shoulder joint, `shoulder` the inner end of the clavicle.
enum Joint : uint8_t {
    hips,
    spine,
    chest,
    upper_chest,
    neck,
    head,
    left_shoulder,
    left_upper_arm,
    left_lower_arm,
    left_hand,
    right_shoulder,
    right_upper_arm,
    right_lower_arm,
    right_hand,
    left_upper_leg,
    left_lower_leg,
    left_foot,
    left_toes,
    right_upper_leg,
    right_lower_leg,
    right_foot,
    right_toes,
};
enum Side : int { k_left = 0, k_right = 1 };

inline constexpr int k_joint_count = 22;
inline constexpr int k_no_parent = -1;
inline constexpr std::array<int, k_joint_count> k_joint_parents = {k_no_parent,
                                                                   hips,
                                                                   spine,
                                                                   chest,
                                                                   upper_chest,
                                                                   neck,
                                                                   upper_chest,
                                                                   left_shoulder,
                                                                   left_upper_arm,
                                                                   left_lower_arm,
                                                                   upper_chest,
                                                                   right_shoulder,
                                                                   right_upper_arm,
                                                                   right_lower_arm,
                                                                   hips,
                                                                   left_upper_leg,
                                                                   left_lower_leg,
                                                                   left_foot,
                                                                   hips,
                                                                   right_upper_leg,
                                                                   right_lower_leg,
                                                                   right_foot};
inline constexpr std::array<std::string_view, k_joint_count> k_joint_names = {
    "hips",           "spine",           "chest",           "upper_chest",     "neck",
    "head",           "left_shoulder",   "left_upper_arm",  "left_lower_arm",  "left_hand",
    "right_shoulder", "right_upper_arm", "right_lower_arm", "right_hand",      "left_upper_leg",
    "left_lower_leg", "left_foot",       "left_toes",       "right_upper_leg", "right_lower_leg",
    "right_foot",     "right_toes"};

// One body in the canonical pose: standing on y = 0 at the origin, facing +z, left side at +x; legs straight
// down, arms hanging straight down at the sides with the palms to the thighs, feet pointing ahead. In this
// pose every joint's rotation is the identity. Metres. Left and right mirror each other.
struct Body {
    std::array<Vec3, k_joint_count> joints;  // places in model space
    float height = 1.7f;                     // crown above ground
    float heel = 0.05f;                      // from the ankle back to where the heel touches, along -z
    float toe = 0.06f;                       // from the ball ahead to the tip of the toes, along +z
    float carriage = 0;  // radians, 0..0.7: arms hang out no less, for hands to clear hips and ground
    Vec3 cane{};         // from the right wrist to the tip of a cane in that hand; zero: there is none
    Girth girth{};       // all zero: as usual for the height
    Wear wear{};
    Vec3 pram{};  // from the ground below the hips to the middle of the handle of a pram; zero: there is none
};

// A standing adult after Drillis & Contini's segment lengths (as fractions of height; Winter 2009, fig. 4.1).
Body standard_body(float height);
// Body::cane for a body of that height: held at the height of a hanging arm's wrist, as canes are fitted
// (Sainsbury & Mulley, BMJ 284, 1982), and upright when the forearm is raised by 0.4 rad.
Vec3 standard_cane(float height);
// Body::pram for a body: a handle at 0.6 of its height, as people like it, from 0.84 to 1.20 m, where both
// hands reach it with elbows bent by some 72 degrees.
Vec3 standard_pram(const Body& body);

// The body's girth, or what is usual for its height.
Girth girth_of(const Body& b);

// Lengths that the gait asks for.
inline float thigh_length(const Body& b) {
    return length(b.joints[left_lower_leg] - b.joints[left_upper_leg]);
}
inline float shank_length(const Body& b) { return length(b.joints[left_foot] - b.joints[left_lower_leg]); }
inline float leg_length(const Body& b) { return b.joints[left_upper_leg].y; }

// Whether one with legs of so many metres sets both feet on each tread of a flight of steps: children of less
// than some five and a half years, who go by turns only where treads are made for them (Gesell, "The First
// Five Years of Life", 1940).
inline constexpr float k_both_feet_leg = 0.6f;
inline bool sets_both_feet(float leg) { return leg < k_both_feet_leg; }
// The share of others' pace on stairs that this leaves.
inline float stair_pace(float leg) { return sets_both_feet(leg) ? 0.5f : 1.0f; }

}  // namespace flaneur
