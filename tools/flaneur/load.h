// From options to a city with people in it.
#pragma once

#include <memory>
#include <vector>

#include "assets/character.h"
#include "sim/base/result.h"
#include "sim/world.h"
#include "tools/flaneur/options.h"

namespace flaneur {

struct Loaded {
    std::unique_ptr<World> world;
    std::vector<Character> characters;  // one for each of the world's bodies
};

// Says on stderr what an import skipped or repaired and, on a terminal, how far it is.
Result<Loaded> load(const Options& options);

// The city of a scene, as load() makes it, without anybody in it.
Result<City> read_city(const Scene& scene);

// Where people can walk in it: as an earlier run kept it, or built.
Result<NavmeshPtr> load_navmesh(const City& city, int threads);

// Refuses in a sentence; says on stderr what was repaired.
Result<Character> read_character(const std::string& path);

// Makes people, in the order of `options`, on so many threads; 0: one a core.
std::vector<Character> make_people(const std::vector<PersonOptions>& options, int threads);

// A line on stderr that the next one replaces; nothing where stderr is not a terminal.
void show_progress(const std::string& line);
void clear_progress();

}  // namespace flaneur
