// What the left button does in a city that is changed: it puts things down, draws walls and barriers, and
// moves what has been put down before.
#pragma once

#include <optional>
#include <span>

#include "renderer/scene.h"
#include "sim/base/vec.h"
#include "tools/flaneur/options/options.h"

namespace flaneur {

struct Addition;
struct Ground;
struct Mouse;
struct Show;
struct Viewer;

// Whether the button, a click of it too, is taken so; else it looks about and asks.
bool take_mouse(const Show& show, const Mouse& before, const Mouse& now, Size size, bool is_panels,
                Viewer& viewer);

// Whether a wall or barrier of which one end was clicked is given up.
bool abandon_line(Viewer& viewer);

// Whether a click puts something down, whoever stands there.
bool is_putting(const Viewer& viewer);

// Adds to the frame, on a map, where it is hardly seen, the outlines of what was put down.
void mark_added(const Viewer& viewer, Show& show, FrameInput& frame);
// The same; in the room Change anywhere, and of what is moved or chosen, or would be put down, too.
void mark_changes(const Viewer& viewer, Show& show, FrameInput& frame);

// A row of barriers from wall to wall over a place, the shortest way; none where a street is wider than 60 m,
// or a square than 20 m.
std::optional<Addition> closure_at(const Ground& ground, Vec3 place);

// What a row of barriers lies across, in a word: "street" where there is a carriageway, "yard" where there is
// nothing but grass.
const char* crossed_by(const Ground& ground, const Addition& row);

// The number of the addition that a place on the ground lies on, or next to.
std::optional<size_t> addition_at(std::span<const Addition> added, Vec3 place);

// What is done to the one that is chosen.
void turn_selected(Viewer& viewer, float degrees);
void remove_selected(Viewer& viewer);

}  // namespace flaneur
