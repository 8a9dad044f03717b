// Pictures of the built-in scenes, compiled in: pictures/NAME.jpg, each 416 x 234 pixels, as
// tools/scene_pictures draws them.
#pragma once

#include <vector>

#include "renderer/scene.h"

namespace flaneur {

// In the order of scene_names(). One that cannot be read, or of which there is none, is a grey one.
std::vector<RgbaImage> scene_pictures();

}  // namespace flaneur
