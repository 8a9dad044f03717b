// Limbs by curves, and all that they go by, changed while people walk: see sim/limbs/limbs.h.
#pragma once

#include "sim/limbs/limbs.h"

namespace flaneur {

struct Show;
struct Viewer;

// From the next tick on. What came before cannot be gone back to where this changes how people walk.
void lead_limbs(Show& show, Viewer& viewer, LimbLead limbs, const LimbCurves& how);

// In the room Gait.
void lay_out_curves(Show& show, Viewer& viewer, float width);

}  // namespace flaneur
