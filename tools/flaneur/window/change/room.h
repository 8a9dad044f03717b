// The panel on the left that changes the city, and what keys do of it.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace flaneur {

struct Action;
struct Change;
struct Show;
struct Viewer;

// What a click does, and of a row of barriers what it closes and how broad that is; "": it asks.
std::string armed_tool(const Show& show, const Change& change);
void lay_out_change(Show& show, Viewer& viewer, float scale);

// A slider of a share that the simulation goes on with at once; whether it was moved.
bool slide_share(const char* name, float& share, float scale);
// After a slider: its drag is undone as one.
uint64_t gesture_of_item(Change& change);

std::span<const Action> change_actions();
// Of the whole city.
void undo_last(Show& show, Viewer& viewer);
void redo_last(Show& show, Viewer& viewer);

}  // namespace flaneur
