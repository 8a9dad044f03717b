// The bipeds of sim/stepper as a world's walkers: each is a walker of the crowd, which is told where it is.
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
    Bipeds bipeds;        // by WalkerId::index
    std::array<BipedOrders, 1> orders;
    std::vector<std::vector<Vec2>> ways;
};

// Sets everybody down on a course, each with 0.8 of the speed that it prefers. Refuses more than find room.
Result<void> set_on_course(World& world, StepCourse course);
// The course that they are on.
StepCourse course_of(const World& world);

// One tick of them, in the place of thinking, steering, moving and gait. Who is driven (sim.h) is so here
// too.
void drive_steppers(World& world);

// From now on all look there who can turn their heads so far; nobody does without.
void look_at(World& world, std::optional<Vec3> place);
// From now on who is driven goes there, without a goal by Driven::wish.
void go_to(World& world, std::optional<Vec3> goal);

uint64_t hash_bipeds(const Stepping& stepping);

}  // namespace flaneur
