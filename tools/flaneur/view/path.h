// How a camera gets from one key of its path to the next.
#pragma once

#include "assets/camera_path.h"
#include "renderer/scene.h"

namespace flaneur {

CameraKey key_of(const Camera& camera, double time);

// Seconds from the first key to the last.
double duration(const CameraPath& path);

// So many seconds after the first key; before it, and after the last, the camera rests there. Places lie on a
// Catmull-Rom curve (Catmull and Rom, "A class of local interpolating splines", 1974) over the times of the
// keys; headings, pitches and lenses are monotone between keys (Fritsch and Carlson, "Monotone piecewise
// cubic interpolation", SIAM J. Numer. Anal. 1980), so that none of them overshoots. All of it starts and
// ends at rest. There must be a key.
Camera camera_at(const CameraPath& path, double seconds);

}  // namespace flaneur
