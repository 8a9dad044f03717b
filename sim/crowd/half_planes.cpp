#include "sim/crowd/half_planes.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace flaneur {

static constexpr float k_parallel = 1e-5f;

// The best point of plane `i`'s edge inside the planes before it and the disc: nearest to `wish`, or, if
// `far`, farthest along `wish`. False if there is none.
static bool best_on_edge(const HalfPlane* planes, int i, float most_speed, Vec2 wish, bool far, Vec2* v) {
    Vec2 n = planes[i].normal, foot = n * planes[i].offset, along{-n.z, n.x};
    float room = most_speed * most_speed - planes[i].offset * planes[i].offset;
    if (room < 0) return false;
    float high = std::sqrt(room), low = -high;
    for (int j = 0; j < i; ++j) {
        // Along the edge plane j reads slope * t >= need.
        float slope = dot(along, planes[j].normal), need = planes[j].offset - dot(foot, planes[j].normal);
        if (std::fabs(slope) < k_parallel) {
            if (need > 1e-6f) return false;
            continue;
        }
        if (slope > 0) {
            low = std::max(low, need / slope);
        } else {
            high = std::min(high, need / slope);
        }
        if (low > high) return false;
    }
    float t = far ? (dot(along, wish) > 0 ? high : low) : clamp(dot(along, wish), low, high);
    *v = foot + along * t;
    return true;
}

// Adds planes one by one; returns the first that cannot be kept, or count.
static int solve(const HalfPlane* planes, int count, float most_speed, Vec2 wish, bool far, Vec2* v) {
    if (far) {
        *v = wish * most_speed;  // a unit vector
    } else {
        float l = length(wish);
        *v = l > most_speed ? wish * (most_speed / l) : wish;
    }
    for (int i = 0; i < count; ++i) {
        if (dot(*v, planes[i].normal) >= planes[i].offset) continue;
        Vec2 before = *v;
        if (!best_on_edge(planes, i, most_speed, wish, far, v)) {
            *v = before;
            return i;
        }
    }
    return count;
}

Vec2 best_velocity(const HalfPlane* planes, int count, int firm, float most_speed, Vec2 wish) {
    assert(count <= k_most_planes);
    Vec2 v;
    int failed = solve(planes, count, most_speed, wish, false, &v);
    if (failed == count) return v;
    firm = std::min(firm, failed);
    // Raise the level of trespass: on the edge where plane i is trespassed on the most, no other plane may be
    // more.
    float level = -1e-6f;
    for (int i = failed; i < count; ++i) {
        float trespass = planes[i].offset - dot(v, planes[i].normal);
        if (trespass <= level) continue;
        HalfPlane equal[k_most_planes];
        std::copy_n(planes, firm, equal);
        int n = firm;
        for (int j = firm; j < i; ++j) {
            Vec2 normal = planes[j].normal - planes[i].normal;
            float l = length(normal);
            if (l < k_parallel)
                continue;  // the same direction: the dearer one is trespassed on more, and is seen
            equal[n++] = {normal / l, (planes[j].offset - planes[i].offset) / l};
        }
        Vec2 before = v;
        if (solve(equal, n, most_speed, planes[i].normal, true, &v) < n) v = before;
        level = planes[i].offset - dot(v, planes[i].normal);
    }
    return v;
}

}  // namespace flaneur
