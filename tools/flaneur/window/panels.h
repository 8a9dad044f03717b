// The panels of the window: time and pace in a bar above; on the left what the chosen room is about; on the
// right who was asked about.
#pragma once

#include <string>

#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/viewer.h"

namespace flaneur {

// While a city is loaded: what is being done, and what one can do meanwhile.
void lay_out_loading(const std::string& city, const std::string& doing, const char* hint, Size size,
                     float scale);

// The time of day in the city: "17:30:05".
std::string clock_text(const Show& show);

// Says something for a while.
void tell(Viewer& viewer, const std::string& what);

// Lays them out, and changes the viewer as they are used. Between begin_gui() and end_gui().
void lay_out_panels(Show& show, Viewer& viewer, Size size, float scale);

}  // namespace flaneur
