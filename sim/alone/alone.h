// Those who walk by the gait but belong to no crowd: where they are set down, and what the gait is told of
// them.
#pragma once

#include <vector>

#include "sim/crowd/locomotion.h"
#include "sim/gait/gait.h"
#include "sim/ground/ground.h"

namespace flaneur {

// A place on the ground, the highest from a metre above `near` to three below; at that height where there is
// none.
Vec3 set_down(const Ground& ground, Vec2 place, float near);

// Of one tick alone.
struct RootRows {
    std::vector<Vec3> position;
    std::vector<Vec2> velocity, wish;
    std::vector<float> heading, turn_rate, brakes;
};
RootMotion told_of(RootRows& rows);
void keep(RootRows& rows, size_t walker, Vec3 position, const Motion& motion);

// Of walkers that have a `position` and a `motion`; what it points to lasts until the next call.
template <class Walkers>
RootMotion told(const Walkers& walkers, RootRows& rows) {
    rows.position.resize(walkers.size()), rows.velocity.resize(walkers.size());
    rows.wish.resize(walkers.size()), rows.heading.resize(walkers.size());
    rows.turn_rate.resize(walkers.size()), rows.brakes.resize(walkers.size());
    for (size_t i = 0; i < walkers.size(); ++i) keep(rows, i, walkers[i].position, walkers[i].motion);
    return told_of(rows);
}

}  // namespace flaneur
