// The square: a paved place with trees and a basin, a broad flight of steps and a ramp up to a terrace, and a
// hall with a tower on it.
#include <algorithm>
#include <cmath>

#include "assets/district.h"
#include "sim/base/math.h"

namespace flaneur {

namespace {

constexpr int k_risers = 14;
constexpr float k_rise = 0.155f, k_tread = 0.34f;
constexpr float k_terrace = k_kerb + k_risers * k_rise;
constexpr float k_parapet = 0.3f;  // thickness

// Axes of the square: origin in its middle, u to the east, v to the south.
struct Frame {
    Vec2 origin, u, v;
    Vec2 at(float east, float south) const { return origin + u * east + v * south; }
    Ring box(float west, float north, float east, float south) const {
        return {to_point(at(west, north)), to_point(at(east, north)), to_point(at(east, south)),
                to_point(at(west, south))};
    }
};

void add_hall(District& d, Dice& dice, const Frame& f, float north, float south) {
    float depth = std::min(south - north, 15.0f), middle = (north + south) * 0.5f;
    House hall;
    hall.lift = k_terrace;
    hall.footprint = f.box(-13, middle - depth * 0.5f, 13, middle + depth * 0.5f);
    hall.street_edges = {};
    hall.cornice = 0;
    hall.eaves = 9.5f;
    hall.roof = RoofKind::gable;
    hall.roof_height = 6;
    hall.overhang = 0.5f;
    hall.style = 0;
    add_house(d, dice, hall);
    House tower;
    tower.lift = k_terrace;
    tower.footprint = f.box(13, middle - 3.4f, 19.8f, middle + 3.4f);
    tower.street_edges = {0, 1, 2, 3};
    tower.cornice = 0.4f;
    tower.eaves = 26;
    tower.roof = RoofKind::pyramid;
    tower.roof_height = 9;
    tower.style = 0;
    add_house(d, dice, tower);
    House porch;
    porch.lift = k_terrace;
    porch.footprint = f.box(-4, middle + depth * 0.5f, 4, middle + depth * 0.5f + 3);
    porch.street_edges = {1, 2, 3};
    porch.cornice = 0.25f;
    porch.eaves = 5;
    porch.roof_height = 0.7f;
    porch.style = 5;
    add_house(d, dice, porch);
}

// Where a wall with a level top stands on the given rings.
void add_parapet(District& d, Dice& dice, const Rings& rings, float lift, float height) {
    for (const Region& region : regions_of(rings)) {
        float lowest = 1e9f, highest = -1e9f;
        for (Point p : region.outer) {
            float y = terrain_at(d, to_metres(p));
            lowest = std::min(lowest, y);
            highest = std::max(highest, y);
        }
        Building wall;
        wall.base = lowest;
        wall.top = highest + lift + height;
        wall.style = 0;
        wall.seed = dice.bits();
        Mass mass;
        mass.footprint = region;
        mass.bottom = lowest;
        mass.eaves = wall.top;
        mass.kind = FaceKind::garden_wall;
        mass.building = static_cast<uint32_t>(d.city.buildings.size());
        d.city.buildings.push_back(wall);
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
void add_ramp(District& d, const Frame& f, float west, float east, float top, float bottom, uint32_t wall) {
    float rise = k_terrace - k_kerb, run = bottom - top;
    Lift lift{k_terrace, k_kerb, k_terrace, f.at(west, top), f.v * (-rise / run)};
    add_area(d, k_rank_steps, Surface::plaza, lift, {f.box(west, top, east, bottom)}, f.v);
    auto side = [&](float inner) {
        Vec2 a = f.at(inner, top - k_parapet), b = f.at(inner, bottom);
        float y = terrain_at(d, a);
        add_garden_wall(d.city, d.plan, b, a, k_parapet, std::min(y, terrain_at(d, b)), y + k_kerb + 0.85f,
                        y + k_terrace + 0.85f, wall);
    };
    side(west - k_parapet);
    side(east);
}

}  // namespace

void fill_square(District& d, Block& block) {
    Dice& dice = block.dice;
    const Quad& q = block.corners;
    add_area(d, k_rank_plaza, Surface::plaza, flat(k_kerb), {ring_of(q)});
    Frame f;
    f.origin = (q[0] + q[1] + q[2] + q[3]) * 0.25f;
    f.u = normalize_or((q[1] - q[0]) + (q[2] - q[3]), {1, 0});
    f.v = {-f.u.z, f.u.x};
    // The largest box inside the block.
    auto south_of = [&](Vec2 p) { return dot(p - f.origin, f.v); };
    auto east_of = [&](Vec2 p) { return dot(p - f.origin, f.u); };
    float north = std::max(south_of(q[0]), south_of(q[1])), south = std::min(south_of(q[2]), south_of(q[3]));
    float west = std::max(east_of(q[0]), east_of(q[3])), east = std::min(east_of(q[1]), east_of(q[2]));
    float edge = north + std::min(27.0f, (south - north) * 0.42f);  // the terrace ends here

    // The terrace takes the block's north part whole.
    Rings terrace = intersect({ring_of(q)}, {f.box(west - 20, north - 20, east + 20, edge)});
    add_area(d, k_rank_terrace, Surface::plaza, flat(k_terrace), terrace);
    float half_flight = 8.5f, ramp_east = east - 1.2f, ramp_west = ramp_east - 3;
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
        add_parapet(d, dice, border, k_terrace, 0.85f);
    }
    auto wall = static_cast<uint32_t>(d.city.buildings.size() - 1);
    float flight_end = edge + k_tread * static_cast<float>(k_risers - 1);
    for (float side : {-half_flight - 0.5f, half_flight}) {
        // Cheeks beside the flight, level with the terrace.
        Vec2 a = f.at(side, edge), b = f.at(side, flight_end + 0.3f);
        float y = terrain_at(d, a);
        add_garden_wall(d.city, d.plan, b, a, 0.5f, y, y + k_kerb + 0.5f, y + k_terrace + 0.5f, wall);
    }
    add_ramp(d, f, ramp_west, ramp_east, edge, std::min(edge + (k_terrace - k_kerb) / 0.07f, south - 3),
             wall);
    add_hall(d, dice, f, north + 4, edge - 6);

    // Trees in rows on the place, a basin in its middle, benches looking at it.
    float place_middle = (flight_end + south) * 0.5f, room = south - flight_end;
    Vec2 centre = f.at(-4, place_middle + 1);
    Ring basin;
    for (int i = 0; i < 24; ++i)
        basin.push_back(to_point(centre + heading_direction(2 * k_pi * static_cast<float>(i) / 24) * 4.2f));
    add_area(d, k_rank_basin, Surface::water, flat(k_kerb + 0.4f), {positive(basin)});
    for (int i = 0; i < 8; ++i) {
        Vec2 n = heading_direction(2 * k_pi * (static_cast<float>(i) + 0.5f) / 8);
        add_prop(d, dice, PropKind::bench, centre + n * 7.5f, heading_of(-n), 0.8f);
    }
    for (float column : {west + 3.5f, west + 10.0f, ramp_west - 4.0f}) {
        int trees = std::max(2, static_cast<int>(room / 7));
        for (int i = 0; i < trees; ++i) {
            float v = flight_end + (static_cast<float>(i) + 0.5f) * room / static_cast<float>(trees);
            add_tree(d, dice, f.at(column, v), 0.9f);
        }
    }
    for (float u : {west + 7, -half_flight - 2.0f, half_flight + 2.0f}) {
        add_prop(d, dice, PropKind::lamp, f.at(u, flight_end + 1.5f), 0, 4.5f);
        add_prop(d, dice, PropKind::lamp, f.at(u, south - 2), 0, 4.5f);
    }
    for (float u : {west + 6, west + 12}) add_tree(d, dice, f.at(u, edge - 6), 0.8f);
}

}  // namespace flaneur
