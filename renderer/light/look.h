// The look of a picture: how bright and how warm what lights the scene is shown.
#pragma once

#include "renderer/light/daylight.h"
#include "renderer/shared.h"

namespace flaneur {

// What shaders are told of light: exposed and balanced for eyes that are used to it, as they are to streets
// by day, by lamplight and by moonlight. `lit_windows`: share of windows with a light on in the dark. View,
// shadows and sun_direction are left at 0.
FrameConstants lit_by(const Daylight& light, float lit_windows);

}  // namespace flaneur
