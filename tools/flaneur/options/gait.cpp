#include "assets/files/file.h"
#include "assets/files/words.h"
#include "tools/flaneur/options/commands.h"
#include "tools/flaneur/options/refusal.h"

namespace flaneur {
namespace {

constexpr const char* k_gait_footer =
    R"(Prints each quantity of the walk beside the bar it is held to; docs/gait.md explains both.
Examples:
  flaneur gait --speed 1.3                                 one person on level ground
  flaneur gait --speed 1.3 --check                         every walk that has bars: fails if one is missed
  flaneur gait --everyone --check                          the same of women and men from 4 to 80 years
  flaneur gait --speed 1.3 --svg out/gait.svg --json out/gait.json
  flaneur gait --sex woman --age 75                        as fast as she likes
  flaneur gait --turn 180                                  a half turn on the way
  flaneur gait --stairs up --riser 0.16 --tread 0.32
  flaneur gait --slope -8
  flaneur gait --crowd 1000 --seconds 60 --check           feet, joints and manners of a whole crowd
  flaneur gait --crowd 500 --city town.osm.pbf             the same in a city of yours
  flaneur gait --stairs up --export out/up.bvh             its motion, for animation programs: metres, +y up, ahead
                                                           along +z, at 60 frames a second
  flaneur gait --crowd 500 --walker 12 --export out/12.glb
                                                           that of one of a crowd, as glTF with a doll to look at
  flaneur gait --strip out/strip.png --view front
  flaneur gait --strip out/stop.png --moments 21.8:24      one who stands for a second, walks, and stops after 22
  flaneur gait --speed 1.4 --change 3.1 --strip out/run.png --moments 4.8:6.8
  flaneur gait --abreast --strip out/people.png            twelve people, each with a walk of their own
  flaneur gait --stand 60 --style 3 --strip out/stand.png --view front
                                                           what the hands of one who waits do
  flaneur gait --stand 12 --aside 0.6 --strip out/aside.png --view front
  flaneur gait --stairs down --age 80 --strip out/stairs.mp4 --moments 9:17
                                                           a film of what a strip shows)";

Result<StripView> parse_view(const std::string& text) {
    if (text == "side") return StripView::side;
    if (text == "front") return StripView::front;
    return Error{excerpt(text) + " is neither side nor front"};
}

Result<Sex> parse_sex(const std::string& text) {
    if (text == "woman") return Sex::woman;
    if (text == "man") return Sex::man;
    return Error{excerpt(text) + " is neither woman nor man"};
}

Result<Bag> parse_bag(const std::string& text) {
    if (text == "backpack") return Bag::backpack;
    if (text == "shoulder_bag") return Bag::shoulder_bag;
    if (text == "handbag") return Bag::handbag;
    return Error{excerpt(text) + " is neither backpack, shoulder_bag nor handbag"};
}

Result<std::string> parse_stairs(const std::string& text) {
    if (text == "up" || text == "down") return text;
    return Error{excerpt(text) + " is neither up nor down"};
}

}  // namespace

