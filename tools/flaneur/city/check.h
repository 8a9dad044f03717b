// Whether people can live in a city: what `flaneur city --check` measures.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "assets/city.h"
#include "sim/world.h"
#include "tools/flaneur/options/options.h"

namespace flaneur {

struct Finding {
    std::string name;
    double value = 0;
    double bar = 0;
    bool at_least = false;           // the value has to be the bar or more; else the bar or less
    std::vector<std::string> where;  // the first few places that count against it, and why
    std::optional<double> most{};    // of a band from the bar on
};
bool is_met(const Finding& finding);

// Places of the navigation mesh that lie inside a building: a wall of the same building all round, a metre
// above.
Finding check_buildings(const City& city, const Navmesh& mesh);

// Random places of the mesh, and places to either side of each kerb and step: share where a vertical ray
// meets the drawn triangles within 5 mm of what `ground` says, in percent.
std::vector<Finding> check_drawn(const City& city, const Navmesh& mesh);

// Random pairs of places on sidewalks between which the ground goes on without a ledge higher than a step:
// share that the mesh has a way for, in percent.
Finding check_paths(const City& city, const Navmesh& mesh);

// A world's walkers, of all its kinds, for so long, but for their bodies where nothing else depends on them:
// who was in a wall, off the ground, or stuck for a minute (where they walk for longer), who waits outside
// for room to come in instead of others, and how much of their walking was on roadways more than 3 m from a
// crossing.
Result<std::vector<Finding>> check_crowd(World& world, const City& city, double seconds);

// All of it for the scene's city; prints a table and fails if a bar is missed. Writes the figures to
// options.json if it names a file.
Result<void> check_city(const Options& options);

}  // namespace flaneur
