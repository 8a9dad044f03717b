// A way of the camera through a city: where it is at some moments.
//
// Files are JSON: { "keys": [ { "time": 0, "eye": [0, 1.7, -20], "target": [0, 1.5, 0], "fov": 32 }, ... ] }.
// `time` is in seconds and grows from key to key, from 0 on or later; `eye` and `target`, which is looked at,
// are in metres, +y up; `fov` is from the picture's lower border to its upper one in degrees, and may be left
// out: 32.
#pragma once

#include <string>
#include <string_view>
#include <vector>

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

// The text of a file. A sentence without a subject says what is wrong, and in which key: "has no key".
std::string path_text(const CameraPath& path);
Result<CameraPath> parse_path(std::string_view text);
// Refuses in a whole sentence.
Result<CameraPath> load_path(const std::string& file);

}  // namespace flaneur
