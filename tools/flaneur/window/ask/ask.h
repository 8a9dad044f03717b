// Asking about what is in the city: people, buildings, what stands in the street, the ground.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "tools/flaneur/window/ask/things.h"

namespace flaneur {

struct Show;
struct Viewer;

struct Asking {
    CityIndex index;                         // of the city that was shown last
    std::optional<Thing> hovered, selected;  // what is no walker
    double still_since = 0;                  // of the window's time: the cursor has rested since then,
    glm::vec2 cursor{0};                     // here
};

// The city's, made when the city is another one.
const CityIndex& index_of(const Show& show, Viewer& viewer);

// What a way from the eye meets first, roofs too; or, where it meets nothing, a place some way off.
glm::vec3 place_under(const Show& show, Viewer& viewer, glm::vec3 way);

}  // namespace flaneur
