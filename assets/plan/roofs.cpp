// Three ways to cover an outline: by a profile swept along the ridge (gable, gambrel, round, skillion), by
// the outline shrunk about its middle (pyramid, dome, onion), and by the outline inset step by step (hip,
// mansard).
#include "assets/plan/roofs.h"

#include <algorithm>
#include <cmath>

namespace flaneur {

namespace {

// Across the ridge: how far, as a share of the breadth, and how high, as a share of the roof's height.
struct Bend {
    float across, height;
};
constexpr Bend k_gable[] = {{0, 0}, {0.5f, 1}, {1, 0}};
constexpr Bend k_skillion[] = {{0, 0}, {1, 1}};
constexpr Bend k_gambrel[] = {{0, 0}, {0.2f, 0.6f}, {0.5f, 1}, {0.8f, 0.6f}, {1, 0}};
constexpr Bend k_round[] = {{0, 0},          {0.067f, 0.5f}, {0.25f, 0.866f}, {0.5f, 1},
                            {0.75f, 0.866f}, {0.933f, 0.5f}, {1, 0}};

// Up the roof: the outline's share about its middle, and the height's share.
struct Ringlet {
    float size, height;
};
constexpr Ringlet k_dome[] = {{1, 0},         {0.966f, 0.259f}, {0.866f, 0.5f}, {0.707f, 0.707f},
                              {0.5f, 0.866f}, {0.259f, 0.966f}, {0, 1}};
constexpr Ringlet k_onion[] = {{1, 0},        {1.13f, 0.1f},  {1.18f, 0.22f}, {1.08f, 0.38f},
                               {0.8f, 0.52f}, {0.45f, 0.65f}, {0.2f, 0.8f},   {0, 1}};
constexpr Ringlet k_pyramid[] = {{1, 0}, {0, 1}};

struct Profile {
    const Bend* bends;
    size_t count;
    Vec2 across;          // unit
    float from, breadth;  // along `across`, metres
    float eaves, rise;

