#include "sim/surface/gravity.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "sim/base/math.h"

namespace flaneur {

namespace {

Vec3 pull_of(const PullPoint& p, Vec3 place) {
    const Vec3 way = p.place - place;
    const float far = std::max(length(way), k_deepest);
    return way * (p.strength / (far * far * far));
}

// Where a line along x through (y, z) is in what the triangles enclose: calls in(from, to).
template <class In>
void for_spans(const Compound& c, float y, float z, std::vector<float>& crossings, const In& in) {
    crossings.clear();
    for (size_t t = 0; t + 2 < c.indices.size(); t += 3) {
        const Vec3 p[3] = {c.vertices[c.indices[t]], c.vertices[c.indices[t + 1]],
                           c.vertices[c.indices[t + 2]]};
        auto side = [&](Vec3 a, Vec3 b) { return (b.y - a.y) * (z - a.z) - (b.z - a.z) * (y - a.y); };
        const float s[3] = {side(p[1], p[2]), side(p[2], p[0]), side(p[0], p[1])};
        const bool is_left = s[0] > 0 && s[1] > 0 && s[2] > 0, is_right = s[0] < 0 && s[1] < 0 && s[2] < 0;
        if (!is_left && !is_right) continue;
        crossings.push_back((p[0].x * s[0] + p[1].x * s[1] + p[2].x * s[2]) / (s[0] + s[1] + s[2]));
    }
    std::sort(crossings.begin(), crossings.end());
    for (size_t i = 0; i + 1 < crossings.size(); i += 2) in(crossings[i], crossings[i + 1]);
}

void add_grid(const Compound& c, std::vector<Vec3>& points) {
    constexpr int k_cells = 8;  // along each axis
    Vec3 low = c.vertices[0], high = low, sum;
    for (const Vec3 v : c.vertices) {
        low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
        high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
        sum += v / static_cast<float>(c.vertices.size());
    }
    const size_t before = points.size();
    const Vec3 cell = (high - low) / static_cast<float>(k_cells);
    std::vector<float> crossings;
    for (int j = 0; j < k_cells; ++j)
        for (int k = 0; k < k_cells; ++k) {
            // Off the middle a little: vertices often lie there.
            const float y = low.y + (static_cast<float>(j) + 0.4871f) * cell.y;
            const float z = low.z + (static_cast<float>(k) + 0.5137f) * cell.z;
            for_spans(c, y, z, crossings, [&](float from, float to) {
                for (int i = 0; i < k_cells; ++i) {
                    const float x = low.x + (static_cast<float>(i) + 0.5f) * cell.x;
                    if (x > from && x < to) points.push_back({x, y, z});
                }
            });
        }
    if (points.size() == before) points.push_back(sum);
}

}  // namespace

void add_body(Gravity& g, std::span<const Vec3> points, std::span<const Vec3> surface, float pull) {
    assert(!points.empty() && !surface.empty());
    const size_t first = g.points.size();
    for (const Vec3 p : points) g.points.push_back({p, 1, g.bodies});
    ++g.bodies;
    float mean = 0;
    for (const Vec3 place : surface) {
        Vec3 all;
        for (size_t i = first; i < g.points.size(); ++i) all += pull_of(g.points[i], place);
        mean += length(all) / static_cast<float>(surface.size());
    }
    for (size_t i = first; i < g.points.size(); ++i) g.points[i].strength = pull / std::max(mean, 1e-9f);
}

Gravity gravity_of(const Compound& c, float pull) {
    constexpr int k_row = 5;
    std::vector<Vec3> points, surface;
    auto ball = [&](Vec3 middle, float radius) {
        for (const float side : {-radius, radius})
            for (const Vec3 way : {Vec3{side, 0, 0}, Vec3{0, side, 0}, Vec3{0, 0, side}})
                surface.push_back(middle + way);
    };
    for (const Sphere& s : c.spheres) points.push_back(s.centre), ball(s.centre, s.radius);
    for (const Capsule& s : c.capsules)
        for (int i = 0; i < k_row; ++i) {
            points.push_back(lerp(s.a, s.b, static_cast<float>(i) / (k_row - 1)));
            ball(points.back(), s.radius);
        }
    if (!c.indices.empty()) {
        add_grid(c, points);
        constexpr size_t k_sample = 500;
        for (size_t v = 0; v < c.vertices.size(); v += c.vertices.size() / k_sample + 1)
            surface.push_back(c.vertices[v]);
    }
    Gravity g;
    if (!points.empty()) add_body(g, points, surface, pull);
    return g;
}

Pull pull_at(const Gravity& g, Vec3 place) {
    Pull pull;
    float most = -1;
    for (size_t i = 0; i < g.points.size();) {
        const uint32_t body = g.points[i].body;
        Vec3 of_body;
        for (; i < g.points.size() && g.points[i].body == body; ++i) of_body += pull_of(g.points[i], place);
        pull.all += of_body;
        const float size = length_squared(of_body);
        if (size > most) most = size, pull.strongest = of_body, pull.body = body;
    }
    return pull;
}

Vec3 pull_of(const Gravity& g, uint32_t body, Vec3 place) {
    Vec3 all;
    for (const PullPoint& p : g.points)
        if (p.body == body) all += pull_of(p, place);
    return all;
}

}  // namespace flaneur
