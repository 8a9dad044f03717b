// A scene: what to simulate and from where to look. Built-in ones are the files of assets/scenes, compiled
// in.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "assets/additions.h"
#include "assets/look.h"
#include "assets/trajectory_reading.h"
#include "sim/alongside/shares.h"
#include "sim/ball/planned_throw.h"
#include "sim/base/result.h"
#include "sim/crowd/habit.h"
#include "sim/fall/planned_push.h"
#include "sim/lamps/kerbs.h"
#include "sim/limbs/limbs.h"
#include "sim/pastimes/places.h"

namespace flaneur {

// Some of the people of a scene.
struct PeopleShare {
    std::string character;  // a glTF or VRM file; empty: the built-in people
    float share = 1;        // of all walkers, against the others' shares: 0.001..1000
    bool operator==(const PeopleShare&) const = default;
};
// How many there are of some of the built-in people, times as many as usual: 0, nobody, to k_most_mix. Who is
// two of these, such as an old one with a cane, is there by both.
struct PeopleMix {
    float children = 1;  // below k_grown_up
    float old = 1;       // from k_old_age
    float canes = 1, prams = 1, phones = 1;
    bool operator==(const PeopleMix&) const = default;
};
inline constexpr float k_grown_up = 14, k_old_age = 65;  // years
// The shares of PastimeShares, by their keys.
struct PastimeKey {
    const char* name;  // in a scene's file
    float PastimeShares::*share;
};
inline constexpr PastimeKey k_pastimes[] = {
    {"sitting", &PastimeShares::sitting},   {"leaning", &PastimeShares::leaning},
    {"on_phones", &PastimeShares::phones},  {"windows", &PastimeShares::windows},
    {"queues", &PastimeShares::queues},     {"tourists", &PastimeShares::tourists},
    {"hurrying", &PastimeShares::hurrying}, {"strolling", &PastimeShares::strolling}};
struct MixKey {
    const char* name;  // in a scene's file
    float PeopleMix::*times;
};
inline constexpr MixKey k_mix[] = {{"children", &PeopleMix::children},
                                   {"old", &PeopleMix::old},
                                   {"canes", &PeopleMix::canes},
                                   {"prams", &PeopleMix::prams},
                                   {"phones", &PeopleMix::phones}};
inline constexpr float k_most_mix = 10;
inline constexpr double k_least_scale = 0.0001, k_most_scale = 10'000;
inline constexpr double k_least_share = 0.001, k_most_share = 1000;
inline constexpr int k_max_walkers = 1'000'000;
// How many surely find room on a course and in a yard, whoever they are.
inline constexpr int k_course_walkers = 24, k_yard_walkers = 120;

// The places that are built in.
enum class BuiltIn : uint8_t {
    district,
    asteroid,
    platform,
    field,
    gallery,
    planets,
    quayside,
    yard,
    course
};
inline constexpr std::string_view k_built_in_names[] = {
    "district", "asteroid", "platform", "field", "gallery", "planets", "quayside", "yard", "course"};
// Where nobody says how many walk.
constexpr int usual_walkers(BuiltIn place) {
    return place == BuiltIn::course ? k_course_walkers : place == BuiltIn::yard ? k_yard_walkers : 500;
}
// Of a scene whose platform nobody has laid out.
inline const std::vector<Vec2> k_usual_platform{{-6.9f, -9}, {10.1f, -2.8f}, {6.9f, 9}, {-10.1f, 2.8f}};

// How one comes and leaves who is seen in the middle of a recording: into sight where it is recorded first,
// within half a second; or before that, and out of it after, going straight on, so that it is there in full
// for as long as it is recorded.
enum class Entering : uint8_t { fade, step };
inline constexpr std::string_view k_entering_names[] = {"fade", "step"};

inline constexpr double k_least_frame_rate = 0.01, k_most_frame_rate = 1000;
inline constexpr double k_least_unit = 1e-6, k_most_unit = 1e4;  // metres

struct Scene {
    std::string name = "district";
    std::string about;               // one line on it
    std::string city;                // an OpenStreetMap or glTF file; empty: the built-in district
    std::optional<MapPlace> center;  // of an OpenStreetMap city: what is drawn lies about it
    float radius = 0;  // how far to each side, metres: k_least_map_radius..k_most_map_radius; 0: see cities.h
    BuiltIn built = BuiltIn::district;  // without a city: all round the asteroid, on a platform in
                                        // the water, on a walled field, by a row of figures, on planets,
                                        // before a yard, on a course
    std::vector<Vec2> platform;         // its corners, metres; see make_platform(); empty: k_usual_platform
    std::string rock;                 // what the asteroid is: k_torus or a glTF file of a closed mesh; or ""
    std::string terrain;              // an elevation file under an OpenStreetMap city; empty: level ground
    float scale = 1;                  // metres to a unit of a glTF city: 0.0001..10,000
    std::vector<PeopleShare> people;  // empty: the built-in people
    PeopleMix mix;                    // of the built-in ones
    std::vector<Addition> added;      // to the city
    std::vector<PlannedPush> pushes;  // that people get
    std::vector<PlannedThrow> balls;  // that are thrown at them
    std::vector<std::string> idles;   // FILE or FILE:CLIP, glTF animations that those who stand play
    int walkers = usual_walkers(BuiltIn::district);  // 0..1,000,000
    int creatures = 0;                               // 0..100, of six legs, among people
    Habit habit = Habit::wander;                     // what they do; they stagger on a platform only
    LimbLead limbs = LimbLead::gait;                 // what leads theirs; curves only of those who ramble
    float drunk = 0;                                 // 0..1, see WorldOptions,
    int steppers = 0;                                // of the walkers, who step when they must, along
    std::vector<Vec2> steppers_way;           // this closed line, metres; of two places, there and back
    int drunks = 0;                           // and there; 0: all are so drunk
    float helpers = k_usual_helpers;          // the same
    bool lamps = false;                       // whether traffic lights work and people mind them
    float jaywalkers = k_usual_jaywalkers;    // see WorldOptions
    std::array<float, 4> groups{1, 0, 0, 0};  // the same
    float acquaintances = 0;                  // the same
    AlongShares along;                        // of people; see WorldOptions
    PastimeShares pastimes;                   // what they do who stay
    float traffic = 0;                        // of who drives; see WorldOptions
    bool flat = false;                        // of a course: all in one plane, seen from the side
    std::optional<Vec3> look;                 // of a course: where all look who can turn their heads there
    uint64_t seed = 1;
    int blocks = 4;      // size of the built-in district
    bool trams = false;  // whether it has tracks
    float hour = 17.5f;  // of the day at the first tick, 0..24
    // Degrees above the horizon, and clockwise from north: where the sun stands, whatever the hour.
    std::optional<float> sun_height, sun_heading;
    bool is_overcast = false;
    std::optional<PassOn> side;  // on which people pass; else as one drives there
    bool stays = false;          // nobody who wanders leaves or comes in
    std::string demand;          // a file of people who are sent; see load_demand(); empty: none are
    std::string trajectories;    // a file of where people were: they go there, and nobody else does; or none
    TrajectoryReading reading;   // of that: what it does not say rightly itself
    Entering entering = Entering::fade;  // of that
    CameraChoice camera;
    float fov = 0;        // of its lens, upright, radians; 0: what suits the camera
    Size size;            // of the picture or the window
    std::string quality;  // one of k_quality_names; empty: what suits the device
    WorkViews views;
    bool operator==(const Scene&) const = default;
};

// What is wrong in the text of a scene file, and where: lines and columns from 1.
struct SceneFault {
    int line = 1, column = 1;
    std::string what;  // a sentence without its full stop
};

// Whether its people go where others were, and the place is made of that.
inline bool is_recorded(const Scene& scene) { return !scene.trajectories.empty(); }
inline bool is_of(const Scene& scene, BuiltIn built) {
    return scene.city.empty() && !is_recorded(scene) && scene.built == built;
}
// All round which people walk, so that up is not one way.
inline bool is_small_world(const Scene& scene) {
    return is_of(scene, BuiltIn::asteroid) || is_of(scene, BuiltIn::planets);
}
inline constexpr std::string_view k_torus = "torus";
inline const std::vector<Vec2>& platform_of(const Scene& scene) {
    return scene.platform.empty() ? k_usual_platform : scene.platform;
}

// A built-in scene's name, or a path to a .json file of at most a megabyte. Unknown names, keys, values out
// of range and what contradicts itself are refused. Relative paths in a file are relative to its folder.
Result<Scene> load_scene(const std::string& name_or_path);

// The same of the text of a scene file; its paths are left as they are. `name` is what errors call it.
Result<Scene> parse_scene(std::string_view text, const std::string& name);

// The scene of people who go where they were recorded, in the place where that was, from above: of a file
// that read_trajectories() reads.
Scene scene_of_trajectories(const std::string& path);
// "120,-40": TrajectoryReading::origin.
Result<Vec2> parse_origin(const std::string& text);

// The text of a scene file of which parse_scene() makes the same scene but for its name and for parts of a
// minute of its hour. Paths are left as they are.
std::string scene_text(const Scene& scene);

// "08:15": the minute of an hour of the day, as parse_time() takes it.
std::string told_time(float hour);

// All that is wrong with a scene, named as load_scene takes it; also a camera that follows nobody unless more
// walkers are asked for. Refuses what cannot be read.
Result<std::vector<SceneFault>> check_scene(const std::string& name_or_path);

// The JSON schema (draft 7) of scene files, from the table that reads them; assets/scenes/scene.schema.json
// is a copy.
std::string scene_schema();

// "2.5 12 60,0": a push 2.5 s after the start, of walker 12 (* is everybody), by 60 newton seconds along x,
// and back.
Result<PlannedPush> parse_push(const std::string& text);
std::string told_push(const PlannedPush& push);
// "2 0,1.6,9 0,1.2,0 12 4": a ball thrown 2 s after the start, from a place past another, at 12 m/s, of 4 kg,
// and back. Without the last it is k_ball_mass.
Result<PlannedThrow> parse_throw(const std::string& text);
std::string told_throw(const PlannedThrow& thrown);
// Who is to be pushed and is not among the scene's walkers, who are numbered from 0.
std::optional<uint32_t> pushed_nobody(const Scene& scene);
// Leaves those out.
void leave_out_nobody(Scene& scene);

// "-8,-5 8,-5 0,9": the corners of a platform, and back. Refuses what make_platform() does.
inline constexpr float k_widest_platform = 400;  // metres from the origin
Result<std::vector<Vec2>> parse_platform(const std::string& text);
std::string told_corners(const std::vector<Vec2>& corners);
// The same of a way: 2 to 64 corners, at most 2 km apart in all.
Result<std::vector<Vec2>> parse_way(const std::string& text);

// Names of the built-in scenes, sorted.
std::vector<std::string> scene_names();

}  // namespace flaneur
