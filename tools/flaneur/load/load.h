// From options to a city with people in it.
#pragma once

#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "assets/character.h"
#include "assets/cities.h"
#include "sim/base/result.h"
#include "sim/stepping.h"
#include "sim/world.h"
#include "tools/flaneur/options/options.h"

namespace flaneur {

struct Loaded {
    std::shared_ptr<const City> city;  // whose ground the world stands on
    std::shared_ptr<const City> bare;  // before anything was added to it; the same one where nothing was
    std::unique_ptr<World> world;
    std::vector<Character> characters;  // one for each of the world's bodies
    // Of each character: the file that it is from, and which part of those from there it usually is.
    std::vector<PeopleShare> parts;
    std::vector<std::string> sent_names;  // what the demand calls each of the world's sendings
};

// What another run with the same characters is made of, apart from the one that goes on meanwhile.
struct PeopleOrder {
    WorldOptions options;
    std::shared_ptr<const Ground> ground;
    std::string mesh;  // bytes of the ground's navmesh: one is a world's own
    std::optional<Compound> compound;
    Gravity gravity;                // of it,
    uint32_t creatures = 0;         // on it or among people
    std::vector<Linkage> linkages;  // without it,
    std::vector<FigurePlan> figures;
    std::shared_ptr<const Traces> traces;  // that they follow, or null
    std::vector<Mover> movers;
    std::vector<DoerPlan> doers;
    Things things;
    std::shared_ptr<const Ground> deed_ground;
    size_t first_deed_mover = 0;
    std::shared_ptr<const Ground> figure_ground;
    std::optional<StepCourse> course;              // that they are on, or none
    std::vector<std::vector<Vec2>> steppers_ways;  // that some of them step along
    uint32_t steppers = 0;
};
// Of a scene that is_recorded(). Says what was assumed.
Result<std::shared_ptr<const Trajectories>> read_recorded(const Scene& scene);
// The tick of their last frame, from that of the first one.
uint32_t last_tick_of(const Trajectories& recorded);

// So many people in the same city, set down and led by that seed, as of the hour at which it began.
PeopleOrder order_people(const Loaded& loaded, uint64_t seed, uint32_t walkers);
// On any thread. `progress` as make_world() calls it; where it answers false, the people are given up with an
// error.
Result<std::unique_ptr<World>> make_people(const PeopleOrder& order,
                                           const std::function<bool(std::string_view, float)>& progress = {});

// The part of all walkers that each character has by a scene's people and mix.
std::vector<float> shares_of(const std::vector<PeopleShare>& people, const PeopleMix& mix,
                             const std::vector<Character>& characters, const std::vector<PeopleShare>& parts);
// Of a world that is to be made.
void set_shares(WorldOptions& options, const std::vector<float>& shares);
// From now on those who come are drawn by these.
void set_shares(World& world, const std::vector<float>& shares);

// The files that a scene names; some are "".
std::vector<std::string> files_of(const Scene& scene);

// Refuses a scene that names a file which is not there: in no time, before anything is read.
Result<void> find_files(const Scene& scene);

// Says on stderr what an import skipped or repaired and, on a terminal, how far it is.
Result<Loaded> load(const Options& options);

// What its city is called: after its file or, built in, after the scene.
std::string city_name(const Scene& scene);

// Whether the scene's city is the built-in district, which grows with the walkers; and how many blocks of
// houses it has along each side then.
bool grows_with_walkers(const Scene& scene);
int district_blocks(const Scene& scene);

// What a scene says of its city; how far it is comes on the terminal.
CityOptions city_options(const Scene& scene);

// The city of a scene, as load() makes it, without anybody in it; and before anything is added to it.
Result<City> read_city(const Scene& scene);
Result<City> read_bare_city(const Scene& scene);

// Refuses in a sentence; says on stderr what was repaired.
Result<Character> read_character(const std::string& path, bool force);

// Makes people, in the order of `options`, on so many threads; 0: one a core. Fails only when interrupted.
Result<std::vector<Character>> make_people(const std::vector<PersonOptions>& options, int threads);

}  // namespace flaneur
