#include "assets/quayside.h"

#include <array>

#include "assets/district/district.h"
#include "assets/plan/streets.h"
#include "sim/base/math.h"

namespace flaneur {

namespace {

constexpr float k_east = 80;                  // metres from the middle to the map's sides
constexpr float k_north = -62, k_south = 96;  // its other sides
constexpr float k_road_north = -20, k_road_south = -13;
constexpr float k_walk = 4;                        // a pavement's width
constexpr float k_square = 25;                     // half the square's width
constexpr float k_houses_south = 6.5f;             // where the houses beside it end
constexpr float k_edge = 10.5f, k_parapet = 0.3f;  // of the upper level, and what stands on it
constexpr int k_risers = 11;
constexpr float k_tread = 0.33f, k_cheek = 0.4f;
constexpr float k_foot = k_edge + k_parapet + k_tread * (k_risers - 1);  // of the flights
constexpr float k_water = 24, k_far_bank = 58;                           // where the river begins and ends
constexpr float k_river = -2.7f;                                         // its height
struct Descent {
    float west, east;
};
constexpr Descent k_descents[] = {{-9, 3}, {-19.4f, -16.6f}};

Ring box(float west, float north, float east, float south) {
    return positive(
        {to_point({west, north}), to_point({east, north}), to_point({east, south}), to_point({west, south})});
}

void add_level(District& d, int rank, Surface kind, float height, const Ring& ring, Vec2 axis = {1, 0}) {
    add_area(d, rank, kind, level(height), {ring}, axis);
}

// Houses shoulder to shoulder round a block; fronts where the street is.
void add_houses(District& d, uint64_t seed, uint32_t number, const Ring& outline,
                std::span<const bool, 4> busy, float depth, int storeys) {
    Block block;
    block.outline = block.ring = outline;
    block.dice = {{seed, number, 6, Purpose::city}};
    for (size_t k = 0; k < outline.size(); ++k) {
        Front front{to_metres(outline[k]), to_metres(outline[(k + 1) % outline.size()])};
        front.way = 0;
        front.busy = busy[k];
        block.fronts.push_back(front);
    }
    add_area(d, k_rank_track, Surface::track, flat(k_kerb), {outline});  // where nobody walks
    fill_row(d, block, depth, storeys, false);
}

void add_street(District& d) {
    const float middle = (k_road_north + k_road_south) / 2, half = (k_road_south - k_road_north) / 2;
    add_level(d, k_rank_road, Surface::road, 0, box(-k_east, k_road_north, k_east, k_road_south));
    for (const float walk : {k_road_north - k_walk, k_road_south})
        add_level(d, k_rank_sidewalk, Surface::sidewalk, k_kerb, box(-k_east, walk, k_east, walk + k_walk));
    for (const float x : {0.0f, -44.0f, 46.0f})
        d.city.crossings.all.push_back(add_crossing(d.plan, {x, middle}, {1, 0}, {0, 1}, half, 4.4f, true));
}

// From the square down to the quay, with cheeks as high as a parapet's foot.
void add_flight(District& d, const Descent& f) {
    const float rise = (k_kerb - k_quay_height) / k_risers;
    for (int k = 1; k < k_risers; ++k) {
        const float z = k_edge + k_parapet + k_tread * static_cast<float>(k - 1);
        add_level(d, k_rank_steps, Surface::steps, k_kerb - rise * static_cast<float>(k),
                  box(f.west, z, f.east, z + k_tread), {0, -1});
    }
    add_level(d, k_rank_terrace, Surface::plaza, k_kerb,
              box(f.west, k_edge - 0.5f, f.east, k_edge + k_parapet));
    for (const float x : {f.west, f.east + k_cheek})
        add_garden_wall(d.city, d.plan, {x, k_edge + k_parapet}, {x, k_foot + 0.2f}, k_cheek,
                        k_quay_height - 0.2f, k_kerb + 0.55f, k_quay_height + 0.55f, trim(d, Trim::coping));
}

// Between and beside the flights.
void add_parapets(District& d) {
    std::vector<float> ends{-k_east};
    for (const Descent* f : {&k_descents[1], &k_descents[0]})
        ends.push_back(f->west - k_cheek), ends.push_back(f->east + k_cheek);
    ends.push_back(k_east);
    constexpr float k_high = 0.98f, k_piece = 6;
    for (size_t i = 0; i + 1 < ends.size(); i += 2)
        for (float x = ends[i]; x < ends[i + 1] - 0.01f; x += k_piece)
            add_garden_wall(d.city, d.plan, {x, k_edge}, {std::min(x + k_piece, ends[i + 1]), k_edge},
                            k_parapet, k_quay_height - 0.2f, k_kerb + k_high, k_kerb + k_high,
                            trim(d, Trim::coping));
}

// Where quay and river leave the map: abutments, with a parapet's height over the streets.
void close_ends(District& d) {
    constexpr float k_thick = 3, k_over = 1;
    for (const float x : {-k_east + k_thick, k_east})
        add_garden_wall(d.city, d.plan, {x, k_edge + k_parapet}, {x, k_far_bank}, k_thick, k_river - 0.5f,
                        k_kerb + k_over, k_kerb + k_over, trim(d, Trim::coping));
}

void furnish(District& d, Dice& dice) {
    const Vec2 south{0, 1}, north{0, -1};
    add_prop(d, dice, PropKind::fountain, {10, -2}, 0, 2.6f, 2.8f);
    add_level(d, k_rank_basin, Surface::water, k_kerb, circle({10, -2}, 2.8f, 24));
    for (int i = 0; i < 6; ++i) {
        const Vec2 out = heading_direction(2 * k_pi * (static_cast<float>(i) + 0.5f) / 6);
        add_bench(d, dice, Vec2{10, -2} + out * 6.2f, -out);
        add_destination(d, DestinationKind::square, Vec2{10, -2} + out * 4.2f, -out, 1);
    }
    add_prop(d, dice, PropKind::statue, {-14, -3}, heading_of(south), 4.2f);
    for (const float x : {-22.0f, 21.5f})
        for (const float z : {-6.5f, -0.5f, 5.0f}) add_tree(d, dice, {x, z}, 0.85f);
    for (float x = -62; x <= 62; x += 12.4f) {
        if (x < k_descents[0].west - 1 || x > k_descents[0].east + 1) add_tree(d, dice, {x, 14.2f}, 1);
        add_prop(d, dice, PropKind::lamp, {x + 6.2f, 23}, heading_of(north), 4.5f);
        add_prop(d, dice, PropKind::lamp, {x + 6.2f, 9.6f}, heading_of(north), 4.5f);
    }
    for (float x = -56; x <= 60; x += 10) {
        if (x > -17 && x < 32) continue;
        add_bench(d, dice, {x - 3, 12.2f}, south);
    }
    for (float x = -75; x <= 75; x += 7.5f) add_prop(d, dice, PropKind::bollard, {x, 23.4f}, 0, 0.7f);
    for (const float x : {-2.9f, 2.9f}) {
        add_prop(d, dice, PropKind::signal, {x, k_road_south + 0.5f}, heading_of(north), 3.2f);
        add_prop(d, dice, PropKind::signal, {x, k_road_north - 0.5f}, heading_of(south), 3.2f);
    }
    for (const float x : {-66.0f, -58.5f, -31.0f, -24.0f, -17.5f, 13.0f, 20.5f, 27.0f, 60.0f, 66.5f})
        add_prop(d, dice, PropKind::car, {x, k_road_south - 1.1f}, heading_of({1, 0}), 1.45f);
    for (const float x : {-20.0f, 18.0f}) add_prop(d, dice, PropKind::planter, {x, 8.6f}, 0, 1);
    add_prop(d, dice, PropKind::bin, {-10, 8.8f}, 0, 0.95f);
    for (const float x : {-6.5f, -3.5f, 12.0f, 18.0f})
        add_destination(d, DestinationKind::square, {x, 22.4f}, south, 0.7f);
    for (const float x : {-24.0f, -13.0f, 5.0f, 15.0f})
        add_destination(d, DestinationKind::square, {x, k_edge - 0.7f}, south, 0.7f);
    // On the other side of the street.
    for (const float x : {-8.0f, 7.0f})
        add_destination(d, DestinationKind::square, {x, k_road_north - 2.6f}, south, 1.5f);
    for (const float side : {-1.0f, 1.0f}) {
        for (const float z : {k_road_north - 2, k_road_south + 2, 8.3f})
            add_destination(d, DestinationKind::edge, {side * (k_east - 1), z}, {side, 0}, 1);
    }
}

// One lane each way, beside those who are parked.
void lay_lanes(City& city) {
    constexpr float k_parked = 2.1f, k_middle = (k_road_north + k_road_south) / 2, k_gate = k_east - 1;
    RoadPlan plan;
    plan.nodes = {{{-k_gate, k_middle}, true}, {{k_gate, k_middle}, true}};
    plan.roads = {{.line = {plan.nodes[0].at, plan.nodes[1].at},
                   .from = 0,
                   .to = 1,
                   .width = k_road_south - k_road_north,
                   .parked_right = k_parked,
                   .speed = 30 / 3.6f}};
    city.lanes = make_lanes(plan, city.crossings, {}, city.ground.obstacles);
    settle_lanes(city.lanes, city.ground);
}

}  // namespace

City build_quayside(uint64_t seed) {
    District d;
    d.plan.cell = 12;
    d.streets.low = d.plan.low = {-k_east, k_north};
    d.streets.high = d.plan.high = {k_east, k_south};
    d.streets.relief = {.origin = d.plan.low, .cell = 12, .east = {0, 0}, .south = {0, 0}};
    d.streets.ways = {{.kind = WayKind::street, .line = {}}};  // what fronts look onto
    d.plan.terrain = [](Vec2) { return 0.0f; };
    d.city.ground.name = "quayside";
    Dice dice{{seed, 0, 7, Purpose::city}};
    lend_colours(d);
    add_street(d);
    for (const Descent& flight : k_descents) add_flight(d, flight);
    add_parapets(d);
    close_ends(d);
    furnish(d, dice);
    const float north = k_road_north - k_walk, beside = k_road_south + k_walk;
    constexpr bool k_north_block[] = {false, false, true, false}, k_west_block[] = {true, true, true, false},
                   k_east_block[] = {true, false, true, true}, k_far[] = {true, false, false, false};
    add_houses(d, seed, 1, box(-k_east, k_north, k_east, north), k_north_block, 12, 5);
    add_houses(d, seed, 2, box(-k_east, beside, -k_square, k_houses_south), k_west_block, 6.5f, 4);
    add_houses(d, seed, 3, box(k_square, beside, k_east, k_houses_south), k_east_block, 6.5f, 4);
    add_houses(d, seed, 4, box(-k_east, k_far_bank + 6, k_east, k_south), k_far, 12, 4);
    add_level(d, k_rank_path, Surface::plaza, k_kerb, box(-k_east, beside, k_east, k_edge + k_parapet));
    add_level(d, k_rank_path, Surface::plaza, k_quay_height,
              box(-k_east, k_edge + k_parapet, k_east, k_water));
    add_level(d, k_rank_path, Surface::track, k_kerb, box(-k_east, k_far_bank, k_east, k_south));
    add_level(d, k_rank_water, Surface::water, k_river, box(-k_east, k_water, k_east, k_far_bank));
    add_area(d, k_rank_rest, Surface::grass, flat(k_kerb),
             {rectangle(to_point(d.plan.low), to_point(d.plan.high))});
    lay_ground(d.plan, d.city);
    index_city(d.city);
    settle(d.city);
    settle_crossings(d.city);
    constexpr uint8_t k_ruled[] = {1, 0, 0};  // where signals stand
    set_lamps(d.city.crossings, k_ruled, seed);
    list_obstacles(d.city);
    lay_lanes(d.city);
    add_horizon(d, seed);
    return std::move(d.city);
}

}  // namespace flaneur
