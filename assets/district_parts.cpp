#include <algorithm>
#include <cmath>

#include "assets/city.h"
#include "assets/colour.h"
#include "assets/district.h"
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
    constexpr uint8_t styles[] = {0, 0, 5, 5, 3, 8, 1};
    return styles[dice.pick(static_cast<int>(std::size(styles)))];
}

float terrain_at(const District& d, Vec2 p) { return d.plan.terrain ? d.plan.terrain(p) : 0; }

Vec2 meeting(Vec2 p, Vec2 q, Vec2 r, Vec2 s) {
    Vec2 u = q - p, v = s - r;
    return p + u * (cross(r - p, v) / cross(u, v));
}

Quad inset_quad(const Quad& quad, const std::array<float, 4>& distance) {
    Quad from, to, result;
    for (size_t k = 0; k < 4; ++k) {
        Vec2 a = quad[k], b = quad[(k + 1) % 4], along = normalize_or(b - a, {1, 0});
        Vec2 in = Vec2{-along.z, along.x} * distance[k];
        from[k] = a + in;
        to[k] = b + in;
    }
    for (size_t k = 0; k < 4; ++k) result[k] = meeting(from[(k + 3) % 4], to[(k + 3) % 4], from[k], to[k]);
    return result;
}

Ring ring_of(const Quad& quad) {
    return {to_point(quad[0]), to_point(quad[1]), to_point(quad[2]), to_point(quad[3])};
}

void add_area(District& d, int rank, Surface kind, Lift lift, Rings rings, Vec2 axis) {
    Area area;
    area.rank = rank;
    area.kind = kind;
    area.lift = lift;
    area.axis = axis;
    area.rings = std::move(rings);
    d.plan.areas.push_back(std::move(area));
}

