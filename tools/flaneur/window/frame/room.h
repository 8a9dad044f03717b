// The room Frame: what a picture costs.
#pragma once

namespace flaneur {

struct Show;
struct Viewer;

// Of what the window shows.
void copy_bench_command(const Show& show, Viewer& viewer);

void lay_out_frame(Show& show, Viewer& viewer, float scale);

}  // namespace flaneur
