// Straight pieces of mapped lines, sorted by squares of the ground plane, for asking what runs nearby.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "sim/base/planar.h"

namespace flaneur {

struct LinePiece {
    Vec2 a, b;
    uint32_t owner = 0;  // whatever the caller calls it by
    float half = 0;      // width to either side, metres
};

// The place on a segment that is closest to `p`, 0 at its start and 1 at its end.
inline float closest_on(const LinePiece& s, Vec2 p) { return closest_on(s.a, s.b, p); }

// Where c-d crosses a-b, as a share of a-b; none where they do not or are parallel.
inline std::optional<float> crossing_on(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
    float s0 = cross(b - a, c - a), s1 = cross(b - a, d - a), s2 = cross(d - c, a - c),
          s3 = cross(d - c, b - c);
    if ((s0 > 0) == (s1 > 0) || (s2 > 0) == (s3 > 0)) return std::nullopt;
    return s2 / (s2 - s3);
}

struct SegmentIndex {
    static constexpr float k_square = 16;  // metres
    std::vector<LinePiece> segments;
    std::vector<std::pair<std::pair<int, int>, uint32_t>> by_square;

    static int square(float v) { return static_cast<int>(std::floor(v / k_square)); }

    void add(Vec2 a, Vec2 b, uint32_t owner, float half) {
        auto index = static_cast<uint32_t>(segments.size());
        segments.push_back({a, b, owner, half});
        if (a.x > b.x) std::swap(a, b);
        float slope = (b.z - a.z) / std::max(b.x - a.x, 1e-6f);
        for (int x = square(a.x); x <= square(b.x); ++x) {
            // Where the segment enters the column of squares and where it leaves it.
            float from = a.z + slope * (std::max(static_cast<float>(x) * k_square, a.x) - a.x);
            float to = a.z + slope * (std::min(static_cast<float>(x + 1) * k_square, b.x) - a.x);
            if (x == square(a.x)) from = a.z;
            if (x == square(b.x)) to = b.z;
            for (int z = square(std::min(from, to) - 0.1f); z <= square(std::max(from, to) + 0.1f); ++z) {
                by_square.push_back({{x, z}, index});
            }
        }
    }
    void add(const std::vector<Vec2>& line, uint32_t owner, float half) {
        for (size_t i = 0; i + 1 < line.size(); ++i) add(line[i], line[i + 1], owner, half);
    }
    // To be called once, before the first question.
    void sort() { std::sort(by_square.begin(), by_square.end()); }

    // Visits the segments of the squares within `radius`, some of them more than once, and some farther away.
    template <class Visit>
    void near(Vec2 p, float radius, Visit visit) const {
        for (int x = square(p.x - radius); x <= square(p.x + radius); ++x) {
            auto at = std::lower_bound(by_square.begin(), by_square.end(),
                                       std::make_pair(std::make_pair(x, square(p.z - radius)), 0u));
            auto last = std::make_pair(x, square(p.z + radius));
            for (; at != by_square.end() && at->first <= last; ++at) visit(segments[at->second]);
        }
    }

    // The segment closest to `p` within `radius`, the first added among equals; null where there is none.
    const LinePiece* nearest(Vec2 p, float radius) const {
        const LinePiece* best = nullptr;
        float least = radius * radius;
        near(p, radius, [&](const LinePiece& s) {
            float d = length_squared(lerp(s.a, s.b, closest_on(s, p)) - p);
            if (d > least || (best && d == least && &s >= best)) return;
            best = &s;
            least = d;
        });
        return best;
    }
};

}  // namespace flaneur
