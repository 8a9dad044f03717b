// Time to collision: when two people, as discs, would first touch if both went on as they go. I. Karamouzas,
// B. Skinner, S. J. Guy, Universal power law governing pedestrian interactions, Physical Review Letters 113,
// 238701, 2014.
#pragma once

#include <span>
#include <vector>

#include "assets/measures/tracks.h"
#include "sim/base/parallel_for.h"

namespace flaneur {

inline constexpr float k_disc_radius = 0.2f;  // metres, as JuPedSim's people have it unless told otherwise

// Of discs `apart` from each other, the second one going by `velocity` as the first one sees it, whose radii
// sum up to `reach`: the smaller root of |apart + velocity t| = reach, seconds. 0: they touch already;
// infinite: they never will.
float time_to_collision(Vec2 apart, Vec2 velocity, float reach);

// One a sighting: the least time to collision with anybody who is there in that frame, infinite where there
// is none, NaN where one's own velocity is not known; and with whom.
struct NextCollision {
    float seconds = 0;
    uint32_t with = 0;  // id; one's own: nobody
};
std::vector<NextCollision> next_collisions(const TrackTable& table, std::span<const Vec2> velocities,
                                           float radius, FrameRange range, Workers& workers);

}  // namespace flaneur
