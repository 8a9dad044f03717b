// How the street lives, in the room Change: lamps, what people do who stay, what goes along with them.
#pragma once

namespace flaneur {

struct Show;
struct Viewer;

// Each says nothing where the world has nothing of it. How many go on red, of all to nobody:
void lay_out_lamps(Show& show, Viewer& viewer, float scale);
// how many drive;
void lay_out_traffic(Show& show, Viewer& viewer, float scale);
// how many sit, lean, use phones, look into windows and line up;
void lay_out_pastimes(Show& show, Viewer& viewer, float scale);
// how many of those who come in are in groups, and how many know each other;
void lay_out_company(Show& show, Viewer& viewer, float scale);
// how many walk dogs, go in wheelchairs and so on.
void lay_out_alongside(Show& show, Viewer& viewer, float scale);

}  // namespace flaneur
