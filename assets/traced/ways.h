// From points to people: what was recorded of where they were, as ways that bodies can walk.
#pragma once

#include <string>
#include <vector>

#include "assets/scene.h"
#include "assets/trajectories/trajectories.h"
#include "sim/traced/traced.h"

namespace flaneur {

struct WaysFigures {
    uint32_t people = 0, ways = 0, bridged = 0, jumps = 0, strays = 0;  // strays: left out, as single spots
                                                                        // that lie far off the others
    uint32_t not_people = 0;  // ids that are no persons, and have no ways
    double sways = 0;         // 0..1, how many of all sightings are of heads that sway
    // Metres, from where they are to where they were recorded: 95 % are nearer; the farthest. With the sway
    // of heads taken out, and as recorded.
    float near = 0, farthest = 0, near_raw = 0, farthest_raw = 0;
};
struct RecordedWays {
    Traces traces;
    WaysFigures figures;
};

// Ways of all persons, from the first frame that anybody is in. Who is missing for k_bridged seconds or less,
// or two and a half times as long as it usually is from one sighting to the next, has one way; who is so for
// longer, or is where nobody gets so soon (faster than k_fastest, and half a metre), leaves and comes again.
// A recording of one frame is a picture, in which everybody stands for k_picture seconds.
RecordedWays make_ways(const Trajectories& recorded, Entering how = Entering::fade, uint64_t seed = 1);
inline constexpr double k_bridged = 2, k_picture = 10;  // seconds
inline constexpr double k_fastest = 9;                  // m/s

// Two sentences on them: who they are, and how near to what was recorded.
std::vector<std::string> told(const WaysFigures& figures);

}  // namespace flaneur
