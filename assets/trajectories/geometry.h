// Where people can be, from files that lie beside their ways: well-known text, geometry of JuPedSim's jpscore
// (XML), nets of SUMO, scenarios of Vadere, floors of crowd:it. Private to assets/trajectories, its tests and
// fuzzing.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "assets/trajectories/trajectories.h"

namespace flaneur {

struct WalkableGeometry {
    std::vector<WalkablePolygon> area;
    std::vector<std::vector<Vec2>> walls;
    std::vector<std::string> assumed;
    double seconds_a_step = 0;  // of Vadere's scenarios; 0: not told
};

// By what is in it. Errors' sentences have no subject.
Result<WalkableGeometry> parse_geometry(std::string_view text);
Result<WalkableGeometry> parse_jps_geometry(std::string_view xml);
Result<WalkableGeometry> parse_sumo_net(std::string_view xml);
Result<WalkableGeometry> parse_floor(std::string_view xml);
Result<WalkableGeometry> parse_vadere_scenario(std::string_view json);

// The file beside `path` whose name ends so and that is the one `mentioned`, mentions `path`, or fits it by
// its name; empty: none does.
std::string geometry_beside(const std::string& path, std::string_view ending, std::string_view mentioned);

}  // namespace flaneur
