#include <cstdlib>

#include "assets/files/words.h"
#include "tools/flaneur/options/commands.h"
#include "tools/flaneur/options/refusal.h"

namespace flaneur {
namespace {

constexpr const char* k_people_footer =
    R"(Prints who they are: age, height and triangles of each. The files are skinned on 22 joints with VRM's names.
A cell of a sheet shows one person twice: with its arms held out, and in the middle of a step; --close shows its face.
Examples:
  flaneur people --count 24 --seed 1 --sheet out/people.png    pictures of 24 of the built-in people
  flaneur people --count 24 --seed 1 --out out/people          the same people as out/people/person_01.glb, ...
  flaneur people --count 6 --close --size 800x500 --sheet out/faces.png
  flaneur people --turn 180 --sheet out/backs.png              all of them from behind
  flaneur people --character me.glb --character you.glb --sheet out/us.png)";

constexpr const char* k_inspect_footer =
    R"(Of a character: which node of the file each joint was taken from, size, facing, triangles, animations and what was
repaired. Of a map: where on Earth it is, what of it render draws, ground and houses, what it has beside what was built
of it, and what was skipped. Of everybody's ways (docs/trajectories.md says which are read): people, frames, extents, speed,
heights, ground, and what was assumed.
Refuses, in a sentence, what cannot be used.
Examples:
  flaneur inspect me.glb
  flaneur inspect berlin.osm.pbf --json out/berlin.json
  flaneur inspect bottleneck.txt
  flaneur inspect monaco.osm.pbf --terrain N43E007.hgt.zip
  flaneur inspect berlin.osm.pbf --center 52.5163,13.3777 --radius 800)";

constexpr const char* k_city_footer =
    R"(--check says whether people can live there: nothing walkable inside buildings, the ground as it is drawn, ways between
sidewalks, and a crowd that nothing stops; it fails where a bar is missed.
--out writes what is drawn, but for what shaders add, in metres, +y up: grouped into ground, facades, roofs
and props, with materials named road, sidewalk, facade and so on. Names and slopes are all that it takes to read it
back as --city FILE.glb.
Examples:
  flaneur city --out out/district.glb
  flaneur city --city berlin.osm.pbf --out out/berlin.glb
  flaneur city --city berlin.osm.pbf --check --walkers 2000 --seconds 300)";

constexpr const char* k_scenes_footer =
    R"(A scene is a JSON file that says what to simulate and from where to look; what the command line says goes before it.
docs/scenes.md tells all its keys, and so does the schema.
Examples:
  flaneur scenes                                           the built-in ones
  flaneur scenes --check mine.json yours.json              what is wrong in them
  flaneur scenes --schema > scene.schema.json              in a scene: "$schema": "scene.schema.json")";

constexpr const char* k_cache_footer =
    R"(Navigation meshes and built-in people are kept between runs in $XDG_CACHE_HOME/flaneur, or ~/.cache/flaneur, and are
the same as those made anew. They take 1024 MiB at most, or as many as FLANEUR_CACHE_MAX says; those that were used least
recently go first. With --no-cache a command neither reads nor keeps any.
Examples:
  flaneur cache                where they are, and how much
  flaneur cache --clear        remove them
  FLANEUR_CACHE_MAX=200 flaneur view
  flaneur render --no-cache --out out/city.png)";

}  // namespace