uint32_t add_house(District& d, Dice& dice, const House& house) {
    auto index = static_cast<uint32_t>(d.city.buildings.size());
    float lowest = 1e9f;
    for (Point p : house.footprint) lowest = std::min(lowest, terrain_at(d, to_metres(p)) + house.lift);
    Building building;
    building.base = lowest;
    building.top = lowest + house.eaves;
    building.storey = 3.2f;
    building.style = house.style;
    building.has_shop = house.shop;
    building.seed = dice.bits();
    d.city.buildings.push_back(building);

    Mass mass;
    mass.footprint.outer = house.footprint;
    mass.bottom = building.base;
    mass.eaves = building.top;
    mass.roof = house.roof;
    mass.roof_height = house.roof_height;
    mass.overhang = house.overhang;
    mass.cornice = house.cornice;
    mass.gable_across = house.gable_across;
    mass.street_edges = house.street_edges;
    mass.building = index;
    add_mass(d.city, mass);

    Area solid;
    solid.rank = k_rank_solid;
    solid.solid = true;
    solid.rings = {house.footprint};
    d.plan.areas.push_back(std::move(solid));
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

// A few chimneys on the ridge of a pitched roof, or a stair head on a flat one.
static void add_roof_things(District& d, Dice& dice, const Quad& lot, float top, RoofKind roof,
                            float roof_height, uint32_t building) {
    Vec2 along = normalize_or(lot[1] - lot[0], {1, 0});
    Vec2 front = lerp(lot[0], lot[1], 0.5f), back = lerp(lot[3], lot[2], 0.5f);
    if (roof == RoofKind::gable || roof == RoofKind::hip) {
        int chimneys = 1 + dice.pick(2);
        for (int i = 0; i < chimneys; ++i) {
            Vec2 at = lerp(front, back, 0.5f) + along * (dice.between(-0.3f, 0.3f) * length(lot[1] - lot[0]));
            add_box(d.city, at_height(at, top + roof_height - 0.7f), along, {0.45f, 0.3f}, 1.7f, building);
        }
        return;
    }
    if (!dice.chance(0.7f)) return;
    float floor = top + (roof == RoofKind::mansard ? roof_height : 0);
    float share = dice.between(0.45f, 0.6f), aside = dice.between(-2, 2), height = dice.between(1.6f, 2.4f);
    Vec2 at = lerp(front, back, share) + along * aside, half{dice.between(1, 1.8f), dice.between(0.9f, 1.4f)};
    add_box(d.city, at_height(at, floor), along, half, height, building);
}

// A way through into the courtyard under the upper storeys of the lot's middle.
static void add_gateway(District& d, Dice& dice, const Quad& lot, House house) {
    float width = length(lot[1] - lot[0]), left = 0.5f - 1.9f / width, right = 0.5f + 1.9f / width;
    auto part = [&](float s, float t) {
        return Quad{lerp(lot[0], lot[1], s), lerp(lot[0], lot[1], t), lerp(lot[3], lot[2], t),
                    lerp(lot[3], lot[2], s)};
    };
    house.roof = RoofKind::flat;
    house.roof_height = 0;
    house.cornice = 0;
    float eaves = house.eaves;
    house.eaves = 3.9f;
    house.shop = false;
    for (Quad q : {part(0, left), part(right, 1)}) {
        house.footprint = ring_of(q);
        add_house(d, dice, house);
    }
    // The upper storeys span the whole lot, in one piece.
    auto index = static_cast<uint32_t>(d.city.buildings.size());
    float base = d.city.buildings.back().base;
    for (Vec2 p : lot) base = std::min(base, terrain_at(d, p));
    Building building = d.city.buildings.back();
    building.base = base + 3.9f;
    building.top = base + eaves;
    d.city.buildings.push_back(building);
    Mass upper;
    upper.footprint.outer = ring_of(lot);
    upper.bottom = building.base;
    upper.eaves = building.top;
    upper.roof = RoofKind::gable;
    upper.roof_height = 3.4f;
    upper.cornice = 0.3f;
    upper.street_edges = {0};
    upper.underside = true;
    upper.building = index;
    add_mass(d.city, upper);
}

void fill_strip(District& d, Block& block, const Quad& strip, int side, bool corner_start, bool corner_end,
                int storeys, bool gateway) {
    Dice& dice = block.dice;
    bool busy = block.busy[static_cast<size_t>(side)];
    float width = length(strip[1] - strip[0]);
    int lots = std::max(1, static_cast<int>(width / dice.between(15, 19) + 0.5f));
    std::vector<float> cuts{0};
    for (int i = 0; i < lots; ++i) cuts.push_back(cuts.back() + dice.between(0.8f, 1.25f));
    for (int i = 0; i < lots; ++i) {
        float s = cuts[static_cast<size_t>(i)] / cuts.back(),
              t = cuts[static_cast<size_t>(i) + 1] / cuts.back();
        Quad lot{lerp(strip[0], strip[1], s), lerp(strip[0], strip[1], t), lerp(strip[3], strip[2], t),
                 lerp(strip[3], strip[2], s)};
        bool start = corner_start && i == 0, end = corner_end && i + 1 == lots;
        if (!start && !end && dice.chance(0.5f)) {
            float shallow = dice.between(0.06f, 0.2f);
            lot[2] = lerp(lot[2], lot[1], shallow);
            lot[3] = lerp(lot[3], lot[0], shallow);
        }
        House house;
        house.footprint = ring_of(lot);
        house.street_edges = {0};
        int floors = std::max(3, storeys + dice.pick(3) - 1);
        house.eaves = static_cast<float>(floors) * 3.2f + 0.7f + dice.between(0, 0.5f);
        house.style = busy ? stone_style(dice) : plaster_style(dice);
        house.shop = dice.chance(busy ? 0.85f : 0.35f);
        float roof = dice.unit();
        house.roof = roof < 0.45f ? RoofKind::gable : roof < 0.75f ? RoofKind::mansard : RoofKind::flat;
        house.roof_height = house.roof == RoofKind::gable     ? dice.between(3, 4.2f)
                            : house.roof == RoofKind::mansard ? 2.6f
                                                              : 0.8f;
        if (start || end) {
            // The corner itself is cut off, and the roof goes round it.
            house.roof = roof < 0.6f ? RoofKind::mansard : RoofKind::flat;
            house.roof_height = roof < 0.6f ? 2.6f : 0.9f;
            house.shop = true;
            float bevel = dice.between(2.6f, 3.6f);
            auto toward = [&](Vec2 p, Vec2 q) { return to_point(p + normalize_or(q - p, {1, 0}) * bevel); };
            Ring ring;
            if (start) {
                ring = {toward(lot[0], lot[3]), toward(lot[0], lot[1])};
            } else {
                ring = {to_point(lot[0])};
            }
            if (end) {
                ring.push_back(toward(lot[1], lot[0]));
                ring.push_back(toward(lot[1], lot[2]));
            } else {
                ring.push_back(to_point(lot[1]));
            }
            ring.push_back(to_point(lot[2]));
            ring.push_back(to_point(lot[3]));
            house.footprint = ring;
            auto n = static_cast<uint32_t>(ring.size());
            house.street_edges.clear();
            for (uint32_t e = 0; e < n; ++e) {
                bool back = e == n - 2, first_side = e == n - 1, last_side = e == n - 3;
                if (back || (first_side && !start) || (last_side && !end)) continue;
                house.street_edges.push_back(e);
            }
        }
        if (gateway && i == lots / 2 && !start && !end && length(lot[1] - lot[0]) > 9) {
            add_gateway(d, dice, lot, house);
            continue;
        }
        uint32_t index = add_house(d, dice, house);
        add_roof_things(d, dice, lot, d.city.buildings[index].top, house.roof, house.roof_height, index);
    }
}

}  // namespace flaneur
