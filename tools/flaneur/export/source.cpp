#include "tools/flaneur/export/source.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sim/base/tick.h"
#include "sim/world.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/console/ending.h"

namespace flaneur {

namespace {

constexpr double k_usual_seconds = 10;

uint32_t tick_at(double seconds) {
    return static_cast<uint32_t>(std::lround(std::min(seconds * k_ticks_a_second, double{k_last_tick})));
}

std::string told_seconds(uint32_t tick) {
    char text[24];
    std::snprintf(text, sizeof text, "%.4g", tick / double{k_ticks_a_second});
    return text;
}

Result<void> find_part(const Options& options, ExportSource& source) {
    const Moments& seconds = options.exported.seconds;
    const bool is_open = seconds.last == Moments(ExportOptions().seconds).last;
    source.first = tick_at(seconds.first);
    source.last = tick_at(is_open && !source.playing ? seconds.first + k_usual_seconds : seconds.last);
    if (!source.playing) return {};
    const Playing& p = *source.playing;
    source.first = std::max(source.first, p.first);
    source.last = std::min(source.last, p.last);
    if (source.first <= source.last) return {};
    return Error{p.replay.recording->path + " has nothing of those seconds: it goes from " +
                 told_seconds(p.first) + " to " + told_seconds(p.last) + " s."};
}

Result<void> go_to(ExportSource& source, uint32_t tick) {
    World& world = *source.loaded.world;
    if (source.playing) return show_tick(*source.playing, world, tick);
    while (world.tick < tick) {
        if (is_stopping()) return interrupted();
        step(world);
    }
    return {};
}

// "3" or "10 to 20".
std::string told(const WalkerRange& range) {
    const std::string first = std::to_string(range.first);
    return is_single(range) ? first : first + " to " + std::to_string(range.last);
}

}  // namespace

Result<ExportSource> open_source(const Options& options) {
    ExportSource source;
    if (!options.replay.empty()) {
        Result<PlayingPtr> playing = open_playing(options.replay, options.threads);
        if (!playing) return playing.error();
        source.playing = std::move(*playing);
    }
    if (Result<void> found = find_part(options, source); !found) return found.error();
    if (Result<void> found = find_files(options.scene); !found) return found.error();
    Result<Loaded> loaded = load(options);
    if (!loaded) return loaded.error();
    source.loaded = std::move(*loaded);
    return source;
}

Result<void> for_each_tick(ExportSource& source, const std::function<Result<void>(const World&)>& take) {
    for (uint32_t tick = source.first; tick <= source.last; ++tick) {
        if (is_stopping()) return interrupted();
        if (Result<void> gone = go_to(source, tick); !gone) return gone;
        if (Result<void> taken = take(*source.loaded.world); !taken) return taken;
        if (tick % k_ticks_a_second == 0)
            show_progress("second " + std::to_string(tick / k_ticks_a_second) + " of " +
                          std::to_string(source.last / k_ticks_a_second));
    }
    clear_progress();
    return {};
}

Result<void> check_seen(const Options& options, const std::vector<uint32_t>& seen) {
    if (seen.empty()) return Error{"Nobody is there in those seconds: choose others with --seconds."};
    for (const WalkerRange& range : options.exported.walkers) {
        if (std::ranges::any_of(seen, [&](uint32_t n) { return range.first <= n && n <= range.last; }))
            continue;
        return Error{"--walkers: there is no walker " + told(range) + " in those seconds. " +
                     std::to_string(seen.size()) + (seen.size() == 1 ? " is" : " are") +
                     " there, by numbers from " + std::to_string(seen.front()) + " to " +
                     std::to_string(seen.back()) + "."};
    }
    return {};
}

}  // namespace flaneur
