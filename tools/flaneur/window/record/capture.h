// RenderDoc's capture of one of the window's pictures, panels and all.
#pragma once

namespace flaneur {

struct Show;
struct Viewer;

// What keys ask for (window/actions.h): the next picture; where RenderDoc is not loaded, that is told
// instead.
void ask_for_capture(Show& show, Viewer& viewer);

// Right before and after the window's picture is drawn: whether a capture has begun, which is then to be
// ended and told of.
bool begin_asked_capture(Show& show, Viewer& viewer);
void end_asked_capture(Show& show, Viewer& viewer);

}  // namespace flaneur
