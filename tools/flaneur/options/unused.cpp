#include "tools/flaneur/options/unused.h"

#include <algorithm>
#include <initializer_list>

#include "assets/files/file.h"

namespace flaneur {

namespace {

struct UselessWhere {
    Command command;
    std::initializer_list<const char*> options;
    bool (*is_useless)(const Options& options);
    const char* why;
};

bool has_place(const GaitOptions& gait) {
    return gait.turn != 0 || !gait.stairs.empty() || gait.slope != 0 || gait.kerb != 0 || gait.leap != 0;
}

bool is_file(const PeopleShare& people) { return !people.character.empty(); }

bool has_no_file(const Options& options) {
    return std::none_of(options.scene.people.begin(), options.scene.people.end(), is_file);
}
constexpr const char* k_force = "is for files: give one with --character";

bool has_built_in(const Options& options) {
    const std::vector<PeopleShare>& people = options.scene.people;
    return people.empty() || !std::all_of(people.begin(), people.end(), is_file);
}

const UselessWhere k_useless[] = {
    {Command::bench,
     {"--scene",   "--city",    "--center",    "--radius",  "--terrain", "--scale",    "--seed",
      "--idle",    "--walkers", "--time",      "--weather", "--side",    "--stay",     "--demand",
      "--lod",     "--threads", "--character", "--force",   "--device",  "--validate", "--size",
      "--quality", "--light",   "--camera",    "--fov",     "--frames",  "--warm-up",  "--move",
      "--count",   "--out",     "--json",      "--trace",   "--isa"},
     [](const Options& o) { return o.load == BenchLoad::compare; },
     "is not for bench compare, which measures nothing"},
    {Command::bench,
     {"--scene", "--city", "--center", "--radius", "--terrain", "--scale", "--seed", "--idle", "--time",
      "--weather", "--side", "--stay", "--demand", "--walkers", "--threads", "--frames", "--warm-up",
      "--character", "--force"},
     [](const Options& o) { return o.load == BenchLoad::ik; },
     "is not for bench ik, which solves the same everywhere"},
    {Command::bench,
     {"--tolerance"},
     [](const Options& o) { return o.load != BenchLoad::compare; },
     "is for bench compare"},
    {Command::bench,
     {"files"},
     [](const Options& o) { return o.load != BenchLoad::compare; },
     "are for bench compare"},
    {Command::bench,
     {"--out", "--count"},
     [](const Options& o) { return o.load != BenchLoad::peers; },
     "is for bench peers"},
    {Command::bench,
     {"--walkers"},
     [](const Options& o) { return o.load != BenchLoad::sweep && !is_single(o.study.walkers); },
     "is one number here: a range, FIRST:LAST, is for bench sweep"},
    {Command::bench,
     {"--walkers"},
     [](const Options& o) { return o.load == BenchLoad::sweep && is_single(o.study.walkers); },
     "is a range for bench sweep, such as 100:100000"},
    {Command::bench,
     {"--record", "--record-as", "--record-error"},
     [](const Options& o) { return o.load != BenchLoad::tick; },
     "is for bench tick"},
    {Command::bench,
     {"--steps"},
     [](const Options& o) { return o.load != BenchLoad::sweep; },
     "is for bench sweep"},
    {Command::bench,
     {"--svg"},
     [](const Options& o) {
         return o.load != BenchLoad::sweep && o.load != BenchLoad::scale && o.load != BenchLoad::ablate;
     },
     "is for bench sweep, bench scale and bench ablate"},
    {Command::bench,
     {"--quick", "--html", "--others", "--markdown"},
     [](const Options& o) { return o.load != BenchLoad::gauntlet; },
     "is for bench gauntlet"},
    {Command::bench,
     {"--others"},
     [](const Options& o) { return o.study.html.empty(); },
     "is shown on a page: say --html FILE too"},
    {Command::bench,
     {"--scene",   "--city",    "--center",  "--radius",  "--terrain", "--scale",  "--seed",
      "--idle",    "--walkers", "--time",    "--weather", "--side",    "--stay",   "--demand",
      "--threads", "--frames",  "--warm-up", "--size",    "--quality", "--camera", "--fov"},
     [](const Options& o) { return o.load == BenchLoad::gauntlet; },
     "is not for bench gauntlet, which plays the same everywhere"},
    {Command::bench,
     {"--isa"},
     [](const Options& o) {
         return o.load != BenchLoad::crowd && o.load != BenchLoad::tick && o.load != BenchLoad::frame &&
                o.load != BenchLoad::sweep && o.load != BenchLoad::scale;
     },
     "is for bench crowd, bench tick, bench frame, bench sweep and bench scale; bench pose measures each"},
    {Command::bench,
     {"--move"},
     [](const Options& o) { return o.load != BenchLoad::frame; },
     "is for bench frame"},
    {Command::bench,
     {"--warm-up"},
     [](const Options& o) { return o.load == BenchLoad::window || o.load == BenchLoad::peers; },
     "is not for bench window and bench peers, which step nobody ahead"},
    {Command::bench,
     {"--quality"},
     [](const Options& o) {
         return o.load != BenchLoad::frame && o.load != BenchLoad::window && o.load != BenchLoad::sweep &&
                o.load != BenchLoad::ablate;
     },
     "is for bench frame, bench window, bench sweep and bench ablate"},
    {Command::bench,
     {"--camera"},
     [](const Options& o) {
         const bool is_of_tick =
             o.load == BenchLoad::tick && o.scene.camera.kind == CameraChoice::Kind::fixed;
         return o.load != BenchLoad::frame && o.load != BenchLoad::window && o.load != BenchLoad::sweep &&
                o.load != BenchLoad::ablate && !is_of_tick;
     },
     "is for bench frame, bench window, bench sweep and bench ablate, and as EX,EY,EZ/TX,TY,TZ for bench "
     "tick"},
    {Command::bench,
     {"--lod"},
     [](const Options& o) {
         return o.load != BenchLoad::frame && o.load != BenchLoad::window && o.load != BenchLoad::tick;
     },
     "is for bench tick, bench frame and bench window: other loads measure everybody in full"},
    {Command::bench,
     {"--size", "--device", "--validate", "--light"},
     [](const Options& o) {
         return o.load != BenchLoad::frame && o.load != BenchLoad::window && o.load != BenchLoad::peers &&
                o.load != BenchLoad::sweep && o.load != BenchLoad::ablate && o.load != BenchLoad::gauntlet;
     },
     "is for loads that draw: frame, window, peers, sweep, ablate and gauntlet"},
    {Command::bench,
     {"--scene", "--city", "--center", "--radius", "--terrain", "--scale", "--seed", "--idle", "--walkers",
      "--time", "--weather", "--side", "--stay", "--demand"},
     [](const Options& o) { return o.load == BenchLoad::peers; },
     "is not for bench peers, which has a scene of its own"},
    {Command::bench,
     {"--character", "--force", "--idle"},
     [](const Options& o) { return o.load == BenchLoad::city; },
     "is not for bench city, which draws and poses nobody"},
    {Command::gait,
     {"--speed", "--height", "--sex", "--age", "--style", "--cane", "--pram", "--bag", "--posture"},
     [](const Options& o) { return o.gait.everyone; },
     "is of one person: leave it or --everyone out"},
    {Command::gait,
     {"--turn",    "--stairs",  "--riser",  "--tread",  "--slope", "--kerb",  "--leap",
      "--wall",    "--seconds", "--crowd",  "--change", "--svg",   "--strip", "--view",
      "--moments", "--abreast", "--export", "--walker", "--stand", "--aside"},
     [](const Options& o) { return o.gait.everyone; },
     "is not for --everyone, who walk in every way and are told in a table"},
    {Command::gait,
     {"--riser", "--tread"},
     [](const Options& o) {
         return o.gait.stairs.empty() && (!o.gait.check || has_place(o.gait) || o.gait.crowd > 0);
     },
     "is of a stair: say --stairs up or down too"},
    {Command::gait,
     {"--seconds"},
     [](const Options& o) { return has_place(o.gait) && o.gait.motion.empty() && o.gait.moments.last == 0; },
     "is for level ground, --crowd, --moments and --export: other ways are as long as they are"},
    {Command::gait,
     {"--change"},
     [](const Options& o) { return o.gait.strip.empty() && o.gait.motion.empty(); },
     "is seen in a --strip or an --export; --check without a place holds a change to its bars"},
    {Command::gait,
     {"--change"},
     [](const Options& o) { return o.gait.turn != 0; },
     "is for one who goes straight: leave it or --turn out"},
    {Command::gait,
     {"--height", "--sex", "--age", "--cane", "--bag"},
     [](const Options& o) { return o.gait.abreast; },
     "is of one person: leave it or --abreast out"},
    {Command::gait,
     {"--speed", "--height", "--sex", "--age", "--style", "--cane", "--pram", "--bag", "--posture"},
     [](const Options& o) { return o.gait.crowd > 0; },
     "is of one person, and those of a --crowd are as they are"},
    {Command::gait,
     {"--speed", "--change", "--stairs", "--riser", "--tread", "--slope", "--kerb", "--wall", "--seconds",
      "--crowd", "--svg"},
     [](const Options& o) { return o.gait.stand > 0; },
     "is of a walk: leave it or --stand out"},
    {Command::gait,
     {"--turn", "--aside"},
     [](const Options& o) { return o.gait.stand > 0 && o.gait.strip.empty() && o.gait.motion.empty(); },
     "of one who stands is seen in a --strip or an --export"},
    {Command::gait,
     {"--aside"},
     [](const Options& o) { return o.gait.stand == 0 || o.gait.turn != 0; },
     "is of one who stands: say --stand 12, and leave --turn out"},
    {Command::gait,
     {"--leap"},
     [](const Options& o) { return o.gait.pram || o.gait.cane; },
     "is for one with free hands: leave it or the --pram or --cane out"},
    {Command::gait,
     {"--pram", "--bag"},
     [](const Options& o) { return o.gait.abreast; },
     "is of one person: leave it or --abreast out"},
    {Command::gait,
     {"--posture"},
     [](const Options& o) { return o.gait.pram || o.gait.cane; },
     "is for free hands: leave it or the --pram or --cane out"},
    {Command::gait,
     {"--walker"},
     [](const Options& o) { return o.gait.crowd == 0; },
     "is one of a --crowd: say how many people"},
    {Command::gait,
     {"--scene", "--city", "--center", "--radius", "--terrain", "--scale", "--seed"},
     [](const Options& o) { return o.gait.crowd == 0; },
     "is where a --crowd walks: say how many people"},
    {Command::gait,
     {"--strip"},
     [](const Options& o) { return o.gait.crowd > 0; },
     "draws one person, not a --crowd"},
    {Command::people,
     {"--count", "--seed", "--threads"},
     [](const Options& o) { return !has_built_in(o); },
     "is of the built-in people: add --character builtin, or leave it out"},
    {Command::people, {"--force"}, has_no_file, k_force},
    {Command::view, {"--force"}, has_no_file, k_force},
    {Command::render, {"--force"}, has_no_file, k_force},
    {Command::render,
     {"--record"},
     [](const Options& o) { return !o.replay.empty(); },
     "is for what is simulated, and --replay shows what was recorded"},
    {Command::view,
     {"--record"},
     [](const Options& o) { return !o.replay.empty(); },
     "is for what is simulated, and --replay shows what was recorded"},
    {Command::render,
     {"--transparent"},
     [](const Options& o) { return has_ending(o.out, ".mp4"); },
     "is for pictures: films have no transparency"},
    {Command::render,
     {"--depth"},
     [](const Options& o) {
         return !has_ending(o.depth, ".exr") && !has_ending(o.depth, ".png") && !has_ending(o.depth, ".pfm");
     },
     "goes into an .exr, a .png or a .pfm"},
    {Command::render,
     {"--ids"},
     [](const Options& o) { return !has_ending(o.ids, ".exr") && !has_ending(o.ids, ".png"); },
     "goes into an .exr or a .png, without loss, with what the numbers mean in a .json beside it"},
    {Command::sim, {"--force"}, has_no_file, k_force},
    {Command::check,
     {"--force"},
     [](const Options& o) { return has_no_file(o) && o.sim_check.against.empty(); },
     k_force},
    {Command::bench, {"--force"}, has_no_file, k_force},
    {Command::validate,
     {"--measured", "--json", "--markdown", "--svg"},
     [](const Options& o) { return o.validation.list; },
     "is not for --list, which tests nothing"},
    {Command::validate,
     {"tests"},
     [](const Options& o) { return o.validation.list; },
     "are not for --list, which tells all"},
    {Command::inspect,
     {"--force"},
     [](const Options& o) { return kind_of(o.file) == FileKind::map; },
     "is for characters, not for maps"},
    {Command::inspect,
     {"--terrain"},
     [](const Options& o) { return kind_of(o.file) == FileKind::gltf; },
     "lies under OpenStreetMap maps"},
};

}  // namespace

Result<void> check_used(const CLI::App& command, const Options& options) {
    for (const UselessWhere& useless : k_useless) {
        if (useless.command != options.command || !useless.is_useless(options)) continue;
        for (const char* name : useless.options)
            if (command.count(name) > 0) return Error{std::string(name) + " " + useless.why + "."};
    }
    return {};
}

}  // namespace flaneur
