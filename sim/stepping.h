// The bipeds of sim/stepper as some or all of a world's walkers: the crowd is told where they are, makes way
// for them, and finds them down where a push has felled them.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "sim/stepper/stepper.h"
#include "sim/world.h"

namespace flaneur {

// Ground, what moves on it, and the closed lines that people go along there.
struct StepCourse {
    std::shared_ptr<const Ground> ground;
    std::vector<Mover> movers;
    std::vector<std::vector<Vec2>> ways;
    bool is_flat = false;  // see Bipeds
};

struct Stepping {
    std::shared_ptr<const Ground> ground;
    MovingGround moving;  // that, and the world's movers
    Bipeds bipeds;
    std::array<BipedOrders, 1> orders;
    std::vector<std::vector<Vec2>> ways;
    bool is_everybody = true;  // nobody else is there
};

// Sets everybody down on a course, each with 0.8 of the speed that it prefers. Refuses more than find room.
Result<void> set_on_course(World& world, StepCourse course);
// The course that they are on.
StepCourse course_of(const World& world);
// Of a crowd, lets so many go along closed lines on the world's own ground: the first who have both hands
// free and neither stagger nor are children below 10, fewer where there are fewer. Refuses more than find
// room.
Result<void> let_step(World& world, uint32_t count, std::vector<std::vector<Vec2>> ways);

// One tick of them, after the crowd has moved; who is down is left where it lies. Who is driven (sim.h) is so
// here too.
void step_those_who_step(World& world);
// Who has been pushed answers by steps.
void shove(World& world, uint32_t walker, Vec2 change);
// Whether one that is pushed over has ground on all sides to fall on, from which it finds back: else it holds
// its own.
bool can_fall(const World& world, uint32_t walker);

// Whether everybody is on a course, or this one steps now.
// Whether a place is not far off the way of one who steps, or no farther than it is already.
bool is_by_way(const World& world, uint32_t walker, Vec3 place);
inline bool is_on_course(const World& world) { return world.stepping && world.stepping->is_everybody; }
bool is_stepping(const World& world, uint32_t walker);

// From now on all look there who can turn their heads so far; nobody does without.
void look_at(World& world, std::optional<Vec3> place);
// From now on who is driven goes there, without a goal by Driven::wish.
void go_to(World& world, std::optional<Vec3> goal);

uint64_t hash_bipeds(const Stepping& stepping);

}  // namespace flaneur
