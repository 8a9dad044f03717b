// The room Find people: who meets what is typed, in a list and in the city.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/scene.h"
#include "tools/flaneur/window/ask/filter.h"

namespace flaneur {

struct Action;
struct Viewer;

struct PeopleSearch {
    char typed[160] = "";
    std::string parsed;  // what `filter` and `refused` are of
    Filter filter;
    std::string refused;  // a sentence, if it cannot be understood
    struct One {
        WalkerFacts facts;
        float away = 0;  // metres from the eye
    };
    std::vector<One> found;           // the nearest first
    std::optional<uint32_t> pointed;  // who is, in the list
    double looked_at = -1e9;          // of the window's time
    bool is_opening = false;          // the field is to be typed in
};

// Looks again, some times a second, while the room is open.
void find_people(const Show& show, Viewer& viewer);
// A ring round each of the nearest, a point over the others.
void mark_found(Show& show, Viewer& viewer, FrameInput& frame);
void lay_out_finding(Show& show, Viewer& viewer, float scale);

std::span<const Action> find_actions();

}  // namespace flaneur
