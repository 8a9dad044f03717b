#include <algorithm>
#include <cmath>

#include "assets/cities.h"
#include "assets/colour.h"
#include "assets/district/district.h"
#include "sim/base/math.h"

namespace flaneur {

const uint32_t k_wall_colours[] = {
    rgb(0xd8c9ae),  // limestone
    rgb(0xe6dcc8),  // cream plaster
    rgb(0xd2a86a),  // ochre plaster
    rgb(0xa5694f),  // brick
    rgb(0xb7b3ab),  // concrete
    rgb(0xcbb89a),  // darker limestone
    rgb(0xddd0bd),  // warm white plaster
    rgb(0xc9a184),  // old rose plaster
    rgb(0x8c5a47),  // dark brick
    rgb(0xb9bdb2),  // grey-green plaster
};
const int k_wall_colour_count = static_cast<int>(std::size(k_wall_colours));

uint8_t plaster_style(Dice& dice) {
    constexpr uint8_t styles[] = {1, 1, 1, 2, 6, 6, 7, 9, 0, 3};
    return styles[dice.pick(static_cast<int>(std::size(styles)))];
}

uint8_t stone_style(Dice& dice) {
    constexpr uint8_t styles[] = {0, 0, 5, 5, 3, 8, 1, 6};
    return styles[dice.pick(static_cast<int>(std::size(styles)))];
}

void lend_colours(District& d) {
    constexpr uint32_t k_colours[k_trim_count] = {
        rgb(0xb5a88f),  // coping
        rgb(0x3c4044),  // metal
        rgb(0xc9bda6),  // stone
        rgb(0x6b2b35),  // awnings
        rgb(0x2f4a40), rgb(0xb58a3c), rgb(0xd9cfb8),
    };
    d.trims = static_cast<uint32_t>(d.city.buildings.size());
    for (uint32_t colour : k_colours) {
        Building lender;
        lender.wall_colour = lender.roof_colour = colour;
        d.city.buildings.push_back(lender);
    }
}

float terrain_at(const District& d, Vec2 p) { return d.streets.relief.height(p); }

void add_area(District& d, int rank, Surface kind, Lift lift, Rings rings, Vec2 axis) {
    Area area;
    area.rank = rank;
    area.kind = kind;
    area.lift = lift;
    area.axis = axis;
    area.rings = std::move(rings);
    d.plan.areas.push_back(std::move(area));
}

void add_path(District& d, const std::vector<Vec2>& line, float width, Surface kind) {
    Rings rings;
    add_strip(rings, line, width * 0.5f, width * 0.5f, false);
    add_area(d, kind == Surface::plaza ? k_rank_plaza : k_rank_path, kind, flat(k_kerb), std::move(rings));
}

std::optional<Ring> shrunk(const Ring& ring, float distance) {
    std::optional<Ring> largest;
    double most = 4;
    for (const Ring& r : inset_rings({ring}, distance)) {
        if (area({r}) > most) most = area({r}), largest = r;
    }
    return largest;
}

Ring circle(Vec2 centre, float radius, int corners) {
    Ring ring;
    for (int i = 0; i < corners; ++i) {
        Vec2 n = heading_direction(2 * k_pi * static_cast<float>(i) / static_cast<float>(corners));
        ring.push_back(to_point(centre + n * radius));
    }
    return positive(ring);
}

// Takes the ground under a ring away.
static void take_ground(District& d, const Ring& ring) {
    Area solid;
    solid.rank = k_rank_solid;
    solid.solid = true;
    solid.rings = {ring};
    d.plan.areas.push_back(std::move(solid));
}

static Building building_of(Dice& dice, const House& house, float base, float top) {
    Building building;
    building.base = base;
    building.top = top;
    building.storey = house.storey;
    building.style = house.style;
    building.has_shop = house.shop;
    building.seed = dice.bits();
    return building;
}

static Mass mass_of(const House& house, const Building& building, float bottom, uint32_t index) {
    Mass mass;
    mass.footprint.outer = house.footprint;
    mass.bottom = bottom;
    mass.eaves = building.top;
    mass.roof = house.roof;
    mass.roof_height = house.roof_height;
    mass.overhang = house.overhang;
    mass.cornice = house.cornice;
    mass.gable_across = house.gable_across;
    mass.street_edges = house.street_edges;
    mass.building = index;
    return mass;
}

// The corners of an edge of a house's footprint.
static std::pair<Vec2, Vec2> edge_of(const House& house, uint32_t edge) {
    const Ring& ring = house.footprint;
    return {to_metres(ring[edge]), to_metres(ring[(edge + 1) % ring.size()])};
}

// In the middle of a wall as its windows are laid, a bay of about 2.7 m each.
static Vec2 door_place(Vec2 a, Vec2 b) {
    float bays = std::max(1.0f, std::floor(length(b - a) / 2.7f + 0.5f));
    return lerp(a, b, (std::floor(bays * 0.5f) + 0.5f) / bays);
}

uint32_t add_house(District& d, Dice& dice, const House& house) {
    auto index = static_cast<uint32_t>(d.city.buildings.size());
    float lowest = 1e9f;
    for (Point p : house.footprint) lowest = std::min(lowest, terrain_at(d, to_metres(p)));
    float base = lowest + house.lift;
    if (house.door_edge) {
        auto [a, b] = edge_of(house, *house.door_edge);
        Vec2 door = door_place(a, b), out = normalize_or(Vec2{(b - a).z, -(b - a).x}, {0, 1});
        base = terrain_at(d, door) + house.lift;
        float storeys = house.eaves / house.storey;
        add_destination(d, house.shop ? DestinationKind::shop : DestinationKind::door, door + out * 0.7f,
                        -out, house.shop ? 1 : storeys * 0.25f);
    }
    d.city.buildings.push_back(building_of(dice, house, base, base + house.eaves));
    add_mass(d.city,
             mass_of(house, d.city.buildings[index], lowest + house.lift - k_kerb - house.sunk, index));
    take_ground(d, house.footprint);
    return index;
}

uint32_t add_upper(District& d, Dice& dice, const House& house, float bottom) {
    auto index = static_cast<uint32_t>(d.city.buildings.size());
    float base = bottom, top = bottom + house.eaves;
    d.city.buildings.push_back(building_of(dice, house, base, top));
    Mass mass = mass_of(house, d.city.buildings[index], base, index);
    mass.underside = true;
    add_mass(d.city, mass);
    return index;
}

void add_prop(District& d, Dice& dice, PropKind kind, Vec2 at, float yaw, float height, float radius) {
    d.city.props.push_back({kind, at_height(at, 0), yaw, height, radius, dice.bits()});
}

void add_tree(District& d, Dice& dice, Vec2 at, float size) {
    float height = dice.between(6.5f, 9) * size;
    float yaw = dice.between(-k_pi, k_pi), crown = height * dice.between(0.24f, 0.32f);
    add_prop(d, dice, PropKind::tree, at, yaw, height, crown);
}

void add_bench(District& d, Dice& dice, Vec2 at, Vec2 facing) {
    add_prop(d, dice, PropKind::bench, at, heading_of(facing), 0.8f);
    add_destination(d, DestinationKind::bench, at + facing * 0.55f, facing, 1);
}

void add_destination(District& d, DestinationKind kind, Vec2 at, Vec2 facing, float weight) {
    d.city.destinations.push_back({kind, at_height(at, 0), facing, weight});
}

void add_long_wall(District& d, Vec2 a, Vec2 b, float thickness, float height) {
    int pieces = std::max(1, static_cast<int>(length(b - a) / 6));
    for (int i = 0; i < pieces; ++i) {
        Vec2 p = lerp(a, b, static_cast<float>(i) / static_cast<float>(pieces));
        Vec2 q = lerp(a, b, static_cast<float>(i + 1) / static_cast<float>(pieces));
        float yp = terrain_at(d, p), yq = terrain_at(d, q), up = k_kerb + height;
        add_garden_wall(d.city, d.plan, p, q, thickness, std::min(yp, yq) - 0.15f, yp + up, yq + up,
                        trim(d, Trim::coping));
    }
}

void add_pillar(District& d, Vec2 at, Vec2 along, float half, float top) {
    Vec2 u = along * half, v = Vec2{-along.z, along.x} * half;
    Mass mass;
    mass.footprint.outer =
        positive({to_point(at - u - v), to_point(at + u - v), to_point(at + u + v), to_point(at - u + v)});
    mass.bottom = terrain_at(d, at) - 0.1f;
    mass.eaves = top;
    mass.kind = FaceKind::garden_wall;
    mass.building = trim(d, Trim::stone);
    add_mass(d.city, mass);
    take_ground(d, mass.footprint.outer);
}

}  // namespace flaneur
