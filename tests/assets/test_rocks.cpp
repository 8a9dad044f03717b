// Rock in space: shapes that close, whatever triangles somebody has, and who walks on them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "assets/stages/asteroid.h"
#include "assets/stages/planets.h"
#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/world.h"

namespace flaneur {
namespace {

// Each edge is passed once each way.
bool is_closed(const RockMesh& mesh) {
    std::map<std::pair<uint32_t, uint32_t>, int> edges;
    for (size_t i = 0; i < mesh.indices.size(); i += 3)
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = mesh.indices[i + k], b = mesh.indices[i + (k + 1) % 3];
            edges[std::minmax(a, b)] += a < b ? 1 : -1;
        }
    return std::ranges::all_of(edges, [](const auto& edge) { return edge.second == 0; });
}

float volume(const RockMesh& mesh) {
    float sum = 0;
    for (size_t i = 0; i < mesh.indices.size(); i += 3)
        sum += dot(mesh.vertices[mesh.indices[i]],
                   cross(mesh.vertices[mesh.indices[i + 1]], mesh.vertices[mesh.indices[i + 2]])) /
               6;
    return sum;
}

// As files have it: corners by themselves for each triangle.
RockMesh loose(const RockMesh& mesh) {
    RockMesh out;
    for (const uint32_t v : mesh.indices) {
        out.indices.push_back(static_cast<uint32_t>(out.vertices.size()));
        out.vertices.push_back(mesh.vertices[v]);
    }
    return out;
}

Result<RockMesh> made(const RockMesh& mesh) { return make_rock_mesh(mesh.vertices, mesh.indices, 36); }
std::string refusal(const RockMesh& mesh) {
    const Result<RockMesh> solid = made(mesh);
    return solid ? "" : solid.error().message;
}

TEST(Rocks, ATorusIsAsLargeAsItsFormula) {
    const RockMesh torus = make_torus(13, 5, 192, 80);
    EXPECT_TRUE(is_closed(torus));
    EXPECT_NEAR(volume(torus), 2 * k_pi * k_pi * 13 * 25, 20);
    for (const Vec3 v : torus.vertices) {
        const float out = std::sqrt(v.x * v.x + v.z * v.z) - 13;
        EXPECT_NEAR(std::sqrt(out * out + v.y * v.y), 5, 1e-3f);
    }
}

TEST(Rocks, AnyClosedMeshIsTakenWhateverWayItIsWritten) {
    for (uint32_t seed = 0; seed < 40; ++seed) {
        const RandomKey key{seed, 0, 0, Purpose::city};
        RockMesh mesh = seed % 2 == 0 ? make_torus(3, 1, 5 + static_cast<int>(seed), 4)
                                      : make_boulder({4, 1, 9}, 2, seed);
        const float size = volume(mesh);
        EXPECT_GT(size, 0) << seed;
        if (random_unit(key, 1) < 0.5f) mesh = loose(mesh);
        if (random_unit(key, 2) < 0.5f)  // inside out
            for (size_t i = 0; i < mesh.indices.size(); i += 3)
                std::swap(mesh.indices[i], mesh.indices[i + 2]);
        // Triangles of no extent, which exporters leave.
        mesh.indices.insert(mesh.indices.end(), {0, 0, 1, 2, 2, 2});
        const float scale = std::pow(10.0f, random_between(key, -3, 3, 3));
        for (Vec3& v : mesh.vertices) v = v * scale;
        const Result<RockMesh> solid = made(mesh);
        ASSERT_TRUE(solid) << seed << ": it " << solid.error().message;
        EXPECT_TRUE(is_closed(*solid)) << seed;
        EXPECT_GT(volume(*solid), 0) << seed;
        Vec3 low = solid->vertices[0], high = low;
        for (const Vec3 v : solid->vertices) {
            low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
            high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
        }
        EXPECT_NEAR(std::max({high.x - low.x, high.y - low.y, high.z - low.z}), 36, 0.01f);
    }
}

TEST(Rocks, WhatIsNoClosedMeshIsRefusedInASentence) {
    const RockMesh ball = make_ball(2);
    auto says = [&](RockMesh mesh, const char* what) {
        const std::string told = refusal(mesh);
        EXPECT_NE(told.find(what), std::string::npos) << what << ": " << told;
        EXPECT_EQ(told.find('\n'), std::string::npos);
    };
    says({}, "no triangles");
    says({ball.vertices, {}}, "no triangles");
    says({ball.vertices, {0, 0, 1}}, "of any extent");
    RockMesh mesh = ball;
    mesh.indices.resize(mesh.indices.size() - 3);
    says(mesh, "is not closed: 3 edges");
    mesh = ball;
    std::swap(mesh.indices[0], mesh.indices[1]);
    says(mesh, "does not face out");
    mesh = ball;
    mesh.indices.insert(mesh.indices.end(), {0, 1, 2});  // a sheet within
    says(mesh, "is not closed");
    mesh = ball;
    mesh.vertices[5].y = std::nanf("");
    says(mesh, "beyond reason");
    mesh.vertices[5].y = 1e20f;
    says(mesh, "beyond reason");
    mesh = ball;
    mesh.indices[4] = 4'000'000'000u;
    says(mesh, "not there");
    mesh = ball;
    for (Vec3& v : mesh.vertices) v = {1, 2, 3};
    says(mesh, "no triangles of any extent");
    // Both sides of a sheet, and a needle.
    says({{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, {0, 1, 2, 0, 2, 1}}, "encloses next to nothing");
    mesh = ball;
    for (Vec3& v : mesh.vertices) v.y *= 1e-6f, v.x *= 1e-3f;
    says(mesh, "encloses next to nothing");
    mesh = ball;
    mesh.indices.resize(3 * (k_most_rock_triangles + 1));
    says(mesh, "at most");
}

std::unique_ptr<World> peopled(SmallWorld small, uint32_t walkers, uint32_t creatures, uint64_t seed) {
    WorldOptions options;
    options.walkers = walkers;
    options.threads = 2;
    options.seed = seed;
    auto stage = std::make_shared<City>(std::move(small.stage));
    auto world = make_world(std::shared_ptr<const Ground>(stage, &stage->ground), options);
    EXPECT_TRUE(world) << world.error().message;
    const Result<void> set =
        set_down(**world, std::move(small.compound), creatures, std::move(small.gravity));
    EXPECT_TRUE(set) << set.error().message;
    return std::move(*world);
}

// On a mesh with edges and dents, everybody goes on, and on it.
TEST(Rocks, PeopleAndCreaturesWalkOnAnyMesh) {
    std::vector<RockMesh> meshes{make_torus(13, 5, 192, 80), make_torus(13, 5, 7, 5)};
    for (uint32_t seed = 0; seed < 3; ++seed) {
        // Spikes and dents.
        RockMesh mesh = make_ball(3);
        for (size_t v = 0; v < mesh.vertices.size(); ++v)
            mesh.vertices[v] =
                mesh.vertices[v] *
                random_between({seed, static_cast<uint32_t>(v), 1, Purpose::city}, 0.85f, 1.15f, 0);
        meshes.push_back(*made(mesh));
    }
    for (size_t n = 0; n < meshes.size(); ++n) {
        auto w = peopled(make_rock(meshes[n], 1, 30), 30, 2, n);
        const std::vector<Vec3> begin = w->roam->walkers.position;
        std::vector<float> way(begin.size());
        float off = 0, turn = 0;
        for (int tick = 0; tick < 60 * 30; ++tick) {
            const SurfaceWalkers before = w->roam->walkers;
            step(*w);
            const SurfaceWalkers& s = w->roam->walkers;
            for (size_t i = 0; i < begin.size(); ++i) {
                way[i] += s.moved[i];
                const auto below =
                    surface_below(w->roam->compound, s.position[i] + s.up[i] * 0.05f, s.up[i], 0.1f);
                off = std::max(off, below ? std::fabs(below->distance - 0.05f) : 0.1f);
                turn = std::max(turn, arccos(std::min(dot(before.up[i], s.up[i]), 1.0f)) * 60);
            }
        }
        size_t stuck = 0;
        for (const float metres : way) stuck += metres < 5;
        std::printf(
            "mesh %zu: %.3f m off at most, up turns %.2f rad/s, %zu of %zu went less than 5 m in half a "
            "minute\n",
            n, static_cast<double>(off), static_cast<double>(turn), stuck, way.size());
        EXPECT_LT(turn, 3.7f) << n;
        EXPECT_LE(stuck, 2u) << n;
        EXPECT_LT(off, 0.06f) << n;
    }
}

TEST(Rocks, PlanetsAreApartAndNearEnoughToLeap) {
    const SmallWorld small = make_planets(1, 100);
    EXPECT_EQ(small.gravity.bodies, 6u);
    EXPECT_EQ(small.compound.middles.size(), 2u);
    auto w = peopled(make_planets(1, 100), 100, 3, 1);
    std::vector<uint32_t> on(6), to(6);
    std::vector<float> aloft(103);
    for (const Vec3 p : w->roam->walkers.position) ++on[pull_at(small.gravity, p).body];
    for (const uint32_t there : on) EXPECT_GT(there, 3u);
    for (int tick = 0; tick < 60 * 120; ++tick) {
        step(*w);
        for (size_t i = 0; i < 103; ++i) {
            const Leap& leap = w->roam->walkers.leaps[i];
            aloft[i] = leap.stage == LeapStage::flies ? aloft[i] + k_tick : 0;
            ASSERT_LT(aloft[i], k_longest_flight + 0.1f);
            if (leap.stage == LeapStage::absorbs && leap.seconds == 0) ++to[leap.to];
        }
    }
    uint32_t all = 0;
    for (const uint32_t landings : to) {
        EXPECT_GT(landings, 0u);
        all += landings;
    }
    EXPECT_GT(all, 40u);
}

}  // namespace
}  // namespace flaneur
