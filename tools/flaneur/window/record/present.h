// A presentation: no panels, slow views of street, crowd and city in turn, each with a title that comes and
// goes. Any key ends it, and gives back what was looked at before.
#pragma once

#include "renderer/scene.h"
#include "tools/flaneur/options/options.h"
#include "tools/flaneur/view/show.h"

namespace flaneur {

struct Viewer;

struct Presentation {
    bool is_on = false;
    int view = -1;        // which of them; -1: none yet
    double seconds = 0;   // that it has been looked at
    Camera from;          // of the view
    glm::vec3 middle{0};  // what it looks at
    CameraChoice choice_before;
    Camera camera_before;
};

inline constexpr double k_view_seconds = 14;  // of each view
// How much of the picture is dark between two views, and of the title is seen, at a moment of a view: 0..1.
float darkness_at(double seconds);
float title_at(double seconds);
// Where a view's eye is then: it turns slowly round what it looks at, by some degrees, or goes nearer.
Camera presented(const Presentation& presentation, bool goes_nearer);

void ask_for_presentation(Show& show, Viewer& viewer);
void end_presentation(Viewer& viewer);
// Once a frame: `passed` seconds later.
void go_on_presenting(const Show& show, Viewer& viewer, double passed);
void lay_out_presentation(const Show& show, const Viewer& viewer, Size size, float scale);

}  // namespace flaneur
