#include "assets/plan/polygons.h"

#include <algorithm>
#include <cmath>

namespace flaneur {

using ClipperLib::Clipper;
using ClipperLib::pftNonZero;
using ClipperLib::PolyNode;
using ClipperLib::PolyTree;
using ClipperLib::ptClip;
using ClipperLib::ptSubject;

Point to_point(Vec2 m) {
    return {static_cast<int64_t>(std::floor(static_cast<double>(m.x) * 1000 + 0.5)),
            static_cast<int64_t>(std::floor(static_cast<double>(m.z) * 1000 + 0.5))};
}

Vec2 to_metres(Point p) {
    return {static_cast<float>(static_cast<double>(p.X) / 1000),
            static_cast<float>(static_cast<double>(p.Y) / 1000)};
}

int64_t twice_area(const Ring& ring) {
    uint64_t sum = 0;  // wraps where a ring runs round and round
    for (size_t i = 1; i + 1 < ring.size(); ++i) {
        Point a = ring[0], b = ring[i], c = ring[i + 1];
        sum += static_cast<uint64_t>((b.X - a.X) * (c.Y - a.Y) - (b.Y - a.Y) * (c.X - a.X));
    }
    return static_cast<int64_t>(sum);
}

double area(const Rings& rings) {
    double sum = 0;
    for (const Ring& r : rings) sum += static_cast<double>(twice_area(r));
    return sum * 0.5e-6;
}

Ring positive(Ring ring) {
    if (twice_area(ring) < 0) std::reverse(ring.begin(), ring.end());
    return ring;
}

Ring rectangle(Point low, Point high) { return {low, {high.X, low.Y}, high, {low.X, high.Y}}; }

bool contains(const Rings& rings, Point p) {
    bool inside = false;
    for (const Ring& r : rings) {
        int side = ClipperLib::PointInPolygon(p, r);
        if (side < 0) return true;
        inside ^= side == 1;
    }
    return inside;
}

// Twice the signed area of a, b, c.
static int64_t turn(Point a, Point b, Point c) {
    return (b.X - a.X) * (c.Y - a.Y) - (b.Y - a.Y) * (c.X - a.X);
}

bool is_convex(const Ring& ring) {
    size_t n = ring.size();
    for (size_t i = 0; i < n; ++i) {
        if (turn(ring[i], ring[(i + 1) % n], ring[(i + 2) % n]) < 0) return false;
    }
    return n >= 3;
}

Rings unite(const Rings& rings) {
    Rings result;
    Clipper clipper;
    clipper.AddPaths(rings, ptSubject, true);
    clipper.Execute(ClipperLib::ctUnion, result, pftNonZero);
    return result;
}

static Rings combine(const Rings& a, const Rings& b, ClipperLib::ClipType type) {
    Rings result;
    Clipper clipper;
    clipper.AddPaths(a, ptSubject, true);
    clipper.AddPaths(b, ptClip, true);
    clipper.Execute(type, result, pftNonZero);
    return result;
}

Rings intersect(const Rings& a, const Rings& b) { return combine(a, b, ClipperLib::ctIntersection); }
Rings subtract(const Rings& a, const Rings& b) { return combine(a, b, ClipperLib::ctDifference); }

std::vector<Region> regions_of(const Rings& rings) {
    PolyTree tree;
    Clipper clipper(ClipperLib::ioStrictlySimple);
    clipper.AddPaths(rings, ptSubject, true);
    clipper.Execute(ClipperLib::ctUnion, tree, pftNonZero);
    std::vector<Region> regions;
    for (const PolyNode* node = tree.GetFirst(); node; node = node->GetNext()) {
        if (node->IsHole() || node->Contour.size() < 3) continue;
        Region region{node->Contour, {}};
        for (const PolyNode* hole : node->Childs) {
            if (hole->Contour.size() >= 3) region.holes.push_back(hole->Contour);
        }
        regions.push_back(std::move(region));
    }
    return regions;
}

Rings rings_of(const Region& region) {
    Rings rings{region.outer};
    rings.insert(rings.end(), region.holes.begin(), region.holes.end());
    return rings;
}

static bool on_segment(Point a, Point b, Point p) {
    return turn(a, b, p) == 0 && std::min(a.X, b.X) <= p.X && p.X <= std::max(a.X, b.X) &&
           std::min(a.Y, b.Y) <= p.Y && p.Y <= std::max(a.Y, b.Y);
}

static int sign(int64_t v) { return v > 0 ? 1 : v < 0 ? -1 : 0; }

// Whether segments a-b and c-d meet anywhere but at corners that they share.
static bool cross_or_touch(Point a, Point b, Point c, Point d) {
    int s0 = sign(turn(a, b, c)), s1 = sign(turn(a, b, d)), s2 = sign(turn(c, d, a)),
        s3 = sign(turn(c, d, b));
    if (s0 * s1 < 0 && s2 * s3 < 0) return true;
    auto touches = [](Point p, Point q, Point r) { return !(r == p) && !(r == q) && on_segment(p, q, r); };
    return touches(a, b, c) || touches(a, b, d) || touches(c, d, a) || touches(c, d, b);
}

bool is_tangled(const Ring& ring, int most) {
    size_t n = ring.size();
    int crossings = 0;
    for (size_t i = 0; i < n; ++i) {
        Point a = ring[i], b = ring[(i + 1) % n];
        int64_t low = std::min(a.X, b.X), high = std::max(a.X, b.X);
        for (size_t j = i + 2; j < std::min(n, i + 4000); ++j) {
            Point c = ring[j], d = ring[(j + 1) % n];
            if (std::max(c.X, d.X) <= low || std::min(c.X, d.X) >= high) continue;
            bool cross = sign(turn(a, b, c)) * sign(turn(a, b, d)) < 0 &&
                         sign(turn(c, d, a)) * sign(turn(c, d, b)) < 0;
            if (cross && ++crossings > most) return true;
        }
    }
    return false;
}

std::optional<Ring> inset(const Ring& ring, int64_t distance) {
    size_t n = ring.size();
    if (n < 3 || n > 400) return std::nullopt;
    Ring moved(n);
    for (size_t i = 0; i < n; ++i) {
        Point before = ring[(i + n - 1) % n], here = ring[i], after = ring[(i + 1) % n];
        double ax = static_cast<double>(here.X - before.X), ay = static_cast<double>(here.Y - before.Y);
        double bx = static_cast<double>(after.X - here.X), by = static_cast<double>(after.Y - here.Y);
        double la = std::sqrt(ax * ax + ay * ay), lb = std::sqrt(bx * bx + by * by);
        if (la < 1 || lb < 1) return std::nullopt;
        double nx = -ay / la - by / lb, ny = ax / la + bx / lb;
        double square = (nx * nx + ny * ny) * 0.5;  // 1 + the cosine of the turn
        if (square < 0.12) return std::nullopt;
        double scale = static_cast<double>(distance) / square;
        moved[i] = {here.X + static_cast<int64_t>(std::floor(nx * scale + 0.5)),
                    here.Y + static_cast<int64_t>(std::floor(ny * scale + 0.5))};
    }
    for (size_t i = 0; i < n; ++i) {
        Point a = ring[i], b = ring[(i + 1) % n], c = moved[i], d = moved[(i + 1) % n];
        if ((b.X - a.X) * (d.X - c.X) + (b.Y - a.Y) * (d.Y - c.Y) <= 0) return std::nullopt;
        for (size_t j = i + 1; j < n; ++j) {
            if (cross_or_touch(c, d, moved[j], moved[(j + 1) % n])) return std::nullopt;
        }
    }
    return moved;
}

Rings inset_rings(const Rings& rings, float distance) {
    ClipperLib::ClipperOffset offset(3.0);
    offset.AddPaths(rings, ClipperLib::jtMiter, ClipperLib::etClosedPolygon);
    Rings result;
    offset.Execute(result, -static_cast<double>(distance) * 1000);
    return result;
}

std::optional<Vec2> middle_of(const Ring& ring) {
    int64_t twice = twice_area(ring);
    if (twice == 0) return std::nullopt;
    double x = 0, z = 0;
    Point o = ring[0];
    for (size_t i = 1; i + 1 < ring.size(); ++i) {
        Point a{ring[i].X - o.X, ring[i].Y - o.Y}, b{ring[i + 1].X - o.X, ring[i + 1].Y - o.Y};
        auto part = static_cast<double>(a.X * b.Y - a.Y * b.X) / static_cast<double>(twice);
        x += part * static_cast<double>(a.X + b.X) / 3;
        z += part * static_cast<double>(a.Y + b.Y) / 3;
    }
    return to_metres(o) + Vec2{static_cast<float>(x / 1000), static_cast<float>(z / 1000)};
}

Ring without_collinear(const Ring& ring, int64_t tolerance) {
    Ring kept = ring;
    for (bool changed = true; changed && kept.size() > 3;) {
        changed = false;
        for (size_t i = 0; i < kept.size() && kept.size() > 3; ++i) {
            Point a = kept[(i + kept.size() - 1) % kept.size()], b = kept[i], c = kept[(i + 1) % kept.size()];
            double dx = static_cast<double>(c.X - a.X), dy = static_cast<double>(c.Y - a.Y);
            double away = std::fabs(static_cast<double>(turn(a, b, c)));
            if (away > static_cast<double>(tolerance) * std::sqrt(dx * dx + dy * dy)) continue;
            kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(i));
            changed = true;
            --i;
        }
    }
    return kept;
}

