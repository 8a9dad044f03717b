// Doors of houses, which are wall to everything else: whoever goes through one goes straight, to where the
// house hides it.
#pragma once

#include "sim/ground/surroundings.h"

namespace flaneur {

struct Door {
    Vec3 at;   // in the plane of the wall, as high as the ground before it
    Vec2 way;  // unit, into the house and square to the wall
};

inline constexpr float k_door_half = 0.4f;   // metres to either side of its middle that people go through it
inline constexpr float k_door_depth = 1.0f;  // behind the wall; there nothing of a body is seen

// The door that one faces who stands at `place`, on the ground. None where it would not go out of sight by
// it: there is no upright wall as high and wide as people close ahead, there is ground behind it, or the
// house is too thin.
std::optional<Door> door_at(const Surroundings& around, Vec3 place, Vec2 facing);

// Metres behind the wall, less than 0 before it; and to a side of the middle, either.
float depth_in(const Door& door, Vec2 place);
float aside_in(const Door& door, Vec2 place);

// Where one comes to who goes from one place to another by the door: no farther to its side than it was, not
// into the wall beside it, and not deeper into the house than is_within says.
Vec3 kept_in_line(const Door& door, Vec3 from, Vec3 to);

// Whether a place on the ground is on the straight way by the door, from before the wall to out of sight.
bool is_within(const Door& door, Vec3 place);

// What feet and hands find of one who goes by a door: beside what is there, a floor behind it that is level
// with the threshold, and no walls.
struct Indoors {
    Surroundings around;
    Door door;
};
Surroundings surroundings_of(const Indoors& indoors);  // which must outlive what asks

}  // namespace flaneur
