// Where the sun stands by the clock, and what people's clocks make them do with their lamps.
#pragma once

#include "assets/scene.h"
#include "renderer/scene.h"

namespace flaneur {

// On a day late in August, by summer time. Declination after Cooper, "The absorption of radiation in solar
// stills" (Solar Energy 1969); height and heading by the spherical triangle of pole, zenith and sun. What the
// scene says of height and heading goes before.
Sun scene_sun(const Scene& scene, float latitude);

// The share of windows with a light on in the dark.
float lit_windows(float hour);

}  // namespace flaneur
