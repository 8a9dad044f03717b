#include <chrono>
#include <cinttypes>
#include <cmath>
#include <cstdio>

#include "assets/files/words.h"
#include "sim/base/isa.h"
#include "sim/base/zone.h"
#include "tools/flaneur/check/state_log.h"
#include "tools/flaneur/commands.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/console/ending.h"
#include "tools/flaneur/load/load.h"
#include "tools/flaneur/measure/coming.h"
#include "tools/flaneur/measure/count.h"
#include "tools/flaneur/measure/csv.h"
#include "tools/flaneur/output/measures.h"
#include "tools/flaneur/output/output.h"
#include "tools/flaneur/recording/check.h"
#include "tools/flaneur/recording/taking.h"
#include "tools/flaneur/tracks/record.h"

namespace flaneur {

namespace {

// A log of states under way; of no file it is none.
struct StateLog {
    PartFilePtr file;
    StateLogWriter writer;
    StateDigest digest;
};

Result<void> begin(StateLog& log, const World& world, const Options& options, uint32_t ticks) {
    if (!log.file) return {};
    log.writer.file = log.file->file;
    StateLogHead head{world_words(options.words), world.crowd.capacity, ticks, state_fields(world)};
    return write_state_log_head(log.writer, head);
}

bool add_state(StateLog& log, const World& world) {
    if (!log.file) return true;
    digest_state(world, log.digest);
    return write_digest(log.writer, log.digest);
}

Result<void> finish(StateLog log, const World& world) {
    if (!log.file) return {};
    (void)write_state_words(log.writer, state_words(world));  // what fails is told by keep_file
    return keep_file(std::move(log.file));
}

}  // namespace

static void tell_coming(const Loaded& loaded) {
    const World& world = *loaded.world;
    std::string told = told_coming(coming_count(world), sent_counts(world), loaded.sent_names);
    if (told.empty()) return;
    told.pop_back();
    for (const std::string_view line : split(told, '\n')) say(line);
}

// A line off all ground counts nobody, which is more likely a slip than what is meant.
static void warn_of_lines(const MeasurePlan& plan, const World& world) {
    if (world.roam) return;
    for (const CountLine& line : plan.lines)
        if (is_off_ground(line, world))
            say("The line " + told(line) +
                " lies where there is nothing to walk on, and will count nobody: lay it over ground.");
}

Result<void> run_sim(const Options& options) {
    Result<void> isa = use_isa(options.isa);
    if (!isa) return isa;
    if (Result<void> allowed = check_record(options); !allowed) return allowed;
    Result<PartFilePtr> log = open_if_asked(options.hash_log);
    if (!log) return log.error();
    Result<PartFilePtr> states = open_if_asked(options.state_log);
    if (!states) return states.error();
    TrackRecord tracks;
    Result<PartFilePtr> track_file = open_tracks(options.trajectories);
    if (!track_file) return track_file.error();
    tracks.file = std::move(*track_file);
    Result<std::vector<PartFilePtr>> counted = std::vector<PartFilePtr>();
    if (!options.measures.empty()) counted = open_counts(options.measures, options.plan);
    if (!counted) return counted.error();
    Result<Loaded> loaded = load(options);
    if (!loaded) return loaded.error();
    World& world = *loaded->world;
    Counts counts;
    set_plan(counts, options.plan, world.tick);
    count_people(counts, world);
    warn_of_lines(options.plan, world);

    auto start = std::chrono::steady_clock::now();
    auto ticks = static_cast<uint32_t>(std::lround(options.seconds / static_cast<double>(k_tick)));
    StateLog state_log{std::move(*states), {}, {}};
    if (Result<void> begun = begin(state_log, world, options, ticks); !begun) return begun;
    if (!add_state(state_log, world)) return keep_file(std::move(state_log.file));  // which says why
    if (Result<void> begun = begin_tracks(tracks, world, options.fps); !begun) return begun;
    Result<TakingPtr> taking = begin_taking(options, world);
    if (!taking) return taking.error();
    while (world.tick < ticks) {
        if (is_stopping()) return interrupted("the simulation is at tick " + std::to_string(world.tick));
        FLANEUR_ZONE("frame");
        step(world);
        count_people(counts, world);
        if (*taking && !take(**taking, world)) return finish_taking(std::move(*taking));  // which says why
        if (!add_tick(tracks, world)) return finish_tracks(std::move(tracks));            // which says why
        if (*log &&
            std::fprintf((*log)->file, "%" PRIu32 " %016" PRIx64 "\n", world.tick, hash_world(world)) < 0)
            return keep_file(std::move(*log));  // which says why
        if (!add_state(state_log, world)) return keep_file(std::move(state_log.file));
        if (world.tick % 60 == 0) {
            show_progress("simulating, " + std::to_string(world.tick / 60) + " s of " +
                          std::to_string(ticks / 60) + " s");
        }
    }
    clear_progress();
    std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;

    const size_t creatures = creatures_of(world).size();
    const std::string others = creatures > 0 ? " and " + std::to_string(creatures) + " creatures" : "";
    char figures[128];
    std::snprintf(figures, sizeof figures,
                  ": %" PRIu32 " walkers%s, %" PRIu32 " ticks on %d threads in %.2f s", people_count(world),
                  others.c_str(), world.tick, thread_count(*world.workers), spent.count());
    say(city_name(options.scene) + figures);
    tell_coming(*loaded);
    if (options.hash) std::printf("%016" PRIx64 "\n", hash_world(world));
    std::fputs(told_counts(counts).c_str(), stdout);
    if (!options.measures.empty()) {
        for (const PartFilePtr& file : *counted) say("Writing " + file->path);
        if (Result<void> written = write_counts(std::move(*counted), counts); !written) return written;
    }
    if (Result<void> finished = finish_taking(std::move(*taking)); !finished) return finished;
    if (Result<void> finished = finish(std::move(state_log), world); !finished) return finished;
    if (Result<void> finished = finish_tracks(std::move(tracks)); !finished) return finished;
    return *log ? keep_file(std::move(*log)) : Result<void>();
}

}  // namespace flaneur