// Points between unit vectors `from` and `to` (under half a turn apart) on the circle about `centre`.
static void add_arc(Ring& out, Vec2 centre, Vec2 from, Vec2 to, float radius) {
    if (dot(from, to) > 0.9f) return;
    Vec2 middle = normalize_or(from + to, from);
    add_arc(out, centre, from, middle, radius);
    out.push_back(to_point(centre + middle * radius));
    add_arc(out, centre, middle, to, radius);
}

static void add_sector(Rings& out, Vec2 centre, Vec2 from, Vec2 to, float radius) {
    Ring ring{to_point(centre), to_point(centre + from * radius)};
    add_arc(ring, centre, from, to, radius);
    ring.push_back(to_point(centre + to * radius));
    ring = positive(std::move(ring));
    if (twice_area(ring) > 0) out.push_back(std::move(ring));
}

void add_strip(Rings& out, const std::vector<Vec2>& line, float left, float right, bool round_start,
               bool round_end) {
    std::vector<Vec2> points;
    for (Vec2 p : line) {
        if (points.empty() || length(p - points.back()) > 0.01f) points.push_back(p);
    }
    Vec2 before{};
    for (size_t i = 0; i + 1 < points.size(); ++i) {
        Vec2 p = points[i], q = points[i + 1], along = normalize_or(q - p, {0, 1});
        Vec2 side{along.z, -along.x};
        Ring quad{to_point(p + side * left), to_point(q + side * left), to_point(q - side * right),
                  to_point(p - side * right)};
        quad = positive(std::move(quad));
        if (twice_area(quad) > 0) out.push_back(std::move(quad));
        if (i > 0) {
            Vec2 old_side{before.z, -before.x};
            bool to_left = dot(along, old_side) > 0;  // then the right side is the outer one
            Vec2 outer = to_left ? -side : side, old_outer = to_left ? -old_side : old_side;
            float reach = to_left ? right : left;
            if (dot(outer, old_outer) > 0) {
                add_sector(out, p, old_outer, outer, reach);
            } else {
                // Around a hairpin the two normals alone do not say which way round.
                Vec2 middle = normalize_or(old_outer + outer, before);
                add_sector(out, p, old_outer, middle, reach);
                add_sector(out, p, middle, outer, reach);
            }
        }
        if (round_start && i == 0) {
            add_sector(out, p, side, -along, left);
            add_sector(out, p, -along, -side, right);
        }
        if (round_end && i + 2 == points.size()) {
            add_sector(out, q, side, along, left);
            add_sector(out, q, along, -side, right);
        }
        before = along;
    }
}

}  // namespace flaneur