void add_people(CLI::App& app, SceneWords& words, Options& options) {
    PeopleOptions& people = options.people;
    CLI::App* command =
        app.add_subcommand("people", "Make people: as files, as pictures")->footer(k_people_footer);
    command->callback([&] { options.command = Command::people; });
    command->add_option("--count", people.count, "How many of the built-in people")
        ->type_name("N")
        ->transform(whole_between(1, 1000))
        ->capture_default_str();
    add_parsed(*command, "--seed", parse_seed, words.seed, "Another seed makes other people", "S", "1");
    add_characters(*command, words,
                   "A skinned humanoid to show instead, or builtin to show both; may be given several times",
                   "FILE");
    add_force(*command, options);
    command->add_option("--out", people.folder, "Write them as person_01.glb and so on")->type_name("FOLDER");
    CLI::Option* sheet = command->add_option("--sheet", people.sheet, "Draw them, a .png")->type_name("FILE");
    command->add_flag("--close", people.close, "Draw their faces")->needs(sheet);
    command->add_option("--turn", people.turn, "Turn them to their left, so that 180 shows their backs")
        ->type_name("DEGREES")
        ->needs(sheet)
        ->check(number_between(-360.0, 360.0))
        ->capture_default_str();
    add_parsed(*command, "--size", parse_size, people.cell, "Pixels of each one's cell of the sheet", "WxH",
               "480x400")
        ->needs(sheet);
    command->add_option("--device", options.device, "Part of the name of a Vulkan device, or its number")
        ->needs(sheet)
        ->type_name("NAME");
    command
        ->add_flag("--validate", options.validate, "Fail if the Khronos validation layer has anything to say")
        ->needs(sheet);
    add_threads_option(*command, options, "Threads that make people; 0: one a core");
}

void add_inspect(CLI::App& app, SceneWords& words, Options& options) {
    CLI::App* command =
        app.add_subcommand("inspect", "Say what is found in a character, a map or a file of people's ways")
            ->footer(k_inspect_footer);
    command->callback([&] { options.command = Command::inspect; });
    command
        ->add_option("file", options.file,
                     "A character (.glb, .gltf, .vrm), a map (.osm, .osm.pbf) or trajectories")
        ->type_name("FILE")
        ->required();
    command->add_option("--terrain", words.terrain, "Heights of the ground under a map, as render takes them")
        ->type_name("FILE");
    add_map_options(*command, words);
    add_force(*command, options);
    add_reading_options(*command, options.reading);
    command->add_option("--json", options.json, "Write it to a file too")->type_name("FILE");
}

void add_city(CLI::App& app, SceneWords& words, Options& options) {
    CLI::App* city = app.add_subcommand("city", "Write a city to a file, or check it")->footer(k_city_footer);
    city->callback([&] { options.command = Command::city; });
    add_place_options(*city, words);
    CLI::Option_group* what = city->add_option_group("What to do");
    what->add_option("--out", options.out, "Write what is drawn, a .glb; - is standard output")
        ->type_name("FILE");
    CLI::Option* check =
        what->add_flag("--check", options.check,
                       "Fail if what is drawn, walked on and found ways through differ, or people get stuck");
    what->require_option(1);
    add_walking_options(*city, words, options);
    // A city that is written has nobody in it.
    for (const char* name : {"--walkers", "--time", "--weather", "--side", "--stay", "--threads"})
        city->get_option(name)->needs(check);
    city->add_option(
            "--seconds", options.seconds,
            "How long they walk in a check, in simulated time: more than a minute shows who gets stuck")
        ->needs(check)
        ->type_name("T")
        ->check(number_between(1.0, 1e6))
        ->capture_default_str();
    city->add_option("--json", options.json, "Write what a check finds to a file too")
        ->needs(check)
        ->type_name("FILE");
}

void add_scenes(CLI::App& app, Options& options) {
    CLI::App* scenes = app.add_subcommand("scenes", "List the built-in scenes, or check scene files")
                           ->footer(k_scenes_footer);
    scenes->callback([&] { options.command = Command::scenes; });
    CLI::Option* check =
        scenes
            ->add_option("--check", options.scene_files,
                         "Say what is wrong in scene files, by line and column; fail if anything is")
            ->type_name("FILE...")
            ->take_all();
    scenes->add_flag("--schema", options.schema, "Print the JSON schema of scene files, for editors")
        ->excludes(check);
}

void add_cache(CLI::App& app, Options& options) {
    // What commands keep: they have --no-cache.
    for (CLI::App* command : app.get_subcommands({})) {
        command->add_flag_callback(
            "--no-cache", [] { setenv("FLANEUR_CACHE_MAX", "0", 1); },
            "Neither read nor keep what is kept between runs; see flaneur cache --help");
    }
    CLI::App* cache =
        app.add_subcommand("cache", "Say what is kept between runs, or remove it")->footer(k_cache_footer);
    cache->callback([&] { options.command = Command::cache; });
    cache->add_flag("--clear", options.clear_cache, "Remove it");
}

}  // namespace flaneur
