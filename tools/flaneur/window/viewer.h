// What keys, mouse and panels of the window do to.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renderer/scene.h"
#include "tools/flaneur/options/options.h"
#include "tools/flaneur/window/change/change.h"
#include "tools/flaneur/window/clock.h"

namespace flaneur {

// What the panel on the left is about: one thing at a time.
enum class Room : uint8_t { none, layers, change };

struct KeyPress {
    int key = 0, mods = 0;
    bool repeats = false;
};

// What is looked for among all actions.
struct Palette {
    bool is_open = false;
    char typed[64] = {};
    int chosen = 0;
};

struct Viewer {
    Clock clock;
    CameraChoice choice;
    bool chosen = false;  // the choice's camera has been taken
    Camera camera;
    bool is_loading = true;
    std::vector<KeyPress> presses;  // not acted upon yet
    bool wants_picture = false, wants_command = false, wants_close = false;
    bool lists_keys = false, has_panels = true;
    Room room = Room::none;
    Palette palette;
    double escaped_at = -1e9;       // of the window's time
    std::vector<WorkView> toggles;  // in the order of their keys
    uint32_t walkers = 0;
    std::optional<uint32_t> hovered, selected;  // walkers, by slot
    double fps = 0;
    std::string note;       // told for a while
    double note_until = 0;  // of the panels' time
    Change change;
    float resolution = 1;  // share of the window's pixels that the picture is drawn in
};

void choose(Viewer& viewer, CameraChoice::Kind kind);
// From wherever the camera is, the eye flies on freely.
void take_off(Viewer& viewer);

}  // namespace flaneur
