// People in a real place: nobody in a house, nobody in the air, feet on the ground, no limb stretched.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "assets/cities.h"
#include "sim/world.h"

namespace flaneur {
namespace {

struct Sums {
    std::vector<float> drift, below, above;  // metres, of planted feet, a value a foot and tick
    float overreach = 0, off_ground = 0;     // metres, worst
    size_t lost = 0, in_wall = 0;            // walkers without ground below them; within 0.1 m of a wall
};

float share(std::vector<float>& values, double part) {
    if (values.empty()) return 0;
    auto at = values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

void look_at_feet(const World& w, size_t i, const std::vector<Sole>& last,
                  const std::vector<uint8_t>& planted, Sums& sums) {
    for (Side side : {k_left, k_right}) {
        size_t k = 2 * i + static_cast<size_t>(side);
        bool stands = w.gait.blocks[i / k_block].feet[side].swinging[i % k_block] == 0;
        if (!stands) continue;
        Sole now = sole(w.poses, w.gait, i, side);
        if (planted[k])
            sums.drift.push_back(std::min(length(now.heel - last[k].heel), length(now.ball - last[k].ball)));
        float deepest = 0, lowest = 1;  // 1: no ground near by
        for (Vec3 p : {now.heel, now.ball, now.tip}) {
            auto hit = ground_at(*w.ground, p + Vec3{0, 0.05f, 0}, 0.02f, 0.5f);
            if (!hit) continue;
            deepest = std::max(deepest, hit->height - p.y);
            lowest = std::min(lowest, p.y - hit->height);
        }
        sums.below.push_back(deepest);
        if (lowest < 1) sums.above.push_back(std::max(lowest, 0.0f));
        const Body& body = w.kinds[w.crowd.identity.body[i]].body;
        float leg = (thigh_length(body) + shank_length(body)) * w.crowd.identity.scale[i];
        float reach =
            length(joint_pose(w.poses, i, side == k_left ? left_upper_leg : right_upper_leg).position -
                   joint_pose(w.poses, i, side == k_left ? left_foot : right_foot).position);
        sums.overreach = std::max(sums.overreach, reach - leg);
    }
}

Sums walk(City city, uint32_t walkers, int ticks) {
    WorldOptions options;
    options.walkers = walkers;
    options.kinds = {{standard_body(1.62f)}, {standard_body(1.78f)}};
    options.destinations = city.destinations;
    auto made = make_world(std::make_shared<Ground>(std::move(city.ground)), options);
    EXPECT_TRUE(made) << (made ? "" : made.error().message);
    Sums sums;
    if (!made) return sums;
    World& w = **made;
    std::vector<Sole> last(2 * walkers);
    std::vector<uint8_t> planted(2 * walkers, 0);
    for (int t = 0; t < ticks; ++t) {
        step(w);
        for (size_t i = 0; i < walkers; ++i) {
            look_at_feet(w, i, last, planted, sums);
            for (Side side : {k_left, k_right}) {
                size_t k = 2 * i + static_cast<size_t>(side);
                planted[k] = w.gait.blocks[i / k_block].feet[side].swinging[i % k_block] == 0;
                last[k] = sole(w.poses, w.gait, i, side);
            }
            Vec3 p = w.crowd.motion.position[i];
            auto hit = ground_at(*w.ground, p, 0.2f, 0.5f);
            if (!hit) {
                ++sums.lost;
            } else {
                sums.off_ground = std::max(sums.off_ground, std::fabs(hit->height - p.y));
            }
            if (t % 60 == 0 && closest_wall(*w.ground, p + Vec3{0, 1, 0}, 0.1f)) ++sums.in_wall;
        }
    }
    std::cout << "planted feet, mm a tick: drift p99 " << 1000 * share(sums.drift, 0.99) << ", worst "
              << 1000 * share(sums.drift, 1) << "; below ground p99 " << 1000 * share(sums.below, 0.99)
              << ", worst " << 1000 * share(sums.below, 1) << "; above ground p99 "
              << 1000 * share(sums.above, 0.99) << ", worst " << 1000 * share(sums.above, 1)
              << "; leg overreached by " << 1000 * sums.overreach << "\n";
    return sums;
}

void expect_believable(Sums& sums) {
    EXPECT_EQ(sums.lost, 0u);
    EXPECT_EQ(sums.in_wall, 0u);
    EXPECT_LT(sums.off_ground, 0.01f);
    EXPECT_LT(share(sums.drift, 0.99), 0.001f);
    EXPECT_LT(share(sums.below, 0.99), 0.02f);
    EXPECT_LT(share(sums.above, 0.99), 0.02f);
    EXPECT_LT(sums.overreach, 1e-3f);
}

TEST(Streets, BuiltInDistrict) {
    Sums sums = walk(generate_district({}), 150, 900);
    expect_believable(sums);
}

TEST(Streets, Neukoelln) {
    std::string path = std::string(FLANEUR_SHARED_DIR) + "/corpus/osm/berlin_neukolln_2024.osm";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "SKIPPED: there is no " << path << " here";
    auto city = load_osm(path);
    ASSERT_TRUE(city) << city.error().message;
    Sums sums = walk(std::move(*city), 150, 900);
    expect_believable(sums);
}

}  // namespace
}  // namespace flaneur
