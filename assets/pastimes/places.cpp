#include "assets/pastimes/places.h"

#include <cmath>

#include "assets/pastimes/edges.h"
#include "sim/base/math.h"

namespace flaneur {

namespace {

// As add_bench() in assets/props/props.cpp makes them: the front edge and the top of its boards, and how far
// behind the edge the back's are.
constexpr float k_bench_edge = 0.21f, k_bench_top = 0.46f, k_bench_depth = 0.44f, k_bench_seats = 0.6f;
// And add_fountain(): the rim of its basin.
constexpr float k_rim_edge = 0.02f, k_rim_top = 0.58f, k_rim_depth = 0.36f, k_rim_seats = 0.8f;

void add_bench_seats(const Prop& bench, uint32_t number, std::vector<Seat>& seats) {
    const Vec2 facing = heading_direction(bench.yaw), left{facing.z, -facing.x};
    for (const float aside : {-k_bench_seats, 0.0f, k_bench_seats}) {
        const Vec2 off = facing * k_bench_edge + left * aside;
        seats.push_back({bench.position + at_height(off, k_bench_top), facing, k_bench_depth, number,
                         aside == 0 ? 1u : 0u});
    }
}

void add_rim_seats(const Prop& fountain, uint32_t number, std::vector<Seat>& seats) {
    const auto count = static_cast<int>(2 * k_pi * fountain.radius / k_rim_seats);
    for (int n = 0; n < count; ++n) {
        const Vec2 out =
            heading_direction(fountain.yaw + 2 * k_pi * static_cast<float>(n) / static_cast<float>(count));
        seats.push_back({fountain.position + at_height(out * (fountain.radius + k_rim_edge), k_rim_top), out,
                         k_rim_depth, number, 0, SeatOn::fountain});
    }
}

// And add_planter(): its rim, on which leaves let one sit at the edge. Two side by side at front and back,
// one at the others, so that nobody is in another's way at the corners.
void add_planter_seats(const Prop& planter, uint32_t number, std::vector<Seat>& seats) {
    constexpr float k_half = 0.6f, k_top = 0.58f, k_depth = 0.18f, k_aside = 0.3f;
    for (int side = 0; side < 4; ++side) {
        const Vec2 out = heading_direction(planter.yaw + 0.5f * k_pi * static_cast<float>(side));
        const Vec2 left{out.z, -out.x};
        for (const float aside : {-k_aside, 0.0f, k_aside})
            if ((aside == 0) == (side % 2 == 1))
                seats.push_back({planter.position + at_height(out * k_half + left * aside, k_top), out,
                                 k_depth, number, 0, SeatOn::planter});
    }
}

constexpr uint32_t k_sells_to_street = 4;  // one shop of so many

// A bay beside a door, if the wall goes on there.
void add_window(const City& city, const Destination& door, float side, std::vector<ShopWindow>& windows) {
    constexpr float k_reach = 1.6f, k_up = 1.2f;
    const Vec2 along{-door.facing.z, door.facing.x};
    const Vec3 beside = door.position + at_height(along * (side * k_bay_width), k_up);
    const auto wall = closest_wall(city.ground, beside, k_reach);
    if (!wall || dot(on_ground(wall->normal), door.facing) > -0.98f) return;
    const Vec3 foot{wall->point.x, door.position.y, wall->point.z};
    // Where the wall ends the closest place is not straight ahead.
    if (std::fabs(dot(on_ground(beside - foot), along)) > 0.1f) return;
    windows.push_back({foot, on_ground(wall->normal), 0.7f * k_bay_width});
}

// A window of a shop through which it sells, with a line along the wall, away from the door.
void add_service(const City& city, const Destination& door, PastimePlaces& places) {
    constexpr float k_off = 0.75f, k_reach = 1.6f, k_up = 1.2f;
    const Vec2 along{-door.facing.z, door.facing.x};
    for (const float side : {1.0f, -1.0f}) {
        const size_t before = places.windows.size();
        add_window(city, door, side, places.windows);
        if (places.windows.size() == before) continue;
        const ShopWindow window = places.windows.back();
        places.windows.pop_back();
        // The wall goes on for the line.
        const Vec3 end = door.position + at_height(along * (side * 2.4f * k_bay_width), k_up);
        if (!closest_wall(city.ground, end, k_reach)) continue;
        places.services.push_back(
            {window.at + at_height(window.out * k_off, 0), -window.out, along * side, 25});
        // Who looks in there would stand in the line.
        std::erase_if(places.windows, [&](const ShopWindow& w) { return length(w.at - window.at) < 0.5f; });
        return;
    }
}

}  // namespace

PastimePlaces pastime_places(const City& city) {
    PastimePlaces places;
    for (uint32_t i = 0; i < city.props.size(); ++i) {
        const Prop& prop = city.props[i];
        if (prop.kind == PropKind::bench) add_bench_seats(prop, i, places.seats);
        if (prop.kind == PropKind::fountain) add_rim_seats(prop, i, places.seats);
        if (prop.kind == PropKind::planter) add_planter_seats(prop, i, places.seats);
        if (prop.kind == PropKind::fountain || prop.kind == PropKind::statue)
            places.sights.push_back(prop.position);
    }
    add_wall_seats(city, places.seats);
    add_step_seats(city, places.seats);
    add_railings(city, places.railings);
    uint32_t shops = 0;
    for (const Destination& d : city.destinations) {
        if (is_entrance(d.kind)) places.doors.push_back(d.position);
        if (d.kind != DestinationKind::shop) continue;
        for (const float side : {-1.0f, 1.0f}) add_window(city, d, side, places.windows);
        if (++shops % k_sells_to_street == 0) add_service(city, d, places);
    }
    return places;
}

}  // namespace flaneur
