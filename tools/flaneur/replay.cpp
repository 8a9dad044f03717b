#include <cstdio>
#include <cstdlib>

#include "assets/recording/recorder.h"
#include "sim/sim.h"
#include "tools/flaneur/commands.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/console/ending.h"
#include "tools/flaneur/load/load.h"
#include "tools/flaneur/output/output.h"
#include "tools/flaneur/recording/difference.h"
#include "tools/flaneur/recording/playing.h"

namespace flaneur {

namespace {

// Every byte of it.
Result<void> read_all(Replay& replay) {
    const Recording& recording = *replay.recording;
    for (const ChunkPlace& chunk : recording.chunks) {
        if (is_stopping()) return interrupted();
        show_progress("reading, tick " + std::to_string(chunk.first));
        Result<void> read;
        if (chunk.kind == k_motion_chunk) {
            const Result<bool> has = seek(replay, chunk.first);
            if (!has) read = has.error();
        } else if (chunk.kind == k_columns_chunk) {
            const Result<bool> has = seek_columns(replay, chunk.first);
            if (!has) read = has.error();
        } else if (const Result<std::string> bytes = read_chunk(recording, chunk); !bytes) {
            read = bytes.error();
        }
        if (!read) return read;
    }
    clear_progress();
    return {};
}

// What was simulated is so again.
Result<void> simulate_again(Playing& playing, World& world) {
    const Recording& recording = *playing.replay.recording;
    std::string equal = "none is equal before";
    for (uint32_t tick = playing.first; tick <= playing.last; ++tick) {
        if (Result<void> shown = show_tick(playing, world, tick); !shown) return shown;
        if (tick % 60 == 0) show_progress("simulating, tick " + std::to_string(tick));
        const Result<std::optional<uint64_t>> hash = hash_at(recording, tick);
        if (!hash) return hash.error();
        if (!*hash) continue;
        if (**hash != hash_world(world))
            return Error{recording.path + " is repeated otherwise than it was recorded: its state at tick " +
                         std::to_string(tick) + " is another, and " + equal +
                         ". What was changed outside of a tick may be more than inputs hold; record it as "
                         "motion."};
        equal = "that at tick " + std::to_string(tick) + " is equal";
    }
    clear_progress();
    return {};
}

Result<void> check_recording(const Options& options) {
    Result<PlayingPtr> opened = open_playing(options.replay, options.threads);
    if (!opened) return opened.error();
    Playing& playing = **opened;
    const Recording& recording = *playing.replay.recording;
    if (Result<void> read = read_all(playing.replay); !read) return read;
    const bool is_motion = playing.head.as == RecordedAs::motion;
    if (!is_motion) {
        if (Result<void> found = find_files(options.scene); !found) return found;
        Result<Loaded> loaded = load(options);
        if (!loaded) return loaded.error();
        if (Result<void> same = simulate_again(playing, *loaded->world); !same) return same;
    }
    std::printf("%s: %s of %s, recorded by flaneur %s, ticks %u to %u (%.1f s), %zu chunks, all %s.\n",
                recording.path.c_str(), is_motion ? "motion" : "inputs", playing.head.scene_name.c_str(),
                playing.head.program.c_str(), playing.first, playing.last,
                (playing.last - playing.first) / 60.0, recording.chunks.size(),
                is_motion ? "as they were written" : "as they were written and simulated");
    if (recording.left_out > 0)
        std::printf("Its last %llu bytes are left out: they were not written to their end.\n",
                    static_cast<unsigned long long>(recording.left_out));
    if (!recording.is_finished) std::printf("Whoever recorded it has not finished it.\n");
    return {};
}

#ifdef FLANEUR_VULKAN
bool has_display() {
    const char* x = std::getenv("DISPLAY");
    const char* wayland = std::getenv("WAYLAND_DISPLAY");
    return (x && *x) || (wayland && *wayland);
}

Result<void> show_recording(Options options) {
    if (options.out.empty() && !options.has_ticks && is_whole(options.shard) && has_display()) {
        options.command = Command::view;
        const bool is_tracks = options.replay.empty();
        options.words = {"--replay", is_tracks ? options.scene.trajectories : options.replay};
        if (is_tracks)
            for (std::string& word : told_reading(options.scene.reading)) options.words.push_back(word);
        return run_view(options);
    }
    options.command = Command::render;
    if (options.out.empty()) {
        const bool is_one = options.has_ticks && count(options.ticks) == 1;
        options.out = is_one ? "out/replay.png" : "out/replay.mp4";
        say("No window is asked for, or there is no display: it goes to " + options.out);
    }
    return run_render(options);
}
#endif

}  // namespace

Result<void> run_replay(const Options& options) {
    if (options.checks_replay && options.replay.empty())
        return Error{"--check is for recordings; flaneur inspect " + options.scene.trajectories +
                     " says what is in it."};
    if (options.checks_replay) return check_recording(options);
#ifdef FLANEUR_VULKAN
    return show_recording(options);
#else
    return Error{
        "This flaneur was built without Vulkan, and shows nothing: say --check to have a recording read."};
#endif
}

Result<void> run_diff(const Options& options) {
    if (options.compared.size() != 2)
        return Error{"diff compares two recordings: say flaneur diff A.flr B.flr."};
    return compare_recordings(options.compared[0], options.compared[1], options.within, options);
}

}  // namespace flaneur
