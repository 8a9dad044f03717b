// Drivers that compile shaders when they are first drawn with do it here, off the way to the first picture.
#pragma once

#include "renderer/state.h"

namespace flaneur {

// Begins to draw a small picture by day with every pipeline, and returns; the frame after waits for it.
Result<void> warm_up(Renderer& renderer);

}  // namespace flaneur
