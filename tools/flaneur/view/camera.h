// Where to look from.
#pragma once

#include <span>

#include "assets/city.h"
#include "renderer/scene.h"
#include "sim/world.h"
#include "tools/flaneur/options/options.h"

namespace flaneur {

inline constexpr float k_fov = 0.557f;  // 32 degrees upright: 54 across at 16:9, a 35 mm lens
Camera make_camera(Vec3 eye, Vec3 target);
// Whether nothing of the ground, walls and solids is in between.
bool sees(const Ground& ground, Vec3 from, Vec3 to);

// From above, of where people and houses are densest: what lies within 65 m of there, or less where there is
// less, fills the picture, seen from the side that shows most of it in the light; elsewhere, if one house
// would take more than a quarter of the picture. `buildings` are the city's, or none; `to_sun` is a unit
// vector.
Camera overview_camera(const World& world, std::span<const Building> buildings, Vec3 to_sun);

// From a pedestrian's eye, where most of the walkers near the middle of the city are in
// sight now, and no wall is within half a metre. Depends on the state alone.
Camera street_camera(const City& city, const World& world);

// Before the densest throng, some of it near: from a pedestrian's eye up to 25 m above the ground.
Camera crowd_camera(const World& world);

// From behind a walker, over its right shoulder, who is in the picture from hat to soles, whatever its
// height; nearer, with a wider lens, where a wall is in between. `between` 0..1 lies between the last two
// ticks.
Camera follow_camera(const World& world, uint32_t walker, float between);

// FrameInput::companion: who is followed.
uint32_t companion_of(const CameraChoice& choice);

Camera choose_camera(const City& city, const World& world, const Sun& sun, const CameraChoice& choice,
                     float between);

}  // namespace flaneur
