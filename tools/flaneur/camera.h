// Where to look from.
#pragma once

#include "renderer/scene.h"
#include "sim/world.h"
#include "tools/flaneur/options.h"

namespace flaneur {

// From 35 m over a street near the middle, looking the way that shows most walkers and houses in the light,
// with the horizon in the upper fifth of the picture. `to_sun` is a unit vector.
Camera overview_camera(const World& world, Vec3 to_sun);

// From a pedestrian's eye, where most of the walkers near the middle of the city are in
// sight now. Depends on the state alone.
Camera street_camera(const World& world);

// From behind a walker, over its right shoulder, nearer where a wall is in between. `between` 0..1 lies
// between the last two ticks.
Camera follow_camera(const World& world, uint32_t walker, float between);

Camera choose_camera(const World& world, const Sun& sun, const CameraChoice& choice, float between);

}  // namespace flaneur
