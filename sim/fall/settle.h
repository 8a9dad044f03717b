// A body that gets up, on the ground that is there: level, sloping, steps.
#pragma once

#include "sim/fall/body_pose.h"
#include "sim/fall/limbs.h"
#include "sim/ground/surroundings.h"

namespace flaneur {

// What of it is to rest on the ground, 0: hangs as posed .. 1: rests there, as far as limbs reach.
struct Rests {
    // Palms of both hands go along the ground from where they were to where they will be, `hands_on` 0..1 of
    // the way, and are lifted between by `hands_lift` metres.
    float hands = 0;
    std::array<ArmWay, 2> arms_from{}, arms_to{};
    float hands_on = 0, hands_lift = 0;
    float left_foot = 0;      // that is set down
    bool may_sink = true;     // until the lowest of trunk, thighs and knees touches the ground; else it is
                              // raised alone
    bool keeps_feet = false;  // legs are as their ankles have them: out of the ground they are only lifted
};

// Sets a pose on the ground: the lowest of trunk, thighs, knees and elbows on what is below it; feet that are
// in a step are bent out of it, at the knee, or the whole leg where the foot is well below the knee; hands go
// down to it, or up out of it. What no limb can keep out of the ground the whole body is raised for:
// `raised`, metres, which goes back at k_sinks m/s. Where there is no ground it is at `floor`. Returns
// whether the ground has no steps.
bool settle(BodyPose& pose, const Segments& segments, const PersonBlock& person, int lane,
            const Surroundings& around, float floor, const Rests& rests, float& raised, float dt);
inline constexpr float k_sinks = 0.8f;

// Moves a pose aside until none of its balls is in a wall.
void keep_off_walls(BodyPose& pose, const Segments& segments, const PersonBlock& person, int lane,
                    const Surroundings& around);

// How the ground rises about a place of it, metres a metre along x and z: a plane through what lies within
// `reach` metres.
Vec2 slope_at(const Surroundings& around, Vec3 place, float reach);

}  // namespace flaneur
