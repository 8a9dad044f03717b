// Where the window looks from: one of several modes, a lens, nine bookmarks and a path.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "assets/look.h"
#include "tools/flaneur/view/path.h"
#include "tools/flaneur/view/rig.h"
#include "tools/flaneur/window/cameras/glide.h"
#include "tools/flaneur/window/cameras/steering.h"
#include "tools/flaneur/window/cameras/walk.h"

struct GLFWwindow;

namespace flaneur {

struct Scene;
struct Show;
struct Viewer;

// What decides where the eye is. The first three choose a place once, and stay there.
enum class CameraMode : uint8_t { street, overview, crowd, follow, eyes, map, fly, walk, path };

// A camera that was kept.
struct Bookmark {
    CameraChoice choice;
    float fov = 0;  // as Cameras::fov
    char name[32] = {};
    bool operator==(const Bookmark&) const = default;
};
inline constexpr size_t k_bookmarks = 9;
inline constexpr double k_narrowest = 20, k_widest = 100;  // lenses that one chooses, degrees

struct Cameras {
    float fov = 0;          // the lens that was chosen, radians; 0: what suits the mode
    bool has_lens = false;  // what is shown was opened with one
    bool has_shown = false;
    CameraChoice whole_map, near_map;  // of all, and what a map shows in turn with it; across 0: none yet
    Glide glide;                       // its end is where the eye will be, or is
    CameraRig rig;
    bool is_walking = false;
    Stroll walk;
    std::array<std::optional<Bookmark>, k_bookmarks> bookmarks;

    CameraPath path;
    bool is_on_path = false, is_playing = false;
    double path_time = 0;  // seconds after its first key
    char path_file[256] = "out/camera-path.json";

    Pad pad;
};

// As a scene that was opened has it; of what was there before only the path is kept.
void begin_cameras(const Scene& scene, Viewer& viewer);

CameraMode mode_of(const Viewer& viewer);
float lens_of(const Viewer& viewer);

// Lets go of whatever leads the eye; it flies on freely from where it is.
void take_off(Viewer& viewer);
// One of the kinds that choose a place themselves.
void choose(Viewer& viewer, CameraChoice::Kind kind);
// This one, from now on.
void choose(Viewer& viewer, const CameraChoice& choice);
// The place from which it is now looked, or who is gone along with.
CameraChoice kept_choice(const Viewer& viewer);

// The map of all of the city; from that one, where one was before.
void look_at_map(const Show& show, Viewer& viewer);
// On foot, where there is ground; says so where there is none.
void set_foot(const Show& show, Viewer& viewer);
// Shows the path at a moment.
void show_path(Viewer& viewer, double seconds, bool plays);
// Appends a key to the path, so long after the last as the way there takes.
void add_key(Viewer& viewer);

// After each tick.
inline void ride(const World& world, Cameras& cameras, const CameraChoice& choice) {
    advance(cameras.rig, world, choice);
}

// What a gamepad, if there is one, asks for; its buttons act.
Steering read_pad(GLFWwindow* window, float seconds, Viewer& viewer);

// Flies, walks or moves the map as hands ask for; tells whether they did.
bool steer(const Show& show, const Steering& hands, float seconds, Viewer& viewer);

// Puts the eye where its mode has it, or on the way there. Whether it moves.
bool move_camera(const Show& show, Size size, float seconds, float between, Viewer& viewer);

// The room of the cameras.
void lay_out_cameras(Show& show, Viewer& viewer, float scale);
// The path over the city, while the room is open.
void mark_path(const Viewer& viewer, Show& show, FrameInput& frame);

struct Action;
std::span<const Action> camera_actions();
std::span<const Action> bookmark_actions();

}  // namespace flaneur
