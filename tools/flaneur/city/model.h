// A city as it is drawn, to be opened elsewhere.
#pragma once

#include "assets/city.h"
#include "assets/gltf/city/still.h"

namespace flaneur {

// The triangles that the renderer draws, in meshes "ground", "facades", "roofs", "props" and "scenery". What
// shaders add, such as windows and the stripes of crossings, is not in it. Materials are named by what they
// are: road, sidewalk, facade, ... ; scenery beyond the ground is "backdrop", on which nobody walks.
StillModel city_model(const City& city);

}  // namespace flaneur
