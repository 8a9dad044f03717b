#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>

#include "tools/flaneur/options/spelling.h"
#include "tools/rendercheck/commands.h"

namespace flaneur {
namespace {

constexpr const char* k_examples = R"(
A case passes where its picture equals its reference, or nearly: at most 0.1 % of the pixels differ at all, 0.02 % by more
than 2/255, and no 16x16 pixels hold more than 16 of those. A suite may say otherwise.

Exit codes: 0 all pass, 1 a picture differs or is flaky, 2 a reference is missing, 3 another device than was required, 4 a
command crashed, took too long or broke Vulkan's rules, 5 these words or the suite cannot be understood.

Examples:
  rendercheck init checks.json                          ask which command draws, and write a first suite
  rendercheck run checks.json --bless                   take its pictures as references
  rendercheck run checks.json --html report.html        hold pictures against them
  rendercheck run checks.json --filter 'night*,-slow'   some of them: names and tags
  rendercheck compare new.png old.png                   two pictures
)";

constexpr const char* k_suites = R"(
A suite is JSON, which `rendercheck init` begins:
  {"programs": {"draw": "build/draw"}, "defaults": {"size": "640x360"},
   "cases": [{"name": "teapot", "command": ["{draw}", "teapot.obj", "-o", "{out}"], "tags": ["quick"]}]}
Of the suite: golden (the folder of references), key (what they are called, where no Vulkan device decides), device, programs,
env, defaults (of all cases), cases. Of a case: name, command (words; with "shell": true one string), picture (the file that it
writes, where that is not {out}), pictures, stdout, size, tolerance {differing, over, step, in_window, flip}, mask, ignore, tags,
env, time_limit, disk_limit, folder, runs, parts. {out} is a picture's path, {dir} its folder, {suite} the suite's.
docs/render-checks.md, in /usr/share/doc/rendercheck where it is installed, tells all of it.
)";

