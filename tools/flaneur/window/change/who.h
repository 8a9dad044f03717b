// Who comes into the city from now on: how many of each sort, against what is usual.
#pragma once

#include <span>

namespace flaneur {

struct Action;
struct Show;
struct Viewer;

// In the room Change.
void lay_out_who(Show& show, Viewer& viewer, float scale);

std::span<const Action> who_actions();

}  // namespace flaneur
