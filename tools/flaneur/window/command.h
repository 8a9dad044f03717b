// The command that draws what the window shows.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renderer/scene.h"
#include "tools/flaneur/options/options.h"

namespace flaneur {

// What is shown.
struct Shown {
    CameraChoice choice;  // of it only a map counts: else the camera's place is told
    Camera camera;
    WorkViews views;
    Size size;
    uint32_t tick = 0;
    bool is_transparent = false;           // where there is sky
    bool has_lens = false;                 // the words, or the scene that they name, have one
    std::optional<bool> is_overcast = {};  // if the weather is not that of the words
    Techniques techniques = {};            // by which bodies are drawn,
    LimbLead limbs = LimbLead::gait;       // of a scene whose limbs are led so
    std::string quality = {};              // if it is not that of the words; empty: as they say
    std::string scene = {};                // a file that says all of it, in place of the words; empty: none
};

struct Show;
struct Viewer;
struct World;
// Why no command draws what the window shows; "": one does.
std::string why_no_command(const Viewer& viewer, const World& world);
// Of what the window shows, as a picture of this size.
// Where the city has been changed, the scene is written beside, and drawn.
std::string command_now(const Show& show, const Viewer& viewer, Size size);
// What measures it: flaneur bench frame of this view, from this moment on.
std::string bench_command_now(const Show& show, const Viewer& viewer, Size size);
inline constexpr const char* k_told_otherwise =
    "Copied; but people stand elsewhere in its picture, for the city was changed while they walked: ";

// `flaneur render` with the words that opened the window (what followed `flaneur view`), but for those that
// `shown` says otherwise, or that a scene's file holds; it writes picture.png. As a shell takes it.
std::string command_of(const std::vector<std::string>& words, const Shown& shown);
// `flaneur bench frame` with them: without layers, and with whole bodies.
std::string bench_command_of(const std::vector<std::string>& words, const Shown& shown);

}  // namespace flaneur
