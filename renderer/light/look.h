// The look of a picture: how bright and how warm what lights the scene is shown.
#pragma once

#include <vector>

#include "renderer/light/daylight.h"
#include "renderer/shared.h"

namespace flaneur {

// What shaders are told of light: exposed and balanced for eyes that are used to it, as they are to streets
// by day, by lamplight and by moonlight. `lit_windows`: share of windows with a light on in the dark. View,
// shadows and sun_direction are left at 0.
struct Look {
    FrameConstants constants;
    vec3 sky_white, white;  // factors for the model's sky, and for all else
};
Look look_of(const Daylight& light, float lit_windows);

// The sky's light at the corners of its grid over the picture, rows from the top; `rays` has the view.
std::vector<vec4> sky_corners(const Daylight& light, const Look& look, const FrameConstants& rays);

}  // namespace flaneur
