// Hands on walls: a palm that trails along the wall beside a slow walk, and rests on it while one stands. And
// hands on canes.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sim/base/spans.h"
#include "sim/gait/gait.h"
#include "sim/ground/surroundings.h"

namespace flaneur {

struct Stepper;

// One tick of `dt` seconds for the hands of walkers [begin, end); comes after advance_gait. Some people touch
// walls, by a style drawn from (seed, walker), and these now and then; whose Manner::touches is 1.5 or more
// at every wall. A hand whose side has a facade or a garden wall within the arm's length goes to its closest
// point, a little ahead, between hip and chest.
//
// Only one hand of a walker reaches, that on the nearer side, never across the body. Its place is on the
// wall's plane while `reach` is near 1, and moves no faster than the walker and 0.6 m/s; `reach` rises and
// falls within some 0.7 s, slowly at both ends. The hand lets go of a wall that ends, turns away, or is
// walked along too fast, and its place then goes along with the walker.
void reach_for_walls(Gait& gait, size_t begin, size_t end, const RootMotion& root, const Surroundings& around,
                     uint64_t seed, uint32_t tick, float dt);

// A tick for a walker's cane, after its feet. The cane goes with the foot of the other side, the left one:
// its tip leaves the ground with it and comes down with it, a little ahead of it on its own side, on the
// ground that is there: on steps that of the left foot. It also steps by itself, where the arm would reach it
// no longer, or beside one who stands. Where no ground is within reach it is carried, a little above what is
// there, and set down as soon as the body has climbed or come down far enough. Who runs or jumps carries it
// too.
void advance_cane(const Gait& gait, Cane& cane, const Stepper& stepper);
// Gives one who stands a cane (see Body::cane), or takes away what it had where that is zero.
void give_cane(Gait& gait, size_t walker, Vec3 tip_hs, const Stepper& stepper);
// The canes of walkers [begin, end), as indices of Gait::canes.
Span canes_of(const Gait& gait, size_t begin, size_t end);

}  // namespace flaneur
