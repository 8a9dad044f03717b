// What goes along with people, in the room Change.
#pragma once

namespace flaneur {

struct Show;
struct Viewer;

// How many walk dogs, go in wheelchairs and so on; nothing in a world that was made without company.
void lay_out_alongside(Show& show, Viewer& viewer, float scale);

}  // namespace flaneur
