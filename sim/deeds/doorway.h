// Through a door: a hand turns its lever, pushes or pulls the leaf while the body goes by it, and lets it go;
// a closer shuts it behind.
#pragma once

#include "sim/deeds/goal.h"

namespace flaneur {

// Where one begins who pushes or pulls: before the handle; out of the leaf's way, if that comes towards one.
Spot before_door(const Deeds& deeds, size_t doer, const SwingDoor& door, bool pushes);

// What one wishes who goes through a door; goes from stage to stage.
DoerWish pass_door(Deeds& deeds, size_t doer);
// The leaf, as the hand has it, after the gait has posed who holds it.
void move_leaf(Deeds& deeds, size_t doer);
// A leaf that nobody holds, after its closer: it keeps off those who stand in its way, and who goes through
// opens it with what comes against it.
void let_by(Deeds& deeds, uint32_t door);
// The hand, trunk and head of one at a door. `pose` is the gait's.
void pose_at_door(const Deeds& deeds, size_t doer, BodyPose& pose);

// What the hand of one who acts has of the leaf: 0 its lever .. 1 its face, on the side to which it closes,
// so many metres from the hinge.
struct LeafHold {
    float share, far;
};
LeafHold hold_of(const Doer& doer);

// Which hand that is: the one on the hinge's side.
Side hand_at(const SwingDoor& door, bool pushes);

}  // namespace flaneur
