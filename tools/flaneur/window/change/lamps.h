// Traffic and its lights, in the room Change.
#pragma once

namespace flaneur {

struct Show;
struct Viewer;

// How many go on red, of all to nobody; nothing where there are no lamps.
void lay_out_lamps(Show& show, Viewer& viewer, float scale);
// How many drive; nothing where nobody can.
void lay_out_traffic(Show& show, Viewer& viewer, float scale);

}  // namespace flaneur
