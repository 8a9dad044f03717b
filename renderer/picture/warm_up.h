// Drivers that compile shaders when they are first drawn with do it here, off the way to the first picture.
#pragma once

#include "renderer/frame/state.h"

namespace flaneur {

// Begins to draw a small picture by day and one by night, as far as they are asked for, each with every
// pipeline that most need then (not the textured people's); and returns: the frames after wait for them.
Result<void> warm_up(Renderer& renderer);

}  // namespace flaneur
