// Getting up: from where one lies, over hands and knees, and a knee with the other foot set down, to where
// one stands. Who lies on the back turns over a side first. Healthy adults take two to four seconds.
//
// The ways are those that people of all ages take most: VanSant, "Rising from a supine position to erect
// stance", Physical Therapy 68, 1988; Bohannon & Lusardi, "Getting up from the floor", Physiotherapy Theory
// and Practice 20, 2004.
#pragma once

#include "sim/fall/body_pose.h"

namespace flaneur {

enum class RiseStage : uint32_t { side, fours, kneel, stand, done };

// Which way up a body lies, and where its head is.
struct Lie {
    float heading = 0;  // yaw from hips to head, or where it faces if that stands up
    bool on_back = false;
    bool on_left = false;  // the left side is lower than the right one
    float climbs = 0;      // how the ground rises along the heading, metres a metre
};
// `slope`: see slope_at() in settle.h.
Lie lie_of(const BodyPose& pose, const PersonBlock& person, int lane, Vec2 slope);

// Metres ahead of where the hips lie that one comes to stand, with legs of so many metres.
inline float rise_ahead(float leg) { return 0.24f * leg; }

RiseStage first_stage(const Lie& lie);
RiseStage next_stage(RiseStage stage);
// How long each takes, times `slowness`.
float seconds_of(RiseStage stage);

// The pose at the end of a stage but the last, which ends in the walker's own stance, with its hips above
// `hips`; of one who kneels the right knee stays down.
BodyPose end_of(RiseStage stage, const Lie& lie, const PersonBlock& person, int lane, Vec2 hips);

}  // namespace flaneur
