#include <algorithm>
#include <cmath>

#include "assets/district.h"
#include "sim/base/math.h"

namespace flaneur {

namespace {

Vec2 middle_of(const Quad& q) { return (q[0] + q[1] + q[2] + q[3]) * 0.25f; }

// A point of the quad by its share from north to south and from west to east.
Vec2 within(const Quad& q, float east, float south) {
    return lerp(lerp(q[0], q[1], east), lerp(q[3], q[2], east), south);
}

Ring circle(Vec2 centre, float radius, int corners) {
    Ring ring;
    for (int i = 0; i < corners; ++i) {
        Vec2 n = heading_direction(2 * k_pi * static_cast<float>(i) / static_cast<float>(corners));
        ring.push_back(to_point(centre + n * radius));
    }
    return positive(ring);
}

void add_path(District& d, const std::vector<Vec2>& line, float width) {
    Rings rings;
    add_strip(rings, line, width * 0.5f, width * 0.5f, false);
    add_area(d, k_rank_path, Surface::path, flat(k_kerb), std::move(rings));
}

void add_bench(District& d, Dice& dice, Vec2 at, Vec2 facing) {
    add_prop(d, dice, PropKind::bench, at, heading_of(facing), 0.8f);
}

}  // namespace

void fill_perimeter(District& d, Block& block) {
    Dice& dice = block.dice;
    const Quad& q = block.corners;
    float depth = dice.between(11.5f, 13.5f);
    Quad inner = inset_quad(q, {depth, depth, depth, depth});
    // The north and south rows take the corners, the others stand between them.
    Vec2 north_west = meeting(inner[0], inner[1], q[3], q[0]),
         north_east = meeting(inner[0], inner[1], q[1], q[2]);
    Vec2 south_west = meeting(inner[3], inner[2], q[3], q[0]),
         south_east = meeting(inner[3], inner[2], q[1], q[2]);
    int storeys = 4 + dice.pick(2), gate = dice.pick(2) * 2 + 1;
    auto floors = [&](size_t side) { return storeys + (block.busy[side] ? 1 : 0); };
    fill_strip(d, block, {q[0], q[1], north_east, north_west}, 0, true, true, floors(0), false);
    fill_strip(d, block, {north_east, south_east, inner[2], inner[1]}, 1, false, false, floors(1), gate == 1);
    fill_strip(d, block, {q[2], q[3], south_west, south_east}, 2, true, true, floors(2), false);
    fill_strip(d, block, {south_west, north_west, inner[0], inner[3]}, 3, false, false, floors(3), gate == 3);

    add_area(d, k_rank_rest, Surface::path, flat(k_kerb), {ring_of(q)});
    Quad lawn = inset_quad(inner, {4, 4.5f, 4, 4.5f});
    add_area(d, k_rank_grass, Surface::grass, flat(k_kerb), {ring_of(lawn)});
    add_path(d, {within(lawn, -0.1f, 0.5f), within(lawn, 1.1f, 0.5f)}, 2.4f);
    for (int i = 0; i < 5; ++i) {
        float south = (i % 2 == 0 ? dice.between(0.08f, 0.36f) : dice.between(0.64f, 0.92f));
        float east = (static_cast<float>(i) + dice.between(0.2f, 0.8f)) / 5;
        add_tree(d, dice, within(lawn, east, south), dice.between(0.8f, 1.15f));
    }
    for (float east : {0.3f, 0.7f}) add_bench(d, dice, within(lawn, east, 0.5f) + Vec2{0, 1.7f}, {0, -1});
}

void fill_villas(District& d, Block& block) {
    Dice& dice = block.dice;
    const Quad& q = block.corners;
    add_area(d, k_rank_rest, Surface::grass, flat(k_kerb), {ring_of(q)});
    // Two rows back to back; each house faces the street to its north or south.
    for (bool south : {false, true}) {
        Vec2 a = south ? q[2] : q[0], b = south ? q[3] : q[1], a_back = south ? q[1] : q[3],
             b_back = south ? q[0] : q[2];
        int lots = std::max(2, static_cast<int>(length(b - a) / 21 + 0.5f));
        for (int i = 0; i < lots; ++i) {
            float s = static_cast<float>(i) / static_cast<float>(lots),
                  t = static_cast<float>(i + 1) / static_cast<float>(lots);
            Vec2 p = lerp(a, b, s), r = lerp(a, b, t), along = normalize_or(r - p, {1, 0}),
                 in{-along.z, along.x};
            float room = length(lerp(a_back, b_back, (s + t) * 0.5f) - lerp(a, b, (s + t) * 0.5f)) * 0.5f;
            float width = std::min(length(r - p) - 6, dice.between(10, 13)),
                  depth = std::min(dice.between(9, 11), room - 12);
            Vec2 corner = lerp(p, r, 0.5f) - along * (width * 0.5f) + in * dice.between(5, 7);
            Quad lot{corner, corner + along * width, corner + along * width + in * depth,
                     corner + in * depth};
            House house;
            house.footprint = ring_of(lot);
            int floors = 2 + dice.pick(2);
            house.eaves = static_cast<float>(floors) * 3.2f + 0.4f;
            house.roof = dice.chance(0.5f) ? RoofKind::hip : RoofKind::gable;
            house.roof_height = dice.between(2.8f, 3.8f);
            house.overhang = 0.45f;
            house.cornice = 0;
            house.gable_across = house.roof == RoofKind::gable && dice.chance(0.4f);
            house.style = plaster_style(dice);
            uint32_t index = add_house(d, dice, house);
            add_box(d.city,
                    at_height(middle_of(lot) + along * 1.5f,
                              d.city.buildings[index].top + house.roof_height - 1.4f),
                    along, {0.4f, 0.4f}, 2.2f, index);

            Vec2 door = lerp(p, r, 0.5f);
            add_path(d, {door - in * 0.2f, door + in * (length(corner - door) + 1)}, 1.6f);
            for (float side : {-1.0f, 1.0f}) {
                Vec2 from = door + along * (side * 0.9f) + in * 0.15f;
                Vec2 to = (side < 0 ? p : r) + in * 0.15f;
                if (side > 0) std::swap(from, to);
                float foot = std::min(terrain_at(d, from), terrain_at(d, to));
                add_garden_wall(d.city, d.plan, to, from, 0.3f, foot, terrain_at(d, to) + k_kerb + 0.95f,
                                terrain_at(d, from) + k_kerb + 0.95f, index);
            }
            float front_share = dice.between(0.1f, 0.25f), front_depth = dice.between(2.5f, 4);
            add_tree(d, dice, lerp(p, r, front_share) + in * front_depth, 0.7f);
            float back_share = dice.between(0.2f, 0.8f), back_depth = room - dice.between(2, 5);
            add_tree(d, dice, lerp(p, r, back_share) + in * back_depth, dice.between(0.8f, 1.1f));
        }
    }
}

void fill_park(District& d, Block& block) {
    Dice& dice = block.dice;
    const Quad& q = block.corners;
    add_area(d, k_rank_grass, Surface::grass, flat(k_kerb), {ring_of(q)});
    Vec2 middle = middle_of(q);
    for (size_t k = 0; k < 4; ++k) {
        // From each corner in a soft bend to the round place, and on to the middle of a side.
        Vec2 to = middle + (q[k] - middle) * 0.12f,
             bend = lerp(q[k], middle, 0.5f) + Vec2{dice.between(-5, 5), dice.between(-5, 5)};
        std::vector<Vec2> line;
        for (int i = 0; i <= 8; ++i) {
            float t = static_cast<float>(i) / 8;
            line.push_back(lerp(lerp(q[k], bend, t), lerp(bend, to, t), t));
        }
        add_path(d, line, 2.8f);
        add_path(d, {lerp(q[k], q[(k + 1) % 4], 0.5f), middle}, 2.2f);
    }
    add_area(d, k_rank_plaza, Surface::plaza, flat(k_kerb), {circle(middle, 9, 32)});
    add_area(d, k_rank_basin, Surface::water, flat(k_kerb + 0.38f), {circle(middle, 3.2f, 20)});
    for (int i = 0; i < 8; ++i) {
        Vec2 n = heading_direction(2 * k_pi * (static_cast<float>(i) + 0.5f) / 8);
        add_bench(d, dice, middle + n * 8.2f, -n);
    }
    for (int i = 0; i < 34; ++i) {
        float east = dice.between(0.05f, 0.95f), south = dice.between(0.05f, 0.95f);
        Vec2 at = within(q, east, south);
        if (length(at - middle) > 13) add_tree(d, dice, at, dice.between(0.9f, 1.4f));
    }
}

void fill_slabs(District& d, Block& block) {
    Dice& dice = block.dice;
    const Quad& q = block.corners;
    add_area(d, k_rank_rest, Surface::plaza, flat(k_kerb), {ring_of(q)});
    Vec2 east = normalize_or((q[1] - q[0]) + (q[2] - q[3]), {1, 0}), south{-east.z, east.x};
    bool tower_west = dice.chance(0.5f);
    auto slab = [&](Vec2 corner, float width, float depth, int floors) {
        House house;
        house.footprint = ring_of(
            {corner, corner + east * width, corner + east * width + south * depth, corner + south * depth});
        house.street_edges = {};
        house.cornice = 0;
        house.eaves = static_cast<float>(floors) * 3.2f + 1;
        house.roof_height = 1;
        house.style = dice.chance(0.6f) ? 4 : stone_style(dice);
        house.shop = true;
        uint32_t index = add_house(d, dice, house);
        add_box(
            d.city,
            at_height(corner + east * (width * 0.4f) + south * (depth * 0.5f), d.city.buildings[index].top),
            east, {width * 0.2f, depth * 0.25f}, 2.8f, index);
    };
    float width = std::min(length(q[1] - q[0]), length(q[2] - q[3])),
          depth = std::min(length(q[3] - q[0]), length(q[2] - q[1]));
    Vec2 tower = within(q, tower_west ? 0.12f : 0.88f, 0.14f) - east * (tower_west ? 0.0f : 17.0f);
    slab(tower, 17, 17, 9 + dice.pick(3));
    Vec2 bar = within(q, 0.1f, 0.95f) - south * 14.0f;
    slab(bar, width * 0.8f, 13, 5 + dice.pick(2));
    Rings lawn{
        ring_of({within(q, tower_west ? 0.5f : 0.1f, 0.14f), within(q, tower_west ? 0.9f : 0.5f, 0.14f),
                 within(q, tower_west ? 0.9f : 0.5f, 0.5f), within(q, tower_west ? 0.5f : 0.1f, 0.5f)})};
    add_area(d, k_rank_grass - 3, Surface::grass, flat(k_kerb), lawn);
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 2; ++j) {
            float s = (tower_west ? 0.56f : 0.16f) + 0.14f * static_cast<float>(i),
                  t = 0.22f + 0.2f * static_cast<float>(j);
            add_tree(d, dice, within(q, s, t), 1.0f);
        }
    }
    for (int i = 0; i < 3; ++i)
        add_bench(d, dice, within(q, 0.3f + 0.2f * static_cast<float>(i), 0.56f),
                  {0, depth > 0 ? 1.0f : -1.0f});
}

}  // namespace flaneur
