#include "assets/measures/moments.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "sim/base/math.h"

namespace flaneur {
namespace {

constexpr size_t k_frames_a_chunk = 8;

std::vector<Vec2> places_of(std::span<const Sighting> seen) {
    std::vector<Vec2> places;
    places.reserve(seen.size());
    for (const Sighting& s : seen) places.push_back(s.at);
    return places;
}

AreaMoment moment_of(std::span<const Sighting> seen, const MeasuredArea& area, const CellGround& ground,
                     std::span<const float> speeds, VoronoiCell& cell) {
    const std::vector<Vec2> places = places_of(seen);
    const PeopleGrid grid = people_grid(places);
    const bool has_cut_off = ground.cut_off.radius > 0;
    const Rectangle close = widened(area.ground.box, ground.cut_off.radius);
    AreaMoment moment{.frame = seen[0].frame};
    double walking = 0, speed = 0;
    for (uint32_t i = 0; i < places.size(); ++i) {
        if (has_cut_off && !touch(close, {places[i], places[i]})) continue;
        const double own_speed = wide(speeds[i]);
        if (is_in(area, places[i])) {
            ++moment.people;
            if (!std::isnan(own_speed)) speed += own_speed, ++walking;
        }
        make_cell(grid, i, ground, cell);
        if (cell.area <= 0) continue;
        const double part = area_within(area, cell, places[i]);
        moment.voronoi += part / cell.area;
        if (std::isnan(own_speed)) continue;
        moment.covered += part;
        moment.voronoi_speed += part * own_speed;
    }
    moment.mean_speed = speed / walking;
    moment.classic = moment.people / area.square_metres;
    for (double* sum : {&moment.voronoi, &moment.voronoi_speed, &moment.covered}) *sum /= area.square_metres;
    return moment;
}

PersonalSpace space_of(const PeopleGrid& grid, uint32_t who, const CellGround& ground, VoronoiCell& cell) {
    make_cell(grid, who, ground, cell);
    PersonalSpace space{.area = static_cast<float>(cell.area),
                        .nearest = std::numeric_limits<float>::infinity(),
                        .neighbours = static_cast<uint32_t>(cell.neighbours.size())};
    for (uint32_t other : cell.neighbours) space.mean_distance += length(grid.of[other] - grid.of[who]);
    if (space.neighbours > 0) space.mean_distance /= static_cast<float>(space.neighbours);
    space.nearest = distance_to_nearest(grid, who);
    return space;
}

}  // namespace

std::vector<AreaMoment> area_moments(const TrackTable& table, const MeasuredArea& area,
                                     const CellGround& ground, std::span<const float> speeds,
                                     FrameRange range, Workers& workers) {
    const auto [first, last] = frames_in(table, range);
    std::vector<AreaMoment> moments(last - first);
    parallel_for(
        workers, moments.size(), k_frames_a_chunk, [&, first = first](size_t begin, size_t end, int) {
            VoronoiCell cell;
            for (size_t k = begin; k < end; ++k) {
                const std::span<const Sighting> seen = seen_in(table, first + k);
                moments[k] =
                    moment_of(seen, area, ground, speeds.subspan(table.begins[first + k], seen.size()), cell);
            }
        });
    return moments;
}

std::vector<PersonalSpace> personal_spaces(const TrackTable& table, const CellGround& ground,
                                           FrameRange range, Workers& workers) {
    const auto [first, last] = frames_in(table, range);
    std::vector<PersonalSpace> spaces(table.of->sightings.size());
    parallel_for(workers, last - first, k_frames_a_chunk, [&, first = first](size_t begin, size_t end, int) {
        VoronoiCell cell;
        for (size_t k = first + begin; k < first + end; ++k) {
            const std::vector<Vec2> places = places_of(seen_in(table, k));
            const PeopleGrid grid = people_grid(places);
            for (uint32_t i = 0; i < places.size(); ++i)
                spaces[table.begins[k] + i] = space_of(grid, i, ground, cell);
        }
    });
    return spaces;
}

std::vector<FundamentalPoint> fundamental_points(std::span<const AreaMoment> moments, DensityMethod method) {
    std::vector<FundamentalPoint> points;
    for (const AreaMoment& m : moments) {
        const FundamentalPoint point = method == DensityMethod::classic
                                           ? FundamentalPoint{m.classic, m.mean_speed}
                                           : FundamentalPoint{m.voronoi, speed_where_covered(m)};
        if (point.density > 0 && std::isfinite(point.speed)) points.push_back(point);
    }
    return points;
}

std::vector<FundamentalBin> fundamental_bins(std::span<const FundamentalPoint> points, double step) {
    std::map<int64_t, FundamentalBin> bins;
    for (const FundamentalPoint& p : points) {
        const auto number = static_cast<int64_t>(std::floor(p.density / step));
        FundamentalBin& bin = bins[number];
        bin.from = static_cast<double>(number) * step;
        ++bin.moments;
        bin.density += p.density;
        bin.speed += p.speed;
        bin.flow += p.density * p.speed;
        bin.speed_spread += p.speed * p.speed;
    }
    std::vector<FundamentalBin> rising;
    for (auto& [number, bin] : bins) {
        const auto n = static_cast<double>(bin.moments);
        for (double* sum : {&bin.density, &bin.speed, &bin.flow, &bin.speed_spread}) *sum /= n;
        bin.speed_spread = std::sqrt(std::max(bin.speed_spread - bin.speed * bin.speed, 0.0));
        rising.push_back(bin);
    }
    return rising;
}

double weidmann_speed(double density) {
    if (density <= 0) return 1.34;
    return std::max(0.0, 1.34 * (1 - std::exp(-1.913 * (1 / density - 1 / 5.4))));
}

std::vector<Sojourn> sojourns(const TrackTable& table, const MeasuredArea& area, FrameRange range) {
    std::vector<Sojourn> sojourns;
    for (size_t k = 0; k < table.ids.size(); ++k) {
        bool goes_on = false;
        for (uint32_t i : sightings_of(table, k)) {
            const Sighting& s = table.of->sightings[i];
            if (s.frame < range.first || s.frame > range.last || !is_in(area, s.at)) {
                goes_on = false;
                continue;
            }
            if (goes_on && sojourns.back().last + 1 == s.frame)
                sojourns.back().last = s.frame;
            else
                sojourns.push_back({s.id, s.frame, s.frame});
            goes_on = true;
        }
    }
    return sojourns;
}

double seconds_of(const Sojourn& sojourn, float fps) {
    return (sojourn.last - sojourn.first + 1) / wide(fps);
}

}  // namespace flaneur
