// What those on foot see of those who drive: where carriageways are, where vehicles stand and drive just now,
// and when one comes where. Nothing of it is kept from tick to tick: it is made anew of the vehicles.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "sim/lamps/crossings.h"
#include "sim/lanes/lanes.h"

namespace flaneur {

// A vehicle on the ground plane: a box.
struct VehicleBox {
    Vec2 middle, ahead{0, 1};  // ahead: unit
    float half_length = 0, half_width = 0;
    float y = 0;      // of the ground under it
    float speed = 0;  // m/s
};
// Metres along and aside from its middle.
struct OnBox {
    float ahead = 0, left = 0;
};
inline OnBox on_box(const VehicleBox& box, Vec2 place) {
    const Vec2 from = place - box.middle;
    return {dot(from, box.ahead), -cross(box.ahead, from)};
}
// Metres from a box to a place; less than 0 within, to the nearest side. And the unit vector that leads from
// it to the place.
struct OffBox {
    float far = 0;
    Vec2 out;
};
OffBox off_box(const VehicleBox& box, Vec2 place);
// Whether two boxes overlap, the first grown by so much to all sides.
bool overlap(const VehicleBox& a, const VehicleBox& b, float grown);

// The carriageways of a map by squares of half a metre.
struct RoadRaster {
    static constexpr int k_tile = 32;        // squares
    static constexpr float k_per_metre = 2;  // the same
    static constexpr uint32_t k_nowhere = ~0u;
    int low_x = 0, low_z = 0, width = 0, depth = 0;  // in tiles
    std::vector<uint32_t> tiles;                     // first square of each, or k_nowhere
    std::vector<uint16_t> what;                      // by square: k_off, k_lane, or 2 more than a crossing
    static constexpr uint16_t k_off = 0, k_lane = 1;
};
// The square of a place, or RoadRaster::k_nowhere.
uint32_t square_of(const RoadRaster& raster, Vec2 place);

// Of four of them together, numbered anew.
inline uint32_t quad_of(uint32_t square) {
    constexpr uint32_t k_tile = RoadRaster::k_tile, k_whole = k_tile * k_tile;
    const uint32_t x = square % k_tile, z = square % k_whole / k_tile;
    return square / k_whole * (k_whole / 4) + z / 2 * (k_tile / 2) + x / 2;
}

// What does not change.
struct RoadMap {
    Lanes lanes;
    Crossings crossings;
    RoadRaster raster;
};
RoadMap make_road_map(Lanes lanes, const Crossings& crossings);
// Whether a place is on a carriageway where one drives.
inline bool is_driven_on(const RoadMap& map, Vec2 place) {
    const uint32_t square = square_of(map.raster, place);
    return square != RoadRaster::k_nowhere && map.raster.what[square] != RoadRaster::k_off;
}

// What vehicles are there, sorted by squares of the ground plane, and when one will be where.
struct Roadway {
    static constexpr int k_side = 64;     // squares; the plane is wrapped onto them
    static constexpr float k_square = 8;  // metres
    static constexpr uint16_t k_nobody_comes = 0xffff;
    std::shared_ptr<const RoadMap> map;           // null: nobody drives
    std::vector<VehicleBox> boxes;                // those that are there,
    std::vector<uint32_t> numbers;                // of these vehicles
    std::vector<uint32_t> first, order, squares;  // boxes by square
    float longest = 0;                            // half, metres
    std::vector<uint16_t> arrival;                // by quad of the raster: ticks until one comes
    std::vector<uint32_t> painted;                // quads where one does
};
inline bool has_traffic(const Roadway& roadway) { return roadway.map != nullptr; }

// Room for so many. Allocates.
void make_room(Roadway& roadway, std::shared_ptr<const RoadMap> map, uint32_t vehicles);
// Begins anew; then boxes are added, and sorted.
void clear(Roadway& roadway);
void add_box(Roadway& roadway, const VehicleBox& box, uint32_t number);
void sort_boxes(Roadway& roadway);
// A vehicle will be at a place, so broad to each side, in so many ticks.
void paint(Roadway& roadway, Vec2 place, Vec2 along, float half_width, uint32_t ticks);

// Calls visit(index of box) for all within `reach` of a place, and others.
template <class Visit>
void for_boxes_near(const Roadway& r, Vec2 place, float reach, const Visit& visit) {
    const float far = reach + r.longest;
    auto square = [](float v) { return static_cast<int>(std::floor(v / Roadway::k_square)); };
    for (int z = square(place.z - far); z <= square(place.z + far); ++z)
        for (int x = square(place.x - far); x <= square(place.x + far); ++x) {
            const auto at = static_cast<uint32_t>((z & (Roadway::k_side - 1)) * Roadway::k_side +
                                                  (x & (Roadway::k_side - 1)));
            for (uint32_t k = r.first[at]; k < r.first[at + 1]; ++k) visit(r.order[k]);
        }
}

// What one on foot who comes along sees.
struct Walking {
    Vec3 at;
    Vec2 way;            // unit: where it goes on
    float speed = 1.3f;  // m/s at which it crosses
    float ahead = 0;     // metres that what it pushes is before it
    uint32_t tick = 0;
};
// Whether it is about to step onto a carriageway and somebody comes whom it would hinder. It lets pass who
// would be there before it is over and 2 s more, of an unmarked place, where it looks for itself: gaps of
// 4.5 to 6 s for usual streets (Brewer, Fitzpatrick, Whitacre & Lord 2006: 85 of 100 take 5.3 to 6.2 s); on a
// crossing, where others give way, only who cannot stop any more; but on red nobody gives way.
bool must_let_pass(const Roadway& roadway, const Walking& walking);
// The wish of one whom a vehicle that stands would be in the way of: round the end that is less of a detour.
Vec2 round_vehicles(const Roadway& roadway, Vec3 here, Vec2 wanted, float radius);

}  // namespace flaneur
