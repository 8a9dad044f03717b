// How far away is what a picture shows.
#pragma once

#include "renderer/frame/state.h"

namespace flaneur {

// Fills Image::depths, and alpha, of the picture that was drawn last, off-screen and to its end.
Result<void> read_depths(Renderer& renderer, float near_plane, Image& image);

}  // namespace flaneur
