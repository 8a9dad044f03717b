#include "assets/plan/masses.h"

#include <algorithm>
#include <cmath>

#include "assets/plan/roofs.h"

namespace flaneur {

void add_triangle(City& city, Vec3 a, Vec3 b, Vec3 c, uint32_t building) {
    auto first = static_cast<uint32_t>(city.roof_vertices.size());
    city.roof_vertices.insert(city.roof_vertices.end(), {a, b, c});
    city.roof_indices.insert(city.roof_indices.end(), {first, first + 1, first + 2});
    city.roof_buildings.push_back(building);
}

void add_quad(City& city, Vec3 a, Vec3 b, Vec3 c, Vec3 d, uint32_t building) {
    auto first = static_cast<uint32_t>(city.roof_vertices.size());
    city.roof_vertices.insert(city.roof_vertices.end(), {a, b, c, d});
    city.roof_indices.insert(city.roof_indices.end(),
                             {first, first + 1, first + 2, first, first + 2, first + 3});
    city.roof_buildings.insert(city.roof_buildings.end(), 2, building);
}

void add_region(City& city, const Region& region, bool up, uint32_t building,
                const std::function<float(Point)>& height) {
    auto first = static_cast<uint32_t>(city.roof_vertices.size());
    for (const Ring& ring : rings_of(region)) {
        for (Point p : ring) city.roof_vertices.push_back(at_height(to_metres(p), height(p)));
    }
    std::vector<uint32_t> t = triangulate(region);
    for (size_t i = 0; i < t.size(); i += 3) {
        if (up) std::swap(t[i + 1], t[i + 2]);
        for (size_t k = 0; k < 3; ++k) city.roof_indices.push_back(first + t[i + k]);
        city.roof_buildings.push_back(building);
    }
}

void add_walls(City& city, const Mass& m, float top) {
    for (const Ring& ring : rings_of(m.footprint)) {
        for (size_t i = 0; i < ring.size(); ++i) {
            Vec2 p = to_metres(ring[i]), q = to_metres(ring[(i + 1) % ring.size()]);
            city.ground.faces.push_back(
                {at_height(q, m.bottom), at_height(p, m.bottom), top, top, m.kind, m.building});
        }
    }
}

namespace {

// A level region, facing up or down.
void add_level(City& city, const Region& region, float y, bool up, uint32_t building) {
    add_region(city, region, up, building, [y](Point) { return y; });
}

// The skin between two rings of as many corners; `lower` winds so that its solid side is to the left.
void add_skirt(City& city, const Ring& lower, float low, const Ring& upper, float high, uint32_t building) {
    for (size_t i = 0; i < lower.size(); ++i) {
        size_t k = (i + 1) % lower.size();
        add_quad(city, at_height(to_metres(lower[k]), low), at_height(to_metres(lower[i]), low),
                 at_height(to_metres(upper[i]), high), at_height(to_metres(upper[k]), high), building);
    }
}

// Every ring of the region moved inwards, if the result is a region again.
std::optional<Region> inset_region(const Region& region, float distance) {
    auto mm = static_cast<int64_t>(distance * 1000);
    std::optional<Ring> outer = inset(region.outer, mm);
    if (!outer) return std::nullopt;
    Region moved{*outer, {}};
    for (const Ring& hole : region.holes) {
        std::optional<Ring> wider = inset(hole, mm);
        if (!wider) return std::nullopt;
        moved.holes.push_back(*wider);
    }
    if (!moved.holes.empty()) {
        Rings rings = rings_of(moved);
        if (std::fabs(area(unite(rings)) - area(rings)) > 0.01) return std::nullopt;
    }
    return moved;
}

// A moulding along the street, `out` metres deep, its top at `y`.
void add_cornice(City& city, const Mass& m, float y) {
    const Ring& ring = m.footprint.outer;
    size_t n = ring.size();
    std::optional<Ring> wide = inset(ring, -static_cast<int64_t>(m.cornice * 1000));
    if (!wide) return;
    auto on_street = [&](size_t edge) {
        return std::find(m.street_edges.begin(), m.street_edges.end(), edge) != m.street_edges.end();
    };
    float low = y - 0.45f, middle = y - 0.12f;
    for (uint32_t i : m.street_edges) {
        size_t k = (i + 1) % n;
        Vec2 p = to_metres(ring[i]), q = to_metres(ring[k]), along = normalize_or(q - p, {1, 0});
        Vec2 out = Vec2{along.z, -along.x} * m.cornice;
        bool turns_p = on_street((i + n - 1) % n), turns_q = on_street(k);
        Vec2 po = turns_p ? to_metres((*wide)[i]) : p + out;
        Vec2 qo = turns_q ? to_metres((*wide)[k]) : q + out;
        // From the wall slanting out, then straight up, then back over the top.
        add_quad(city, at_height(q, low), at_height(p, low), at_height(po, middle), at_height(qo, middle),
                 m.building);
        add_quad(city, at_height(qo, middle), at_height(po, middle), at_height(po, y), at_height(qo, y),
                 m.building);
        add_quad(city, at_height(qo, y), at_height(po, y), at_height(p, y), at_height(q, y), m.building);
        if (!turns_p) {
            add_triangle(city, at_height(p, low), at_height(p, y), at_height(po, middle), m.building);
            add_triangle(city, at_height(p, y), at_height(po, y), at_height(po, middle), m.building);
        }
        if (!turns_q) {
            add_triangle(city, at_height(q, low), at_height(qo, middle), at_height(q, y), m.building);
            add_triangle(city, at_height(q, y), at_height(qo, middle), at_height(qo, y), m.building);
        }
    }
}

void add_flat_roof(City& city, const Mass& m) {
    std::optional<Region> inner = m.roof_height > 0.1f ? inset_region(m.footprint, 0.3f) : std::nullopt;
    float top = inner ? m.eaves + m.roof_height : m.eaves;
    add_walls(city, m, top);
    if (!inner) {
        add_level(city, m.footprint, m.eaves, true, m.building);
        return;
    }
    Rings outer_rings = rings_of(m.footprint), inner_rings = rings_of(*inner);
    for (size_t r = 0; r < outer_rings.size(); ++r) {
        add_skirt(city, outer_rings[r], top, inner_rings[r], top, m.building);
        Ring seen_from_inside = inner_rings[r];
        std::reverse(seen_from_inside.begin(), seen_from_inside.end());
        add_skirt(city, seen_from_inside, m.eaves, seen_from_inside, top, m.building);
    }
    add_level(city, *inner, m.eaves, true, m.building);
}

}  // namespace

RoofKind add_mass(City& city, const Mass& mass) {
    Mass m = mass;
    if (!add_pitched_mass(city, m)) {
        if (m.roof != RoofKind::flat) m.roof_height = 0.5f;
        m.roof = RoofKind::flat;
        add_flat_roof(city, m);
    }
    if (m.cornice > 0) add_cornice(city, m, m.eaves);
    if (m.underside) add_level(city, m.footprint, m.bottom, false, m.building);
    return m.roof;
}

void add_box(City& city, Vec3 centre, Vec2 along, Vec2 half, float height, uint32_t building) {
    Vec2 u = along * half.x, v = Vec2{-along.z, along.x} * half.z, c = on_ground(centre);
    Vec2 corners[4] = {c - u - v, c + u - v, c + u + v, c - u + v};
    float top = centre.y + height;
    for (int i = 0; i < 4; ++i) {
        Vec2 p = corners[i], q = corners[(i + 1) % 4];
        add_quad(city, at_height(q, centre.y), at_height(p, centre.y), at_height(p, top), at_height(q, top),
                 building);
    }
    add_quad(city, at_height(corners[3], top), at_height(corners[2], top), at_height(corners[1], top),
             at_height(corners[0], top), building);
}

void add_garden_wall(City& city, GroundPlan& plan, Vec2 a, Vec2 b, float thickness, float foot, float a_top,
                     float b_top, uint32_t building) {
    Vec2 along = normalize_or(b - a, {1, 0}), right = Vec2{-along.z, along.x} * thickness;
    Ring ring{to_point(a), to_point(b), to_point(b + right), to_point(a + right)};
    if (twice_area(ring) <= 0) return;
    float tops[4] = {a_top, b_top, b_top, a_top};
    for (size_t i = 0; i < 4; ++i) {
        size_t k = (i + 1) % 4;
        city.ground.faces.push_back({at_height(to_metres(ring[k]), foot), at_height(to_metres(ring[i]), foot),
                                     tops[k], tops[i], FaceKind::garden_wall, building});
    }
    add_quad(city, at_height(to_metres(ring[3]), tops[3]), at_height(to_metres(ring[2]), tops[2]),
             at_height(to_metres(ring[1]), tops[1]), at_height(to_metres(ring[0]), tops[0]), building);
    Area solid;
    solid.rank = k_rank_solid;
    solid.solid = true;
    solid.rings = {ring};
    plan.areas.push_back(std::move(solid));
}

}  // namespace flaneur
