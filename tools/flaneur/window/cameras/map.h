// A map in the window: what is under the cursor, and how hands move it.
#pragma once

#include <glm/glm.hpp>
#include <string>

#include "renderer/scene.h"
#include "sim/world.h"
#include "tools/flaneur/options/options.h"
#include "tools/flaneur/window/cameras/steering.h"

namespace flaneur {

struct Viewer;

// About what a camera looks at, as wide as is seen there.
CameraChoice map_around(const World& world, const Camera& camera, Size size);

// All of the city, between two rows of the picture: what is above and below is covered.
CameraChoice map_between(const World& world, Size size, float top, float foot);

// Of a picture of this size, at the height of the ground.
Vec2 place_under(const CameraChoice& map, Size size, glm::vec2 pixel);

// By so many notches of a wheel: what is under the pixel stays there.
void zoom_map(CameraChoice& map, Size size, glm::vec2 pixel, float notches);
// What was under one pixel is under the other.
void pan_map(CameraChoice& map, Size size, glm::vec2 from, glm::vec2 to);
// Radians counter-clockwise on the screen, about the picture's middle.
void turn_map(CameraChoice& map, float angle);
// Along and nearer, as keys and gamepads ask for; tells whether they did.
bool steer_map(CameraChoice& map, const Steering& hands, float seconds);

// A length of 1, 2 or 5 times a power of ten metres, the longest that takes no more than `most` pixels, and
// how many it takes.
struct ScaleBar {
    float metres = 1, pixels = 0;
};
ScaleBar scale_bar(float metres_a_pixel, float most);
std::string told_length(float metres);  // "50 m", "2 km"

// The arrow to the north and the scale, in the lower right corner.
void lay_out_map(Viewer& viewer, Size size, float scale);

}  // namespace flaneur
