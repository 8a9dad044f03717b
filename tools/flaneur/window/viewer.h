// What keys, mouse and panels of the window do to.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renderer/scene.h"
#include "tools/flaneur/options/options.h"
#include "tools/flaneur/window/clock.h"

namespace flaneur {

struct Viewer {
    Clock clock;
    CameraChoice choice;
    bool chosen = false;  // the choice's camera has been taken
    Camera camera;
    bool wants_picture = false, wants_command = false;
    bool lists_keys = false, lists_layers = false, has_panels = true;
    std::vector<WorkView> toggles;  // in the order of their keys
    uint32_t walkers = 0;
    std::optional<uint32_t> hovered, selected;  // walkers, by slot
    double fps = 0;
    std::string note;       // told for a while
    double note_until = 0;  // of the panels' time
    float resolution = 1;   // share of the window's pixels that the picture is drawn in
};

void choose(Viewer& viewer, CameraChoice::Kind kind);
// From wherever the camera is, the eye flies on freely.
void take_off(Viewer& viewer);

}  // namespace flaneur
