#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>

#include "assets/files/file.h"
#include "sim/base/isa.h"
#include "sim/base/tick.h"
#include "tools/flaneur/check/other.h"
#include "tools/flaneur/check/parting.h"
#include "tools/flaneur/check/state_log.h"
#include "tools/flaneur/commands.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/console/ending.h"
#include "tools/flaneur/load/load.h"
#include "tools/flaneur/options/shell_words.h"

namespace flaneur {

namespace {

using Words = std::vector<std::string>;

// Of a check itself, and of what it runs only here.
constexpr std::array<std::string_view, 3> k_own_options = {"--with", "--with-options", "--against"};
constexpr std::array<std::string_view, 1> k_own_flags = {"--sim"};
constexpr std::array<std::string_view, 1> k_seconds = {"--seconds"};

uint32_t tick_at(double seconds) {
    return static_cast<uint32_t>(std::lround(seconds / static_cast<double>(k_tick)));
}

// As --seconds takes it to end after that tick.
std::string seconds_until(uint32_t tick) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4f", tick / 60.0);
    return text;
}

// "a man of 34, 1.78 m tall, with a cane"
std::string told_walker(const World& world, uint32_t walker) {
    const Crowd& crowd = world.crowd;
    const Kind& kind = world.kinds[crowd.identity.body[walker]];
    const float height = kind.body.height * crowd.identity.scale[walker];
    const Vec3 place = world.roam ? world.roam->walkers.position[walker] : crowd.motion.position[walker];
    const float speed = length(crowd.motion.velocity[walker]);
    const Journey& journey = crowd.journeys[walker];
    const bool has_goal = !world.roam && !journey.arrived;
    char text[256];
    std::snprintf(text, sizeof text, "a %s of %.0f, %.2f m tall%s%s, at %.2f,%.2f,%.2f, ",
                  kind.woman ? "woman" : "man", static_cast<double>(kind.age), static_cast<double>(height),
                  kind.body.cane != Vec3{} ? ", with a cane" : "",
                  kind.body.pram != Vec3{} ? ", with a pram" : "", static_cast<double>(place.x),
                  static_cast<double>(place.y), static_cast<double>(place.z));
    std::string told = text;
    constexpr float k_stands = 0.05f;  // m/s
    if (speed < k_stands)
        std::snprintf(text, sizeof text, "stands");
    else
        std::snprintf(text, sizeof text, "goes at %.2f m/s", static_cast<double>(speed));
    told += text;
    if (has_goal) {
        std::snprintf(
            text, sizeof text, ", on the way to %.1f,%.1f,%.1f", static_cast<double>(journey.goal.position.x),
            static_cast<double>(journey.goal.position.y), static_cast<double>(journey.goal.position.z));
        told += text;
    }
    return told;
}

// The commands that show a walker at a tick.
std::string told_ways_to_look(const World& world, const Words& words, uint32_t tick, uint32_t walker) {
    if (world.roam) return "";  // where no camera follows anybody
    Words render{"flaneur", "render"}, view{"flaneur", "view"};
    render.insert(render.end(), words.begin(), words.end());
    view.insert(view.end(), words.begin(), words.end());
    const std::string who = "follow:" + std::to_string(walker);
    view.insert(view.end(), {"--camera", who});
    render.insert(render.end(), {"--camera", who, "--frames", std::to_string(tick), "--out",
                                 "tick" + std::to_string(tick) + ".png"});
    return "To look: " + shell_line(render) + "\n     or: " + shell_line(view) + "\n";
}

// The other side's values after a tick (state_words); empty: they cannot be had.
using Values = std::vector<uint32_t>;
using ValuesAt = std::function<Result<Values>(uint32_t tick)>;
// What to say of a log that cannot be read on.
using ToldFailure = std::function<Error(const Error&)>;

Error they_part(const World& world, const Words& words, const Parting& parting, const CommonFields& common) {
    std::fputs(told_parting(parting, world.crowd.capacity, common).c_str(), stdout);
    std::optional<uint32_t> walker;
    if (!parting.fields.empty()) walker = parting.fields[0].walker;
    if (!walker && !parting.walkers.empty()) walker = parting.walkers[0];
    if (walker)
        std::printf("Walker %u here is %s.\n%s", *walker, told_walker(world, *walker).c_str(),
                    told_ways_to_look(world, words, parting.tick, *walker).c_str());
    return Error{"The two part at tick " + std::to_string(parting.tick) + ": " + told_first(parting) + "."};
}

// Runs the world here beside what the log says of it there, to the last tick that both have.
Result<void> compare(const Options& options, const Words& words, StateLogReader& log,
                     const ValuesAt& values_at, const ToldFailure& told) {
    if (Result<void> isa = use_isa(options.isa); !isa) return isa;
    Result<Loaded> loaded = load(options);
    if (!loaded) return loaded.error();
    World& world = *loaded->world;
    if (log.head.walkers != world.crowd.capacity)
        return Error{"The two begin apart: there is room for " + std::to_string(world.crowd.capacity) +
                     " walkers here and for " + std::to_string(log.head.walkers) + " there."};
    const StateFields fields = state_fields(world);
    const CommonFields common = common_fields(fields, log.head.fields);
    if (common.walkers.empty() && world.crowd.capacity > 0)
        return Error{"Nothing is compared: the log of " + log.name +
                     " has no field that this flaneur knows."};
    const StatePair pair{fields, log.head.fields, common};
    const uint32_t last = std::min(tick_at(options.seconds), log.head.last);
    StateDigest here, there;
    for (;;) {
        if (is_stopping()) return interrupted("they are equal to tick " + std::to_string(world.tick));
        digest_state(world, here);
        if (Result<void> read = read_digest(log, there); !read) return told(read.error());
        if (are_different(pair, here, there)) break;
        if (world.tick == last) {
            // Whether the log comes to its end.
            if (last == log.head.last)
                if (const Result<Values> values = read_state_words(log); !values) return told(values.error());
            clear_progress();
            const std::string states = last == 0
                                           ? "The state at tick 0 is equal"
                                           : "All " + std::to_string(last + 1) +
                                                 " states are equal, from tick 0 to " + std::to_string(last);
            std::printf("%s: %zu walkers, %zu fields.\n", states.c_str(), walkers(world).size(),
                        common.walkers.size() + common.crowd.size());
            std::fputs(told_alone(common).c_str(), stdout);
            return {};
        }
        step(world);
        if (world.tick % 60 == 0)
            show_progress("comparing, " + std::to_string(world.tick / 60) + " s of " +
                          std::to_string(last / 60) + " s");
    }
    clear_progress();
    const bool is_last = world.tick == log.head.last;
    const Result<Values> values = is_last ? read_state_words(log) : values_at(world.tick);
    if (!values) return is_last ? told(values.error()) : values.error();
    const Parting parting =
        values->empty() ? parting_of(pair, world.tick, here, there)
                        : parting_of(pair, world.tick, world.crowd.capacity, state_words(world), *values);
    return they_part(world, words, parting, common);
}

// Against a log of a file, which may be another machine's.
Result<void> check_against(const Options& options, const Words& said) {
    const std::string& path = options.sim_check.against;
    if (Result<void> found = find_file(path); !found) return found;
    const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) return Error{"Cannot read the state log " + path + "."};
    const std::unique_ptr<const int, void (*)(const int*)> closed(&file, [](const int* f) { close(*f); });
    StateLogReader log{.from = file, .name = path};
    if (Result<void> head = read_state_log_head(log); !head) return head;
    Words words{"flaneur", "sim"};
    const bool has_length = has_option(said, k_seconds[0]);
    words.insert(words.end(), log.head.words.begin(), log.head.words.end());
    words.insert(words.end(), said.begin(), said.end());
    if (!has_length) words.insert(words.end(), {"--seconds", seconds_until(log.head.last)});
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    const auto parsed = parse_options(static_cast<int>(pointers.size()), pointers.data());
    const Options* const its = parsed ? std::get_if<Options>(&*parsed) : nullptr;
    if (!its)
        return Error{"The world of the state log " + path +
                     " cannot be made here: " + (parsed ? "it has other words" : parsed.error().message)};
    const Words world = world_words(its->words);
    // Files may lie elsewhere here; whatever else is asked for makes another world.
    constexpr std::string_view k_files[] = {"--city", "--terrain", "--character", "--demand"};
    const Words other = without_options(world_words(said), k_files);
    if (!other.empty())
        say("This is not the world of the log, but with " + shell_line(other) + ": it may well differ.");
    const ValuesAt values_at = [&](uint32_t tick) -> Result<Values> {
        if (!other.empty()) return Values();
        Words there{"flaneur", "sim"};
        there.insert(there.end(), world.begin(), world.end());
        there.insert(there.end(), {"--seconds", seconds_until(tick), "--state-log", "tick.log"});
        say("A log has all values of its last tick. To see them, write there one that ends at the "
            "difference, and "
            "check against that: " +
            shell_line(there));
        return Values();
    };
    return compare(*its, world, log, values_at, [](const Error& error) { return error; });
}

