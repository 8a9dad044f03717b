// What was counted, as text.
#pragma once

#include <string>

#include "tools/flaneur/measure/count.h"

namespace flaneur {

// A row for each crossing, under a line that names the columns and their units:
// time_s,walker,direction,speed_m_per_s,x_m,z_m. The direction is "right" or "left": where to they cross, of
// one who stands at the line's first end and looks to its last.
std::string line_csv(const LineCount& line);

// A row for each second: time_s,people,density_per_m2,voronoi_density_per_m2,mean_speed_m_per_s. There is no
// speed where there is nobody.
std::string zone_csv(const ZoneCount& zone);

// A sentence on each line and zone, for a terminal: what was counted since it began.
std::string told_counts(const Counts& counts);

// The file of one of them: "out/flow.csv" and "L1" are "out/flow-L1.csv".
std::string csv_path(const std::string& path, const std::string& name);

}  // namespace flaneur
