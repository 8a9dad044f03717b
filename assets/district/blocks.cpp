// What fills blocks other than the square.
#include <algorithm>
#include <cmath>

#include "assets/district/district.h"
#include "assets/plan/streets.h"
#include "sim/base/math.h"

namespace flaneur {

namespace {

bool is_inside(const Ring& ring, Vec2 p) { return contains({ring}, to_point(p)); }

// A place in the ring, at least `margin` metres from its edge where that can be had.
Vec2 place_in(Dice& dice, const Ring& ring, float margin) {
    Point low = ring[0], high = ring[0];
    for (Point p : ring) {
        low = {std::min(low.X, p.X), std::min(low.Y, p.Y)};
        high = {std::max(high.X, p.X), std::max(high.Y, p.Y)};
    }
    std::optional<Ring> within = shrunk(ring, margin);
    Vec2 a = to_metres(low), b = to_metres(high), at = middle_of(ring).value_or(to_metres(ring[0]));
    for (int i = 0; i < 20; ++i) {
        Vec2 tried{dice.between(a.x, b.x), dice.between(a.z, b.z)};
        if (is_inside(within ? *within : ring, tried)) return tried;
    }
    return at;
}

bool is_level(const District& d, Vec2 at, float radius) {
    float y = terrain_at(d, at);
    for (Vec2 n : {Vec2{1, 0}, Vec2{0, 1}, Vec2{-1, 0}, Vec2{0, -1}}) {
        if (std::fabs(terrain_at(d, at + n * radius) - y) > 0.02f) return false;
    }
    return true;
}

// A curve from a to b that leans over to `bend`.
std::vector<Vec2> curve(Vec2 a, Vec2 bend, Vec2 b) {
    std::vector<Vec2> line;
    for (int i = 0; i <= 8; ++i) {
        float t = static_cast<float>(i) / 8;
        line.push_back(lerp(lerp(a, bend, t), lerp(bend, b, t), t));
    }
    return line;
}

// A detached house with its front towards the street a-b, which lies on its left as one walks from a to b.
void build_villa(District& d, Block& block, Vec2 p, Vec2 r, float room) {
    Dice& dice = block.dice;
    Vec2 along = normalize_or(r - p, {1, 0}), in{-along.z, along.x};
    float width = std::min(length(r - p) - 5, dice.between(9.5f, 13)), depth = dice.between(8.5f, 11);
    float back = dice.between(4.5f, 6.5f);
    depth = std::min(depth, room - back - 2);
    Vec2 corner = lerp(p, r, 0.5f) - along * (width * 0.5f) + in * back;
    House house;
    house.footprint = {to_point(corner), to_point(corner + along * width),
                       to_point(corner + along * width + in * depth), to_point(corner + in * depth)};
    bool fits = width > 6 && depth > 5 && area(subtract({house.footprint}, {block.ring})) < 0.1;
    Vec2 gate = lerp(p, r, 0.5f);
    if (fits) {
        int floors = 2 + dice.pick(2);
        house.eaves = static_cast<float>(floors) * 3.2f + 0.4f;
        house.roof = dice.chance(0.5f) ? RoofKind::hip : RoofKind::gable;
        house.roof_height = dice.between(2.8f, 3.8f);
        house.overhang = 0.45f;
        house.cornice = 0;
        house.gable_across = house.roof == RoofKind::gable && dice.chance(0.4f);
        house.style = plaster_style(dice);
        house.door_edge = 0;
        uint32_t index = add_house(d, dice, house);
        dress_roof(d, dice, house, index, corner, corner + along * width, depth);
        float bays = std::max(1.0f, std::floor(width / 2.7f + 0.5f));
        gate = corner + along * (width * (std::floor(bays * 0.5f) + 0.5f) / bays) - in * back;
        add_path(d, {gate - in * 0.2f, gate + in * (back + 1)}, 1.6f);
    }
    add_long_wall(d, p + in * 0.05f, gate - along * 0.9f + in * 0.05f, 0.3f, 0.95f);
    add_long_wall(d, gate + along * 0.9f + in * 0.05f, r + in * 0.05f, 0.3f, 0.95f);
    float front_share = dice.between(0.1f, 0.25f), front_depth = dice.between(2.2f, 3.4f);
    add_tree(d, dice, lerp(p, r, front_share) + in * front_depth, 0.65f);
    float back_share = dice.between(0.2f, 0.8f), behind = back + depth + dice.between(2.5f, 5);
    Vec2 tree = lerp(p, r, back_share) + in * behind;
    if (behind < room && is_inside(block.ring, tree)) add_tree(d, dice, tree, dice.between(0.8f, 1.1f));
}

}  // namespace

void fill_houses(District& d, Block& block) {
    Dice& dice = block.dice;
    int storeys = 4 + dice.pick(2);
    float depth = dice.between(11, 12.5f);
    bool built = fill_row(d, block, depth, storeys, true);
    add_area(d, k_rank_rest, Surface::sidewalk, flat(k_kerb), {block.outline});
    std::optional<Ring> yard = shrunk(block.ring, built ? depth * 0.8f : 2.5f);
    std::optional<Ring> lawn = shrunk(block.ring, depth + 4);
    if (yard && built) add_area(d, k_rank_path, Surface::path, flat(k_kerb), {*yard});
    if (!built) lawn = yard;
    if (!lawn) return;
    add_area(d, k_rank_terrace, Surface::grass, flat(k_kerb), {*lawn});
    int trees = std::clamp(static_cast<int>(area({*lawn}) / 170), 2, 8);
    for (int i = 0; i < trees; ++i) {
        Vec2 at = place_in(dice, *lawn, 1.5f);
        add_tree(d, dice, at, dice.between(0.8f, 1.15f));
    }
    for (size_t k = 0; k < lawn->size(); k += 2) {
        Vec2 a = to_metres((*lawn)[k]), b = to_metres((*lawn)[(k + 1) % lawn->size()]);
        if (length(b - a) < 6) continue;
        Vec2 along = normalize_or(b - a, {1, 0}), out{along.z, -along.x};
        add_bench(d, dice, lerp(a, b, 0.5f) + out * 0.6f, out);
    }
}

void fill_villas(District& d, Block& block) {
    Dice& dice = block.dice;
    add_area(d, k_rank_rest, Surface::grass, flat(k_kerb), {block.outline});
    Vec2 middle = middle_of(block.ring).value_or(to_metres(block.ring[0]));
    for (const Front& front : block.fronts) {
        float width = length(front.b - front.a);
        Vec2 along = normalize_or(front.b - front.a, {1, 0}), in{-along.z, along.x};
        // Lots keep out of each other's way at corners.
        float room = dot(middle - front.a, in) * 0.92f, margin = 0.5f;
        int lots = static_cast<int>(width / dice.between(17, 22) + 0.4f);
        if (room < 15) lots = 0;
        if (front.way == ~0u) continue;
        if (lots == 0) {
            add_long_wall(d, front.a + in * 0.05f, front.b + in * 0.05f, 0.3f, 0.95f);
            continue;
        }
        for (int i = 0; i < lots; ++i) {
            float s = static_cast<float>(i) / static_cast<float>(lots),
                  t = static_cast<float>(i + 1) / static_cast<float>(lots);
            Vec2 p = lerp(front.a + along * margin, front.b - along * margin, s),
                 r = lerp(front.a + along * margin, front.b - along * margin, t);
            // Each house must lie nearer to its own front than to the others.
            Vec2 back = lerp(p, r, 0.5f) + in * 11.0f;
            bool own = true;
            for (const Front& other : block.fronts) {
                Vec2 u = normalize_or(other.b - other.a, {1, 0});
                float s_other = dot(back - other.a, u);
                bool beside = s_other > -6 && s_other < length(other.b - other.a) + 6;
                own &= &other == &front || !beside || dot(back - other.a, Vec2{-u.z, u.x}) > 10.9f;
            }
            build_villa(d, block, p, r, own ? std::min(room, 26.0f) : 6);
        }
    }
}

void fill_park(District& d, Block& block) {
    Dice& dice = block.dice;
    const Ring& ring = block.ring;
    add_area(d, k_rank_grass, Surface::grass, flat(k_kerb), {block.outline});
    Vec2 middle = middle_of(ring).value_or(to_metres(ring[0]));
    size_t n = block.fronts.size();
    // Gates at the corners and, on long sides, in the middle: gaps in the wall around.
    std::vector<Vec2> gates;
    for (size_t k = 0; k < n; ++k) {
        const Front &before = block.fronts[(k + n - 1) % n], &front = block.fronts[k];
        Vec2 u = normalize_or(before.b - before.a, {1, 0}), v = normalize_or(front.b - front.a, {1, 0});
        bool is_corner = cross(u, v) > 0.5f;
        if (is_corner) gates.push_back(front.a);
        if (length(front.b - front.a) > 45) gates.push_back(lerp(front.a, front.b, 0.5f));
    }
    for (Vec2 gate : gates) {
        Vec2 to = middle + normalize_or(gate - middle, {1, 0}) * 7.0f, way = to - gate;
        Vec2 bend = lerp(gate, to, 0.5f) + Vec2{-way.z, way.x} * dice.between(-0.2f, 0.2f);
        std::vector<Vec2> line = curve(gate, bend, to);
        add_path(d, line, 2.8f);
        for (float s : {0.35f, 0.7f}) {
            Station seat = station(line, length_of(line) * s);
            Vec2 right{-seat.along.z, seat.along.x};
            float side = dice.chance(0.5f) ? 1.0f : -1.0f;
            if (dice.chance(0.75f)) add_bench(d, dice, seat.at + right * (side * 1.9f), right * -side);
            add_prop(d, dice, PropKind::lamp, seat.at - right * (side * 1.8f), heading_of(right * side),
                     4.2f);
        }
    }
    for (const Front& front : block.fronts) {
        Vec2 along = normalize_or(front.b - front.a, {1, 0}), in{-along.z, along.x};
        float width = length(front.b - front.a);
        // Pieces of wall between the gates on this side.
        std::vector<std::pair<float, float>> gaps;
        for (Vec2 gate : gates) {
            float s = dot(gate - front.a, along), away = std::fabs(dot(gate - front.a, in));
            if (away < 3 && s > -4 && s < width + 4) gaps.push_back({s - 2.6f, s + 2.6f});
        }
        std::sort(gaps.begin(), gaps.end());
        gaps.push_back({width, width});
        float from = 0;
        for (auto [start, end] : gaps) {
            if (start - from > 1.5f)
                add_long_wall(d, front.a + along * from + in * 0.05f, front.a + along * start + in * 0.05f,
                              0.32f, 0.9f);
            from = std::max(from, end);
        }
    }
    add_area(d, k_rank_plaza, Surface::plaza, flat(k_kerb), {circle(middle, 8, 32)});
    add_prop(d, dice, PropKind::statue, middle, heading_of(to_metres(ring[0]) - middle), 4.2f);
    add_destination(d, DestinationKind::square, middle + Vec2{0, 3}, {0, -1}, 1);
    for (int i = 0; i < 6; ++i) {
        Vec2 out = heading_direction(2 * k_pi * (static_cast<float>(i) + 0.5f) / 6);
        add_bench(d, dice, middle + out * 7.2f, -out);
    }
    // A pond between two paths, where the ground is level.
    std::optional<Vec2> pond;
    float pond_radius = 7.5f;
    for (int i = 0; i < 24 && !pond; ++i) {
        Vec2 at = place_in(dice, ring, pond_radius + 4);
        if (length(at - middle) > pond_radius + 12 && is_level(d, at, pond_radius + 2)) pond = at;
    }
    if (pond) {
        Ring water, rim;
        float turn = dice.between(0, 2 * k_pi);
        for (int i = 0; i < 28; ++i) {
            float angle = 2 * k_pi * static_cast<float>(i) / 28;
            SinCos twice = sin_cos(2 * angle + turn), thrice = sin_cos(3 * angle - turn);
            float radius = pond_radius * (0.85f + 0.12f * twice.sine + 0.06f * thrice.cosine);
            water.push_back(to_point(*pond + heading_direction(angle) * radius));
            rim.push_back(to_point(*pond + heading_direction(angle) * (radius + 0.5f)));
        }
        add_area(d, k_rank_solid + 1, Surface::water, flat(-0.1f), {positive(water)});
        add_area(d, k_rank_solid + 1, Surface::path, flat(k_kerb), {positive(rim)});
    }
    int trees = std::clamp(static_cast<int>(area({ring}) / 130), 8, 48);
    for (int i = 0; i < trees; ++i) {
        Vec2 at = place_in(dice, ring, 2.5f);
        bool is_free = length(at - middle) > 12 && (!pond || length(at - *pond) > pond_radius + 2.5f);
        float size = dice.between(0.95f, 1.45f);
        if (is_free) add_tree(d, dice, at, size);
    }
}

void fill_slabs(District& d, Block& block) {
    Dice& dice = block.dice;
    const Ring& ring = block.ring;
    add_area(d, k_rank_rest, Surface::grass, flat(k_kerb), {block.outline});
    Vec2 middle = middle_of(ring).value_or(to_metres(ring[0])),
         south = dice.chance(0.5f) ? Vec2{0, 1} : Vec2{0, -1};
    // Along the longest front.
    float longest = 0;
    for (const Front& f : block.fronts) {
        if (length(f.b - f.a) <= longest) continue;
        longest = length(f.b - f.a);
        Vec2 along = (f.b - f.a) / longest;
        south = {-along.z, along.x};
    }
    Vec2 east{south.z, -south.x};
    auto slab = [&](Vec2 centre, float width, float depth, int floors, bool shops) {
        House house;
        Vec2 u = east * (width * 0.5f), v = south * (depth * 0.5f);
        house.footprint = positive({to_point(centre - u - v), to_point(centre + u - v),
                                    to_point(centre + u + v), to_point(centre - u + v)});
        if (area(subtract({house.footprint}, {ring})) > 0.1) return;
        house.street_edges = {};
        house.door_edge = 0;
        house.cornice = 0;
        house.eaves = static_cast<float>(floors) * 3.2f + 1;
        house.roof_height = 1;
        house.style = dice.chance(0.6f) ? 4 : stone_style(dice);
        house.shop = shops;
        uint32_t index = add_house(d, dice, house);
        add_box(d.city, at_height(centre, d.city.buildings[index].top), east, {width * 0.2f, depth * 0.25f},
                2.8f, index);
    };
    slab(middle - east * 18.0f - south * 12.0f, 17, 17, 9 + dice.pick(3), true);
    slab(middle + south * 16.0f, 46, 12.5f, 5 + dice.pick(2), false);
    slab(middle + east * 17.0f - south * 14.0f, 22, 13, 3 + dice.pick(2), true);
    {
        Vec2 u = east * 30.0f, v = south * 5.0f;
        add_area(d, k_rank_plaza, Surface::plaza, flat(k_kerb),
                 {positive({to_point(middle - u - v), to_point(middle + u - v), to_point(middle + u + v),
                            to_point(middle - u + v)})});
        // Ways out to the streets.
        for (const Front& front : block.fronts) {
            if (length(front.b - front.a) < 25) continue;
            add_path(d, {middle, lerp(front.a, front.b, 0.5f)}, 3, Surface::plaza);
        }
        for (int i = 0; i < 9; ++i) {
            Vec2 at = place_in(dice, ring, 4);
            add_tree(d, dice, at, dice.between(0.9f, 1.35f));
        }
        for (int i = 0; i < 6; ++i) {
            Vec2 at = middle + east * (9.5f * (static_cast<float>(i) - 2.5f)) + south * dice.between(-3, 3);
            add_tree(d, dice, at, dice.between(0.9f, 1.2f));
        }
        for (float s : {-14.0f, 0.0f, 14.0f}) add_bench(d, dice, middle + east * s + south * 6.0f, south);
    }
}

void fill_belt(District& d, uint32_t way_index, uint64_t seed) {
    const StreetPlan& plan = d.streets;
    const Way& way = plan.ways[way_index];
    Block block;
    block.dice = {{seed, way_index, 5, Purpose::city}};
    constexpr float k_deep = 32;
    // Which side is out: away from the middle.
    std::vector<Vec2> line = way.line;
    Vec2 centre = (plan.low + plan.high) * 0.5f, along = line.back() - line.front();
    if (cross(along, lerp(line.front(), line.back(), 0.5f) - centre) < 0)
        std::reverse(line.begin(), line.end());
    Rings land, streets;
    add_strip(land, line, 0, way.half() + k_deep, false);
    std::vector<uint32_t> near{way_index};
    for (uint32_t node : {way.from, way.to})
        near.insert(near.end(), plan.ways_at[node].begin(), plan.ways_at[node].end());
    for (uint32_t w : near)
        add_strip(streets, plan.ways[w].line, plan.ways[w].half(), plan.ways[w].half(), true);
    double largest = 100;
    for (const Region& region : regions_of(subtract(unite(land), streets))) {
        double size = area({region.outer});
        if (size <= largest || !region.holes.empty()) continue;
        largest = size;
        block.outline = region.outer;
        block.ring = simple_outline(region.outer);
    }
    if (block.ring.empty()) return;
    for (size_t k = 0; k < block.ring.size(); ++k) {
        Front front{to_metres(block.ring[k]), to_metres(block.ring[(k + 1) % block.ring.size()])};
        Vec2 at = lerp(front.a, front.b, 0.5f);
        for (uint32_t w : near) {
            const std::vector<Vec2>& l = plan.ways[w].line;
            for (size_t i = 0; i + 1 < l.size(); ++i) {
                Vec2 u = normalize_or(l[i + 1] - l[i], {1, 0});
                float s = dot(at - l[i], u), away = std::fabs(cross(u, at - l[i])) - plan.ways[w].half();
                if (away < 0.3f && s > -1 && s < length(l[i + 1] - l[i]) + 1) front.way = w;
            }
        }
        block.fronts.push_back(front);
    }
    fill_row(d, block, 11.5f, way.kind == WayKind::avenue ? 5 : 4, false);
    for (int i = 0; i < 6; ++i) {
        Vec2 at = place_in(block.dice, block.ring, 3);
        add_tree(d, block.dice, at, block.dice.between(0.8f, 1.3f));
    }
}

}  // namespace flaneur
