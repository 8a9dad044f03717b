#include "tools/flaneur/export/tracks.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "assets/trajectories/write.h"
#include "sim/base/math.h"
#include "sim/world.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/export/source.h"
#include "tools/flaneur/tracks/record.h"

namespace flaneur {

namespace {

void tell(const std::string& path, size_t people, uint32_t frames) {
    say("Wrote " + path + ": " + std::to_string(people) + (people == 1 ? " person, " : " people, ") +
        std::to_string(frames) + (frames == 1 ? " frame" : " frames"));
}

size_t wanted_of(const Options& options, const std::set<uint32_t>& seen) {
    return static_cast<size_t>(std::ranges::count_if(
        seen, [&](uint32_t number) { return is_wanted(options.exported.walkers, number); }));
}

// One person's sightings, by frame, and what is sought in them: the frame and the next one.
struct Row {
    std::vector<Sighting> sightings;
    size_t at = 0;
};

// Where somebody is at a time, in frames of its file; false: it is not there.
bool find(Row& row, double time, Sighting& out) {
    const auto frame = static_cast<uint32_t>(time);
    while (row.at + 1 < row.sightings.size() && row.sightings[row.at + 1].frame <= frame) ++row.at;
    const Sighting& a = row.sightings[row.at];
    const auto share = static_cast<float>(time - frame);
    out = a;
    if (a.frame != frame) return false;
    if (share == 0) return true;
    if (row.at + 1 == row.sightings.size() || row.sightings[row.at + 1].frame != frame + 1) return false;
    const Sighting& b = row.sightings[row.at + 1];
    out.at = lerp(a.at, b.at, share);
    out.height = lerp(a.height, b.height, share);
    if (a.facing != Vec2{}) out.facing = normalize_or(lerp(a.facing, b.facing, share), a.facing);
    return true;
}

// A database wants some ground: where the file has none, the box about everybody and their bodies.
std::vector<WalkablePolygon> ground_of(const Trajectories& tracks) {
    if (!tracks.area.empty()) return tracks.area;
    constexpr float k_body = 0.5f;
    Vec2 low = tracks.sightings[0].at, high = low;
    for (const Sighting& s : tracks.sightings) {
        low = {std::min(low.x, s.at.x), std::min(low.z, s.at.z)};
        high = {std::max(high.x, s.at.x), std::max(high.z, s.at.z)};
    }
    low = low - Vec2{k_body, k_body}, high = high + Vec2{k_body, k_body};
    WalkablePolygon box;
    box.outer = {low, {high.x, low.z}, high, {low.x, high.z}};
    return {box};
}

bool is_person(const Trajectories& tracks, uint32_t id) {
    const Tracked* known = tracked_of(tracks, id);
    return !known || known->kind == TrackedKind::person;
}

}  // namespace

Result<void> export_tracks(const Options& options, PartFilePtr file) {
    Result<ExportSource> source = open_source(options);
    if (!source) return source.error();
    constexpr uint32_t k_usual_fps = 25;
    std::set<uint32_t> seen;
    TrackRecord record;
    record.file = std::move(file);
    record.wanted = options.exported.walkers;
    record.has_their_numbers = !source->playing;
    record.seen = &seen;
    const uint32_t fps = options.exported.fps > 0 ? options.exported.fps : k_usual_fps;
    const Result<void> done = for_each_tick(*source, [&](const World& world) -> Result<void> {
        if (!record.writer) return begin_tracks(record, world, fps);
        return add_tick(record, world) ? Result<void>() : finish_tracks(std::move(record));  // says why
    });
    if (!done) return done;
    if (Result<void> good = check_seen(options, {seen.begin(), seen.end()}); !good) return good;
    const std::string path = record.file->path;
    const uint32_t frames = record.frame;
    if (Result<void> finished = finish_tracks(std::move(record)); !finished) return finished;
    tell(path, wanted_of(options, seen), frames);
    return {};
}

Result<void> export_file(const Options& options, PartFilePtr file) {
    Result<Trajectories> read = read_trajectories(options.file);
    if (!read) return read.error();
    std::map<uint32_t, Row> rows;
    const double rate = wide(read->fps);
    const uint32_t begin = read->sightings.front().frame, end = read->sightings.back().frame;
    size_t others = 0;
    for (const Sighting& s : read->sightings) {
        if (is_person(*read, s.id))
            rows[s.id].sightings.push_back(s);
        else
            ++others;
    }
    if (others > 0)
        say(printable(options.file) + ": " + std::to_string(others) +
            " places of what is no person are left out.");
    const Moments& seconds = options.exported.seconds;
    const double fps = options.exported.fps > 0 ? options.exported.fps : rate;
    const std::string path = file->path;
    Result<TrajectoryWriterPtr> writer =
        begin_trajectories(*trajectory_format_of(path), file->file, file->part, static_cast<float>(fps),
                           ground_of(*read), "flaneur " FLANEUR_VERSION);
    if (!writer) return Error{"Cannot write " + path + ": " + writer.error().message};
    std::set<uint32_t> seen;
    std::vector<Sighting> people;
    uint32_t frame = 0;
    bool is_written = true;
    constexpr double k_near = 1e-6;  // of a frame: roundings
    for (;; ++frame) {
        const double second = seconds.first + frame / fps;
        double at = begin + second * rate;
        if (std::fabs(at - std::round(at)) < k_near * (1 + at)) at = std::round(at);
        if (!is_written || at > end || second > seconds.last + k_near) break;
        people.clear();
        for (auto& [id, row] : rows) {
            Sighting s;
            if (!find(row, at, s)) continue;
            seen.insert(id);
            s.frame = frame;
            if (is_wanted(options.exported.walkers, id)) people.push_back(s);
        }
        is_written = add_frame(**writer, frame, people);
    }
    if (is_written)
        if (Result<void> good = check_seen(options, {seen.begin(), seen.end()}); !good) return good;
    if (Result<void> done = finish_trajectories(std::move(*writer)); !done)
        return Error{"Cannot write " + path + ": " + done.error().message};
    if (Result<void> kept = keep_file(std::move(file)); !kept) return kept;
    tell(path, wanted_of(options, seen), frame);
    return {};
}

}  // namespace flaneur
