// What has been changed of a city, as one thing that is done, undone and saved.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/scene.h"
#include "sim/linkages/linkages.h"

namespace flaneur {

struct Design {
    std::vector<Addition> added{};
    float hour = 17.5f;     // of the day, that was set last,
    uint32_t hour_set = 0;  // and at which tick
    bool is_overcast = false;
    uint32_t people = 0;
    std::vector<PeopleShare> who{};  // as Scene::people
    PeopleMix mix{};
    std::vector<HeldTarget> held{};  // as Linkages::held
    std::vector<Method> methods{};   // as Linkages::methods
    std::vector<Vec2> platform{};    // its corners; none: they are on no platform
    bool operator==(const Design&) const = default;
};

// One after the other; `at` is the one that holds.
struct Designs {
    std::vector<Design> all = {Design()};
    size_t at = 0;
    uint64_t gesture = 0;               // of the last change
    std::vector<uint64_t> deeds = {0};  // by design: the deed that led to it; see Viewer::deeds
};

inline const Design& current(const Designs& designs) { return designs.all[designs.at]; }

// From now on it is another; what was undone is forgotten. Changes of one gesture, such as the drag of a
// slider, are undone together; gestures are numbered from 1, and 0 is one by itself.
void change(Designs& designs, Design next, uint64_t gesture = 0);
// False if there is nothing to undo, or to do again.
bool undo(Designs& designs);
bool redo(Designs& designs);
// Takes back the last change as if it had not been: it turned out to be impossible.
void give_up(Designs& designs);

// The scene that was opened, with a design in place of its own. The sun stands where the hour has it, unless
// that is the scene's.
Scene scene_with(Scene opened, const Design& design);

// Of the ground plane, about both outlines and a little more.
Rectangle area_about(const std::vector<Vec2>& a, const std::vector<Vec2>& b);

// What differs between the two, as areas of the ground plane.
std::vector<Rectangle> changed_areas(const std::vector<Addition>& a, const std::vector<Addition>& b);

}  // namespace flaneur
