// Taking a parcel from a shelf, carrying it, and putting it onto another one.
#pragma once

#include "sim/deeds/goal.h"

namespace flaneur {

// Where a parcel lies on a shelf.
ParcelNow at_rest(const Parcel& parcel, const Shelf& shelf, uint32_t number);
// Where one stands before a shelf.
Spot before_shelf(const Deeds& deeds, size_t doer, const Shelf& shelf);

// What one wishes who takes or puts; goes from stage to stage.
DoerWish carry(Deeds& deeds, size_t doer);
// Where what it has is in this tick, after the gait has posed it.
void move_parcel(Deeds& deeds, size_t doer);
// Hands, trunk and head of one who takes, carries or puts. `pose` is the gait's.
void pose_carrying(const Deeds& deeds, size_t doer, BodyPose& pose);

// The hand that holds a side of a parcel, fingers `pitch` radians ahead of down.
Palm grip_of(const Parcel& parcel, const ParcelNow& now, Side side, float pitch);

}  // namespace flaneur
