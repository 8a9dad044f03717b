// The panel on the left that changes the city, and what keys do of it.
#pragma once

#include <span>

namespace flaneur {

struct Action;
struct Show;
struct Viewer;

void lay_out_change(Show& show, Viewer& viewer, float scale);

std::span<const Action> change_actions();
// Of the whole city.
void undo_last(Show& show, Viewer& viewer);
void redo_last(Show& show, Viewer& viewer);

}  // namespace flaneur