    float at(Vec2 p) const {
        float u = clamp((dot(p, across) - from) / breadth, 0, 1);
        for (size_t i = 0; i + 1 < count; ++i) {
            Bend a = bends[i], b = bends[i + 1];
            if (u <= b.across || i + 2 == count)
                return eaves +
                       rise * lerp(a.height, b.height, clamp((u - a.across) / (b.across - a.across), 0, 1));
        }
        return eaves;
    }
    float place(size_t bend) const { return from + breadth * bends[bend].across; }
};

// The walls under a profile: every edge is cut where the profile bends.
void add_walls_under(City& city, const Mass& m, const Profile& profile) {
    for (const Ring& ring : rings_of(m.footprint)) {
        for (size_t i = 0; i < ring.size(); ++i) {
            Vec2 p = to_metres(ring[i]), q = to_metres(ring[(i + 1) % ring.size()]);
            float pu = dot(p, profile.across), qu = dot(q, profile.across);
            std::vector<float> cuts{0, 1};
            for (size_t b = 1; b + 1 < profile.count; ++b) {
                float t = (profile.place(b) - pu) / (qu - pu);
                if (t > 0.001f && t < 0.999f) cuts.push_back(t);
            }
            std::sort(cuts.begin(), cuts.end());
            for (size_t c = 0; c + 1 < cuts.size(); ++c) {
                Vec2 a = lerp(p, q, cuts[c + 1]), b = lerp(p, q, cuts[c]);
                city.ground.faces.push_back({at_height(a, m.bottom), at_height(b, m.bottom), profile.at(a),
                                             profile.at(b), m.kind, m.building});
            }
        }
    }
}

bool add_profile_roof(City& city, const Mass& m, const Bend* bends, size_t count, Vec2 ridge) {
    Profile profile{bends, count, {-ridge.z, ridge.x}, 1e9f, 0, m.eaves, m.roof_height};
    float to = -1e9f, first = 1e9f, last = -1e9f;
    for (Point p : m.footprint.outer) {
        float u = dot(to_metres(p), profile.across), v = dot(to_metres(p), ridge);
        profile.from = std::min(profile.from, u), to = std::max(to, u);
        first = std::min(first, v), last = std::max(last, v);
    }
    profile.breadth = to - profile.from;
    double box = static_cast<double>(profile.breadth) * static_cast<double>(last - first);
    bool skillion = count == 2;
    if (profile.breadth < 1 || (!skillion && area(rings_of(m.footprint)) < 0.72 * box)) return false;
    Rings footprint = rings_of(m.footprint);
    for (size_t b = 0; b + 1 < count; ++b) {
        float low = b == 0 ? profile.from - 1 : profile.place(b),
              high = b + 2 == count ? to + 1 : profile.place(b + 1);
        auto corner = [&](float u, float v) { return to_point(profile.across * u + ridge * v); };
        Ring strip = positive(
            {corner(low, first - 1), corner(high, first - 1), corner(high, last + 1), corner(low, last + 1)});
        for (const Region& region : regions_of(intersect(footprint, {strip})))
            add_region(city, region, true, m.building, [&](Point p) { return profile.at(to_metres(p)); });
    }
    add_walls_under(city, m, profile);
    return true;
}

bool add_central_roof(City& city, const Mass& m, const Ringlet* rings, size_t count) {
    const Ring& outline = m.footprint.outer;
    size_t n = outline.size();
    if (!m.footprint.holes.empty()) return false;
    std::optional<Vec2> found = middle_of(outline);
    if (!found) return false;
    Vec2 middle = *found;
    for (size_t i = 0; i < n; ++i) {  // every corner must be seen from the middle
        if (cross(to_metres(outline[i]) - middle, to_metres(outline[(i + 1) % n]) - middle) <= 0.01f)
            return false;
    }
    add_walls(city, m, m.eaves);
    for (size_t r = 0; r + 1 < count; ++r) {
        auto corner = [&](size_t i, const Ringlet& at) {
            return at_height(lerp(middle, to_metres(outline[i % n]), at.size),
                             m.eaves + m.roof_height * at.height);
        };
        for (size_t i = 0; i < n; ++i) {
            Vec3 a = corner(i + 1, rings[r]), b = corner(i, rings[r]), c = corner(i, rings[r + 1]),
                 d = corner(i + 1, rings[r + 1]);
            if (rings[r + 1].size > 0) {
                add_quad(city, a, b, c, d, m.building);
            } else {
                add_triangle(city, a, b, c, m.building);
            }
        }
    }
    return true;
}

// The skin between a set of outlines and the smaller one within it.
void add_band(City& city, const Mass& m, const Rings& outer, float low, const Rings& inner, float high) {
    std::vector<Point> upper;
    for (const Ring& ring : inner) upper.insert(upper.end(), ring.begin(), ring.end());
    auto less = [](Point a, Point b) { return a.X != b.X ? a.X < b.X : a.Y < b.Y; };
    std::sort(upper.begin(), upper.end(), less);
    for (const Region& region : regions_of(subtract(outer, inner))) {
        add_region(city, region, true, m.building, [&](Point p) {
            return std::binary_search(upper.begin(), upper.end(), p, less) ? high : low;
        });
    }
}

// How far the outline can be inset until nothing is left, metres.
float depth_of(const Rings& outline) {
    float possible = 0, impossible = 60;
    for (int i = 0; i < 12; ++i) {
        float middle = 0.5f * (possible + impossible);
        (inset_rings(outline, middle).empty() ? impossible : possible) = middle;
    }
    return possible;
}

bool add_inset_roof(City& city, const Mass& m) {
    Rings outline = rings_of(m.footprint), last = outline;
    size_t corners = 0;
    for (const Ring& ring : outline) corners += ring.size();
    if (corners > 300) return false;
    bool mansard = m.roof == RoofKind::mansard;
    float depth = depth_of(outline);
    if (depth < 0.5f) return false;
    // A hip roof over a wide outline would be a hill: it ends level.
    float reach = mansard ? std::min(m.roof_height * 0.55f, depth * 0.8f) : std::min(depth * 0.985f, 9.0f);
    int bands = mansard ? 1 : corners <= 4 ? 1 : 4;
    add_walls(city, m, m.eaves);
    for (int b = 1; b <= bands; ++b) {
        float part = static_cast<float>(b) / static_cast<float>(bands);
        Rings next = inset_rings(outline, reach * part);
        add_band(city, m, last, m.eaves + m.roof_height * (part - 1 / static_cast<float>(bands)), next,
                 m.eaves + m.roof_height * part);
        last = std::move(next);
    }
    for (const Region& region : regions_of(last))
        add_region(city, region, true, m.building, [&](Point) { return m.eaves + m.roof_height; });
    return true;
}

// Gable and hip over the quad p0 p1 p2 p3, the ridge running from edge 1's middle to edge 3's.
void add_quad_roof(City& city, const Mass& m, const Vec2* p) {
    bool gable = m.roof == RoofKind::gable;
    float eaves = m.eaves, ridge = m.eaves + m.roof_height;
    Vec2 s = lerp(p[1], p[2], 0.5f), t = lerp(p[3], p[0], 0.5f);
    Vec2 along = normalize_or(s - t, {1, 0});
    float long_side = length(s - t), half = 0.25f * (length(p[2] - p[1]) + length(p[0] - p[3]));
    if (!gable) {
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
    if (gable) {
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
    for (int i = 0; i < 4; ++i) {
        Vec2 u = p[i], w = p[(i + 1) % 4], middle = lerp(u, w, 0.5f);
        if (!gable || i % 2 == 0) {
            city.ground.faces.push_back(
                {at_height(w, m.bottom), at_height(u, m.bottom), eaves, eaves, m.kind, m.building});
            continue;
        }
        city.ground.faces.push_back(
            {at_height(w, m.bottom), at_height(middle, m.bottom), eaves, ridge, m.kind, m.building});
        city.ground.faces.push_back(
            {at_height(middle, m.bottom), at_height(u, m.bottom), ridge, eaves, m.kind, m.building});
    }
    if (gable) return;
    for (bool inner : {false, true}) {
        if (inner && m.overhang <= 0) break;
        add_triangle(city, inner ? rs : c, b, inner ? c : rs, m.building);
        add_triangle(city, inner ? rt : a, d, inner ? a : rt, m.building);
    }
}

// A gable roof whose ridge is cut off by small slopes, over the same quad.
void add_half_hip_roof(City& city, const Mass& m, const Vec2* p) {
    constexpr float k_walled = 0.55f;  // of the rise
    float ridge = m.eaves + m.roof_height, middle = m.eaves + m.roof_height * k_walled;
    Vec2 s = lerp(p[1], p[2], 0.5f), t = lerp(p[3], p[0], 0.5f), along = normalize_or(s - t, {1, 0});
    float half = 0.25f * (length(p[2] - p[1]) + length(p[0] - p[3]));
    float back = std::min(half * (1 - k_walled), length(s - t) * 0.45f);
    Vec3 tops[2] = {at_height(t + along * back, ridge), at_height(s - along * back, ridge)};
    for (int side : {0, 2}) {
        // Eaves from u to w, ridge from w's end back to u's.
        Vec2 u = p[side], w = p[side + 1], w_end = side == 0 ? s : t, u_end = side == 0 ? t : s;
        Vec3 a = at_height(w, m.eaves), b = at_height(u, m.eaves);
        Vec3 c = at_height(lerp(u, u_end, k_walled), middle), f = at_height(lerp(w, w_end, k_walled), middle);
        Vec3 d = tops[side == 0 ? 0 : 1], e = tops[side == 0 ? 1 : 0];
        add_quad(city, a, b, c, f, m.building);
        add_quad(city, f, c, d, e, m.building);
        city.ground.faces.push_back(
            {at_height(w, m.bottom), at_height(u, m.bottom), m.eaves, m.eaves, m.kind, m.building});
    }
    for (int end : {1, 3}) {
        Vec2 u = p[end], w = p[(end + 1) % 4], top = end == 1 ? s : t;
        Vec2 left = lerp(w, top, k_walled), right = lerp(u, top, k_walled);
        auto wall = [&](Vec2 from, Vec2 to, float from_top, float to_top) {
            city.ground.faces.push_back(
                {at_height(from, m.bottom), at_height(to, m.bottom), from_top, to_top, m.kind, m.building});
        };
        wall(w, left, m.eaves, middle);
        wall(left, right, middle, middle);
        wall(right, u, middle, m.eaves);
        add_triangle(city, at_height(left, middle), at_height(right, middle), tops[end == 1 ? 1 : 0],
                     m.building);
    }
}

// The sides of the smallest box about the outline: its longer side's direction.
Vec2 long_direction(const Ring& ring) {
    Vec2 best{1, 0};
    float least = 1e30f;
    for (size_t i = 0; i < ring.size() && i < 200; ++i) {
        Vec2 d = to_metres(ring[(i + 1) % ring.size()]) - to_metres(ring[i]);
        if (length(d) < 0.5f) continue;
        Vec2 u = normalize_or(d, {1, 0}), v{-u.z, u.x};
        float low_u = 1e9f, high_u = -1e9f, low_v = 1e9f, high_v = -1e9f;
        for (Point q : ring) {
            Vec2 p = to_metres(q);
            low_u = std::min(low_u, dot(p, u)), high_u = std::max(high_u, dot(p, u));
            low_v = std::min(low_v, dot(p, v)), high_v = std::max(high_v, dot(p, v));
        }
        float wide = high_u - low_u, deep = high_v - low_v;
        if (wide * deep < least) {
            least = wide * deep;
            best = wide >= deep ? u : v;
        }
    }
    return best;
}

}  // namespace

bool add_pitched_mass(City& city, const Mass& mass) {
    const Ring& ring = mass.footprint.outer;
    bool no_ridge = dot(mass.ridge, mass.ridge) < 0.5f;
    switch (mass.roof) {
        case RoofKind::flat:
            return false;
        case RoofKind::gable:
        case RoofKind::half_hip:
        case RoofKind::hip:
            if (mass.footprint.holes.empty() && ring.size() == 4 && is_convex(ring)) {
                Vec2 p[4];
                for (size_t i = 0; i < 4; ++i) p[i] = to_metres(ring[i]);
                bool across = mass.gable_across;
                if (!no_ridge) {
                    Vec2 s = lerp(p[1], p[2], 0.5f), t = lerp(p[3], p[0], 0.5f);
                    across = std::fabs(dot(normalize_or(s - t, {1, 0}), mass.ridge)) < 0.7071f;
                }
                if (across) std::rotate(p, p + 1, p + 4);
                (mass.roof == RoofKind::half_hip ? add_half_hip_roof : add_quad_roof)(city, mass, p);
                return true;
            }
            if (mass.roof != RoofKind::gable) return add_inset_roof(city, mass);
            [[fallthrough]];
        case RoofKind::gambrel:
        case RoofKind::round:
        case RoofKind::skillion: {
            Vec2 ridge = no_ridge ? long_direction(ring) : mass.ridge;
            switch (mass.roof) {
                case RoofKind::gambrel:
                    return add_profile_roof(city, mass, k_gambrel, std::size(k_gambrel), ridge);
                case RoofKind::round:
                    return add_profile_roof(city, mass, k_round, std::size(k_round), ridge);
                case RoofKind::skillion:
                    return add_profile_roof(city, mass, k_skillion, std::size(k_skillion), ridge);
                default:
                    return add_profile_roof(city, mass, k_gable, std::size(k_gable), ridge);
            }
        }
        case RoofKind::pyramid:
            return add_central_roof(city, mass, k_pyramid, std::size(k_pyramid)) ||
                   add_inset_roof(city, mass);
        case RoofKind::dome:
            return add_central_roof(city, mass, k_dome, std::size(k_dome));
        case RoofKind::onion:
            return add_central_roof(city, mass, k_onion, std::size(k_onion));
        case RoofKind::mansard:
            return add_inset_roof(city, mass);
    }
    return false;
}

}  // namespace flaneur
