// Trajectories for other programs, written as they come.
#pragma once

#include <cstdio>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "assets/trajectories/trajectories.h"

namespace flaneur {

// csv: a row each under "frame,time_s,id,x_m,y_m,z_m,facing_x,facing_y". sqlite: JuPedSim's, version 2. text:
// PeTrack's, which PedPy reads. fcd: floating-car data of SUMO, XML. features: moving features of OGC in
// metres, which are kept in memory until all is told, 24 bytes each. steps: Vadere's, from frame to frame.
enum class TrajectoryFormat : uint8_t { csv, sqlite, text, fcd, features, steps };
// By how a name ends; none: by no ending that is known.
std::optional<TrajectoryFormat> trajectory_format_of(std::string_view path);

struct TrajectoryWriter;
struct TrajectoryWriterDelete {
    void operator()(TrajectoryWriter*) const;
};
using TrajectoryWriterPtr = std::unique_ptr<TrajectoryWriter, TrajectoryWriterDelete>;

// Writes to `file`, which is open and empty; SQLite opens it by its name `path` once more. `about`, a line,
// and what heights are of are told where the format has a place for it.
Result<TrajectoryWriterPtr> begin_trajectories(TrajectoryFormat format, FILE* file, const std::string& path,
                                               float fps, const std::vector<WalkablePolygon>& area,
                                               const std::string& about,
                                               HeightsOf heights = HeightsOf::ground);
// All who are there in the next frame, all of one number and larger than the last one's. False where it could
// not be written, as finish_trajectories() then tells.
bool add_frame(TrajectoryWriter& writer, uint32_t frame, std::span<const Sighting> people);
// What of the writing failed; `file` tells what happened to its own.
Result<void> finish_trajectories(TrajectoryWriterPtr writer);

}  // namespace flaneur
