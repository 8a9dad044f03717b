// A way of the camera through a city: where it is at some moments, and how it gets from one to the next.
//
// Files are JSON: { "keys": [ { "time": 0, "eye": [0, 1.7, -20], "target": [0, 1.5, 0], "fov": 32 }, ... ] }.
// `time` is in seconds and grows from key to key, from 0 on or later; `eye` and `target`, which is looked at,
// are in metres, +y up; `fov` is from the picture's lower border to its upper one in degrees, and may be left
// out: 32.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "renderer/scene.h"
#include "sim/base/result.h"
#include "sim/base/vec.h"

namespace flaneur {

struct CameraKey {
    double time = 0;  // seconds
    Vec3 eye, target;
    float fov = 0;  // radians
};
struct CameraPath {
    std::vector<CameraKey> keys;  // by time, which grows
};
inline constexpr size_t k_most_keys = 10'000;
inline constexpr double k_longest_path = 36'000;  // seconds

CameraKey key_of(const Camera& camera, double time);

// Seconds from the first key to the last.
double duration(const CameraPath& path);

// So many seconds after the first key; before it, and after the last, the camera rests there. Places lie on a
// Catmull-Rom curve (Catmull and Rom, "A class of local interpolating splines", 1974) over the times of the
// keys; headings, pitches and lenses are monotone between keys (Fritsch and Carlson, "Monotone piecewise
// cubic interpolation", SIAM J. Numer. Anal. 1980), so that none of them overshoots. All of it starts and
// ends at rest. There must be a key.
Camera camera_at(const CameraPath& path, double seconds);

// The text of a file. A sentence without a subject says what is wrong, and in which key: "has no key".
std::string path_text(const CameraPath& path);
Result<CameraPath> parse_path(std::string_view text);
// Refuses in a whole sentence.
Result<CameraPath> load_path(const std::string& file);

}  // namespace flaneur
