// Moving as in maps and 3D programs: towards what is under the cursor, along with it, and round it.
#pragma once

#include <optional>

#include "sim/world.h"
#include "tools/flaneur/window/gui.h"
#include "tools/flaneur/window/input.h"

namespace flaneur {

// What a way from the eye meets: ground or a wall, or, where it meets nothing, a place some way off.
glm::vec3 place_along(const World& world, const Camera& camera, glm::vec3 way);

// Nearer to a place by so many notches of a wheel, or away from it; never through it.
void zoom(glm::vec3 place, float notches, Viewer& viewer);

// So that a place that was under the cursor is under it again, as far away as it was; `from` and `to` are
// pixels.
void pan(glm::vec3 place, glm::vec2 from, glm::vec2 to, Size size, Viewer& viewer);

// Round the upright line through a place, and over or under it, by so many pixels.
void orbit(glm::vec3 place, glm::vec2 pixels, Viewer& viewer);

// What a hand does with the mouse: the wheel zooms, or pans to the side, the middle button pans, the right
// one orbits what it took hold of. Of a map the left one pans too, and the right one turns it. Tells whether
// the eye has moved.
struct Grip {
    std::optional<glm::vec3> place;
};
bool navigate(const World& world, const Mouse& before, const Mouse& now, Wheel wheel, Size size, Grip& grip,
              Viewer& viewer);

}  // namespace flaneur
