// One walker driven as the crowd's are, watched closely.
#pragma once

#include <functional>
#include <vector>

#include "sim/base/tick.h"
#include "sim/crowd/locomotion.h"
#include "sim/gait/gait.h"
#include "sim/pose/pose.h"

namespace flaneur {

constexpr float k_leg_share = 0.53f;  // of the height of a standard body

// A walker that wishes, and what was seen of it in the last tick.
struct Tried {
    Ground ground;
    Gait gait;
    std::vector<PoseBlock> poses;
    Motion motion;
    Vec3 position;
    Vec2 wish, look{};
    uint32_t tick = 0;
    float height = 1.72f;

    Sole soles[2];
    Quat rotations[k_joint_count];
    Vec3 pelvis, pelvis_before;
    int swinging[2] = {0, 0};

    float drift = 0;         // of a foot planted in this tick and the one before, metres
    float slide = 0;         // the same over the ground
    float fastest = 0;       // turn of any joint, degrees a second
    float acceleration = 0;  // of the pelvis, m/s2
    bool landed[2] = {false, false};

    const GaitBlock& block() const { return gait.blocks[0]; }
    const FootBlock& foot(int side) const { return gait.blocks[0].feet[side]; }
    Vec2 foot_place(int side) const { return {foot(side).to.x[0], foot(side).to.z[0]}; }
    bool in_air(int side) const { return foot(side).swinging[0] != 0; }
};

// Stands at the origin.
Tried make_tried(Ground ground, float height = 1.72f);

// One tick towards `wish`, m/s.
void advance(Tried& t, Vec2 wish);
void for_seconds(Tried& t, float seconds, Vec2 wish, const std::function<void()>& check = {});

Ground wide_floor();
// How far left of the other foot's place a foot lies, as the walker faces.
float leftward(const Tried& t);

}  // namespace flaneur
