#include "sim/lanes/roadway.h"

#include <algorithm>
#include <cmath>

#include "sim/lanes/near.h"

namespace flaneur {

OffBox off_box(const VehicleBox& box, Vec2 place) {
    const OnBox at = on_box(box, place);
    const Vec2 left{box.ahead.z, -box.ahead.x};
    const float z = std::fabs(at.ahead) - box.half_length, x = std::fabs(at.left) - box.half_width;
    const Vec2 end = at.ahead < 0 ? -box.ahead : box.ahead, side = at.left < 0 ? -left : left;
    if (z <= 0 && x <= 0) return z > x ? OffBox{z, end} : OffBox{x, side};
    const Vec2 out = end * std::max(z, 0.0f) + side * std::max(x, 0.0f);
    const float far = length(out);
    return {far, out / far};
}

bool overlap(const VehicleBox& a, const VehicleBox& b, float grown) {
    const Vec2 between = b.middle - a.middle;
    const float reach = a.half_length + b.half_length + grown;
    if (length_squared(between) > (reach + 3) * (reach + 3)) return false;
    auto apart = [&](const VehicleBox& on, Vec2 axis) {
        const VehicleBox& other = &on == &a ? b : a;
        const Vec2 left{other.ahead.z, -other.ahead.x};
        const bool is_ahead = std::fabs(dot(axis, on.ahead)) > 0.5f;
        return std::fabs(dot(between, axis)) > (is_ahead ? on.half_length : on.half_width) + grown +
                                                   other.half_length * std::fabs(dot(other.ahead, axis)) +
                                                   other.half_width * std::fabs(dot(left, axis));
    };
    for (const VehicleBox* box : {&a, &b})
        for (const Vec2 axis : {box->ahead, Vec2{box->ahead.z, -box->ahead.x}})
            if (apart(*box, axis)) return false;
    return true;
}

static int square_at(float v) { return static_cast<int>(std::floor(v)); }

uint32_t square_of(const RoadRaster& r, Vec2 place) {
    constexpr int k_tile = RoadRaster::k_tile;
    const int x = square_at(place.x * RoadRaster::k_per_metre) - r.low_x * k_tile,
              z = square_at(place.z * RoadRaster::k_per_metre) - r.low_z * k_tile;
    if (x < 0 || z < 0 || x >= r.width * k_tile || z >= r.depth * k_tile) return RoadRaster::k_nowhere;
    const uint32_t tile = r.tiles[static_cast<size_t>(z / k_tile * r.width + x / k_tile)];
    if (tile == RoadRaster::k_nowhere) return tile;
    return tile + static_cast<uint32_t>(z % k_tile * k_tile + x % k_tile);
}

// Calls visit(place) for places all over what a lane takes.
template <class Visit>
static void for_each_place(const Lanes& lanes, const Lane& lane, float half, const Visit& visit) {
    constexpr float k_step = 0.25f;
    for (uint32_t k = 0; k + 1 < lane.count; ++k) {
        const Vec2 a = on_ground(lanes.places[lane.first + k]),
                   b = on_ground(lanes.places[lane.first + k + 1]);
        const Vec2 along = normalize_or(b - a, {0, 1}), left{along.z, -along.x};
        for (const float t : {0.0f, 0.25f, 0.5f, 0.75f})
            for (float aside = -half; aside <= half; aside += k_step) visit(lerp(a, b, t) + left * aside);
    }
}

static void lay_tiles(RoadRaster& r, const Lanes& lanes) {
    constexpr float k_tile = RoadRaster::k_tile / RoadRaster::k_per_metre, k_beyond = 4;
    Vec2 low{1e9f, 1e9f}, high{-1e9f, -1e9f};
    for (const Vec3& p : lanes.places) {
        low = {std::min(low.x, p.x), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.z, p.z)};
    }
    r.low_x = square_at((low.x - k_beyond) / k_tile), r.low_z = square_at((low.z - k_beyond) / k_tile);
    r.width = square_at((high.x + k_beyond) / k_tile) - r.low_x + 1;
    r.depth = square_at((high.z + k_beyond) / k_tile) - r.low_z + 1;
    r.tiles.assign(static_cast<size_t>(r.width) * static_cast<size_t>(r.depth), RoadRaster::k_nowhere);
}

