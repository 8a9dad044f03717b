#include "tools/flaneur/measures/measures.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/base/planar.h"
#include "tools/flaneur/measures/put.h"

namespace flaneur {
namespace {

constexpr double k_speed_seconds = 0.2;     // before and after, where nothing is said
constexpr double k_least_square = 0.2;      // metres, of a map, where nothing is said,
constexpr double k_usual_squares = 20'000;  // and how many there may be then

void leave_out_vehicles(MeasuredFile& measured) {
    const std::vector<uint32_t> others = ids_of_vehicles(measured.tracks);
    if (others.empty()) return;
    std::erase_if(measured.tracks.sightings,
                  [&](const Sighting& s) { return std::binary_search(others.begin(), others.end(), s.id); });
    measured.notes.push_back(std::to_string(others.size()) + " of its ids are vehicles and are left out.");
}

void choose_ground(MeasuredFile& measured) {
    const MeasureOptions& options = measured.options;
    measured.walkable = !options.walkable.empty() ? options.walkable : measured.tracks.area;
    if (!measured.walkable.empty()) return;
    const std::vector<Sighting>& all = measured.tracks.sightings;
    Rectangle box{all[0].at, all[0].at};
    for (const Sighting& s : all) {
        box.low = {std::min(box.low.x, s.at.x), std::min(box.low.z, s.at.z)};
        box.high = {std::max(box.high.x, s.at.x), std::max(box.high.z, s.at.z)};
    }
    const Vec2 size = box.high - box.low;
    measured.walkable = {{{box.low, {box.high.x, box.low.z}, box.high, {box.low.x, box.high.z}}, {}}};
    measured.notes.push_back(
        put_values("It has no walkable area: the box about everybody, %.2f x %.2f m, is taken "
                   "for it; --walkable tells a better one.",
                   wide(size.x), wide(size.z)));
}

Result<void> choose_range(MeasuredFile& measured) {
    const MeasureOptions& options = measured.options;
    const double fps = wide(measured.tracks.fps);
    const double first = std::max(options.frames.first, std::ceil(options.seconds.first * fps - 1e-6));
    const double last = std::min(options.frames.last, std::floor(options.seconds.last * fps + 1e-6));
    measured.range = {static_cast<uint32_t>(std::min(first, 4e9)),
                      static_cast<uint32_t>(std::clamp(last, 0.0, 4e9))};
    const auto [begin, end] = frames_in(measured.table, measured.range);
    if (begin < end && first <= last) return {};
    return Error{put_values("Nobody is there then: the file has frames %u to %u, %.2f to %.2f s.",
                            measured.table.frames.front(), measured.table.frames.back(),
                            measured.table.frames.front() / fps, measured.table.frames.back() / fps)};
}

void tell_who_is_off(MeasuredFile& measured) {
    size_t off = 0;
    for (const Sighting& s : measured.tracks.sightings) {
        const CellGround::Piece& piece = piece_at(measured.ground, s.at);
        off += piece.shape == CellGround::Shape::none ||
               (piece.shape != CellGround::Shape::all && !is_on(piece, s.at));
    }
    if (off > 0)
        measured.notes.push_back(
            put_values("%zu of %zu places lie off the walkable area: who is there has no cell.", off,
                       measured.tracks.sightings.size()));
}

// 0.2, 0.5, 1, 2, 5 .. metres.
double usual_square(const Rectangle& box) {
    const Vec2 size = box.high - box.low;
    const double least = std::sqrt(wide(size.x) * wide(size.z) / k_usual_squares);
    double square = k_least_square;
    for (int k = 0; square < least; ++k) square *= k % 3 == 0 ? 2.5 : 2;
    return square;
}

Result<void> make_profiles(MeasuredFile& measured, Workers& workers) {
    const MeasureOptions& options = measured.options;
    const double square = options.profile > 0 ? options.profile : usual_square(measured.area.ground.box);
    const Vec2 size = measured.area.ground.box.high - measured.area.ground.box.low;
    if (std::ceil(wide(size.x) / square) * std::ceil(wide(size.z) / square) > k_most_field_squares)
        return Error{
            put_values("--profile %g would take more than %d squares: make them larger, or --area smaller.",
                       square, k_most_field_squares)};
    measured.profiles = profiles_of(measured.table, measured.ground, measured.speeds,
                                    profile_grid(measured.area.ground.box, static_cast<float>(square)),
                                    {.method = options.profile_method, .range = measured.range}, workers);
    return {};
}

void measure_lines(MeasuredFile& measured) {
    const MeasureOptions& options = measured.options;
    const float fps = measured.tracks.fps;
    const auto delta = static_cast<uint32_t>(std::max(1L, std::lround(options.flow_seconds * wide(fps))));
    const uint32_t last = std::min(measured.range.last, measured.table.frames.back());
    for (const CountLine& line : options.lines) {
        MeasuredLineFlow flow{.line = line};
        if (line.name.empty()) flow.line.name.append("L").append(std::to_string(measured.lines.size() + 1));
        const MeasuredLine where{line.a, line.b};
        flow.crossings = line_crossings(measured.table, where, measured.range);
        flow.first = first_crossings(flow.crossings);
        flow.flows = flow_intervals(flow.first, measured.speeds, delta, last, fps);
        if (options.passing > 0)
            flow.passages =
                passages(measured.table, where, static_cast<float>(options.passing), measured.range);
        measured.lines.push_back(std::move(flow));
    }
}

}  // namespace

Result<void> measure_file(Trajectories tracks, const MeasureOptions& options, Workers& workers,
                          MeasuredFile& measured) {
    measured.options = options;
    measured.tracks = std::move(tracks);
    measured.notes = measured.tracks.assumed;
    leave_out_vehicles(measured);
    if (measured.tracks.sightings.empty()) return Error{"It has no people."};
    measured.table = track_table(measured.tracks);
    if (Result<void> chosen = choose_range(measured); !chosen) return chosen;
    const bool has_area = !options.walkable.empty() || !measured.tracks.area.empty();
    choose_ground(measured);
    const CutOff cut_off{static_cast<float>(options.cut_off)};
    measured.area =
        measured_area(options.area.empty() ? measured.walkable : options.area, measured.walkable, cut_off);
    if (measured.area.square_metres < 0.01)
        return Error{has_area || !options.area.empty()
                         ? "Nobody can walk in that --area."
                         : "Its people are all on one line: say with --walkable where they could be."};
    measured.ground = cell_ground(measured.walkable, cut_off);
    if (has_area) tell_who_is_off(measured);
    const double fps = wide(measured.tracks.fps);
    const uint32_t step = options.frame_step > 0
                              ? options.frame_step
                              : static_cast<uint32_t>(std::max(1L, std::lround(k_speed_seconds * fps)));
    measured.options.frame_step = step;
    measured.velocities = velocities(measured.table, step, options.at_ends);
    const bool is_along = length(options.direction) > 0;
    measured.speeds =
        is_along ? speeds_along(measured.velocities, options.direction) : speeds_of(measured.velocities);

    const bool all = asks_for_all(options);
    if (all || options.voronoi || options.fundamental || options.service)
        measured.moments = area_moments(measured.table, measured.area, measured.ground, measured.speeds,
                                        measured.range, workers);
    if (all || options.profile > 0)
        if (Result<void> made = make_profiles(measured, workers); !made) return made;
    if (all || options.ttc || options.individual)
        measured.next_collisions = next_collisions(
            measured.table, measured.velocities, static_cast<float>(options.radius), measured.range, workers);
    if (all || options.dwell) measured.sojourns = sojourns(measured.table, measured.area, measured.range);
    if (all || options.individual) {
        measured.spaces = personal_spaces(measured.table, measured.ground, measured.range, workers);
        measured.accelerations = accelerations(measured.table, step);
    }
    measure_lines(measured);
    return {};
}

}  // namespace flaneur
