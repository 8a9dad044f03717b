#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/ik/solvers.h"
#include "sim/linkages/linkages.h"

namespace flaneur {
namespace {

struct Chain {
    std::vector<Vec3> places;
    std::vector<float> bones;
    float reach = 0;
};
// Bones of 5 to 30 cm in any directions.
Chain random_chain(RandomKey key, int joints) {
    Chain c;
    c.places.push_back({0.3f, 1, -0.2f});
    uint32_t draw = 0;
    for (int j = 1; j < joints; ++j) {
        Vec3 way;
        for (float* x : {&way.x, &way.y, &way.z}) *x = random_between(key, -1, 1, draw++);
        const float bone = random_between(key, 0.05f, 0.3f, draw++);
        c.places.push_back(c.places.back() + normalize_or(way, {0, 1, 0}) * bone);
        c.bones.push_back(bone);
        c.reach += bone;
    }
    return c;
}
float worst_bone(const Chain& c) {
    float worst = 0;
    for (size_t i = 0; i < c.bones.size(); ++i)
        worst = std::max(worst, std::fabs(length(c.places[i + 1] - c.places[i]) - c.bones[i]));
    return worst;
}

constexpr Solver k_any_chain[] = {Solver::fabrik, Solver::ccd, Solver::transpose, Solver::damped};

// Where the ends of other chains of the same bones are, which can be reached.
TEST(Solvers, BringChainsOfAnyLengthToWhatTheyCanReach) {
    constexpr int k_chains = 400;
    for (const Solver solver : k_any_chain) {
        int reached = 0;
        for (uint32_t n = 0; n < k_chains; ++n) {
            const int joints = 3 + static_cast<int>(n % 62);
            Chain c = random_chain({41, n}, joints), goal = random_chain({42, n}, joints);
            goal.places[0] = c.places[0];
            for (size_t i = 0; i < c.bones.size(); ++i)
                goal.places[i + 1] =
                    goal.places[i] +
                    normalize_or(goal.places[i + 1] - goal.places[i], {0, 1, 0}) * c.bones[i];
            const Vec3 base = c.places[0];
            const Solved solved = solve_chain(solver, c.places, c.bones, goal.places.back(), {0.001f, 2000});
            EXPECT_EQ(c.places[0], base);
            EXPECT_FLOAT_EQ(solved.off, length(goal.places.back() - c.places.back()));
            ASSERT_LT(worst_bone(c), 3e-6f * static_cast<float>(joints)) << n;
            reached += solved.off <= 0.001f;
        }
        EXPECT_GE(reached, k_chains - 4) << k_solver_names[static_cast<size_t>(solver)];
    }
}

// In the order of the table of Aristidou & Lasenby (2011) as far as that says how each takes its steps.
TEST(Solvers, TakeAsManyIterationsAsIsKnownOfThem) {
    constexpr int k_tries = 300;
    double mean[k_solver_count] = {};
    for (const Solver solver : k_any_chain) {
        const Linkage rest = chain_linkage(10, 0.1f, solver);
        for (uint32_t n = 0; n < k_tries; ++n) {
            Vec3 target;
            uint32_t draw = 0;
            do {
                for (float* x : {&target.x, &target.y, &target.z})
                    *x = random_between({43, n}, -0.9f, 0.9f, draw++);
            } while (length(target) > 0.9f);
            std::vector<Vec3> places = rest.rest;
            mean[static_cast<size_t>(solver)] +=
                solve_chain(solver, places, std::span(rest.bones).subspan(1), target, {0.0009f, 5000})
                    .iterations /
                static_cast<double>(k_tries);
        }
    }
    auto of = [&](Solver solver) { return mean[static_cast<size_t>(solver)]; };
    EXPECT_NEAR(of(Solver::fabrik), 15.5, 5);
    EXPECT_GT(of(Solver::ccd), 1.5 * of(Solver::fabrik));
    EXPECT_GT(of(Solver::transpose), of(Solver::ccd));
    EXPECT_LT(of(Solver::damped), of(Solver::transpose));
}

TEST(Solvers, TwoBonesAreClosedInOneStep) {
    for (uint32_t n = 0; n < 1000; ++n) {
        Chain c = random_chain({44, n}, 3);
        Vec3 way;
        uint32_t draw = 0;
        for (float* x : {&way.x, &way.y, &way.z}) *x = random_between({45, n}, -1, 1, draw++);
        const float least = std::fabs(c.bones[0] - c.bones[1]) + 0.002f, most = 0.999f * c.reach;
        const Vec3 target =
            c.places[0] + normalize_or(way, {0, 1, 0}) * lerp(least, most, random_unit({46, n}));
        const Vec3 across = cross(c.places[1] - c.places[0], target - c.places[0]);
        const Solved solved = solve_chain(Solver::two_bone, c.places, c.bones, target, {1e-6f, 10});
        EXPECT_LE(solved.iterations, 1);
        ASSERT_LT(solved.off, 1e-4f) << n;
        ASSERT_LT(worst_bone(c), 1e-5f) << n;
        // It bends in the plane in which it was bent, to the side to which it was.
        EXPECT_GT(dot(cross(c.places[1] - c.places[0], target - c.places[0]), across), 0) << n;
    }
}

TEST(Solvers, LeaveWhatIsThereAlready) {
    for (const Solver solver : k_any_chain) {
        Chain c = random_chain({47}, 6);
        const std::vector<Vec3> before = c.places;
        EXPECT_EQ(solve_chain(solver, c.places, c.bones, before.back(), {}).iterations, 0);
        EXPECT_EQ(c.places, before);
    }
}

// Targets on the base, straight along the chain, beyond reach: nothing breaks.
TEST(Solvers, TakeWhatIsDegenerate) {
    for (const Solver solver : k_any_chain)
        for (const Vec3 target :
             {Vec3{0, 0, 0}, {0, 0.5f, 0}, {0, 0.9f, 0}, {0, 5, 0}, {0, -0.9f, 0}, {1e9f, 0, 0}}) {
            Chain c;
            for (int j = 0; j < 10; ++j) c.places.push_back({0, 0.1f * static_cast<float>(j), 0});
            c.bones.assign(9, 0.1f);
            const Solved solved = solve_chain(solver, c.places, c.bones, target, {0.001f, 300});
            EXPECT_LE(solved.iterations, 300);
            EXPECT_LT(worst_bone(c), 1e-5f) << k_solver_names[static_cast<size_t>(solver)];
        }
}

}  // namespace
}  // namespace flaneur