RoadMap make_road_map(Lanes lanes, const Crossings& crossings) {
    RoadMap map{std::move(lanes), crossings, {}};
    if (!has_lanes(map.lanes)) return map;
    RoadRaster& r = map.raster;
    lay_tiles(r, map.lanes);
    auto mark = [&](Vec2 place, uint16_t what, bool lays) {
        const int x = square_at(place.x * RoadRaster::k_per_metre) - r.low_x * RoadRaster::k_tile,
                  z = square_at(place.z * RoadRaster::k_per_metre) - r.low_z * RoadRaster::k_tile;
        if (x < 0 || z < 0 || x >= r.width * RoadRaster::k_tile || z >= r.depth * RoadRaster::k_tile) return;
        uint32_t& tile =
            r.tiles[static_cast<size_t>(z / RoadRaster::k_tile * r.width + x / RoadRaster::k_tile)];
        if (tile == RoadRaster::k_nowhere) {
            if (!lays) return;
            tile = static_cast<uint32_t>(r.what.size());
            r.what.resize(r.what.size() + RoadRaster::k_tile * RoadRaster::k_tile, RoadRaster::k_off);
        }
        uint16_t& square = r.what[square_of(r, place)];
        if (lays || square != RoadRaster::k_off) square = what;
    };
    for (const Lane& lane : map.lanes.all)
        for_each_place(map.lanes, lane, std::min(lane.width / 2, 2.4f) - 0.15f,
                       [&](Vec2 place) { mark(place, RoadRaster::k_lane, true); });
    for (size_t c = 0; c < std::min<size_t>(crossings.all.size(), 0xfff0); ++c) {
        const Crossing& crossing = crossings.all[c];
        for (float over = -crossing.half_length; over <= crossing.half_length; over += 0.25f)
            for (float aside = -crossing.half_width; aside <= crossing.half_width; aside += 0.25f)
                mark(on_ground(crossing.centre) + crossing.across * over + crossing.along * aside,
                     static_cast<uint16_t>(c + 2), false);
    }
    return map;
}

void make_room(Roadway& r, std::shared_ptr<const RoadMap> map, uint32_t vehicles) {
    r.map = std::move(map);
    r.boxes.reserve(vehicles);
    r.numbers.reserve(vehicles);
    r.order.reserve(vehicles);
    r.squares.reserve(vehicles);
    r.first.assign(2 * k_roadway_squares + 1, 0);
    r.arrival.assign(r.map ? r.map->raster.what.size() / 4 : 0, Roadway::k_nobody_comes);
    r.painted.reserve(r.arrival.size());
    clear(r);
}

void clear(Roadway& r) {
    r.boxes.clear();
    r.numbers.clear();
    for (const uint32_t quad : r.painted) r.arrival[quad] = Roadway::k_nobody_comes;
    r.painted.clear();
    r.longest = 0;
}

void add_box(Roadway& r, const VehicleBox& box, uint32_t number) {
    r.boxes.push_back(box);
    r.numbers.push_back(number);
    r.longest = std::max(r.longest, box.half_length + box.half_width);
}

// Squares in which somebody may be near a box.
static void mark_near(Roadway& r, const VehicleBox& box) {
    const float reach = box.half_length + box.half_width + k_minds_vehicles;
    auto square = [](float v) { return square_at(v / Roadway::k_square); };
    for (int z = square(box.middle.z - reach); z <= square(box.middle.z + reach); ++z)
        for (int x = square(box.middle.x - reach); x <= square(box.middle.x + reach); ++x) {
            const Vec2 place{static_cast<float>(x) * Roadway::k_square,
                             static_cast<float>(z) * Roadway::k_square};
            r.first[k_roadway_squares + 1 + roadway_square(place)] = 1;
        }
}

void sort_boxes(Roadway& r) {
    std::fill(r.first.begin(), r.first.end(), 0);
    r.squares.clear();
    for (const VehicleBox& box : r.boxes) r.squares.push_back(roadway_square(box.middle));
    for (const uint32_t square : r.squares) ++r.first[square + 1];
    for (size_t k = 1; k <= k_roadway_squares; ++k) r.first[k] += r.first[k - 1];
    r.order.resize(r.boxes.size());
    for (size_t i = r.boxes.size(); i-- > 0;) r.order[--r.first[r.squares[i] + 1]] = static_cast<uint32_t>(i);
    // Each first[square + 1] has come to where that square begins.
    for (size_t k = 0; k < k_roadway_squares; ++k) r.first[k] = r.first[k + 1];
    r.first[k_roadway_squares] = static_cast<uint32_t>(r.boxes.size());
    for (const VehicleBox& box : r.boxes) mark_near(r, box);
}

void paint(Roadway& r, Vec2 place, Vec2 along, float half_width, uint32_t ticks) {
    constexpr float k_step = 0.7f;
    const Vec2 left{along.z, -along.x};
    const auto soon = static_cast<uint16_t>(std::min(ticks, 0xfff0u));
    for (float aside = -half_width; aside <= half_width; aside += k_step) {
        const uint32_t square = square_of(r.map->raster, place + left * aside);
        if (square == RoadRaster::k_nowhere) continue;
        const uint32_t quad = quad_of(square);
        if (r.arrival[quad] <= soon) continue;
        if (r.arrival[quad] == Roadway::k_nobody_comes) r.painted.push_back(quad);
        r.arrival[quad] = soon;
    }
}

}  // namespace flaneur
