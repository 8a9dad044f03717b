#include "tools/flaneur/tracks/record.h"

#include <algorithm>

#include "assets/files/file.h"
#include "assets/trajectories/walkable.h"
#include "sim/base/math.h"
#include "sim/base/tick.h"
#include "sim/world.h"

namespace flaneur {
namespace {

// Those who are there `share` of a tick after the one before the last, 0 .. 1.
void find_people(TrackRecord& record, const World& world, float share) {
    const Crowd& crowd = world.crowd;
    record.people.clear();
    for (uint32_t i = 0; i < crowd.count; ++i) {
        if (!is_there(crowd, i)) continue;
        const uint32_t generation = crowd.slots.generation[i];
        const uint32_t number = number_of(world, i, record.has_their_numbers);
        Vec3 at = crowd.motion.position[i];
        Vec2 facing = heading_direction(crowd.motion.heading[i]);
        if (share < 1) {
            if (i >= record.before.size()) continue;
            const TrackRecord::Before& before = record.before[i];
            if (!before.is_there || before.generation != generation) continue;
            at = lerp(before.at, at, share);
            facing = normalize_or(lerp(heading_direction(before.heading), facing, share), facing);
        }
        if (record.seen) record.seen->insert(number);
        if (!is_wanted(record.wanted, number)) continue;
        record.people.push_back({record.frame, number, on_ground(at), at.y, facing});
    }
    std::sort(record.people.begin(), record.people.end(),
              [](const Sighting& a, const Sighting& b) { return a.id < b.id; });
}

void remember(TrackRecord& record, const World& world) {
    const Crowd& crowd = world.crowd;
    record.before.resize(crowd.count);
    for (uint32_t i = 0; i < crowd.count; ++i)
        record.before[i] = {is_there(crowd, i), crowd.slots.generation[i], crowd.motion.position[i],
                            crowd.motion.heading[i]};
}

}  // namespace

uint32_t number_of(const World& world, uint32_t walker, bool as_traced) {
    if (as_traced && is_on(world.traced)) return world.traced.traces->ways[world.traced.way_of[walker]].id;
    return person_number(world.crowd, {walker, world.crowd.slots.generation[walker]});
}

bool is_wanted(const std::vector<WalkerRange>& wanted, uint32_t number) {
    return wanted.empty() || std::ranges::any_of(wanted, [&](const WalkerRange& range) {
               return range.first <= number && number <= range.last;
           });
}

Result<PartFilePtr> open_tracks(const std::string& path) {
    if (path.empty()) return PartFilePtr();
    const std::optional<TrajectoryFormat> format = trajectory_format_of(path);
    if (!format)
        return Error{
            "--trajectories " + path +
            " must end in .csv, .sqlite, .txt, .xml, .json, .geojson or .traj, which tells its format."};
    if (*format == TrajectoryFormat::sqlite && is_stream(path))
        return Error{
            "--trajectories " + path +
            " is a pipe or a device, and a database is written here and there: give the name of a file."};
    return open_file(path);
}

Result<void> begin_tracks(TrackRecord& record, const World& world, uint32_t fps) {
    if (!record.file) return {};
    const TrajectoryFormat format = *trajectory_format_of(record.file->path);
    std::vector<WalkablePolygon> area;
    if (format == TrajectoryFormat::sqlite) area = walkable_area(*world.ground);
    // A file that is there already is written beside itself as any other; a device never comes here.
    Result<TrajectoryWriterPtr> writer =
        begin_trajectories(format, record.file->file, record.file->part, static_cast<float>(fps), area,
                           "flaneur " FLANEUR_VERSION);
    if (!writer) return Error{"Cannot write " + record.file->path + ": " + writer.error().message};
    record.writer = std::move(*writer);
    record.fps = fps;
    record.begin = world.tick;
    add_tick(record, world);
    return {};
}

bool add_tick(TrackRecord& record, const World& world) {
    if (!record.writer) return true;
    bool written = true;
    const int64_t tick = int64_t{world.tick} - record.begin, fps = record.fps;
    while (written && record.frame * k_ticks_a_second <= tick * fps) {
        const int64_t past = record.frame * k_ticks_a_second - (tick - 1) * fps;  // in parts of a tick
        find_people(record, world, past >= fps ? 1 : static_cast<float>(past) / static_cast<float>(fps));
        written = add_frame(*record.writer, record.frame, record.people);
        ++record.frame;
    }
    remember(record, world);
    return written;
}

Result<void> finish_tracks(TrackRecord record) {
    if (!record.file) return {};
    if (Result<void> written = finish_trajectories(std::move(record.writer)); !written)
        return Error{"Cannot write " + record.file->path + ": " + written.error().message};
    return keep_file(std::move(record.file));
}

}  // namespace flaneur
