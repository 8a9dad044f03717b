// How a scene is looked at: from where, how large, how well drawn, and by which views for work. Scene files
// and the command line say it in the same words.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "assets/place.h"
#include "sim/base/result.h"
#include "sim/base/vec.h"
#include "sim/crowd/pass_on.h"

namespace flaneur {

struct Size {
    int width = 1280, height = 720;  // pixels, 1..8192
    bool operator==(const Size&) const = default;
};

struct CameraChoice {
    enum class Kind { overview, street, crowd, follow, eyes, map, fixed } kind = Kind::street;
    uint32_t walker = 0;  // follow, eyes
    Vec3 eye, target;     // fixed, metres
    // Of a map. `across` are the metres from the picture's left border to its right one; 0: all of the city,
    // whose middle it then has.
    Vec2 middle{0, 0};
    float across = 0;
    float bearing = 0;  // that is up, degrees clockwise from north
    bool operator==(const CameraChoice&) const = default;
};

// Views for work.
enum class WorkView {
    wireframe,
    normals,
    overdraw,  // how often each pixel is drawn
    lods,      // people by level of detail
    speed,     // people by speed
    density,   // people to a square metre of ground
    walkable,  // the navigation mesh
    trails,    // where people walked in the last ten seconds
    skeletons,
    gizmos,  // of the gait: steps, targets, gaze, velocity
    ways,    // what those go by who have no goal: circles, rays
};
inline constexpr int k_work_views = 11;
inline constexpr const char* k_work_view_names[k_work_views] = {"wireframe", "normals", "overdraw", "lods",
                                                                "speed",     "density", "walkable", "trails",
                                                                "skeletons", "gizmos",  "ways"};

// Those that are on.
struct WorkViews {
    uint32_t mask = 0;
    bool operator[](WorkView view) const { return (mask >> static_cast<int>(view) & 1) != 0; }
    bool operator==(const WorkViews&) const = default;
};
// Those that show their own surfaces (wireframe, normals, overdraw), colour people (lods, speed) or colour
// the ground (density, walkable) go one at a time: the mask of those that cannot be on beside `view`.
uint32_t rivals_of(WorkView view);
// Switching one on switches its rivals off.
WorkViews toggled(WorkViews views, WorkView view);

inline constexpr float k_least_across = 5, k_most_across = 20'000;  // of a map, metres
// The usual lens: 32 degrees from the picture's lower border to its upper one, 54 across at 16:9, as through
// a 35 mm lens. Radians.
inline constexpr float k_fov = 0.557f;
// Others, degrees.
inline constexpr double k_least_fov = 1, k_most_fov = 150;
// Radians, and back: the shortest degrees of which the same radians come.
float fov_of(double degrees);
std::string told_fov(float radians);

inline constexpr const char* k_quality_names[] = {"low", "medium", "high", "ultra"};

// What reads a value refuses in a sentence that begins with the text: "12 is not a width and ...".

// "overview", "street", "crowd", "follow:12", "eyes:12", "map", "map:X,Z,ACROSS", "map:X,Z,ACROSS,BEARING" or
// "0,1.7,0/10,1.5,0".
Result<CameraChoice> parse_camera(const std::string& text);
// "12.5,0,-3": a place, metres, none of them beyond a thousand kilometres.
Result<Vec3> parse_spot(const std::string& text);
// As parse_camera() takes it, to the last bit.
std::string told_camera(const CameraChoice& camera);
// As parse_spot() takes it, to the last bit.
std::string told_spot(Vec3 place);
// Of those that are on.
std::vector<std::string> names_of(WorkViews views);
// "1280x720".
Result<Size> parse_size(const std::string& text);
// Degrees from k_least_fov to k_most_fov, as radians.
Result<float> parse_fov(const std::string& text);
// Names of views. Refuses unknown ones and rivals.
Result<WorkViews> parse_work_views(const std::vector<std::string>& names);
// "52.5163,13.3777", blanks behind the comma or not: latitude and longitude, degrees.
Result<MapPlace> parse_place(const std::string& text);
// "17:30" as an hour of the day: 17.5. From 00:00 to 23:59; or "dawn", "noon", "dusk" and "night" of a day
// late in August.
Result<float> parse_time(const std::string& text);
// Whether "clear" or "overcast" is overcast.
Result<bool> parse_weather(const std::string& text);
// "right" or "left".
Result<PassOn> parse_side(const std::string& text);
// One of k_quality_names.
Result<std::string> parse_quality(const std::string& text);

}  // namespace flaneur
