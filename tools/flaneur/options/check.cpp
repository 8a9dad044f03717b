#include "tools/flaneur/options/commands.h"
#include "tools/flaneur/options/refusal.h"
#include "tools/flaneur/options/shell_words.h"

namespace flaneur {
namespace {

constexpr const char* k_check_footer =
    R"(Runs without Vulkan. Two runs of one world must be equal to the last bit, whatever the build, the machine, the threads and
the instruction set. Where they are not, this tells the first tick, walker and field that differ, with both values, and the
command that shows the walker then.
On one machine, --with runs another flaneur beside this one with the same options, --with-options adds some to its own (and
without --with runs this program once more). Between two machines, `flaneur sim --state-log FILE` writes a log on one, and
--against FILE runs here the world that it names. A log has all values of its last tick alone: to see both values of a
difference, write one that ends there.
--replay FILE reads all of a recording, as flaneur replay FILE --check does.
It ends with 0 where all is equal, and with 1 where something differs or nothing could be compared.
Examples:
  flaneur check --sim --with build/before/flaneur --scene corner --walkers 40 --seconds 20
  flaneur check --sim --with-options "--threads 1 --isa sse4" --threads 4
  flaneur sim --scene district --seconds 60 --state-log a.log      on one machine
  flaneur check --sim --against a.log                              on another one
  flaneur check --sim --against a.log --city here/berlin.osm       where its map lies elsewhere)";

}  // namespace

void add_check(CLI::App& app, SceneWords& words, Options& options) {
    CLI::App* check = app.add_subcommand("check", "Find where two builds or machines simulate differently")
                          ->footer(k_check_footer);
    check->callback([&] { options.command = Command::check; });
    SimCheckOptions& sim = options.sim_check;
    check->add_flag_callback(
        "--sim", [] {}, "Compare simulations, tick by tick");
    CLI::Option* with = check->add_option("--with", sim.with, "Another flaneur, to be run beside this one")
                            ->type_name("FILE");
    CLI::Option* other =
        check
            ->add_option_function<std::string>(
                "--with-options",
                [&sim](const std::string& text) {
                    Result<std::vector<std::string>> given = shell_words(text);
                    if (!given)
                        throw CLI::ValidationError("--with-options has " + given.error().message,
                                                   CLI::ExitCodes::ValidationError);
                    sim.with_options = std::move(*given);
                },
                "Options for the other one alone, as `flaneur sim` has them; without --with, this program is "
                "run "
                "again with them")
            ->type_name("OPTIONS");
    check
        ->add_option("--against", sim.against,
                     "A log that `flaneur sim --state-log` wrote, here or elsewhere")
        ->type_name("FILE")
        ->excludes(with)
        ->excludes(other);
    check
        ->add_option("--seconds", options.seconds,
                     "How long, in simulated time; against a log, as long as that is")
        ->type_name("T")
        ->check(number_between(0.0, 1e6))
        ->capture_default_str();
    add_scene_options(*check, words, options);
    add_isa_option(*check, options);
    add_replay_option(*check, words);
    for (const char* name : {"--sim", "--with", "--with-options", "--against", "--seconds"})
        check->get_option("--replay")->excludes(check->get_option(name));
}

Result<void> settle_check(const CLI::App& command, const Options& options) {
    if (options.command != Command::check || !options.replay.empty()) return {};
    if (command.count("--sim") == 0)
        return Error{
            "check finds where two simulations part, with --sim, or reads a recording, with --replay FILE."};
    if (command.count("--with") + command.count("--with-options") + command.count("--against") > 0) return {};
    return Error{
        "check --sim compares this program with another one: say --with OTHER_FLANEUR, --with-options "
        "\"--threads 1\" or --against LOG."};
}

}  // namespace flaneur
