#include "assets/measures/profile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/base/math.h"
#include "sim/base/planar.h"

namespace flaneur {
namespace {

// What is summed up in each square over people and frames.
struct FieldSums {
    std::vector<double> density, flow, weight, moved;  // speed is moved / weight
    explicit FieldSums(size_t count) : density(count), flow(count), weight(count), moved(count) {}
};

void add_to(FieldSums& sums, size_t square, double density, double weight, double speed) {
    sums.density[square] += density;
    if (std::isnan(speed)) return;
    sums.flow[square] += density * speed;
    sums.weight[square] += weight;
    sums.moved[square] += weight * speed;
}

// Splits a ring along a line of the grid: what lies up to `at` goes to `low`, the rest stays.
void take_low(std::vector<Vec2>& ring, std::vector<Vec2>& low, std::vector<Vec2>& scratch, bool across_x,
              float at) {
    const Vec2 normal = across_x ? Vec2{1, 0} : Vec2{0, 1};
    low = ring;
    cut_by(low, scratch, normal, at);
    cut_by(ring, scratch, -normal, -at);
}

Rectangle box_of(std::span<const Vec2> ring) {
    Rectangle box{ring[0], ring[0]};
    for (Vec2 p : ring) {
        box.low = {std::min(box.low.x, p.x), std::min(box.low.z, p.z)};
        box.high = {std::max(box.high.x, p.x), std::max(box.high.z, p.z)};
    }
    return box;
}

// The first and last column, or row, that a span touches.
std::pair<int, int> lines_of(float low, float high, float square, int count) {
    const int first =
        static_cast<int>(std::floor(std::clamp(low / square, -1.0f, static_cast<float>(count))));
    const int last =
        static_cast<int>(std::floor(std::clamp(high / square, -1.0f, static_cast<float>(count))));
    return {std::max(first, 0), std::min(last, count - 1)};
}

struct RingScratch {
    std::vector<Vec2> rest, strip, part, scratch;
};

// Calls add(square, square metres, less than 0 of holes) with how much of each square lies in a ring, whose
// corners are told from the grid's.
template <class Add>
void share_out(std::span<const Vec2> ring, const ProfileGrid& grid, RingScratch& room, const Add& add) {
    if (ring.size() < 3) return;
    const Rectangle box = box_of(ring);
    const auto [top, bottom] = lines_of(box.low.z, box.high.z, grid.square, grid.rows);
    room.rest.assign(ring.begin(), ring.end());
    if (box.low.z < 0) take_low(room.rest, room.strip, room.scratch, false, 0);
    for (int row = top; row <= bottom; ++row) {
        take_low(room.rest, room.strip, room.scratch, false, grid.square * static_cast<float>(row + 1));
        if (room.strip.size() < 3) continue;
        const Rectangle strip_box = box_of(room.strip);
        const auto [left, right] = lines_of(strip_box.low.x, strip_box.high.x, grid.square, grid.columns);
        if (strip_box.low.x < 0) take_low(room.strip, room.part, room.scratch, true, 0);
        for (int column = left; column <= right; ++column) {
            take_low(room.strip, room.part, room.scratch, true, grid.square * static_cast<float>(column + 1));
            if (room.part.size() >= 3)
                add(static_cast<size_t>(row) * static_cast<size_t>(grid.columns) +
                        static_cast<size_t>(column),
                    signed_area_of(room.part));
        }
    }
}

void add_cells(FieldSums& sums, const ProfileGrid& grid, std::span<const Vec2> places,
               std::span<const float> speeds, const CellGround& ground, VoronoiCell& cell,
               RingScratch& room) {
    const PeopleGrid people = people_grid(places);
    const double square_metres = wide(grid.square) * wide(grid.square);
    const Rectangle all{
        grid.low,
        grid.low + Vec2{static_cast<float>(grid.columns), static_cast<float>(grid.rows)} * grid.square};
    const bool has_cut_off = ground.cut_off.radius > 0;
    std::vector<Vec2> ring;
    for (uint32_t i = 0; i < places.size(); ++i) {
        if (has_cut_off && !touch(widened(all, ground.cut_off.radius), {places[i], places[i]})) continue;
        make_cell(people, i, ground, cell);
        if (cell.area <= 0) continue;
        for (const std::vector<Vec2>& own : cell.rings) {
            ring.clear();
            for (Vec2 p : own) ring.push_back(places[i] - grid.low + p);
            share_out(ring, grid, room, [&](size_t square, double part) {
                add_to(sums, square, part / cell.area / square_metres, part, wide(speeds[i]));
            });
        }
    }
}

void add_places(FieldSums& sums, const ProfileGrid& grid, std::span<const Vec2> places,
                std::span<const float> speeds) {
    const double square_metres = wide(grid.square) * wide(grid.square);
    for (size_t i = 0; i < places.size(); ++i) {
        const Vec2 at = (places[i] - grid.low) / grid.square;
        if (!(at.x >= 0 && at.z >= 0)) continue;
        if (at.x >= static_cast<float>(grid.columns) || at.z >= static_cast<float>(grid.rows)) continue;
        const size_t square =
            static_cast<size_t>(at.z) * static_cast<size_t>(grid.columns) + static_cast<size_t>(at.x);
        add_to(sums, square, 1 / square_metres, 1, wide(speeds[i]));
    }
}

void add_gaussians(FieldSums& sums, const ProfileGrid& grid, std::span<const Vec2> places,
                   std::span<const float> speeds, double width) {
    const double sigma = width / (2 * std::sqrt(2 * std::log(2.0))), reach = 6 * sigma;
    const double scale = 1 / (sigma * std::sqrt(2 * 3.14159265358979323846));
    std::vector<double> across, down;
    for (size_t i = 0; i < places.size(); ++i) {
        const Vec2 at = places[i] - grid.low;
        // Weights of the middles of squares near by, column by column and row by row.
        auto weigh = [&](std::vector<double>& weights, double place, int count) {
            const auto [first, last] = lines_of(static_cast<float>(place - reach),
                                                static_cast<float>(place + reach), grid.square, count);
            weights.clear();
            for (int k = first; k <= last; ++k) {
                const double off = (k + 0.5) * wide(grid.square) - place;
                weights.push_back(scale * std::exp(-off * off / (2 * sigma * sigma)));
            }
            return first;
        };
        const int left = weigh(across, wide(at.x), grid.columns), top = weigh(down, wide(at.z), grid.rows);
        for (size_t r = 0; r < down.size(); ++r)
            for (size_t c = 0; c < across.size(); ++c) {
                const size_t square = (static_cast<size_t>(top) + r) * static_cast<size_t>(grid.columns) +
                                      static_cast<size_t>(left) + c;
                add_to(sums, square, down[r] * across[c], down[r] * across[c], wide(speeds[i]));
            }
    }
}

}  // namespace

ProfileGrid profile_grid(const Rectangle& area, float square) {
    const Vec2 size = (area.high - area.low) / square;
    auto count = [](float squares) { return std::max(static_cast<int>(std::ceil(squares - 1e-4f)), 1); };
    return {area.low, square, count(size.x), count(size.z)};
}

Profiles profiles_of(const TrackTable& table, const CellGround& ground, std::span<const float> speeds,
                     const ProfileGrid& grid, const ProfileOf& what, Workers& workers) {
    auto [first, last] = frames_in(table, what.range);
    const size_t count = (last - first + what.every - 1) / what.every;
    // A sum a stretch of frames, whatever thread has it: the same on any number of them.
    constexpr size_t k_stretches = 16;
    const size_t grain = std::max<size_t>((count + k_stretches - 1) / k_stretches, 1);
    std::vector<FieldSums> stretches((count + grain - 1) / grain, FieldSums(count_of(grid)));
    parallel_for(workers, count, grain, [&, first = first](size_t begin, size_t end, int) {
        VoronoiCell cell;
        RingScratch room;
        std::vector<Vec2> places;
        FieldSums& sums = stretches[begin / grain];
        for (size_t n = begin; n < end; ++n) {
            const size_t k = first + n * what.every;
            const std::span<const Sighting> seen = seen_in(table, k);
            const std::span<const float> own = speeds.subspan(table.begins[k], seen.size());
            places.clear();
            for (const Sighting& s : seen) places.push_back(s.at);
            if (what.method == FieldMethod::voronoi)
                add_cells(sums, grid, places, own, ground, cell, room);
            else if (what.method == FieldMethod::gaussian)
                add_gaussians(sums, grid, places, own, wide(what.gaussian_width));
            else
                add_places(sums, grid, places, own);
        }
    });
    Profiles profiles{.grid = grid, .frames = count};
    for (size_t square = 0; square < count_of(grid); ++square) {
        double density = 0, flow = 0, weight = 0, moved = 0;
        for (const FieldSums& sums : stretches) {
            density += sums.density[square], flow += sums.flow[square];
            weight += sums.weight[square], moved += sums.moved[square];
        }
        const double frames = std::max<double>(static_cast<double>(count), 1);
        profiles.density.push_back(static_cast<float>(density / frames));
        profiles.flow.push_back(static_cast<float>(flow / frames));
        profiles.speed.push_back(weight > 1e-9 ? static_cast<float>(moved / weight)
                                               : std::numeric_limits<float>::quiet_NaN());
    }
    return profiles;
}

}  // namespace flaneur
