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
    CameraChoice choice;  // of it only who is followed counts
    Camera camera;
    WorkViews views;
    Size size;
    uint32_t tick = 0;
    std::optional<bool> is_overcast;  // if the weather is not that of the words
    std::string scene;                // a file that says all of it, in place of the words; empty: none
};

// `flaneur render` with the words that opened the window (what followed `flaneur view`), but for those that
// `shown` says otherwise, or that a scene's file holds; it writes picture.png. As a shell takes it.
std::string command_of(const std::vector<std::string>& words, const Shown& shown);

}  // namespace flaneur
