#include "sim/surface/compound.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace flaneur {

namespace {

constexpr uint32_t k_leaf = 4;    // triangles of a box that is not divided further
constexpr int k_deep = 64;        // boxes on the way down, at most
constexpr float k_flat = 1e-12f;  // twice the area of a triangle of no extent, squared

struct Ray {
    Vec3 origin, direction;
    std::optional<SurfaceHit> hit;
    float reach;

    void meet(float distance, Vec3 normal) {
        reach = distance;
        hit = SurfaceHit{distance, origin + direction * distance, normal};
    }
};

// Where a ray enters a ball, negative if it does not.
float entry(Vec3 from, Vec3 direction, float radius) {
    float b = dot(from, direction), c = dot(from, from) - radius * radius;
    float root = b * b - c;
    return c <= 0 || b >= 0 || root < 0 ? -1 : -b - std::sqrt(root);
}

void cast(Ray& ray, const Sphere& s) {
    Vec3 from = ray.origin - s.centre;
    float t = entry(from, ray.direction, s.radius);
    if (t < 0 || t > ray.reach) return;
    ray.meet(t, normalize_or(from + ray.direction * t, -ray.direction));
}

// The cylinder between the ends, then both ends; the first of them is the whole's, unless the origin is
// inside.
void cast(Ray& ray, const Capsule& c) {
    Vec3 axis = c.b - c.a;
    float size = dot(axis, axis);
    if (!(size > 1e-12f)) return cast(ray, Sphere{c.a, c.radius});
    Vec3 from = ray.origin - c.a;
    float along = clamp(dot(from, axis) / size, 0, 1);
    if (length_squared(from - axis * along) <= c.radius * c.radius) return;
    Vec3 side = from - axis * (dot(from, axis) / size);
    Vec3 way = ray.direction - axis * (dot(ray.direction, axis) / size);
    float speed = length(way);
    if (speed > 1e-6f) {
        float t = entry(side, way / speed, c.radius) / speed;
        float at = dot(from + ray.direction * t, axis) / size;
        if (t >= 0 && t <= ray.reach && at >= 0 && at <= 1) {
            ray.meet(t, normalize_or(side + way * t, -ray.direction));
            return;
        }
    }
    cast(ray, Sphere{c.a, c.radius});
    cast(ray, Sphere{c.b, c.radius});
}

// Moeller and Trumbore 1997, from the front only.
void cast(Ray& ray, Vec3 a, Vec3 b, Vec3 c) {
    Vec3 u = b - a, v = c - a, normal = cross(u, v);
    float facing = -dot(ray.direction, normal);
    if (!(facing > 0) || !(dot(normal, normal) > k_flat)) return;
    Vec3 from = ray.origin - a;
    float t = dot(from, normal) / facing;
    if (t < 0 || t > ray.reach) return;
    Vec3 turned = cross(from, ray.direction);
    float at_b = dot(v, turned) / facing, at_c = -dot(u, turned) / facing;
    if (at_b < 0 || at_c < 0 || at_b + at_c > 1) return;
    ray.meet(t, normalize_or(normal, -ray.direction));
}

bool meets(const Ray& ray, const CompoundBox& box) {
    float enter = 0, leave = ray.reach;
    auto clip = [&](float from, float way, float low, float high) {
        if (std::fabs(way) < 1e-9f) {
            if (from < low || from > high) leave = -1;
            return;
        }
        float s = (low - from) / way, t = (high - from) / way;
        enter = std::max(enter, std::min(s, t));
        leave = std::min(leave, std::max(s, t));
    };
    clip(ray.origin.x, ray.direction.x, box.low.x, box.high.x);
    clip(ray.origin.y, ray.direction.y, box.low.y, box.high.y);
    clip(ray.origin.z, ray.direction.z, box.low.z, box.high.z);
    return enter <= leave;
}

Vec3 middle_of(const Compound& c, uint32_t t) {
    return c.vertices[c.indices[3 * t]] + c.vertices[c.indices[3 * t + 1]] + c.vertices[c.indices[3 * t + 2]];
}

// Fills box `b` with triangles order[first .. first + count), halved along the longest side until few are
// left.
void divide(Compound& c, size_t b, uint32_t first, uint32_t count) {
    constexpr float k_margin = 1e-3f;  // for rounding, metres
    Vec3 low{1e30f, 1e30f, 1e30f}, high = -low;
    for (uint32_t i = first; i < first + count; ++i)
        for (size_t k = 0; k < 3; ++k) {
            Vec3 p = c.vertices[c.indices[3 * c.order[i] + k]];
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        }
    Vec3 margin{k_margin, k_margin, k_margin}, size = high - low;
    c.boxes[b] = {low - margin, high + margin, first, count};
    if (count <= k_leaf) return;
    auto place = [&](uint32_t t) {
        Vec3 m = middle_of(c, t);
        return size.x >= size.y && size.x >= size.z ? m.x : size.y >= size.z ? m.y : m.z;
    };
    auto begin = c.order.begin() + first;
    std::sort(begin, begin + count, [&](uint32_t s, uint32_t t) {
        float u = place(s), v = place(t);
        return u != v ? u < v : s < t;
    });
    auto below = static_cast<uint32_t>(c.boxes.size());
    c.boxes[b].first = below;
    c.boxes[b].count = 0;
    c.boxes.resize(below + 2);
    divide(c, below, first, count / 2);
    divide(c, below + 1, first + count / 2, count - count / 2);
}

}  // namespace

void index_compound(Compound& c) {
    c.order.resize(c.indices.size() / 3);
    std::iota(c.order.begin(), c.order.end(), 0u);
    c.boxes.clear();
    if (c.order.empty()) return;
    c.boxes.resize(1);
    divide(c, 0, 0, static_cast<uint32_t>(c.order.size()));
}

std::optional<SurfaceHit> cast_ray(const Compound& c, Vec3 origin, Vec3 direction, float reach) {
    Ray ray{origin, direction, {}, reach};
    for (const Sphere& s : c.spheres) cast(ray, s);
    for (const Capsule& s : c.capsules) cast(ray, s);
    uint32_t open[k_deep];
    int count = 0;
    if (!c.boxes.empty()) open[count++] = 0;
    while (count > 0) {
        const CompoundBox& box = c.boxes[open[--count]];
        if (!meets(ray, box)) continue;
        if (box.count == 0 && count + 2 <= k_deep) {
            open[count++] = box.first;
            open[count++] = box.first + 1;
        }
        for (uint32_t i = box.first; i < box.first + box.count; ++i) {
            const uint32_t* corner = &c.indices[3 * c.order[i]];
            cast(ray, c.vertices[corner[0]], c.vertices[corner[1]], c.vertices[corner[2]]);
        }
    }
    return ray.hit;
}

Rays rays_of(const Compound& compound) {
    return {&compound, [](const void* asked, Vec3 origin, Vec3 direction, float reach) {
                return cast_ray(*static_cast<const Compound*>(asked), origin, direction, reach);
            }};
}

}  // namespace flaneur
