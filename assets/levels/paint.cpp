#include "assets/levels/paint.h"

#include <algorithm>
#include <array>

#include "assets/levels/texel.h"

namespace flaneur {

namespace {

constexpr size_t k_samples = 6000;  // about, over the whole surface
constexpr int k_most_steps = 5;     // along an edge of a triangle

// What the surface shows somewhere.
struct PaintSample {
    Vec3 place, normal;
    std::array<float, 3> colour;  // times its weight
    float weight;                 // area
};

// A corner to be painted.
struct PaintCorner {
    Vec3 place, normal;  // a little within its triangle
    std::array<float, 3> sum{};
    float weight = 0;
    float nearest = 1e30f;  // sample of those that are nearer to other corners
    std::array<float, 3> colour{};
};

void add_samples(const Character& c, const std::array<uint32_t, 3>& vertices, int steps,
                 std::vector<PaintSample>& out) {
    const CharacterVertex &p = c.vertices[vertices[0]], &q = c.vertices[vertices[1]],
                          &r = c.vertices[vertices[2]];
    const Vec3 normal = cross(q.position - p.position, r.position - p.position);
    const float area = length(normal) / float(steps * steps);
    for (int i = 0; i < steps; ++i)
        for (int j = 0; i + j < steps; ++j) {
            const float a = (float(i) + 1 / 3.0f) / float(steps), b = (float(j) + 1 / 3.0f) / float(steps);
            const float d = 1 - a - b;
            PaintSample s{p.position * a + q.position * b + r.position * d, normal, {}, area + 1e-12f};
            for (size_t n = 0; n < 3; ++n) {
                auto channel = [&](const CharacterVertex& v) { return float(v.colour >> (8 * n) & 0xffu); };
                s.colour[n] = channel(p) * a + channel(q) * b + channel(r) * d;
            }
            if (is_textured(c, p)) {
                const uint8_t* rgba =
                    texel(c.textures[p.texture], p.u * a + q.u * b + r.u * d, p.v * a + q.v * b + r.v * d);
                for (size_t n = 0; n < 3; ++n) s.colour[n] *= float(rgba[n]) / 255;
            }
            for (float& channel : s.colour) channel *= s.weight;
            out.push_back(s);
        }
}

// Each sample gives to the corner that is nearest to it, and each corner that none gave to takes from the
// sample that is nearest.
void spread(const std::vector<PaintSample>& samples, std::vector<PaintCorner>& corners) {
    for (const PaintSample& s : samples) {
        PaintCorner* to = nullptr;
        float best = 1e29f;
        for (PaintCorner& corner : corners) {
            float d = length_squared(corner.place - s.place);
            if (dot(corner.normal, s.normal) < 0) d = 4 * d + 1e-3f;
            if (d < best) best = d, to = &corner;
            if (d < corner.nearest) {
                corner.nearest = d;
                for (size_t n = 0; n < 3; ++n) corner.colour[n] = s.colour[n] / s.weight;
            }
        }
        if (!to) continue;
        for (size_t n = 0; n < 3; ++n) to->sum[n] += s.colour[n];
        to->weight += s.weight;
    }
    for (PaintCorner& corner : corners)
        if (corner.weight > 0)
            for (size_t n = 0; n < 3; ++n) corner.colour[n] = corner.sum[n] / corner.weight;
}

}  // namespace

std::vector<uint32_t> painted(Character& c, const LevelSurface& s, const DrawnTriangles& triangles) {
    const std::vector<uint8_t> cut = find_cut(c.textures);
    auto sees_through = [&](uint32_t vertex) {
        const CharacterVertex& v = c.vertices[vertex];
        return is_textured(c, v) && cut[v.texture];
    };
    const DrawnTriangles fine = with_vertices(c, s, s.corners, 0);
    std::vector<uint32_t> out = triangles.vertices;
    auto chart_of = [&](const DrawnTriangles& of, size_t corner) { return s.chart[of.points[corner]]; };

    std::vector<std::vector<PaintSample>> samples(s.charts);
    int steps = 1;
    while (steps < k_most_steps &&
           size_t((steps + 1) * (steps + 1)) * fine.vertices.size() / 3 <= 2 * k_samples)
        ++steps;
    const size_t stride = std::max<size_t>(fine.vertices.size() / 3 / k_samples, 1);
    std::vector<size_t> seen(s.charts, 0);
    for (size_t t = 0; t + 2 < fine.vertices.size(); t += 3) {
        const uint32_t chart = chart_of(fine, t);
        if (seen[chart]++ % stride == 0)
            add_samples(c, {fine.vertices[t], fine.vertices[t + 1], fine.vertices[t + 2]}, steps,
                        samples[chart]);
    }
    std::vector<std::vector<PaintCorner>> wanted(s.charts);
    for (size_t t = 0; t + 2 < out.size(); t += 3) {
        std::array<Vec3, 3> p;
        for (size_t i = 0; i < 3; ++i) p[i] = c.vertices[out[t + i]].position;
        const Vec3 middle = (p[0] + p[1] + p[2]) / 3, normal = cross(p[1] - p[0], p[2] - p[0]);
        for (const Vec3& corner : p)
            wanted[chart_of(triangles, t)].push_back({lerp(corner, middle, 0.5f), normal});
    }
    for (uint32_t chart = 0; chart < s.charts; ++chart) spread(samples[chart], wanted[chart]);

    std::vector<size_t> next(s.charts, 0);
    for (size_t t = 0; t + 2 < out.size(); t += 3) {
        const uint32_t chart = chart_of(triangles, t);
        const bool keeps = sees_through(out[t]) || samples[chart].empty();
        for (size_t i = 0; i < 3; ++i) {
            const PaintCorner& paint = wanted[chart][next[chart]++];
            if (keeps) continue;
            CharacterVertex v = c.vertices[out[t + i]];
            v.texture = CharacterVertex::k_no_texture;
            v.u = v.v = 0;
            v.colour = 0xff000000u;
            for (size_t n = 0; n < 3; ++n)
                v.colour |= uint32_t(clamp(paint.colour[n] + 0.5f, 0, 255)) << (8 * n);
            out[t + i] = uint32_t(c.vertices.size());
            c.vertices.push_back(v);
        }
    }
    return out;
}

}  // namespace flaneur
