// Density, speed and flow of people whose ways are known, as PedPy measures them; cells after B. Steffen, A.
// Seyfried, Physica A 389, 2010.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "assets/trajectories/trajectories.h"
#include "sim/ground/rectangle.h"

namespace flaneur {

// At one moment in a measuring area.
struct FlowSample {
    double seconds = 0;
    uint32_t people = 0;
    double classic = 0;     // people to a square metre, counted
    double density = 0;     // the same by Voronoi cells, which the walkable area and 3 m cut
    double speed = 0;       // m/s, of those whose cells reach in, by how much of the area they have
    double mean_speed = 0;  // of those inside; 0: nobody is
};

// Of the frames nearest to every `every` seconds, from `first` to `last`. Speeds are those over 0.4 s about a
// frame. Moments when nobody's cell reaches in are left out.
std::vector<FlowSample> flow_samples(const Trajectories& tracks, const Rectangle& zone, double every,
                                     double first, double last);

// When anybody crosses the line x = `x` to the east, seconds, in order.
std::vector<double> crossings_at(const Trajectories& tracks, float x);

struct MeanFlow {
    double classic = 0, density = 0, speed = 0, mean_speed = 0;
    size_t samples = 0;
};
MeanFlow mean_of(std::span<const FlowSample> samples);

}  // namespace flaneur
