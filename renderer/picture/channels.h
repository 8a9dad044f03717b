// What a picture shows besides its light: how far away it is, and whose it is.
#pragma once

#include "renderer/frame/state.h"

namespace flaneur {

// Fills Image::depths with alpha, and Image::ids, as `frame` wants them, of the picture that was drawn last,
// off-screen and to its end. For ids what is seen is drawn once more, and depths are those of that drawing:
// they agree.
Result<void> add_channels(Renderer& renderer, const FrameInput& frame, Image& image);

}  // namespace flaneur
