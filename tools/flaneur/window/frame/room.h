// The room Frame: what a picture costs.
#pragma once

namespace flaneur {

struct Show;
struct Viewer;

void lay_out_frame(Show& show, Viewer& viewer, float scale);

}  // namespace flaneur
