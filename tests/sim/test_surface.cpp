// Walking with any up: rays against compounds, and walkers that go all round them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/base/hash.h"
#include "sim/base/math.h"
#include "sim/base/parallel_for.h"
#include "sim/base/rng.h"
#include "sim/surface/surface_walk.h"

namespace flaneur {
namespace {

constexpr float k_dt = 1.0f / 60;

// A ball of triangles: an octahedron divided `times` times.
Compound ball(Vec3 centre, float radius, int times) {
    Compound c;
    std::vector<Vec3> v = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    std::vector<uint32_t> t = {4, 0, 2, 0, 5, 2, 5, 1, 2, 1, 4, 2, 0, 4, 3, 5, 0, 3, 1, 5, 3, 4, 1, 3};
    for (int n = 0; n < times; ++n) {
        std::vector<uint32_t> finer;
        for (size_t i = 0; i < t.size(); i += 3) {
            uint32_t m[3];
            for (size_t k = 0; k < 3; ++k) {
                m[k] = static_cast<uint32_t>(v.size());
                v.push_back(normalize_or(v[t[i + k]] + v[t[i + (k + 1) % 3]], {0, 1, 0}));
            }
            for (uint32_t f :
                 {t[i], m[0], m[2], m[0], t[i + 1], m[1], m[2], m[1], t[i + 2], m[0], m[1], m[2]})
                finer.push_back(f);
        }
        t = finer;
    }
    for (Vec3 p : v) c.vertices.push_back(centre + p * radius);
    c.indices = t;
    index_compound(c);
    return c;
}

// How far a point lies outside all solids but triangles, metres.
float outside(const Compound& c, Vec3 p) {
    float least = 1e30f;
    for (const Sphere& s : c.spheres) least = std::min(least, length(p - s.centre) - s.radius);
    for (const Capsule& s : c.capsules) {
        Vec3 axis = s.b - s.a;
        float t = clamp(dot(p - s.a, axis) / dot(axis, axis), 0, 1);
        least = std::min(least, length(p - s.a - axis * t) - s.radius);
    }
    return least;
}

TEST(Surface, RaysMeetWhatIsThere) {
    Compound c;
    c.spheres.push_back({{0, 0, 0}, 2});
    c.capsules.push_back({{10, -3, 0}, {10, 3, 0}, 1});
    auto down = cast_ray(c, {0, 5, 0}, {0, -1, 0}, 10);
    ASSERT_TRUE(down);
    EXPECT_NEAR(down->distance, 3, 1e-5f);
    EXPECT_NEAR(down->normal.y, 1, 1e-5f);
    EXPECT_FALSE(cast_ray(c, {0, 5, 0}, {0, -1, 0}, 2.9f));
    EXPECT_FALSE(cast_ray(c, {0, 0, 0}, {0, -1, 0}, 10)) << "from inside";
    auto side = cast_ray(c, {5, 2, 0}, {1, 0, 0}, 10), cap = cast_ray(c, {10, 9, 0}, {0, -1, 0}, 10);
    ASSERT_TRUE(side && cap);
    EXPECT_NEAR(side->point.x, 9, 1e-5f);
    EXPECT_NEAR(cap->point.y, 4, 1e-5f);
    // Random rays at the triangles of a fine ball meet them where they meet the ball, and from inside
    // nothing.
    Compound triangles = ball({1, 2, 3}, 4, 5);
    for (uint32_t i = 0; i < 500; ++i) {
        RandomKey key{1, i, 0, Purpose::spawn};
        Vec3 way = normalize_or({random_normal(key, 0), random_normal(key, 1), random_normal(key, 2)}, {});
        auto hit = cast_ray(triangles, Vec3{1, 2, 3} + way * 20, -way, 30);
        ASSERT_TRUE(hit);
        EXPECT_NEAR(hit->distance, 16, 0.02f);
        EXPECT_GT(dot(hit->normal, way), 0.99f);
        EXPECT_FALSE(cast_ray(triangles, {1, 2, 3}, way, 30));
    }
}

struct Tour {
    float farthest = 0, deepest = 0;      // metres off the surface, outwards and inwards
    float longest = 0, shortest = 1e30f;  // way in a tick, metres
    float sharpest = 0;                   // turn of an up in a tick, radians
    std::vector<Vec3> been;               // of the first walker
    uint64_t hash = 0;
    SurfaceWalkers walkers;
};

template <class Off>
Tour tour(const Compound& c, SurfaceWalkers walkers, int ticks, int threads, Off off) {
    Tour out;
    out.walkers = std::move(walkers);
    SurfaceWalkers& w = out.walkers;
    WorkersPtr workers = make_workers(threads);
    for (int t = 0; t < ticks; ++t) {
        std::vector<Vec3> up = w.up;
        look_round(w);
        parallel_for(*workers, w.position.size(), 3, [&](size_t begin, size_t end, int) {
            walk_on_surface(c, w, begin, end, 5, static_cast<uint32_t>(t), k_dt);
        });
        for (size_t i = 0; i < w.position.size(); ++i) {
            float o = off(w.position[i]);
            out.farthest = std::max(out.farthest, o);
            out.deepest = std::max(out.deepest, -o);
            out.longest = std::max(out.longest, w.moved[i]);
            out.shortest = std::min(out.shortest, w.moved[i]);
            out.sharpest = std::max(out.sharpest, arccos(dot(up[i], w.up[i])));
            EXPECT_NEAR(length(w.up[i]), 1, 1e-4f);
            EXPECT_NEAR(length(w.ahead[i]), 1, 1e-4f);
            EXPECT_NEAR(dot(w.up[i], w.ahead[i]), 0, 1e-4f);
        }
        out.been.push_back(w.position[0]);
        out.hash = hash_bytes(out.hash, w.position.data(), w.position.size() * sizeof(Vec3));
        out.hash = hash_bytes(out.hash, w.ahead.data(), w.ahead.size() * sizeof(Vec3));
    }
    return out;
}

// One walker at `from`, looking along `ahead`.
SurfaceWalkers one(Vec3 from, Vec3 up, Vec3 ahead) {
    SurfaceWalkers w;
    w.position = {from};
    w.up = {up};
    w.ahead = {ahead};
    w.speed = {1.3f};
    w.pace = w.turn_rate = w.moved = {0};
    w.radius = {0.25f};
    w.widest = 0.25f;
    w.probes.resize(1);
    w.leaps.resize(1);
    w.middle = {0.9f};
    w.leaps_at_will = {0};
    w.stands = {0};
    w.wish.resize(1);
    return w;
}

// Whether it has been near both ends along each axis.
void expect_all_round(const std::vector<Vec3>& been, Vec3 centre, Vec3 half) {
    Vec3 low{1e30f, 1e30f, 1e30f}, high = -low;
    for (Vec3 p : been) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    EXPECT_LT(low.y, centre.y - 0.9f * half.y);
    EXPECT_GT(high.y, centre.y + 0.9f * half.y);
    EXPECT_LT(low.z, centre.z - 0.9f * half.z);
    EXPECT_GT(high.z, centre.z + 0.9f * half.z);
}

constexpr float k_off = 0.003f;  // metres

TEST(Surface, GoesAllRoundASphere) {
    Compound c;
    c.spheres.push_back({{0, 0, 0}, 5});
    Tour t = tour(c, one({0, 5, 0}, {0, 1, 0}, {0, 0, 1}), 2400, 1, [&](Vec3 p) { return outside(c, p); });
    EXPECT_LT(t.farthest, k_off);
    EXPECT_LT(t.deepest, k_off);
    expect_all_round(t.been, {}, {0, 5, 5});
}

TEST(Surface, GoesAllRoundACapsule) {
    Compound c;
    c.capsules.push_back({{0, 0, -6}, {0, 0, 6}, 2.5f});
    Tour t = tour(c, one({0, 2.5f, 0}, {0, 1, 0}, {0, 0, 1}), 3600, 1, [&](Vec3 p) { return outside(c, p); });
    EXPECT_LT(t.farthest, k_off);
    EXPECT_LT(t.deepest, k_off);
    expect_all_round(t.been, {}, {0, 2.5f, 8.5f});
}

TEST(Surface, ClimbsOutOfConcaveJoints) {
    for (float apart : {5.0f, 7.0f, 8.0f}) {
        Compound c;
        c.spheres = {{{0, 0, 0}, 5}, {{0, 0, apart}, 5}};
        Tour t =
            tour(c, one({0, 5, 0}, {0, 1, 0}, {0, 0, 1}), 1800, 1, [&](Vec3 p) { return outside(c, p); });
        EXPECT_LT(t.farthest, k_off) << apart;
        EXPECT_LT(t.deepest, k_off) << apart;
        EXPECT_LT(t.sharpest, 3.6f * k_dt) << apart;
        EXPECT_LT(t.longest, 0.045f) << apart;
        auto far = std::max_element(t.been.begin(), t.been.end(), [](Vec3 a, Vec3 b) { return a.z < b.z; });
        EXPECT_GT(far->z, apart + 4) << apart << ": it did not get over the joint";
    }
}

TEST(Surface, WalksAlongTriangles) {
    Compound c = ball({0, 0, 0}, 6, 3);
    Tour t = tour(c, one({0, 6, 0}, {0, 1, 0}, {0, 0, 1}), 4800, 1, [&](Vec3 p) {
        auto hit = surface_below(c, p * 1.1f, normalize_or(p, {}), 3);
        return hit ? length(p) - length(hit->point) : 1.0f;
    });
    EXPECT_LT(t.farthest, k_off);
    EXPECT_LT(t.deepest, k_off);
    expect_all_round(t.been, {}, {0, 5.9f, 5.9f});
}

TEST(Surface, IsTheSameOnAnyNumberOfThreads) {
    Compound c;
    c.spheres = {{{0, 0, 0}, 5}, {{4, 3, 2}, 4}};
    c.capsules.push_back({{0, 0, 0}, {-9, 2, 3}, 2});
    SurfaceWalkers start =
        place_on_surface(c, std::vector<float>(40, 1.3f), std::vector<float>(40, 0.25f), 9);
    ASSERT_EQ(start.position.size(), 40u);
    auto off = [&](Vec3 p) { return outside(c, p); };
    Tour alone = tour(c, start, 900, 1, off), many = tour(c, start, 900, 3, off);
    EXPECT_EQ(alone.hash, many.hash);
    EXPECT_LT(alone.farthest, k_off);
    EXPECT_LT(alone.deepest, k_off);
    EXPECT_LT(alone.longest, 0.045f);
    // Nobody is stuck.
    for (size_t i = 0; i < 40; ++i) EXPECT_GT(length(alone.walkers.position[i] - start.position[i]), 0.5f);
}

TEST(Surface, NobodyWalksIntoAnybody) {
    constexpr size_t k_walkers = 120;
    constexpr int k_ticks = 60 * 600;
    Compound c;
    c.spheres = {{{0, 0, 0}, 5}, {{4, 3, 2}, 4}};
    c.capsules.push_back({{0, 0, 0}, {-9, 2, 3}, 2});
    std::vector<float> speed, radius;
    for (uint32_t i = 0; i < k_walkers; ++i) {
        speed.push_back(random_between({6, i}, 0.8f, 1.7f, 0));
        radius.push_back(random_between({6, i}, 0.18f, 0.3f, 1));
    }
    SurfaceWalkers w = place_on_surface(c, speed, radius, 9);
    ASSERT_EQ(w.position.size(), k_walkers);
    double moved = 0, liked = 0;
    float deepest = 0, hardest = 0;
    std::vector<float> pace(k_walkers), way(k_walkers);
    size_t stuck = 0;
    for (int t = 0; t < k_ticks; ++t) {
        look_round(w);
        walk_on_surface(c, w, 0, k_walkers, 5, static_cast<uint32_t>(t), k_dt);
        for (size_t i = 0; i < k_walkers; ++i) {
            moved += wide(w.moved[i]), liked += wide(w.speed[i] * k_dt);
            way[i] += w.moved[i];
            hardest = std::max(hardest, (pace[i] - w.pace[i]) / k_dt);
            pace[i] = w.pace[i];
            for (size_t j = 0; j < i; ++j)
                deepest =
                    std::max(deepest, w.radius[i] + w.radius[j] - length(w.position[i] - w.position[j]));
        }
        if (t % 1800 != 1799) continue;  // half a minute
        for (float& metres : way) stuck += metres < 1, metres = 0;
    }
    std::printf(
        "%zu people on %.0f m2: %.3f m into each other at most, %.2f of the speed that they like, braking "
        "%.1f m/s2 at most, %zu times one had not got on in half a minute\n",
        k_walkers, 600.0, wide(deepest), moved / liked, wide(hardest), stuck);
    EXPECT_LT(deepest, 0.05f);
    EXPECT_GT(moved / liked, 0.8);
    EXPECT_LT(hardest, 6.1f);
    EXPECT_EQ(stuck, 0u);
}

TEST(Surface, FramesStandUpright) {
    for (uint32_t i = 0; i < 100; ++i) {
        RandomKey key{2, i, 0, Purpose::spawn};
        auto unit = [&](uint32_t n) {
            return normalize_or({random_normal(key, n), random_normal(key, n + 1), random_normal(key, n + 2)},
                                {0, 1, 0});
        };
        Vec3 up = unit(0), ahead = normalize_or(cross(up, unit(3)), {1, 0, 0});
        Quat q = frame_of(up, ahead);
        EXPECT_LT(length(rotate(q, {0, 1, 0}) - up), 1e-4f);
        EXPECT_LT(length(rotate(q, {0, 0, 1}) - ahead), 1e-4f);
    }
}

}  // namespace
}  // namespace flaneur
