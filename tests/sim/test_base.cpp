#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <vector>

#include "sim/base/hash.h"
#include "sim/base/math.h"
#include "sim/base/parallel_for.h"
#include "sim/base/rng.h"

namespace flaneur {
namespace {

TEST(Math, AgreesWithLibm) {
    for (int i = -20000; i <= 20000; ++i) {
        float x = static_cast<float>(i) * 0.0005f;
        SinCos sc = sin_cos(x);
        ASSERT_NEAR(sc.sine, std::sin(double(x)), 3e-7) << x;
        ASSERT_NEAR(sc.cosine, std::cos(double(x)), 3e-7) << x;
        ASSERT_NEAR(exponential(x), std::exp(double(x)), 2e-7 * std::exp(double(x)) + 1e-30) << x;
    }
    for (int i = 0; i < 10000; ++i) {
        float a = static_cast<float>(i - 5000) * (k_pi / 5001);
        ASSERT_NEAR(arctan2(std::sin(a) * 3, std::cos(a) * 3), a, 1e-6);
        float x = static_cast<float>(i - 5000) / 5000;
        ASSERT_NEAR(arccos(x), std::acos(double(x)), 6e-4 * (std::fabs(x) > 0.999f) + 2e-6);
    }
    EXPECT_EQ(arctan2(0, 0), 0);
}

TEST(Math, Headings) {
    EXPECT_NEAR(heading_of({1, 0}), k_pi / 2, 1e-6f);
    EXPECT_NEAR(heading_direction(k_pi / 2).x, 1, 1e-6f);
    EXPECT_NEAR(wrap_angle(7 * k_pi / 2), -k_pi / 2, 1e-5f);
    Vec3 turned = rotate(rotation_y(k_pi / 2), Vec3{0, 0, 1});
    EXPECT_NEAR(turned.x, 1, 1e-6f);
}

TEST(Vec, RotationBetweenTakesOneToTheOther) {
    RandomKey key{7};
    for (uint32_t i = 0; i < 1000; ++i) {
        auto random_direction = [&](uint32_t k) {
            return normalize_or(Vec3{random_between(key, -1, 1, k), random_between(key, -1, 1, k + 1),
                                     random_between(key, -1, 1, k + 2)},
                                {1, 0, 0});
        };
        Vec3 a = random_direction(i * 6), b = i % 10 ? random_direction(i * 6 + 3) : -a;
        EXPECT_LT(length(rotate(rotation_between(a, b), a) - b), 2e-3f);
    }
}

TEST(Rng, KeysAreIndependentAndUniform) {
    double sum = 0, squares = 0;
    std::vector<int> bins(16);
    for (uint32_t i = 0; i < 64000; ++i) {
        float u = random_unit({1, i, 3, Purpose::spawn});
        ASSERT_GE(u, 0);
        ASSERT_LT(u, 1);
        ++bins[static_cast<size_t>(u * 16)];
        float n = random_normal({1, i, 3, Purpose::style});
        sum += n;
        squares += n * n;
    }
    for (int b : bins) EXPECT_NEAR(b, 4000, 300);
    EXPECT_NEAR(sum / 64000, 0, 0.02);
    EXPECT_NEAR(squares / 64000, 1, 0.03);
    EXPECT_NE(random_bits({1, 2, 3, Purpose::spawn}), random_bits({1, 3, 2, Purpose::spawn}));
    EXPECT_NE(random_bits({1, 2, 3, Purpose::spawn}), random_bits({1, 2, 3, Purpose::style}));
}

TEST(Hash, SeesEveryByteAndTheLength) {
    std::vector<uint8_t> bytes(37, 5);
    uint64_t before = hash_bytes(1, bytes.data(), bytes.size());
    for (uint8_t& b : bytes) {
        b ^= 1;
        EXPECT_NE(before, hash_bytes(1, bytes.data(), bytes.size()));
        b ^= 1;
    }
    EXPECT_NE(before, hash_bytes(1, bytes.data(), 36));
}

TEST(ParallelFor, VisitsEverythingOnce) {
    for (int threads : {1, 2, 7}) {
        WorkersPtr workers = make_workers(threads);
        EXPECT_EQ(thread_count(*workers), threads);
        for (size_t count : {0u, 1u, 5u, 1000u}) {
            std::vector<std::atomic<int>> visits(count);
            std::atomic<bool> sane = true;
            for (int round = 0; round < 20; ++round) {
                parallel_for(*workers, count, 7, [&](size_t begin, size_t end, int thread) {
                    if (begin >= end || end > count || thread >= threads) sane = false;
                    for (size_t i = begin; i < end; ++i) ++visits[i];
                });
            }
            EXPECT_TRUE(sane);
            for (auto& v : visits) EXPECT_EQ(v, 20);
        }
    }
}

}  // namespace
}  // namespace flaneur
