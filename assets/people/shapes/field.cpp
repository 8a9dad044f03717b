#include "assets/people/shapes/field.h"

#include <algorithm>

namespace flaneur {

namespace {

constexpr int k_table_size = 96;
constexpr float k_far = 1;  // longer than any distance that matters

// Catmull-Rom over uneven knots, one channel.
float cubic(float v0, float v1, float v2, float v3, float t0, float t1, float t2, float t3, float t) {
    float h = t2 - t1, u = (t - t1) / h;
    float m1 = t2 > t0 ? (v2 - v0) / (t2 - t0) * h : 0, m2 = t3 > t1 ? (v3 - v1) / (t3 - t1) * h : 0;
    float u2 = u * u, u3 = u2 * u;
    return (2 * u3 - 3 * u2 + 1) * v1 + (u3 - 2 * u2 + u) * m1 + (3 * u2 - 2 * u3) * v2 + (u3 - u2) * m2;
}

BodyRing ring_at(std::span<const BodyRing> rings, float t) {
    if (rings.size() == 1) return rings[0];
    size_t i = 0;
    while (i + 2 < rings.size() && t > rings[i + 1].t) ++i;
    const BodyRing &b = rings[i], &c = rings[i + 1];
    const BodyRing &a = i > 0 ? rings[i - 1] : b, &d = i + 2 < rings.size() ? rings[i + 2] : c;
    auto channel = [&](float BodyRing::*m) { return cubic(a.*m, b.*m, c.*m, d.*m, a.t, b.t, c.t, d.t, t); };
    return {t,
            channel(&BodyRing::side),
            channel(&BodyRing::front),
            std::max(channel(&BodyRing::width), 1e-4f),
            std::max(channel(&BodyRing::ahead), 1e-4f),
            std::max(channel(&BodyRing::behind), 1e-4f),
            clamp(channel(&BodyRing::square), 0, 1)};
}

float smooth_min(float a, float b, float k) {
    if (k <= 0) return std::min(a, b);
    float h = std::max(k - (a > b ? a - b : b - a), 0.0f) / k;
    return std::min(a, b) - h * h * k * 0.25f;
}

// The ring at t, which lies between begin and end.
BodyRing table_ring(const Loft& loft, float t) {
    if (loft.table.size() == 1) return loft.table[0];
    float at = (t - loft.begin) / (loft.end - loft.begin) * float(k_table_size - 1);
    int i = std::min(int(at), k_table_size - 2);
    return mix_rings(loft.table[size_t(i)], loft.table[size_t(i + 1)], at - float(i));
}

float part_distance(const FieldPart& part, Vec3 p) {
    return part.is_plane ? dot(part.normal, p) - part.offset : distance(part.loft, p) - part.grow;
}

}  // namespace

BodyRing mix_rings(const BodyRing& a, const BodyRing& b, float t) {
    return {lerp(a.t, b.t, t),          lerp(a.side, b.side, t),   lerp(a.front, b.front, t),
            lerp(a.width, b.width, t),  lerp(a.ahead, b.ahead, t), lerp(a.behind, b.behind, t),
            lerp(a.square, b.square, t)};
}

Loft make_loft(Vec3 origin, Vec3 side, Vec3 axis, std::span<const BodyRing> rings, float cap_begin,
               float cap_end) {
    Loft loft;
    loft.origin = origin;
    loft.side = side;
    loft.axis = axis;
    loft.front = cross(side, axis);
    loft.begin = rings.front().t;
    loft.end = rings.back().t;
    loft.cap_begin = cap_begin;
    loft.cap_end = cap_end;
    int size = rings.size() == 1 ? 1 : k_table_size;
    float widest = 0;
    for (int i = 0; i < size; ++i) {
        float t = size == 1 ? loft.begin : lerp(loft.begin, loft.end, float(i) / float(size - 1));
        BodyRing ring = ring_at(rings, t);
        loft.table.push_back(ring);
        float reach = std::max({ring.width, ring.ahead, ring.behind});
        widest =
            std::max(widest, reach + std::max(ring.side, -ring.side) + std::max(ring.front, -ring.front));
    }
    loft.centre = origin + axis * ((loft.begin + loft.end) * 0.5f);
    float half = (loft.end - loft.begin) * 0.5f + std::max(cap_begin, cap_end);
    loft.radius = std::sqrt(half * half + 2 * widest * widest);
    return loft;
}

Loft trimmed(const Loft& loft, float begin, float end, float cap_begin, float cap_end) {
    std::vector<BodyRing> rings;
    for (int i = 0; i < k_table_size; ++i) {
        float t = lerp(begin, end, float(i) / float(k_table_size - 1));
        rings.push_back(table_ring(loft, clamp(t, loft.begin, loft.end)));
        rings.back().t = t;
    }
    return make_loft(loft.origin, loft.side, loft.axis, rings, cap_begin, cap_end);
}

Loft make_ellipsoid(Vec3 centre, Vec3 radii) { return make_ellipsoid(centre, radii, {1, 0, 0}, {0, 1, 0}); }

Loft make_ellipsoid(Vec3 centre, Vec3 radii, Vec3 side, Vec3 axis) {
    BodyRing ring{0, 0, 0, radii.x, radii.z, radii.z};
    return make_loft(centre, side, axis, std::span(&ring, 1), radii.y, radii.y);
}

Loft make_capsule(Vec3 a, Vec3 b, float radius_a, float radius_b) {
    Vec3 axis = normalize_or(b - a, {0, 1, 0});
    Vec3 side = normalize_or(cross(axis, axis.x * axis.x < 0.8f ? Vec3{1, 0, 0} : Vec3{0, 0, 1}), {0, 0, 1});
    BodyRing rings[] = {{0, 0, 0, radius_a, radius_a, radius_a},
                        {length(b - a), 0, 0, radius_b, radius_b, radius_b}};
    return make_loft(a, side, axis, rings, radius_a, radius_b);
}

float distance(const Loft& loft, Vec3 p) {
    Vec3 q = p - loft.origin;
    float t = dot(q, loft.axis), along = clamp(t, loft.begin, loft.end), beyond = t - along;
    BodyRing ring = table_ring(loft, along);
    float x = (dot(q, loft.side) - ring.side) / ring.width;
    float depth = dot(q, loft.front) - ring.front, reach = depth > 0 ? ring.ahead : ring.behind;
    float z = depth / reach;
    float cap = beyond < 0 ? loft.cap_begin : loft.cap_end, y = cap > 0 ? beyond / cap : 0;
    float round = std::sqrt(x * x + y * y + z * z);
    float slope = std::sqrt(x * x / (ring.width * ring.width) + (cap > 0 ? y * y / (cap * cap) : 0) +
                            z * z / (reach * reach));
    float d = -std::min(ring.width, std::min(ring.ahead, ring.behind));
    if (slope > 1e-6f) {
        float shape = round;
        if (ring.square > 0) {
            float xx = x * x, yy = y * y, zz = z * z;
            shape = lerp(round, std::sqrt(std::sqrt(xx * xx + yy * yy + zz * zz)), ring.square);
        }
        d = (shape - 1) * round / slope;
    }
    if (loft.cap_begin <= 0) d = std::max(d, loft.begin - t);
    if (loft.cap_end <= 0) d = std::max(d, t - loft.end);
    return d;
}

void parts_near(const Field& field, Vec3 p, float radius, std::vector<uint16_t>& near) {
    near.clear();
    p.x = p.x < 0 ? -p.x : p.x;
    for (size_t i = 0; i < field.parts.size(); ++i) {
        const FieldPart& part = field.parts[i];
        float reach = part.loft.radius + part.grow + part.round + radius;
        if (part.is_plane || length_squared(p - part.loft.centre) < reach * reach)
            near.push_back(uint16_t(i));
    }
}

void parts_touching(const Field& field, Vec3 p, float radius, std::vector<uint16_t>& near) {
    parts_near(field, p, radius, near);
    p.x = p.x < 0 ? -p.x : p.x;
    // Distances are approximate: a third of them is left as a margin.
    radius *= 1.33f;
    std::erase_if(near, [&](uint16_t i) {
        const FieldPart& part = field.parts[i];
        float d = part_distance(part, p);
        return part.blend == FieldBlend::keep ? d < -radius - part.round : d > radius + part.round;
    });
}

LayerDistances layer_distances(const Field& field, std::span<const uint16_t> near, Vec3 p) {
    p.x = p.x < 0 ? -p.x : p.x;
    LayerDistances d;
    d.fill(k_far);
    for (uint16_t i : near) {
        const FieldPart& part = field.parts[i];
        float& layer = d[part.layer];
        if (part.blend != FieldBlend::keep) {
            // Too far off to matter, whatever its shape is.
            float limit = part.loft.radius + part.grow + part.round;
            limit += std::max(part.blend == FieldBlend::add ? layer : -layer, 0.0f);
            if (length_squared(p - part.loft.centre) > limit * limit) continue;
        }
        float v = part_distance(part, p);
        if (part.blend == FieldBlend::add) layer = smooth_min(layer, v, part.round);
        if (part.blend == FieldBlend::carve) layer = -smooth_min(-layer, v, part.round);
        if (part.blend == FieldBlend::keep) layer = -smooth_min(-layer, -v, part.round);
    }
    return d;
}

float distance(const LayerDistances& layers) { return *std::min_element(layers.begin(), layers.end()); }

Vec3 gradient(const Field& field, std::span<const uint16_t> near, Vec3 p, int layer) {
    constexpr float h = 8e-4f;
    auto at = [&](Vec3 q) {
        LayerDistances d = layer_distances(field, near, q);
        return layer < 0 ? distance(d) : d[size_t(layer)];
    };
    Vec3 g{at(p + Vec3{h, 0, 0}) - at(p - Vec3{h, 0, 0}), at(p + Vec3{0, h, 0}) - at(p - Vec3{0, h, 0}),
           at(p + Vec3{0, 0, h}) - at(p - Vec3{0, 0, h})};
    return g / (2 * h);
}

}  // namespace flaneur
