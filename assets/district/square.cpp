// The square: a paved place with trees and a fountain, a broad flight of steps and a ramp up to a terrace,
// and a church on it.
#include <algorithm>
#include <cmath>

#include "assets/district/district.h"
#include "sim/base/math.h"

namespace flaneur {

namespace {

constexpr int k_risers = 14;
constexpr float k_rise = 0.155f, k_tread = 0.34f;
constexpr float k_terrace = k_kerb + k_risers * k_rise;
constexpr float k_parapet = 0.3f;  // thickness

// Axes of the square: origin in its middle, u to the east, v to the south.
struct SquareFrame {
    Vec2 origin, u, v;
    Vec2 at(float east, float south) const { return origin + u * east + v * south; }
    Ring box(float west, float north, float east, float south) const {
        return {to_point(at(west, north)), to_point(at(east, north)), to_point(at(east, south)),
                to_point(at(west, south))};
    }
};

// A church: a nave with aisles, an apse to the east, a tower with a spire to the west, doors to the south.
void add_church(District& d, Dice& dice, const SquareFrame& f, float north, float south) {
    float depth = std::min(south - north, 15.0f), middle = (north + south) * 0.5f, nave = depth * 0.29f;
    auto part = [&](Ring ring, float eaves, float storey, RoofKind roof, float roof_height) {
        House house;
        house.lift = k_terrace;
        house.footprint = std::move(ring);
        house.eaves = eaves;
        house.storey = storey;
        house.roof = roof;
        house.roof_height = roof_height;
        house.cornice = 0;
        house.style = 0;
        return house;
    };
    House aisles =
        part(f.box(-12, middle - depth * 0.5f, 14, middle + depth * 0.5f), 6.2f, 6.2f, RoofKind::flat, 0.5f);
    aisles.street_edges = {0, 1, 2};
    aisles.cornice = 0.25f;
    uint32_t base = add_house(d, dice, aisles);
    float foot = d.city.buildings[base].base;
    House high = part(f.box(-12.4f, middle - nave, 14.5f, middle + nave), 6.4f, 6.0f, RoofKind::gable, 5.4f);
    high.overhang = 0.35f;
    high.gable_across = false;
    add_upper(d, dice, high, foot + 6.0f);
    // Half of a round, closed by the nave.
    Ring apse;
    for (int i = 0; i <= 8; ++i) {
        SinCos turn = sin_cos(k_pi * static_cast<float>(i) / 8);
        apse.push_back(to_point(f.at(14 + turn.sine * nave, middle - turn.cosine * nave)));
    }
    House round = part(apse, 9.5f, 9.5f, RoofKind::pyramid, 3.2f);
    add_house(d, dice, round);
    constexpr float k_half = 3.6f;
    House tower = part(f.box(-12 - 2 * k_half, middle - k_half, -12, middle + k_half), 23, 5.75f,
                       RoofKind::pyramid, 1.2f);
    tower.street_edges = {0, 1, 2, 3};
    tower.cornice = 0.45f;
    tower.door_edge = 2;
    uint32_t stem = add_house(d, dice, tower);
    float top = d.city.buildings[stem].top;
    House bells =
        part(circle(f.at(-12 - k_half, middle), k_half * 0.86f, 8), 5.2f, 5.2f, RoofKind::pyramid, 12);
    bells.cornice = 0.3f;
    bells.street_edges = {0, 1, 2, 3, 4, 5, 6, 7};
    add_upper(d, dice, bells, top);
    // As wide as three of the ten bays of the aisle behind it, and as high as its windows, so that it cuts
    // none.
    constexpr float k_bay = 26.0f / 10, k_west = -12 + 3 * k_bay, k_east = -12 + 6 * k_bay;
    House porch = part(f.box(k_west, middle + depth * 0.5f, k_east, middle + depth * 0.5f + 2.6f), 5.65f,
                       5.65f, RoofKind::gable, 1.0f);
    porch.gable_across = true;
    porch.overhang = 0.25f;
    porch.door_edge = 2;
    add_house(d, dice, porch);
}

// Where a wall with a level top stands on the given rings.
void add_parapet(District& d, const Rings& rings, float lift, float height) {
    for (const Region& region : regions_of(rings)) {
        float lowest = 1e9f, highest = -1e9f;
        for (Point p : region.outer) {
            float y = terrain_at(d, to_metres(p));
            lowest = std::min(lowest, y);
            highest = std::max(highest, y);
        }
        Mass mass;
        mass.footprint = region;
        mass.bottom = lowest;
        mass.eaves = highest + lift + height;
        mass.kind = FaceKind::garden_wall;
        mass.building = trim(d, Trim::coping);
        add_mass(d.city, mass);
        Area solid;
        solid.rank = k_rank_solid;
        solid.solid = true;
        solid.rings = rings_of(region);
        d.plan.areas.push_back(std::move(solid));
    }
}

// The ramp along the east side, from the place up to the terrace at `top` (south of the terrace's edge), with
// walls.
void add_ramp(District& d, const SquareFrame& f, float west, float east, float top, float bottom) {
    float rise = k_terrace - k_kerb, run = bottom - top;
    Lift lift{k_terrace, k_kerb, k_terrace, f.at(west, top), f.v * (-rise / run)};
    add_area(d, k_rank_steps, Surface::plaza, lift, {f.box(west, top, east, bottom)}, f.v);
    auto side = [&](float inner) {
        Vec2 a = f.at(inner, top - k_parapet), b = f.at(inner, bottom);
        float y = terrain_at(d, a);
        add_garden_wall(d.city, d.plan, b, a, k_parapet, std::min(y, terrain_at(d, b)), y + k_kerb + 0.85f,
                        y + k_terrace + 0.85f, trim(d, Trim::coping));
    };
    side(west - k_parapet);
    side(east);
}

}  // namespace

void fill_square(District& d, Block& block) {
    Dice& dice = block.dice;
    add_area(d, k_rank_plaza, Surface::plaza, flat(k_kerb), {block.outline});
    // North is where the first front that faces north is.
    SquareFrame f;
    Vec2 sum{}, across{0, 0};
    for (const Front& front : block.fronts) {
        Vec2 way = front.b - front.a;
        sum += lerp(front.a, front.b, 0.5f) * length(way);
        if (std::fabs(way.x) > std::fabs(way.z)) across += way.x > 0 ? way : -way;
    }
    float around = 0;
    for (const Front& front : block.fronts) around += length(front.b - front.a);
    f.origin = sum / around;
    f.u = normalize_or(across, {1, 0});
    f.v = {-f.u.z, f.u.x};
    // The largest box inside the block: each side in turn comes in until it is clear of the edge.
    float west = -60, north = -60, east = 60, south = 60;
    auto narrow = [&](float& side, float step, auto strip) {
        while (std::fabs(side) > 12 && area(subtract({strip()}, {block.outline})) > 0.05) side += step;
    };
    narrow(north, 0.5f, [&] { return f.box(-10, north, 10, north + 1); });
    narrow(south, -0.5f, [&] { return f.box(-10, south - 1, 10, south); });
    narrow(west, 0.5f, [&] { return f.box(west, north * 0.8f, west + 1, south * 0.8f); });
    narrow(east, -0.5f, [&] { return f.box(east - 1, north * 0.8f, east, south * 0.8f); });
    float edge = north + std::min(27.0f, (south - north) * 0.42f);  // the terrace ends here

    // The terrace takes the block's north part whole.
    Rings terrace = intersect({block.outline}, {f.box(west - 40, north - 40, east + 40, edge)});
    add_area(d, k_rank_terrace, Surface::plaza, flat(k_terrace), terrace);
    float half_flight = 8.5f, ramp_east = east - 1.6f, ramp_west = ramp_east - 3;
    for (int k = 1; k < k_risers; ++k) {
        float from = edge + k_tread * static_cast<float>(k_risers - 1 - k);
        add_area(d, k_rank_steps, Surface::steps, flat(k_kerb + k_rise * static_cast<float>(k)),
                 {f.box(-half_flight, from, half_flight, from + k_tread)}, -f.v);
    }
    Rings border = terrace;
    std::optional<Ring> within =
        inset(without_collinear(terrace[0], 5), static_cast<int64_t>(k_parapet * 1000));
    if (within) {
        border = subtract(border, {*within});
        border = subtract(border, {f.box(-half_flight, edge - 1, half_flight, edge + 1),
                                   f.box(ramp_west, edge - 1, ramp_east, edge + 1)});
        add_parapet(d, border, k_terrace, 0.85f);
    }
    float flight_end = edge + k_tread * static_cast<float>(k_risers - 1);
    for (float side : {-half_flight - 0.5f, half_flight}) {
        // Cheeks beside the flight, level with the terrace.
        Vec2 a = f.at(side, edge), b = f.at(side, flight_end + 0.3f);
        float y = terrain_at(d, a);
        add_garden_wall(d.city, d.plan, b, a, 0.5f, y, y + k_kerb + 0.5f, y + k_terrace + 0.5f,
                        trim(d, Trim::coping));
    }
    add_ramp(d, f, ramp_west, ramp_east, edge, std::min(edge + (k_terrace - k_kerb) / 0.07f, south - 3));
    add_church(d, dice, f, north + 4, edge - 5);

    // A fountain in the middle of the place with benches around, a monument to the west of it, trees in rows.
    float place_middle = (flight_end + south) * 0.5f, room = south - flight_end;
    Vec2 centre = f.at(0, place_middle + 0.5f);
    float basin = std::min(4.0f, room * 0.18f);
    add_prop(d, dice, PropKind::fountain, centre, 0, 3.2f, basin);
    add_area(d, k_rank_basin, Surface::water, flat(k_kerb), {circle(centre, basin, 24)});
    for (int i = 0; i < 8; ++i) {
        Vec2 out = heading_direction(2 * k_pi * (static_cast<float>(i) + 0.5f) / 8);
        add_bench(d, dice, centre + out * (basin + 4.2f), -out);
        add_destination(d, DestinationKind::square, centre + out * (basin + 1.6f), -out, 1);
    }
    add_prop(d, dice, PropKind::statue, f.at(west * 0.62f, place_middle), heading_of(f.u), 4.6f);
    for (float column : {west + 3.5f, ramp_west - 4.0f}) {
        int trees = std::max(2, static_cast<int>(room / 7));
        for (int i = 0; i < trees; ++i) {
            float v = flight_end + (static_cast<float>(i) + 0.5f) * room / static_cast<float>(trees);
            add_tree(d, dice, f.at(column, v), 0.9f);
        }
    }
    for (float u : {west + 7, -half_flight - 2.0f, half_flight + 2.0f}) {
        add_prop(d, dice, PropKind::lamp, f.at(u, flight_end + 1.5f), 0, 4.5f);
        add_prop(d, dice, PropKind::lamp, f.at(u, south - 2), heading_of(-f.v), 4.5f);
    }
    for (float u = west + 2; u < ramp_west - 1; u += 3)
        add_prop(d, dice, PropKind::bollard, f.at(u, south - 0.4f), 0, 0.9f);
    for (float u : {-half_flight - 3.2f, half_flight + 3.2f})
        add_prop(d, dice, PropKind::planter, f.at(u, flight_end + 1.2f), heading_of(f.v), 1.1f);
    for (float u : {west * 0.55f, ramp_west - 2})
        add_prop(d, dice, PropKind::bin, f.at(u, south - 2.2f), 0, 0.95f);
    for (float u : {west + 4, west + 9, east - 5}) add_tree(d, dice, f.at(u, edge - 4.5f), 0.75f);
}

}  // namespace flaneur
