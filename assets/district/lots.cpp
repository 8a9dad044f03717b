// Rows of houses along streets: a block's rim is cut into lots.
#include <algorithm>
#include <cmath>

#include "assets/district/district.h"
#include "sim/base/math.h"

namespace flaneur {

namespace {

constexpr float k_arcade_deep = 3.4f, k_arcade_high = 4.1f;

// The rim of a block: its fronts, the line at the lots' backs, and how much of each front its corners' houses
// take.
struct Rim {
    const Block* block = nullptr;
    Ring back;
    float depth = 12;
    std::vector<float> start, end;  // metres from either end of a front
    std::vector<uint8_t> is_corner;

    size_t count() const { return block->fronts.size(); }
    const Front& front(size_t k) const { return block->fronts[k % count()]; }
    float width(size_t k) const { return length(front(k).b - front(k).a); }
    Vec2 along(size_t k) const { return normalize_or(front(k).b - front(k).a, {1, 0}); }
    bool is_street(size_t k) const { return front(k).way != ~0u; }

    Vec2 at(size_t k, float s) const { return front(k).a + along(k) * s; }
    // Behind a front's point, at the lots' backs.
    Vec2 behind(size_t k, float s) const {
        Vec2 u = along(k), in{-u.z, u.x}, p = at(k, s) + in * depth;
        size_t n = count();
        Vec2 from = to_metres(back[k % n]), to = to_metres(back[(k + 1) % n]);
        bool begins = is_street(k + n - 1), ends = is_street(k + 1);
        if (s < 0.01f && begins && !is_corner[k % n]) return from;
        if (s > width(k) - 0.01f && ends && !is_corner[(k + 1) % n]) return to;
        if (begins && dot(p - from, u) < 0) return from;
        if (ends && dot(p - to, u) > 0) return to;
        return p;
    }
};

std::optional<Rim> find_rim(const Block& block, float depth) {
    Rim rim;
    rim.block = &block;
    for (float d : {depth, depth - 2, depth - 4}) {
        std::optional<Ring> back = inset(block.ring, static_cast<int64_t>(d * 1000));
        if (!back) continue;
        rim.back = *back;
        rim.depth = d;
        break;
    }
    size_t n = rim.count();
    if (rim.back.size() != n) return std::nullopt;
    rim.start.assign(n, 0);
    rim.end.assign(n, 0);
    rim.is_corner.assign(n, 0);
    for (size_t k = 0; k < n; ++k) {
        size_t before = (k + n - 1) % n;
        Vec2 u = rim.along(before), v = rim.along(k);
        if (!rim.is_street(before) || !rim.is_street(k) || cross(u, v) < 0.4f * (1 + dot(u, v))) continue;
        float share = rim.depth * cross(u, v) / std::max(0.1f, 1 + dot(u, v));
        rim.is_corner[k] = 1;
        rim.start[k] = rim.end[before] = share;
    }
    for (size_t k = 0; k < n; ++k) {
        float taken = rim.start[k] + rim.end[k], width = rim.width(k), spare = width - taken;
        if (spare < 0) {
            rim.start[k] *= width / taken;
            rim.end[k] *= width / taken;
        } else if (spare < 5 && taken > 0) {
            (rim.start[k] > 0 ? rim.start[k] : rim.end[k]) += spare;
        }
    }
    return rim;
}

// Storeys, colours and a roof.
House draw_house(Dice& dice, bool busy, int storeys) {
    House house;
    int floors = std::max(3, storeys + dice.pick(3) - 1);
    house.storey = dice.between(3.1f, 3.5f);
    house.eaves = static_cast<float>(floors) * house.storey + 0.5f;
    house.style = busy ? stone_style(dice) : plaster_style(dice);
    house.shop = dice.chance(busy ? 0.85f : 0.3f);
    float roof = dice.unit(), pitch = dice.between(3, 4.4f);
    house.roof = roof < 0.5f ? RoofKind::gable : roof < 0.8f ? RoofKind::mansard : RoofKind::flat;
    house.roof_height = house.roof == RoofKind::gable ? pitch : house.roof == RoofKind::mansard ? 2.7f : 0.8f;
    return house;
}

// Under the upper storeys of a house people walk: its ground floor stands back behind pillars along a-b.
void add_arcade(District& d, Dice& dice, House house, Vec2 a, Vec2 b, float depth) {
    Vec2 along = normalize_or(b - a, {1, 0}), in{-along.z, along.x};
    Vec2 far_a = a - along * 40.0f, far_b = b + along * 40.0f;
    Ring strip = positive({to_point(far_a - in * 6.0f), to_point(far_b - in * 6.0f),
                           to_point(far_b + in * k_arcade_deep), to_point(far_a + in * k_arcade_deep)});
    std::vector<Region> lower = regions_of(subtract({house.footprint}, {strip}));
    if (lower.size() != 1 || !lower[0].holes.empty()) return;
    House shops = house;
    shops.footprint = without_collinear(lower[0].outer, 5);
    shops.street_edges = {};
    shops.cornice = 0;
    shops.roof = RoofKind::flat;
    shops.roof_height = 0;
    shops.eaves = k_arcade_high;
    shops.storey = k_arcade_high;
    shops.shop = true;
    shops.door_edge.reset();
    for (uint32_t e = 0; e < shops.footprint.size(); ++e) {
        Vec2 p = to_metres(shops.footprint[e]),
             q = to_metres(shops.footprint[(e + 1) % shops.footprint.size()]);
        bool is_front = std::fabs(dot(p - a, in) - k_arcade_deep) < 0.05f &&
                        std::fabs(dot(q - a, in) - k_arcade_deep) < 0.05f;
        if (is_front && length(q - p) > 4) shops.door_edge = e;
    }
    uint32_t below = add_house(d, dice, shops);
    float bottom = d.city.buildings[below].top;
    house.eaves = std::max(house.eaves - k_arcade_high, 2 * house.storey) + 0.3f;
    house.shop = false;
    house.door_edge.reset();
    uint32_t above = add_upper(d, dice, house, bottom);
    dress_roof(d, dice, house, above, a, b, depth);
    // Pillars at even distances, one at each end of the front.
    float width = length(b - a), parts = std::max(1.0f, std::floor(width / 3.9f + 0.5f));
    for (float i = 0; i <= parts; i += 1) {
        float s = lerp(0.32f, width - 0.32f, i / parts);
        add_pillar(d, a + along * s + in * 0.32f, along, 0.3f, bottom + 0.02f);
    }
}

// A way through into the courtyard under the upper storeys of the lot's middle.
void add_gateway(District& d, Dice& dice, const Ring& lot, House house) {
    Vec2 a = to_metres(lot[0]), b = to_metres(lot[1]), c = to_metres(lot[2]), e = to_metres(lot[3]);
    float width = length(b - a), left = 0.5f - 1.9f / width, right = 0.5f + 1.9f / width;
    auto part = [&](float s, float t) {
        return Ring{to_point(lerp(a, b, s)), to_point(lerp(a, b, t)), to_point(lerp(e, c, t)),
                    to_point(lerp(e, c, s))};
    };
    House side = house;
    side.roof = RoofKind::flat;
    side.roof_height = 0;
    side.cornice = 0;
    side.eaves = 4.0f;
    side.storey = 4.0f;
    side.shop = false;
    side.street_edges = {};
    float bottom = 0;
    for (const Ring& ring : {part(0, left), part(right, 1)}) {
        side.footprint = ring;
        side.door_edge.reset();
        bottom = std::max(bottom, d.city.buildings[add_house(d, dice, side)].top);
    }
    house.footprint = lot;
    house.eaves -= 4.0f;
    house.shop = false;
    house.door_edge.reset();
    uint32_t above = add_upper(d, dice, house, bottom);
    dress_roof(d, dice, house, above, a, b, length(e - a));
}

// Whether a lot is a fair polygon inside the block.
bool is_sound(const Ring& lot, const Ring& block) {
    double size = area({lot});
    return size > 25 && std::fabs(area(unite({lot})) - size) < 0.05 && area(subtract({lot}, {block})) < 0.4;
}

Ring ring_of(std::initializer_list<Vec2> points) {
    Ring ring;
    for (Vec2 p : points) {
        if (ring.empty() || length(to_metres(ring.back()) - p) > 0.25f) ring.push_back(to_point(p));
    }
    if (length(to_metres(ring.back()) - to_metres(ring.front())) < 0.25f) ring.pop_back();
    return ring;
}

void build_corner(District& d, Block& block, const Rim& rim, size_t k, int storeys) {
    Dice& dice = block.dice;
    size_t n = rim.count(), before = (k + n - 1) % n;
    const Front &first = rim.front(before), &second = rim.front(k);
    bool busy = first.busy || second.busy;
    House house = draw_house(dice, busy, storeys + 1);
    if (house.roof == RoofKind::gable) house.roof = RoofKind::mansard, house.roof_height = 2.7f;
    house.shop = true;
    Vec2 corner = second.a, u = rim.along(before), v = rim.along(k);
    float bevel = std::min({dice.between(2.4f, 3.4f), rim.start[k] * 0.4f, rim.end[before] * 0.4f});
    float from = rim.width(before) - rim.end[before];
    Vec2 p = rim.at(before, from), q = rim.at(k, rim.start[k]);
    house.footprint = ring_of({p, corner - u * bevel, corner + v * bevel, q, rim.behind(k, rim.start[k]),
                               to_metres(rim.back[k]), rim.behind(before, from)});
    if (!is_sound(house.footprint, block.ring)) return;
    house.street_edges = {0, 1, 2};
    bool on_stairs = false;
    for (const Front* f : {&first, &second}) {
        on_stairs |= d.streets.ways[f->way].kind == WayKind::stairs;
    }
    if (on_stairs) house.sunk = 1;
    if (first.arcade != second.arcade) {
        Vec2 a = first.arcade ? p : corner + v * bevel, b = first.arcade ? corner - u * bevel : q;
        add_arcade(d, dice, house, a, b, rim.depth);
        return;
    }
    house.door_edge = 1;
    uint32_t index = add_house(d, dice, house);
    const Building building = d.city.buildings[index];
    dress_roof(d, dice, house, index, p, corner - u * bevel, rim.depth);
    if (!on_stairs) {
        dress_front(d, dice, house, building.base, p, corner - u * bevel);
        dress_front(d, dice, house, building.base, corner + v * bevel, q);
    }
    // Some carry a turret over the cut-off corner.
    if (dice.chance(0.45f) && bevel > 2) {
        House turret;
        Vec2 middle = corner + (v - u) * (bevel * 0.5f), out = normalize_or(u - v, {1, 0});
        turret.footprint = circle(middle - out * 0.7f, bevel * 0.72f, 8);
        turret.style = house.style;
        turret.storey = house.storey;
        turret.cornice = 0;
        turret.roof = RoofKind::pyramid;
        turret.roof_height = dice.between(3.5f, 5.5f);
        float floors = std::floor(house.eaves / house.storey);
        turret.eaves = (floors - 1) * house.storey + 2.2f;
        add_upper(d, dice, turret, building.base + house.storey + 0.4f);
    }
}

void build_lot(District& d, Block& block, const Rim& rim, size_t k, float from, float to, int storeys,
               bool gateway) {
    Dice& dice = block.dice;
    const Front& front = rim.front(k);
    House house = draw_house(dice, front.busy, storeys);
    Vec2 a = rim.at(k, from), b = rim.at(k, to), c = rim.behind(k, to), e = rim.behind(k, from);
    float shallow = dice.chance(0.5f) ? dice.between(0.06f, 0.2f) : 0;
    c = lerp(c, b, shallow);
    e = lerp(e, a, shallow);
    house.footprint = ring_of({a, b, c, e});
    if (house.footprint.size() != 4 || !is_sound(house.footprint, block.ring)) return;
    house.street_edges = {0};
    bool on_stairs = d.streets.ways[front.way].kind == WayKind::stairs;
    float depth = length(e - a);
    if (front.arcade) {
        add_arcade(d, dice, house, a, b, depth);
        return;
    }
    if (gateway && length(b - a) > 9) {
        add_gateway(d, dice, house.footprint, house);
        return;
    }
    if (on_stairs) {
        house.sunk = 1;
        house.shop = false;
    } else {
        house.door_edge = 0;
    }
    uint32_t index = add_house(d, dice, house);
    dress_roof(d, dice, house, index, a, b, depth);
    if (!on_stairs) dress_front(d, dice, house, d.city.buildings[index].base, a, b);
}

}  // namespace

Ring simple_outline(const Ring& outline) {
    constexpr int64_t k_room = 12'500;
    constexpr double k_most = 40;  // m^2 that a corner may be worth
    Ring ring = without_collinear(outline, 250);
    while (ring.size() > 4 && !inset(ring, k_room)) {
        size_t least = 0, n = ring.size();
        double least_area = 1e9;
        for (size_t i = 0; i < n; ++i) {
            double size = area({{ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n]}});
            // Better to lose ground than to take the sidewalk's.
            if (size < 0) size *= -5;
            if (size < least_area) least_area = size, least = i;
        }
        if (least_area > k_most) break;
        ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(least));
    }
    return ring;
}

