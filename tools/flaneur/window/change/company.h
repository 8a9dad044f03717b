// People who go with others, in the room Change.
#pragma once

namespace flaneur {

struct Show;
struct Viewer;

// How many of those who come in do so in groups, and how many know each other; nothing where nobody goes with
// anybody.
void lay_out_company(Show& show, Viewer& viewer, float scale);

}  // namespace flaneur
