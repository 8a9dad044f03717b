// Thirteen key poses that make a whole character: after Rosen's Animation Bootcamp (Overgrowth; GDC 2014) and
// "An implementation guide to procedural animation", section 3.6. A table of plain numbers in key_poses.cpp,
// of the left side; the right side's steps and leans are the same mirrored.
//
// The tree over them (sim/animation/blend.h): a grid of two parameters, speed by crouch, whose points are
// trees of their own along the cycle (a loop of four keys each); a lean into bends added to that; and leaps
// in place of it.
#pragma once

#include <cstdint>
#include <string_view>

#include "sim/animation/blend.h"
#include "sim/gait/gait.h"

namespace flaneur {

enum class KeyPose : uint8_t {
    stand,
    rest,          // the same, breathed in and let go
    walk_contact,  // left heel
    walk_passing,  // the right foot passes the left one
    run_contact,
    run_off,  // the left foot leaves
    crouch,
    sneak_contact,
    sneak_passing,
    lean,  // to the left
    rise,  // of a leap
    fall,
    land,
};
inline constexpr int k_key_pose_count = 13;
inline constexpr std::string_view k_key_pose_names[k_key_pose_count] = {
    "stand",  "rest",           "walk, contact",  "walk, passing", "run, contact", "run, off",
    "crouch", "sneak, contact", "sneak, passing", "lean",          "rise",         "fall",
    "land"};

// Of a body that faces +z, its lower sole on the ground; `is_mirrored`: left and right changed.
LocalPose key_pose(const Body& body, KeyPose pose, bool is_mirrored = false);

// What the tree is put to, a row of BlendTree::inputs each.
enum KeyInput : uint16_t {
    key_phase,   // cycles, 0 as the left foot comes down
    key_speed,   // 0 stands, 0.5 walks, 1 runs
    key_crouch,  // 0 upright .. 1
    key_lean,    // 0 to the right, 0.5 upright, 1 to the left
    key_leap,    // weight of the leap, 0..1
    key_flight,  // 0 before it, 1/3 rises, 2/3 falls, 1 has landed
    key_breath,  // cycles
    key_whole,   // 1
    k_key_inputs
};

// `along` the cycles, leans and leaps, and `across` speed and crouch.
struct KeyCurves {
    Curve along = Curve::cubic, across = Curve::linear;
    bool operator==(const KeyCurves&) const = default;
};
BlendTree key_tree(const Body& body, KeyCurves curves);

// Where the tree is put to by the gait of a walker, who crouches by so much.
struct KeyInputs {
    float rows[k_key_inputs];
};
KeyInputs key_inputs(const GaitBlock& gait, size_t lane, float crouch);

// Poses one walker of a block by a tree. What stands stays where `posed`, the gait's own pose of it, has it:
// legs are solved, by two bones, from the hips of the key pose to feet that follow their keys only in the
// air, and the hips come down as far as these ask. The lane of `posed` is written over.
void pose_by_keys(const BlendTree& tree, const KeyInputs& inputs, const Gait& gait, size_t walker,
                  PoseBlock& posed);
// One pose, as it is, of a walker of this body who stands at its root.
void pose_as(const LocalPose& pose, const Body& body, const Gait& gait, size_t walker, PoseBlock& posed);

}  // namespace flaneur
