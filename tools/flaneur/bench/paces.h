// A window that no hand uses, for `flaneur bench window`: what its pictures take as hands would use it.
#pragma once

#include <cstdint>

#include "tools/flaneur/output/figures.h"
#include "tools/flaneur/window/cameras/steering.h"

namespace flaneur {

struct Viewer;

// Parts that follow each other, each of `pictures` after a few that do not count: at rest, with panels open
// and somebody asked about, looking about, and looking about with panels.
struct Paces {
    uint32_t pictures = 0;
    uint32_t part = 0, shown = 0;
    Figures figures;  // a series for each part
};

// Before a picture: opens what this part has open, and tells what hands ask for.
Steering lead(const Paces& paces, Viewer& viewer);

// After a picture, so many seconds after the one before. `resolution`: the share that it was drawn in.
void note_picture(Paces& paces, double seconds, float resolution);

bool are_over(const Paces& paces);

}  // namespace flaneur