// A run of the other program that writes its log for us, up to a tick.
struct OtherRun {
    OtherProgramPtr program;
    StateLogReader log;
};

// Why no log came of the other program, or none to its end.
Error told_failure(const Error& error, OtherRun& run) {
    if (is_stopping()) return error;
    const std::optional<OtherEnd> end = end_of(*run.program);
    if (is_stopping()) return interrupted();
    const std::string said = last_said(*run.program);
    const std::string it_said = said.empty() ? "It said nothing." : "It said: " + said;
    if (end && end->has_failed)
        return Error{"The other side failed: " + run.log.name + " ended " + end->told + ". " + it_said};
    if (run.log.is_one) return Error{error.message + (said.empty() ? "" : " " + it_said)};
    return Error{run.log.name + " is no flaneur that knows `sim --state-log`: " +
                 (end ? "it ended " + end->told + " and wrote no log" : "what it writes is no log") +
                 ". Give one by --with, as in --with ./build/release/flaneur."};
}

Result<OtherRun> run_other(const Options& options, const Words& said, uint32_t last) {
    const SimCheckOptions& check = options.sim_check;
    Words words{check.with.empty() ? "/proc/self/exe" : check.with, "sim"};
    words.insert(words.end(), said.begin(), said.end());
    words.insert(words.end(), check.with_options.begin(), check.with_options.end());
    words.insert(words.end(), {"--seconds", seconds_until(last), "--state-log", "-"});
    Result<OtherProgramPtr> program = start_other(words);
    if (!program) return program.error();
    std::string name = check.with.empty() ? "this program" : check.with;
    if (!check.with_options.empty()) name += ", with " + shell_line(check.with_options) + ",";
    OtherRun run{std::move(*program), {}};
    run.log.from = run.program->output;
    run.log.name = name;
    if (Result<void> head = read_state_log_head(run.log); !head) return told_failure(head.error(), run);
    if (run.log.head.last != last)
        return Error{"Nothing is compared: " + name + " ran to tick " + std::to_string(run.log.head.last) +
                     " where it was asked to run to " + std::to_string(last) + "."};
    return run;
}

