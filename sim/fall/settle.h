// A body that gets up, on the ground that is there: level, sloping, steps.
#pragma once

#include "sim/fall/body_pose.h"
#include "sim/fall/limbs.h"
#include "sim/ground/surroundings.h"

namespace flaneur {

// What of it is to rest on the ground, 0: hangs as posed .. 1: rests there, as far as limbs reach.
struct Rests {
    // Palms of both hands go along the ground from where they were to where they will be, `hands_above`
    // metres over it at the end, `hands_on` 0..1 of the way, and are lifted between by `hands_lift` metres.
    float hands = 0;
    std::array<ArmWay, 2> arms_from{}, arms_to{};
    std::array<float, 2> hands_above{};
    float hands_on = 0, hands_lift = 0;
    float sees_steps = 1;     // 0: only what is right below it, 1: keeps off the edges of steps too
    float left_foot = 0;      // that is set down
    bool may_sink = true;     // until the lowest of trunk, thighs and knees touches the ground; else it is
                              // raised alone
    bool keeps_feet = false;  // legs are as their ankles have them: out of the ground they are only lifted
};

// Sets a pose on the ground: the lowest of trunk, thighs, knees and elbows on what is below it; feet that are
// in a step are bent out of it, at the knee, or the whole leg where the foot is well below the knee; hands go
// down to it, or up out of it. What no limb can keep out of the ground the whole body is raised for:
// `raised`, metres, at k_rises m/s, and lowered again at k_sinks m/s. Where there is no ground it is at
// `floor`. Arms go on from where they were in `before`, a tick ago, at most so fast that they swing and do
// not jump; elbows go over the ground, never through it, and begin to before they would have to. Returns
// whether the ground has no steps.
bool settle(BodyPose& pose, const BodyPose& before, const Segments& segments, const PersonBlock& person,
            int lane, const Surroundings& around, float floor, const Rests& rests, float& raised, float dt);
inline constexpr float k_rises = 7, k_sinks = 1.6f;

// How far the lowest of trunk, thighs and knees is above the ground, metres; 0 if it is in it.
float air_below(const BodyPose& pose, const Segments& segments, const PersonBlock& person, int lane,
                const Surroundings& around, float floor);

// Metres that the middle of each palm is over the lowest of trunk, thighs and knees, less what it is thick;
// at least 0.
std::array<float, 2> palms_above(const BodyPose& pose, const Segments& segments, const PersonBlock& person,
                                 int lane);

// Moves a pose aside until none of its balls is in a wall, but 3 cm at most; returns by how much.
Vec3 keep_off_walls(BodyPose& pose, const Segments& segments, const PersonBlock& person, int lane,
                    const Surroundings& around);

// How the ground rises about a place of it, metres a metre along x and z: a plane through what lies within
// `reach` metres.
Vec2 slope_at(const Surroundings& around, Vec3 place, float reach);

}  // namespace flaneur
