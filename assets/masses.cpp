#include "assets/masses.h"

#include <algorithm>
#include <cmath>

namespace flaneur {

namespace {

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

// A level region, facing up or down.
void add_level(City& city, const Region& region, float y, bool up, uint32_t building) {
    auto first = static_cast<uint32_t>(city.roof_vertices.size());
    for (const Ring& ring : rings_of(region)) {
        for (Point p : ring) city.roof_vertices.push_back(at_height(to_metres(p), y));
    }
    std::vector<uint32_t> t = triangulate(region);
    for (size_t i = 0; i < t.size(); i += 3) {
        if (up) std::swap(t[i + 1], t[i + 2]);
        for (size_t k = 0; k < 3; ++k) city.roof_indices.push_back(first + t[i + k]);
        city.roof_buildings.push_back(building);
    }
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

void add_walls(City& city, const Region& footprint, float bottom, float top, FaceKind kind,
               uint32_t building) {
    for (const Ring& ring : rings_of(footprint)) {
        for (size_t i = 0; i < ring.size(); ++i) {
            Vec2 p = to_metres(ring[i]), q = to_metres(ring[(i + 1) % ring.size()]);
            city.faces.push_back({at_height(q, bottom), at_height(p, bottom), top, top, kind, building});
        }
    }
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

// Gable and hip roofs over the quad p0 p1 p2 p3, the ridge running from edge 1's middle to edge 3's.
void add_ridge_roof(City& city, const Mass& m, const Vec2* p) {
    bool hip = m.roof == RoofKind::hip;
    float eaves = m.eaves, ridge = m.eaves + m.roof_height;
    Vec2 s = lerp(p[1], p[2], 0.5f), t = lerp(p[3], p[0], 0.5f);
    Vec2 along = normalize_or(s - t, {1, 0});
    float long_side = length(s - t), half = 0.25f * (length(p[2] - p[1]) + length(p[0] - p[3]));
    if (hip) {
        float back = std::min(half, long_side * 0.45f);
        s = s - along * back;
        t = t + along * back;
    }
    // Corners pushed out, and down along the slope, for the overhang.
    Vec2 e[4];
    float drop = m.overhang * m.roof_height / std::max(half, 0.5f);
    for (int i = 0; i < 4; ++i) {
        Vec2 before = normalize_or(p[i] - p[(i + 3) % 4], {1, 0}),
             after = normalize_or(p[(i + 1) % 4] - p[i], {1, 0});
        e[i] = p[i] + (before - after) * m.overhang;
    }
    if (!hip) {
        s = s + along * m.overhang;
        t = t - along * m.overhang;
    }
    float low = eaves - drop;
    Vec3 a = at_height(e[0], low), b = at_height(e[1], low), c = at_height(e[2], low),
         d = at_height(e[3], low);
    Vec3 rs = at_height(s, ridge), rt = at_height(t, ridge);
    auto both = [&](Vec3 u, Vec3 v, Vec3 w, Vec3 x) {
        add_quad(city, u, v, w, x, m.building);
        if (m.overhang > 0) add_quad(city, x, w, v, u, m.building);
    };
    both(b, a, rt, rs);
    both(d, c, rs, rt);
    if (hip) {
        for (bool inner : {false, true}) {
            if (inner && m.overhang <= 0) break;
            add_triangle(city, inner ? rs : c, b, inner ? c : rs, m.building);
            add_triangle(city, inner ? rt : a, d, inner ? a : rt, m.building);
        }
    } else {
        for (int i : {1, 3}) {
            Vec2 u = p[i], w = p[(i + 1) % 4], middle = lerp(u, w, 0.5f);
            city.faces.push_back(
                {at_height(w, m.bottom), at_height(middle, m.bottom), eaves, ridge, m.kind, m.building});
            city.faces.push_back(
                {at_height(middle, m.bottom), at_height(u, m.bottom), ridge, eaves, m.kind, m.building});
        }
    }
}

void add_flat_roof(City& city, const Mass& m) {
    std::optional<Region> inner = m.roof_height > 0.1f ? inset_region(m.footprint, 0.3f) : std::nullopt;
    float top = inner ? m.eaves + m.roof_height : m.eaves;
    add_walls(city, m.footprint, m.bottom, top, m.kind, m.building);
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

bool add_mansard(City& city, const Mass& m) {
    std::optional<Region> inner = inset_region(m.footprint, m.roof_height * 0.55f);
    if (!inner) return false;
    add_walls(city, m.footprint, m.bottom, m.eaves, m.kind, m.building);
    Rings outer_rings = rings_of(m.footprint), inner_rings = rings_of(*inner);
    for (size_t r = 0; r < outer_rings.size(); ++r) {
        add_skirt(city, outer_rings[r], m.eaves, inner_rings[r], m.eaves + m.roof_height, m.building);
    }
    add_level(city, *inner, m.eaves + m.roof_height, true, m.building);
    return true;
}

void add_pyramid(City& city, const Mass& m) {
    add_walls(city, m.footprint, m.bottom, m.eaves, m.kind, m.building);
    const Ring& ring = m.footprint.outer;
    Vec2 middle{};
    for (Point p : ring) middle += to_metres(p) / static_cast<float>(ring.size());
    for (size_t i = 0; i < ring.size(); ++i) {
        add_triangle(city, at_height(to_metres(ring[(i + 1) % ring.size()]), m.eaves),
                     at_height(to_metres(ring[i]), m.eaves), at_height(middle, m.eaves + m.roof_height),
                     m.building);
    }
}

}  // namespace

void add_mass(City& city, const Mass& mass) {
    Mass m = mass;
    const Ring& ring = m.footprint.outer;
    bool whole = m.footprint.holes.empty() && is_convex(ring);
    bool ridge = m.roof == RoofKind::gable || m.roof == RoofKind::hip;
    if ((ridge && !(whole && ring.size() == 4)) || (m.roof == RoofKind::pyramid && !whole)) {
        m.roof = RoofKind::flat;
        m.roof_height = std::min(m.roof_height, 0.6f);
        ridge = false;
    }
    if (ridge) {
        Vec2 p[4];
        size_t turned = m.gable_across ? 1 : 0;
        for (size_t i = 0; i < 4; ++i) p[i] = to_metres(ring[(i + turned) % 4]);
        for (size_t i = 0; i < 4; ++i) {
            if (m.roof == RoofKind::gable && i % 2 == 1) continue;  // gable ends come with the roof
            city.faces.push_back({at_height(p[(i + 1) % 4], m.bottom), at_height(p[i], m.bottom), m.eaves,
                                  m.eaves, m.kind, m.building});
        }
        add_ridge_roof(city, m, p);
    } else if (m.roof == RoofKind::pyramid) {
        add_pyramid(city, m);
    } else if (m.roof != RoofKind::mansard || !add_mansard(city, m)) {
        if (m.roof == RoofKind::mansard) m.roof_height = 0.5f;
        add_flat_roof(city, m);
    }
    if (m.cornice > 0) add_cornice(city, m, m.eaves);
    if (m.underside) add_level(city, m.footprint, m.bottom, false, m.building);
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
        city.faces.push_back({at_height(to_metres(ring[k]), foot), at_height(to_metres(ring[i]), foot),
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