int parse(int argc, char** argv) {
    CLI::App app("rendercheck: renders by any program, held against references\n", "rendercheck");
    app.set_version_flag("--version", "rendercheck " FLANEUR_VERSION);
    app.footer(k_examples);
    app.require_subcommand(1);

    CheckOptions check;
    auto takes_programs = [&](CLI::App& command) {
        command
            .add_option("--program", check.programs,
                        "where a program of the suite lies, instead of what it says")
            ->type_name("NAME=PATH")
            ->expected(1)
            ->take_all();
    };
    CLI::App* run = app.add_subcommand("run", "Run a suite's cases and judge their pictures.");
    run->add_option("suite", check.suite, "the suite")->type_name("SUITE.json")->required();
    run->add_option("--filter", check.filter,
                    "only cases of these names or tags, * and ? stand for letters, - leaves out")
        ->type_name("WORDS");
    run->footer(k_suites);
    takes_programs(*run);
    run->add_option("--jobs", check.jobs, "how many at once")
        ->type_name("N")
        ->check(CLI::Range(1, 256))
        ->capture_default_str();
    run->add_option("--runs", check.runs, "run each case so often: one that differs from itself is flaky")
        ->type_name("N")
        ->check(CLI::Range(1, 100));
    auto* bless =
        run->add_flag("--bless", check.blesses, "keep what differs or is missing as references from now on");
    run->add_flag("--force", check.forces,
                  "bless although there are references of other devices and none of this one")
        ->needs(bless);
    run->add_option("--references", check.references, "hold against those of another device")
        ->type_name("KEY")
        ->excludes(bless);
    run->add_option("--require-device", check.required_device,
                    "end with 3 unless the Vulkan device's name has this in it")
        ->type_name("NAME");
    run->add_option("--keep", check.keep, "a folder for what the commands write; else it goes")
        ->type_name("DIR");
    run->add_option("--html", check.html, "write a page to look at the pictures")->type_name("FILE.html");
    run->add_option("--junit", check.junit, "write results as JUnit's XML")->type_name("FILE.xml");
    run->add_flag("--github", check.is_github, "mark failures for GitHub Actions, and write its summary");

    CompareOptions pair;
    CLI::App* compare = app.add_subcommand("compare", "Hold one picture against another.");
    compare->add_option("picture", pair.picture, "the new one, .png or .exr")->type_name("A.png")->required();
    compare->add_option("reference", pair.reference, "the one that is right")->type_name("B.png")->required();
    compare->add_option("--mask", pair.mask, "where they may differ: white")->type_name("FILE.png");
    auto bar = [&](const char* option, auto& value, auto most, const char* unit, const char* what) {
        compare->add_option(option, value, what)
            ->type_name(unit)
            ->check(CLI::Range(decltype(most){0}, most))
            ->capture_default_str();
    };
    bar("--differing", pair.tolerance.differing, 1.0, "SHARE", "share of pixels that may differ");
    bar("--over", pair.tolerance.over, 1.0, "SHARE", "share that may differ by more than --step");
    bar("--step", pair.tolerance.step, 255.0, "N", "255ths of a channel");
    bar("--in-window", pair.tolerance.in_window, 256, "N", "pixels over the step in 16x16");
    bar("--flip", pair.tolerance.flip, 1.0, "ERROR", "mean FLIP at most; 1 does not judge");
    compare->add_flag("--json", pair.is_json, "say it as JSON");
    compare->add_option("--html", pair.html, "write a page to look at them")->type_name("FILE.html");

    std::string first = "rendercheck.json";
    std::vector<std::string> command;
    CLI::App* init =
        app.add_subcommand("init", "Write a first suite: asks which command draws, unless it follows --.");
    init->add_option("suite", first, "where it goes")->type_name("SUITE.json")->capture_default_str();
    init->add_option("command", command, "what draws, after --")->type_name("-- COMMAND...");

    std::string name;
    CLI::App* explain =
        app.add_subcommand("explain", "Say what a case runs, with what, and what it is held against.");
    explain->add_option("suite", check.suite, "the suite")->type_name("SUITE.json")->required();
    explain->add_option("case", name, "its name")->type_name("CASE")->required();
    takes_programs(*explain);

    app.add_subcommand("device", "Say which Vulkan devices there are, and what their references are called.");

    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& success) {
        return app.exit(success);
    } catch (const CLI::ParseError& error) {
        const CLI::App* used = &app;
        if (app.get_subcommands().empty() && argc > 1 && argv[1][0] != '-') {
            std::vector<std::string> commands;
            for (const CLI::App* one : app.get_subcommands([](const CLI::App*) { return true; }))
                commands.push_back(one->get_name());
            return fail_with(k_exit_usage, std::string("There is no command ") + argv[1] + "." +
                                               did_you_mean(argv[1], commands) +
                                               " rendercheck --help says more.");
        }
        for (const CLI::App* one : app.get_subcommands()) used = one;
        std::vector<std::string> known;
        for (const CLI::Option* option : used->get_options())
            if (!option->get_lnames().empty()) known.push_back("--" + option->get_lnames().front());
        for (const CLI::App* one : app.get_subcommands([](const CLI::App*) { return true; }))
            known.push_back(one->get_name());
        std::string hint;
        for (int i = 1; i < argc && hint.empty() && dynamic_cast<const CLI::ExtrasError*>(&error); ++i) {
            const std::string word = argv[i];
            if (std::find(known.begin(), known.end(), word) == known.end() && error.what() &&
                std::string(error.what()).find(word) != std::string::npos)
                hint = did_you_mean(word, known);
        }
        return fail_with(k_exit_usage, std::string(error.what()) + "." + hint + " rendercheck " +
                                           (used == &app ? "" : used->get_name() + " ") +
                                           "--help says more.");
    }
    if (run->parsed()) return run_suite(check);
    if (compare->parsed()) return run_compare(pair);
    if (init->parsed()) return run_init(first, command);
    if (explain->parsed()) return run_explain(check, name);
    return run_device();
}

}  // namespace
}  // namespace flaneur

int main(int argc, char** argv) {
    std::signal(SIGPIPE, SIG_IGN);
    try {
        return flaneur::parse(argc, argv);
    } catch (const std::exception& fault) {
        return flaneur::fail_with(
            flaneur::k_exit_usage,
            std::string("That is more than this machine can do: ") + fault.what() + ".");
    }
}
