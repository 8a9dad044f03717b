// Where to look from.
#pragma once

#include <span>

#include "assets/city.h"
#include "renderer/scene.h"
#include "sim/world.h"
#include "tools/flaneur/options/options.h"

namespace flaneur {

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
// ticks. view/rig.h does it smoothly.
Camera follow_camera(const World& world, uint32_t walker, float between);

// FrameInput::companion: who is followed.
uint32_t companion_of(const CameraChoice& choice);

// What that is made of: whose back it is, and from where about it.
struct Behind {
    Vec3 feet;
    float heading = 0, height = 1.7f;
    float round = 0;  // radians from straight behind, counter-clockwise seen from above
    float lift = 0;   // metres up
    float reach = 1;  // share of the way from the crown to the eye
};
Vec3 eye_behind(const Behind& place);  // as if no wall were there
// How far the eye may be from the crown, metres, until it is too near to a wall.
float clear_behind(const Ground& ground, const Behind& place);
Camera camera_behind(const Behind& place);

// From straight above, as a map of the ground there; nearly without perspective, and without haze. `choice`
// is of a map, and `size` that of the picture.
Camera map_camera(const World& world, const CameraChoice& choice, Size size);
// A map of all of the city, whole in such a picture.
CameraChoice map_of_all(const World& world, Size size);

// How somebody, or a place of such a height, is looked at from near: fills a third of the picture's height.
// From the side nearest to where `from` is that no wall hides; `fov` is the lens.
Camera framing_camera(const World& world, Vec3 feet, float height, Vec3 from, float fov);

// What a choice shows; of a place that it chooses itself, now. `fov`, radians, in place of the usual lens,
// unless it is 0. Who is gone along with is so without a past: view/rig.h has one.
struct Show;
Camera choose_camera(const Show& show, const CameraChoice& choice, float fov, Size size, float between);

}  // namespace flaneur
