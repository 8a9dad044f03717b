// Drunk Stride: never off the edge, never straight, speed constant.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/base/math.h"
#include "sim/ways/stride.h"

namespace flaneur {
namespace {

constexpr float k_dt = 1.0f / 60;

// A rectangle of any size and rotation, or the hull of places on an ellipse, anywhere within a kilometre.
std::vector<Vec2> random_platform(uint32_t n) {
    const RandomKey key{11, n, 0, Purpose::city};
    const float turn = random_between(key, 0, 6.28f, 0), wide = random_between(key, 1.2f, 60, 1),
                deep = random_between(key, 1.2f, 60, 2);
    const Vec2 middle{random_between(key, -1000, 1000, 3), random_between(key, -1000, 1000, 4)};
    const Vec2 ahead = heading_direction(turn), right{-ahead.z, ahead.x};
    std::vector<Vec2> corners;
    auto add = [&](float x, float z) { corners.push_back(middle + right * x + ahead * z); };
    if (n % 2 == 0) {
        add(wide, deep), add(-wide, deep), add(-wide, -deep), add(wide, -deep);
    } else {
        const auto count = 3 + static_cast<int>(random_unit(key, 5) * 13);
        for (int k = 0; k < count; ++k) {
            const float angle = 6.2831853f * (static_cast<float>(k) + 0.7f * random_unit(key, 6 + k)) /
                                static_cast<float>(count);
            const SinCos at = sin_cos(angle);
            add(wide * at.cosine, deep * at.sine);
        }
    }
    return corners;
}

// The same, smaller or larger about its middle, moved and turned a little.
std::vector<Vec2> changed(const std::vector<Vec2>& corners, RandomKey key) {
    Vec2 middle;
    for (const Vec2 c : corners) middle += c / static_cast<float>(corners.size());
    const float size = random_between(key, 0.7f, 1.4f, 0), turn = random_between(key, -0.3f, 0.3f, 1);
    const SinCos by = sin_cos(turn);
    const Vec2 moved = middle + Vec2{random_between(key, -1, 1, 2), random_between(key, -1, 1, 3)};
    std::vector<Vec2> out;
    for (const Vec2 c : corners) {
        const Vec2 from = (c - middle) * size;
        out.push_back(moved +
                      Vec2{from.x * by.cosine + from.z * by.sine, from.z * by.cosine - from.x * by.sine});
    }
    return out;
}

double apart(Vec2 a, Vec2 b) {
    return std::hypot(static_cast<double>(a.x) - static_cast<double>(b.x),
                      static_cast<double>(a.z) - static_cast<double>(b.z));
}

// Ten million steps on a thousand platforms, half of which change while one walks.
TEST(Stride, NeverLeavesThePlatformNeverGoesStraightAndKeepsItsSpeed) {
    constexpr uint32_t k_platforms = 1000, k_steps = 10000;
    uint64_t steps = 0, circles = 0, carried = 0, changes = 0, narrow = 0;
    for (uint32_t n = 0; n < k_platforms; ++n) {
        std::vector<Vec2> corners = random_platform(n);
        auto platform = make_platform(corners);
        ASSERT_TRUE(platform) << n << ": " << platform.error().message;
        const RandomKey key{5, n, 0, Purpose::destination};
        const Strider who{.speed = n % 3 == 0 ? 0.6f : 1, .radius = 0.2f + 0.1f * static_cast<float>(n % 2)};
        auto begun = begin_stride(*platform, who, corners[0], random_between(key, -3, 3, 9), key);
        if (!begun) {
            ++narrow;
            continue;
        }
        Stride s = *begun;
        float side = s.side;
        for (uint32_t k = 0; k < k_steps; ++k) {
            bool is_changed = false;
            if (n % 4 >= 2 && k % 997 == 996) {
                auto other = changed(corners, {5, n, k, Purpose::city});
                auto smaller = make_platform(other);
                ASSERT_TRUE(smaller);
                Stride trial = s;
                if (advance_stride(*smaller, who, trial, 0, key)) {
                    corners = other, platform = smaller, is_changed = true, ++changes;
                }
            }
            const Vec2 before = place_of(s);
            const float heading = s.heading;
            const uint32_t had = s.circles;
            ASSERT_TRUE(advance_stride(*platform, who, s, k_dt, key)) << n << " at " << k;
            ++steps;
            const Vec2 after = place_of(s);
            // All of the body is on it.
            for (int e = 0; e < platform->count; ++e) {
                const auto& [inward, offset] = platform->edges[e];
                ASSERT_GE(dot(after, inward) - offset, who.radius - 5e-4f)
                    << n << " at " << k << " edge " << e;
            }
            // It turns in each step, no quicker than it can, and to its side.
            const float turned = wrap_angle(s.heading - heading) * -s.side;
            ASSERT_GT(turned, 0) << n << " at " << k;
            ASSERT_LE(turned, who.turns * k_dt * 1.001f) << n << " at " << k;
            // A step is the chord of an arc.
            const double chord =
                2 * static_cast<double>(s.radius) * std::sin(static_cast<double>(turned) / 2);
            const double arc = static_cast<double>(who.speed * k_dt);
            if (is_changed && std::fabs(apart(before, after) - chord) > 4e-4) {
                ++carried;
            } else {
                ASSERT_NEAR(apart(before, after), chord, 4e-4) << n << " at " << k;
                ASSERT_NEAR(static_cast<double>(turned * s.radius), arc, 0.02 * arc) << n << " at " << k;
            }
            if (s.circles != had) {
                ASSERT_TRUE(is_changed || s.side == -side) << "circles take turns";
                side = s.side;
                ++circles;
            }
        }
    }
    std::printf(
        "%llu steps, %llu circles, %llu changes of the platform, carried %llu times; %llu too narrow\n",
        static_cast<unsigned long long>(steps), static_cast<unsigned long long>(circles),
        static_cast<unsigned long long>(changes), static_cast<unsigned long long>(carried),
        static_cast<unsigned long long>(narrow));
    EXPECT_GE(steps, 9'900'000u);
    EXPECT_GT(circles, 20'000u);
    EXPECT_GT(changes, 3000u);
    EXPECT_LT(narrow, 10u);
}

// The document's own case: a rectangle along the axes, the least of four quotients.
TEST(Stride, LargestCirclesTouchAnEdge) {
    for (uint32_t n = 0; n < 500; ++n) {
        const RandomKey key{3, n, 0, Purpose::city};
        const Vec2 low{random_between(key, -9, -1, 0), random_between(key, -9, -1, 1)},
            high{random_between(key, 1, 9, 2), random_between(key, 1, 9, 3)};
        const Vec2 corners[] = {low, {low.x, high.z}, high, {high.x, low.z}};
        const auto platform = make_platform(corners);
        ASSERT_TRUE(platform);
        const Vec2 p{random_between(key, -0.9f, 0.9f, 4), random_between(key, -0.9f, 0.9f, 5)};
        const float heading = random_between(key, -3, 3, 6);
        const Vec2 ahead = heading_direction(heading), d{-ahead.z, ahead.x};
        for (const float s : {1.0f, -1.0f}) {
            const float of_four = std::min({(p.x - low.x) / (1 - d.x * s), (high.x - p.x) / (1 + d.x * s),
                                            (p.z - low.z) / (1 - d.z * s), (high.z - p.z) / (1 + d.z * s)});
            EXPECT_NEAR(largest_circle(*platform, p, heading, s, 0), of_four, 1e-3f * of_four);
            const float r = largest_circle(*platform, p, heading, s, 0.1f);
            EXPECT_NEAR(room_at(*platform, p + d * (s * r)), r + 0.1f, 1e-3f)
                << "with the body, it touches one";
        }
    }
}

TEST(Stride, PlatformsAreConvexAndGoRoundOnce) {
    const Vec2 dart[] = {{0, 0}, {4, 0}, {1, 1}, {0, 4}};
    EXPECT_FALSE(make_platform(dart));
    const Vec2 star[] = {{0, 3}, {1.8f, -2.4f}, {-2.9f, 0.9f}, {2.9f, 0.9f}, {-1.8f, -2.4f}};
    EXPECT_FALSE(make_platform(star));
    const Vec2 line[] = {{0, 0}, {1, 0}, {2, 0}};
    EXPECT_FALSE(make_platform(line));
    const Vec2 nowhere[] = {{0, 0}, {1, std::nanf("")}, {2, 4}};
    EXPECT_FALSE(make_platform(nowhere));
    const Vec2 small[] = {{0, 0}, {0.4f, 0}, {0.4f, 0.4f}, {0, 0.4f}};
    ASSERT_TRUE(make_platform(small));
    EXPECT_FALSE(begin_stride(*make_platform(small), {}, {0.2f, 0.2f}, 0, {})) << "nobody can turn on it";
}

}  // namespace
}  // namespace flaneur