bool fill_row(District& d, Block& block, float depth, int storeys, bool closed) {
    std::optional<Rim> rim = find_rim(block, depth);
    if (!rim) return false;
    Dice& dice = block.dice;
    // The gateway goes into the longest quiet front.
    size_t gate = rim->count();
    float longest = 20;
    for (size_t k = 0; closed && k < rim->count(); ++k) {
        const Front& f = rim->front(k);
        bool is_flat = rim->is_street(k) && d.streets.ways[f.way].kind != WayKind::stairs &&
                       std::fabs(terrain_at(d, f.a) - terrain_at(d, f.b)) < 0.5f;
        float free = rim->width(k) - rim->start[k] - rim->end[k];
        if (is_flat && !f.arcade && !f.busy && free > longest) longest = free, gate = k;
    }
    for (size_t k = 0; k < rim->count(); ++k) {
        if (rim->is_corner[k]) build_corner(d, block, *rim, k, storeys);
        if (!rim->is_street(k)) continue;
        float from = rim->start[k], to = rim->width(k) - rim->end[k];
        if (to - from < 4.5f) continue;
        int lots = std::max(1, static_cast<int>((to - from) / dice.between(12, 17.5f) + 0.5f));
        std::vector<float> cuts{0};
        for (int i = 0; i < lots; ++i) cuts.push_back(cuts.back() + dice.between(0.75f, 1.25f));
        for (int i = 0; i < lots; ++i) {
            auto cut = [&](int c) { return lerp(from, to, cuts[static_cast<size_t>(c)] / cuts.back()); };
            build_lot(d, block, *rim, k, cut(i), cut(i + 1), storeys + (rim->front(k).busy ? 1 : 0),
                      k == gate && i == lots / 2);
        }
    }
    return true;
}

}  // namespace flaneur
