// Drunk Stride: never off the edge, never straight.
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

// Ten million steps on a thousand platforms, half of which change while one walks: of one who goes just as
// it is led.
TEST(Stride, NeverLeavesThePlatformNeverGoesStraightAndTakesTurns) {
    constexpr uint32_t k_platforms = 1000, k_steps = 10000;
    uint64_t steps = 0, halves = 0, turning = 0, circles = 0, left = 0, changes = 0, narrow = 0;
    for (uint32_t n = 0; n < k_platforms; ++n) {
        std::vector<Vec2> corners = random_platform(n);
        auto platform = make_platform(corners);
        ASSERT_TRUE(platform) << n << ": " << platform.error().message;
        const RandomKey key{5, n, 0, Purpose::destination};
        const Strider who{.speed = n % 3 == 0 ? 0.6f : 1, .radius = 0.2f + 0.1f * static_cast<float>(n % 2)};
        const float room = least_circle(who) + who.radius;
        const auto first = nearest_with_room(*platform, corners[0], room);
        if (!first) {
            ++narrow;
            continue;
        }
        Stride s;
        Vec2 place = *first;
        float heading = random_between(key, -3, 3, 9);
        bool is_beside = false, was_along = false;
        uint32_t since = 0;
        float turn = 0;
        for (uint32_t k = 0; k < k_steps; ++k, ++steps) {
            bool is_changed = false;
            if (n % 4 >= 2 && k % 997 == 996) {
                auto other = changed(corners, {5, n, k, Purpose::city});
                auto smaller = make_platform(other);
                ASSERT_TRUE(smaller);
                if (nearest_with_room(*smaller, place, room))
                    corners = other, platform = smaller, is_changed = true, ++changes;
            }
            const uint32_t had = s.circles;
            const float side = s.side;
            const Vec2 way = stride_on(*platform, who, s, place, heading, k_dt, key);
            ASSERT_NEAR(length(way), 1, 1e-4f) << n << " at " << k;
            place += way * (who.speed * k_dt);
            const float turned = wrap_angle(heading_of(way) - heading) * -s.side;
            heading = heading_of(way);
            // All of the body is on it, but where it has been taken from under its feet.
            if (is_changed && room_at(*platform, place) < who.radius) is_beside = true, ++left;
            if (room_at(*platform, place) >= who.radius) is_beside = false;
            if (!is_beside) {
                ASSERT_GE(room_at(*platform, place), who.radius - 1e-3f) << n << " at " << k;
            }
            if (s.circles != had) {
                ASSERT_TRUE(is_changed || had == 0 || !was_along || s.side == -side) << "circles take turns";
                ++circles;
            }
            // In each half second on one circle it turns to that one's side.
            const bool is_along_one = !is_beside && is_along(s, place) && is_on(*platform, who, s);
            if (!is_along_one || s.circles != had) since = 0, turn = 0;
            ++since, turn += turned;
            if (since == 30) {
                ++halves, turning += turn > 0;
                since = 0, turn = 0;
            }
            was_along = is_along_one;
        }
    }
    std::printf(
        "%llu steps, turning in %llu of %llu half seconds, %llu circles, %llu changes of the platform, "
        "beside it after %llu; %llu "
        "too narrow\n",
        static_cast<unsigned long long>(steps), static_cast<unsigned long long>(turning),
        static_cast<unsigned long long>(halves), static_cast<unsigned long long>(circles),
        static_cast<unsigned long long>(changes), static_cast<unsigned long long>(left),
        static_cast<unsigned long long>(narrow));
    EXPECT_GE(steps, 9'900'000u);
    EXPECT_GT(halves * 30, steps / 100 * 85);
    EXPECT_GT(turning, halves / 1000 * 999);
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

// As far as places themselves are told apart, at sharp corners too.
TEST(Stride, TheNearestPlaceWithRoomIsExactAKilometreAway) {
    for (uint32_t n = 0; n < 300; ++n) {
        const RandomKey key{8, n, 0, Purpose::city};
        // On whole metres, so that both are the same platform.
        const float wide = 1 + static_cast<float>(n % 3), deep = 10 + static_cast<float>(n % 17);
        const Vec2 from{2 + wide, static_cast<float>(n % 20) - 10}, far{1024, -2048};
        const Vec2 here[] = {{0, 0}, {wide, 0}, {wide / 2, deep}};
        Vec2 there[3];
        for (int k = 0; k < 3; ++k) there[k] = here[k] + far;
        const float room = random_between(key, 0.1f, 0.3f);
        const auto near_by = nearest_with_room(*make_platform(here), from, room),
                   away = nearest_with_room(*make_platform(there), from + far, room);
        ASSERT_TRUE(near_by) << n;
        ASSERT_TRUE(away) << n;
        EXPECT_LT(length(*away - far - *near_by), 3e-3f) << n << " " << deep;
        EXPECT_GT(room_at(*make_platform(there), *away), room - 5e-4f) << n;
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
    // A corner midway on an edge is none, also with the rounding of written numbers; one given twice is
    // named.
    const Vec2 midway[] = {{0, 0}, {1, 0.1f}, {3, 0.3f}, {6, 0.6f}, {6, 6}, {0, 6}, {0, 3}};
    const auto square = make_platform(midway);
    ASSERT_TRUE(square) << square.error().message;
    EXPECT_EQ(square->count, 4);
    const Vec2 twice[] = {{0, 0}, {6, 0}, {6, 0}, {6, 6}, {0, 6}},
               closed[] = {{0, 0}, {6, 0}, {6, 6}, {0, 0}};
    EXPECT_NE(make_platform(twice).error().message.find("6,0 twice"), std::string::npos);
    EXPECT_NE(make_platform(closed).error().message.find("0,0 twice"), std::string::npos);
    const Vec2 spike[] = {{0, 0}, {9, 0}, {6, 0}, {6, 6}, {0, 6}};
    EXPECT_FALSE(make_platform(spike));
    EXPECT_NE(make_platform(dart).error().message.find("at 1,1"), std::string::npos);
    const Vec2 small[] = {{0, 0}, {0.4f, 0}, {0.4f, 0.4f}, {0, 0.4f}};
    ASSERT_TRUE(make_platform(small));
    Stride s;
    EXPECT_EQ(stride_on(*make_platform(small), {}, s, {0.2f, 0.2f}, 0, 0, {}), Vec2{})
        << "nobody can turn on it";
}

}  // namespace
}  // namespace flaneur