void add_gait(CLI::App& app, SceneWords& words, Options& options) {
    GaitOptions& gait = options.gait;
    CLI::App* command =
        app.add_subcommand("gait", "Walk one person and measure the walk")->footer(k_gait_footer);
    command->callback([&] { options.command = Command::gait; });
    auto number = [&](const char* group, const char* name, double& to, double low, double high,
                      const char* unit, const std::string& what, const char* shown = "") {
        return command->add_option(name, to, what + " (" + plainly(low) + " to " + plainly(high) + ")")
            ->type_name(unit)
            ->check(number_between(low, high))
            ->default_str(shown)
            ->group(group);
    };
    constexpr const char *k_who = "Who", *k_where = "Where";
    number(k_who, "--speed", gait.speed, 0.3, 5, "M/S", "How fast; without it, as fast as such people like");
    number(k_who, "--height", gait.height, 0.8, 2.3, "M", "How tall; without it, as tall as such people are");
    add_parsed(*command, "--sex", parse_sex, gait.sex, "woman or man", "SEX", "man")->group(k_who);
    number(k_who, "--age", gait.age, 4, 100, "YEARS", "How old", "30");
    add_parsed(*command, "--style", parse_seed, gait.style, "Seed of a manner of walking; 0: the middle one",
               "S", "0")
        ->group(k_who);
    command
        ->add_flag("--everyone", gait.everyone,
                   "Women and men from 4 to 80 years instead, with ten styles each, in every way of walking")
        ->group(k_who);
    command->add_flag("--cane", gait.cane, "Who walks with a cane")->group(k_who);
    command->add_flag("--pram", gait.pram, "Who pushes a pram")->group(k_who);
    add_parsed(*command, "--bag", parse_bag, gait.bag, "Who carries a backpack, shoulder_bag or handbag",
               "BAG", "")
        ->group(k_who);
    command
        ->add_option(
            "--posture", gait.posture,
            "What hands do as soon as they may: pocket, pockets, hip, hips, clasp, behind, fold, across "
            "or strap")
        ->type_name("WORD")
        ->group(k_who);
    number(k_where, "--stand", gait.stand, 10, 600, "T",
           "Stands for so long instead of walking, and does with its hands what people do");
    number(k_where, "--seconds", gait.seconds, 12, k_longest_walk, "T",
           "On level ground, from standing to standing, or of what is exported, or of a crowd", "25");
    number(k_where, "--turn", gait.turn, -180, 180, "DEG",
           "Turn on the way, to the left, or, with --stand, on the spot after five seconds");
    number(k_where, "--aside", gait.aside, -1, 1, "M",
           "With --stand, steps so far to the left after five seconds, in a strip or an export");
    number(k_where, "--change", gait.change, 0.3, 5, "M/S",
           "So fast from the fifth to the tenth second, in a strip or an export");
    add_parsed(*command, "--stairs", parse_stairs, gait.stairs, "A flight up or down", "up|down", "")
        ->group(k_where);
    number(k_where, "--riser", gait.riser, 0.05, 0.25, "M", "Height of a stair", "0.17");
    number(k_where, "--tread", gait.tread, 0.2, 0.6, "M", "Depth of a stair", "0.29");
    number(k_where, "--slope", gait.slope, -25, 25, "PERCENT", "Up, or down, so many metres in a hundred");
    number(k_where, "--kerb", gait.kerb, 0.02, 0.25, "M", "Up a kerb so high and down again");
    number(k_where, "--leap", gait.leap, 0.2, 2, "M", "Leap over a puddle so wide, on level ground");
    CLI::Option* wall =
        number(k_where, "--wall", gait.wall, 0.2, 2, "M", "A wall so far to the left, in a strip");
    command
        ->add_option("--crowd", gait.crowd,
                     "Watch so many people in a city instead, for --seconds: in the built-in one, or in that "
                     "of a scene")
        ->type_name("N")
        ->transform(whole_between(1, k_max_walkers))
        ->group(k_where);
    add_place_options(*command, words);
    command->add_option("--csv", gait.csv, "Write every quantity and curve")->type_name("FILE");
    command->add_option("--json", options.json, "The same")->type_name("FILE");
    command->add_option("--svg", gait.svg, "Draw the curves over those of people")->type_name("FILE");
    CLI::Option* strip =
        command
            ->add_option("--strip", gait.strip,
                         "Draw twelve moments of it side by side, a .png, or all between, a film, an .mp4")
            ->type_name("FILE");
    add_parsed(*command, "--view", parse_view, gait.view, "What a strip shows it from: side or front", "VIEW",
               "side")
        ->needs(strip);
    add_parsed(*command, "--moments", parse_moments, gait.moments,
               "From which to which second of the walk a strip is; without it, of one stride or the turn",
               "FROM:TO", "")
        ->needs(strip);
    command
        ->add_flag("--abreast", gait.abreast,
                   "Twelve different people in a strip, at one moment; others by --style")
        ->needs(strip);
    wall->needs(strip);
    CLI::Option* motion =
        command
            ->add_option("--export", gait.motion, "Write the motion, for Blender and others, a .bvh or .glb")
            ->type_name("FILE");
    command->add_option("--walker", gait.walker, "Whose of a --crowd that is, from 0 on")
        ->type_name("ID")
        ->transform(whole_between(0, k_max_walkers))
        ->capture_default_str()
        ->needs(motion);
    command->add_flag("--check", gait.check,
                      "Fail if a bar is not met; without a place, try every walk that has bars");
}

}  // namespace flaneur
