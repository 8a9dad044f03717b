// What files of trajectories hold, format by format. Errors' sentences have no subject: "is cut short".
// Private to assets/trajectories, and its tests.
#pragma once

#include <string_view>

#include "assets/trajectories/trajectories.h"

namespace flaneur {

Result<Trajectories> parse_petrack(std::string_view text);
Result<Trajectories> parse_trajectory_csv(std::string_view text);
Result<Trajectories> parse_juelich(std::string_view bytes);
Result<Trajectories> read_jupedsim(const std::string& path);

// Numbers as a file has them: y to the north, and whatever ids and frames it counts. Refuses those that no
// sighting has.
Result<void> add_sighting(Trajectories& to, int64_t frame, int64_t id, double x, double y, double z = 0);

// Sorts by frame and id; refuses somebody twice in a frame, nobody, and rates of frames out of range.
Result<void> settle_trajectories(Trajectories& trajectories);

}  // namespace flaneur
