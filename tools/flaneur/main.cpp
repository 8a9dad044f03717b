#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>

#include "assets/cache/cache_file.h"
#include "assets/files/file.h"
#include "assets/gltf/file.h"
#include "tools/flaneur/check/other.h"
#include "tools/flaneur/commands.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/console/ending.h"
#include "tools/flaneur/load/load.h"
#include "tools/flaneur/output/output.h"
#include "tools/flaneur/output/trace.h"

namespace flaneur {

namespace {

Result<void> run_command(const Options& options) {
#ifndef FLANEUR_VULKAN
    bool draws = options.command == Command::view || options.command == Command::render ||
                 (options.command == Command::bench &&
                  (options.load == BenchLoad::frame || options.load == BenchLoad::window ||
                   options.load == BenchLoad::peers || options.load == BenchLoad::ablate)) ||
                 (options.command == Command::gait && !options.gait.strip.empty()) ||
                 (options.command == Command::people && !options.people.sheet.empty()) ||
                 options.command == Command::city;
    if (draws) {
        return Error{
            "This flaneur was built without Vulkan: it has sim, check, validate, measure, bench "
            "crowd|pose|city|sweep|scale|gauntlet, "
            "gait without --strip, "
            "people without --sheet and inspect. One that draws is made by ./tools/build release."};
    }
#endif
    switch (options.command) {
#ifdef FLANEUR_VULKAN
        case Command::view:
            return run_view(options);
        case Command::render:
            return run_render(options);
        case Command::city:
            return run_city(options);
#endif
        case Command::sim:
            return run_sim(options);
        case Command::check:
            return run_check(options);
        case Command::replay:
            return run_replay(options);
        case Command::exports:
            return run_export(options);
        case Command::diff:
            return run_diff(options);
        case Command::join:
            return run_join(options);
        case Command::validate:
            return run_validate(options);
        case Command::measure:
            return run_measure(options);
        case Command::gait:
            return run_gait(options);
        case Command::inspect:
            return run_inspect(options);
        case Command::people:
            return run_people(options);
        case Command::scenes:
            return run_scenes(options);
        case Command::cache:
            return run_cache(options);
        default:
            return run_bench(options);
    }
}

Result<void> run(const Options& options) {
    if (Result<void> started = start_trace(options.trace); !started) return started;
    Result<void> done = run_command(options);
    Result<void> traced = finish_trace();
    return done ? traced : done;
}

// Of what is half done only a trace is worth keeping.
void clean_up() {
    (void)finish_trace();
    abandon_outputs();
    abandon_other();
}

int fail(const Error& error) {
    if (is_unread(error)) end_unread();
    // What was given up says so in many ways.
    bool given_up = is_stopping() && !error.message.starts_with("Interrupted");
    say("flaneur: " + (given_up ? interrupted() : error).message);
    if (is_stopping()) end_by_signal();
    return 1;
}

// What the command reads, and what that names in its turn.
std::vector<std::string> inputs_of(const Options& options) {
    std::vector<std::string> inputs = files_of(options.scene);
    // A window may save over the scene that it was opened with.
    if (options.command != Command::view)
        inputs.insert(inputs.end(), options.inputs.begin(), options.inputs.end());
    for (size_t i = 0, given = inputs.size(); i < given; ++i) {
        if (kind_of(inputs[i]) != FileKind::gltf) continue;
        for (std::string& file : files_named_by(inputs[i])) inputs.push_back(std::move(file));
    }
    return inputs;
}

int run_program(int argc, char** argv) {
    auto parsed = parse_options(argc, argv);
    if (!parsed) return fail(parsed.error());
    if (const Options* options = std::get_if<Options>(&*parsed)) {
        if (auto limit = read_cache_limit(); !limit) return fail(limit.error());
        protect_inputs([options] { return inputs_of(*options); });
        Result<void> done = run(*options);
        if (!done) return fail(done.error());
    }
    if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return 0;
    return fail(is_unread(stdout) ? unread() : Error{"Cannot write to standard output."});
}

// Where a standard file is closed, the next file to be opened would take its number, and what is said on the
// terminal would be written into it. Nothing can be written to what takes it here: what was to go there
// fails.
void fill_standard_files() {
    for (int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (fcntl(standard, F_GETFD) < 0 && errno == EBADF) open("/dev/null", O_RDONLY);
}

}  // namespace

}  // namespace flaneur

int main(int argc, char** argv) {
    using namespace flaneur;
    fill_standard_files();
    std::signal(SIGPIPE, SIG_IGN);  // a pipe that closes is an error like others
    return run_guarded([&] {
        obey_signals(clean_up);
        return run_program(argc, argv);
    });
}