// Against another program, which runs beside this one.
Result<void> check_with(const Options& options, const Words& said) {
    Result<OtherRun> other = run_other(options, said, tick_at(options.seconds));
    if (!other) return other.error();
    const ValuesAt values_at = [&](uint32_t tick) -> Result<Values> {
        // Once more, only so far: a log has all values of its last tick.
        other->program.reset();
        show_progress("running the other one again, to tick " + std::to_string(tick));
        Result<OtherRun> again = run_other(options, said, tick);
        if (!again) return again.error();
        StateDigest digest;
        for (uint32_t i = 0; i <= tick; ++i)
            if (Result<void> read = read_digest(again->log, digest); !read)
                return told_failure(read.error(), *again);
        Result<Values> values = read_state_words(again->log);
        clear_progress();
        if (!values) return told_failure(values.error(), *again);
        return values;
    };
    return compare(options, world_words(said), other->log, values_at,
                   [&](const Error& error) { return told_failure(error, *other); });
}

}  // namespace

Result<void> run_check(const Options& options) {
    if (!options.replay.empty()) {
        Options checked = options;
        checked.checks_replay = true;
        return run_replay(checked);
    }
    const Words said = without_options(options.words, k_own_options, k_own_flags);
    return options.sim_check.against.empty() ? check_with(options, said) : check_against(options, said);
}

}  // namespace flaneur
