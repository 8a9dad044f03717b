// What people do who stay, in the room Change.
#pragma once

namespace flaneur {

struct Show;
struct Viewer;

// How many sit, lean, use phones, look into windows and line up; nothing where nobody has places to go to.
void lay_out_pastimes(Show& show, Viewer& viewer, float scale);

}  // namespace flaneur
