// Drawing in the room Measure, by mouse and actions.
#pragma once

#include <span>

#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/measure/measure.h"

namespace flaneur {

struct Action;
struct Mouse;
struct Viewer;

// What the left button does in the room. True: it is taken, and means nothing else in this frame.
bool draw_with_mouse(const Show& show, const Mouse& before, const Mouse& now, Size size, bool is_panels,
                     Viewer& viewer);

void take_tool(MarkingKind kind, Viewer& viewer);
// Enough points: it is kept, and its counting begins. Else, or where its outline crosses itself, a note says
// so.
void finish_draft(const Show& show, Viewer& viewer);
// Keeps what is drawn, for going back: it is about to be changed.
void remember(Viewer& viewer);
// The last point of what is not finished; else what was drawn, dragged or removed last.
void undo_drawing(const Show& show, Viewer& viewer);
void redo_drawing(const Show& show, Viewer& viewer);
void remove_selected(const Show& show, Viewer& viewer);
// Lets go of the draft, the tool or what is selected, one at a time. False: there was none of them.
bool abandon_drawing(Viewer& viewer);

// Counts by what is drawn, from now on.
void count_drawn(const Show& show, Viewer& viewer);
// Forgets what was counted, in a run beside this one too.
void count_anew(const Show& show, Viewer& viewer);

// What is written and read.
void write_counts_as_csv(const Show& show, Viewer& viewer);
void write_plan(Viewer& viewer);
void read_plan(const Show& show, Viewer& viewer);
void copy_options(Viewer& viewer);
// "--line L1:.. --zone Z1:..", as a shell takes them.
std::string options_of(const MeasurePlan& plan);

std::span<const Action> measure_actions();

// What is drawn, in the city; its names and numbers, over the picture.
void mark_measures(Show& show, Viewer& viewer, FrameInput& frame);
// Only what is drawn, by these counts: over the picture of a run beside this one, and in films.
void mark_measures_beside(const Viewer& viewer, const Counts& counts, Overlay& overlay, FrameInput& frame);
void lay_out_labels(const Viewer& viewer, Size size, float scale);

// The room's panel.
void lay_out_measures(Show& show, Viewer& viewer, float scale);

}  // namespace flaneur
