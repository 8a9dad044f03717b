// Creatures of six legs on a compound: feet that stay where they are put, on its surface, and legs that reach
// them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sim/base/math.h"
#include "sim/roam.h"

namespace flaneur {
namespace {

// Spheres and capsules that lie into one another, with corners between, and a wedge of triangles.
Compound rock() {
    Compound rock;
    rock.spheres = {{{0, 0, 0}, 9}, {{11, 2, -3}, 5}};
    rock.capsules = {{{-6, 0, 5}, {-10, 9, 8}, 4}};
    rock.vertices = {{-5, 7, -9}, {5, 7, -9}, {0, 12, -2}, {0, -2, -2}};
    rock.indices = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    index_compound(rock);
    return rock;
}

struct Herd {
    Roam roam;
    Linkages linkages;
};
Herd herd(uint32_t count, uint64_t seed) {
    Herd h;
    h.roam.compound = rock();
    std::vector<float> sizes, speed, radius;
    for (uint32_t n = 0; n < count; ++n) {
        sizes.push_back(1 + 0.25f * static_cast<float>(n));
        speed.push_back(0.6f * sizes.back());
        radius.push_back(creature_radius(sizes.back()));
    }
    h.roam.walkers = place_on_surface(h.roam.compound, speed, radius, seed);
    for (uint32_t n = 0; n < count; ++n)
        h.roam.creatures.push_back(make_creature(rays_of(h.roam.compound), h.roam.walkers, n, sizes[n]));
    h.linkages = make_bones(h.roam.creatures);
    return h;
}
void tick_herd(Herd& h, Workers& workers, uint64_t seed, uint32_t tick) {
    look_round(h.roam.walkers);
    walk_on_surface(h.roam.compound, h.roam.walkers, 0, h.roam.walkers.position.size(), seed, tick, k_tick);
    step_creatures(h.roam, h.linkages, workers);
}

// How far a point is from the nearest surface along the way that it stands.
float off_surface(const Compound& compound, Vec3 p, Vec3 normal) {
    constexpr float k_look = 0.3f;
    const auto hit = cast_ray(compound, p + normal * k_look, -normal, 2 * k_look);
    return hit ? std::fabs(hit->distance - k_look) : k_look;
}

TEST(Creatures, StandOnTheRockForTenMinutes) {
    constexpr uint32_t k_count = 4;
    constexpr uint32_t k_ticks = 36000;
    float slide = 0, float_off = 0, missed = 0, bone = 0, turn = 0, way = 0;
    uint32_t more_up = 0, steps = 0, low_knees = 0, knees = 0;
    Herd h = herd(k_count, 3);
    WorkersPtr workers = make_workers(2);
    for (uint32_t tick = 0; tick < k_ticks; ++tick) {
        const std::vector<Creature> before = h.roam.creatures;
        tick_herd(h, *workers, 3, tick);
        for (uint32_t n = 0; n < k_count; ++n) {
            const Creature &was = before[n], &is = h.roam.creatures[n];
            const Linkage& f = h.linkages.all[n];
            const std::span p = places_of(h.linkages, n);
            ASSERT_NEAR(length(is.up), 1, 1e-4f);
            turn = std::max(turn, arccos(std::min(dot(was.up, is.up), 1.0f)) / k_tick);
            way += h.roam.walkers.moved[n];
            uint32_t up = 0;
            for (int leg = 0; leg < k_creature_legs; ++leg) {
                const CreatureLeg &a = was.legs[leg], &b = is.legs[leg];
                up += b.swing < 1;
                steps += a.swing == 1 && b.swing < 1;
                if (a.swing == 1 && b.swing == 1) slide = std::max(slide, length(a.foot - b.foot));
                if (b.swing == 1)
                    float_off = std::max(float_off, off_surface(h.roam.compound, b.foot, b.normal));
                const size_t at = f.rest.size() - static_cast<size_t>(4 * (k_creature_legs - leg));
                if (b.swing == 1) missed = std::max(missed, length(p[at + 3] - b.foot));
                const Vec3 middle = lerp(p[at], p[at + 3], 0.5f);
                low_knees += dot(p[at + 2] - middle, is.up) < 0;
                ++knees;
            }
            more_up += up > 3;
            for (size_t j = 1; j < f.rest.size(); ++j)
                bone = std::max(
                    bone, std::fabs(length(p[j] - p[static_cast<size_t>(f.shape.parents[j])]) - f.bones[j]));
        }
    }
    std::printf(
        "creatures: feet slide %.4f m, %.4f m off, ends miss by %.4f m, bones by %.5f m; up turns "
        "%.2f rad/s; %u steps, more than three feet up for %.2f %%; %.1f m each; %u of %u knees "
        "hang\n",
        slide, float_off, missed, bone, turn, steps, 100.0 * more_up / (k_count * k_ticks), way / k_count,
        low_knees, knees);
    EXPECT_EQ(slide, 0);
    EXPECT_LT(float_off, 0.01f);
    EXPECT_LT(missed, 0.01f);
    EXPECT_LT(bone, 1e-3f);
    EXPECT_LT(turn, 2.05f);
    // Over the wedge's sharp edges a foot that is left too far comes at once.
    EXPECT_LT(more_up, k_count * k_ticks / 50);
    EXPECT_GT(way / k_count, 200);
    EXPECT_GT(steps, k_count * 1000u);
    EXPECT_LT(low_knees, knees / 1000);
}

TEST(Creatures, AreTheSameOnEveryNumberOfThreads) {
    std::vector<Vec3> places[2];
    for (const int threads : {1, 3}) {
        Herd h = herd(5, 9);
        WorkersPtr workers = make_workers(threads);
        for (uint32_t tick = 0; tick < 600; ++tick) tick_herd(h, *workers, 9, tick);
        places[threads > 1] = h.linkages.places;
    }
    EXPECT_EQ(places[0], places[1]);
}

}  // namespace
}  // namespace flaneur
