// The library as another program uses it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <thread>

#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/sim.h"
#include "sim/world.h"
#include "tests/sim/allocations.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

// A level square of edge 2 * `half`, cut into four.
struct Plane {
    std::vector<Vec3> positions;
    std::vector<uint32_t> indices;
    Triangles triangles() const { return {positions, indices, {}}; }
};
Plane plane(float half) {
    Plane p;
    for (float z : {-half, 0.0f, half})
        for (float x : {-half, 0.0f, half}) p.positions.push_back({x, 0, z});
    for (uint32_t z = 0; z < 2; ++z) {
        for (uint32_t x = 0; x < 2; ++x) {
            uint32_t a = z * 3 + x, b = a + 1, c = a + 3, d = a + 4;
            for (uint32_t i : {a, c, d, a, d, b}) p.indices.push_back(i);
        }
    }
    return p;
}

WorldPtr made(const Plane& p, const WorldOptions& options) {
    auto world = make_world(p.triangles(), options);
    EXPECT_TRUE(world) << world.error().message;
    return std::move(world).value();
}

float deepest_overlap(const World& world) {
    const Crowd& c = world.crowd;
    float deepest = -1;
    for (WalkerId a : walkers(world)) {
        for (WalkerId b : walkers(world)) {
            if (a == b) continue;
            Vec3 off = c.motion.position[a.index] - c.motion.position[b.index];
            float radii = c.identity.radius[a.index] + c.identity.radius[b.index];
            deepest = std::max(deepest, radii - length(on_ground(off)));
        }
    }
    return deepest;
}

// Threads of one's own, started for each job.
void run_on_threads(void* user, int count, void (*task)(void* context, int index), void* context) {
    ++*static_cast<int*>(user);
    std::vector<std::thread> threads;
    for (int i = count - 1; i >= 0; --i) threads.emplace_back(task, context, i);
    for (auto& t : threads) t.join();
}

TEST(Library, TheProgramOnTopOfTheHeader) {
    const Vec3 corners[] = {{-20, 0, -20}, {-20, 0, 20}, {20, 0, 20}, {20, 0, -20}};
    const uint32_t triangles[] = {0, 1, 2, 0, 2, 3};
    auto world = make_world({corners, triangles, {}}, {.capacity = 100});
    ASSERT_TRUE(world) << world.error().message;
    for (int i = 0; i < 100; ++i) ASSERT_TRUE(add_walker(**world, {.wanders = true}));
    std::vector<Vec3> before;
    for (WalkerId id : walkers(**world)) before.push_back(motion_of(**world, id)->position);
    for (int tick = 0; tick < 600; ++tick) step(**world);
    float moved = 0;
    for (size_t i = 0; i < 100; ++i)
        moved += length(motion_of(**world, walkers(**world)[i])->position - before[i]);
    EXPECT_GT(moved / 100, 3);
}

struct Visit {
    uint64_t hash = 0;  // at the end
    size_t added = 0;
    size_t allocated = 0;  // by the steps
};

// Hundreds come and go each second while it runs.
Visit come_and_go(const WorldOptions& options, uint32_t ticks, bool look = false) {
    WorldPtr w = made(plane(30), options);
    std::vector<WalkerId> gone;
    std::set<std::pair<uint32_t, uint32_t>> seen;
    Visit visit;
    for (uint32_t tick = 0; tick < ticks; ++tick) {
        auto number = [&](uint32_t i) { return random_unit({77, tick, 0, Purpose::spawn}, i); };
        for (uint32_t k = 0; k < 8 && walkers(*w).size() < 150; ++k) {
            WalkerOptions o;
            o.wanders = k % 2 == 0;
            o.radius = k % 3 == 0 ? 0.18f : 0.27f;
            auto id = add_walker(*w, o);
            if (!id) continue;
            ++visit.added;
            EXPECT_TRUE(seen.insert({id->index, id->generation}).second) << "an id came again";
            if (!o.wanders) {
                EXPECT_TRUE(send_to(*w, *id, {number(k) * 50 - 25, 0, number(k + 50) * 50 - 25}));
            }
        }
        size_t before = allocations();
        step(*w);
        visit.allocated += allocations() - before;
        for (uint32_t k = 0; k < 7 && walkers(*w).size() > 20; ++k) {
            auto all = walkers(*w);
            WalkerId id = all[static_cast<size_t>(number(100 + k) * static_cast<float>(all.size()))];
            EXPECT_TRUE(remove_walker(*w, id));
            gone.push_back(id);
        }
        if (!look) continue;
        EXPECT_LT(deepest_overlap(*w), 0.05f);
        for (WalkerId id : walkers(*w)) EXPECT_TRUE(is_alive(*w, id));
    }
    JointPose joints[k_joint_count];
    for (WalkerId id : gone) {
        EXPECT_FALSE(is_alive(*w, id));
        EXPECT_FALSE(remove_walker(*w, id));
        EXPECT_FALSE(send_to(*w, id, {0, 0, 0}));
        EXPECT_FALSE(let_wander(*w, id));
        EXPECT_FALSE(let_jump(*w, id));
        EXPECT_FALSE(has_arrived(*w, id));
        EXPECT_FALSE(motion_of(*w, id));
        EXPECT_FALSE(pose_of(*w, id, joints));
    }
    visit.hash = hash_world(*w);
    return visit;
}

WorldOptions with_room(int threads) {
    WorldOptions options;
    options.capacity = 160;
    options.threads = threads;
    return options;
}

TEST(Library, ThousandsComeAndGo) {
    Visit visit = come_and_go(with_room(1), 400, true);
    EXPECT_GT(visit.added, 2000u);
    EXPECT_EQ(visit.allocated, 0u) << "in a step";
}

TEST(Library, WhoComesAndGoesIsEqualOnEveryThreadCount) {
    Visit expected = come_and_go(with_room(1), 200);
    for (int threads : {2, 7}) {
        Visit visit = come_and_go(with_room(threads), 200);
        EXPECT_EQ(visit.hash, expected.hash) << threads << " threads";
        EXPECT_EQ(visit.allocated, 0u) << threads << " threads";
    }
    WorldOptions another = with_room(1);
    another.seed = 2;
    EXPECT_NE(come_and_go(another, 200).hash, expected.hash);
}

TEST(Library, StepsOnSomebodyElsesThreads) {
    WorldOptions options = with_room(1);
    uint64_t expected = come_and_go(options, 100).hash;
    int jobs = 0;
    options.tasks = {run_on_threads, &jobs, 3};
    EXPECT_EQ(come_and_go(options, 100).hash, expected);
    EXPECT_GT(jobs, 100);
}

// Ground that knows what stands in the way keeps people out of it, as triangles alone cannot.
TEST(Library, PeopleWalkOnAGroundWithItsObstacles) {
    Ground ground = square(20);
    ground.obstacles.push_back({{0, 0, 0}, 0, {2, 2}});
    auto made = make_world_on(ground, {.walkers = 30});
    ASSERT_TRUE(made) << made.error().message;
    for (int tick = 0; tick < 1200; ++tick) {
        step(**made);
        for (WalkerId id : walkers(**made)) {
            Vec3 p = motion_of(**made, id)->position;
            EXPECT_FALSE(std::fabs(p.x) < 2 && std::fabs(p.z) < 2) << p.x << ", " << p.z;
        }
    }
}

TEST(Library, NobodyStandsWhereOneLeft) {
    WorldPtr w = made(plane(10), {.capacity = 3});
    auto a = add_walker(*w, {.place = Vec3{0, 0, 0}});
    ASSERT_TRUE(a);
    EXPECT_FALSE(add_walker(*w, {.place = Vec3{0.3f, 0, 0}})) << "somebody stands there";
    EXPECT_TRUE(remove_walker(*w, *a));
    auto b = add_walker(*w, {.place = Vec3{0.3f, 0, 0}});
    ASSERT_TRUE(b);
    EXPECT_EQ(b->index, a->index);
    EXPECT_NE(b->generation, a->generation);
    // It stands there from the first tick on, not in a way from where the other stood.
    JointPose before[k_joint_count], after[k_joint_count];
    ASSERT_TRUE(pose_of(*w, *b, before, 0));
    ASSERT_TRUE(pose_of(*w, *b, after, 1));
    for (int j = 0; j < k_joint_count; ++j) EXPECT_LT(length(before[j].position - after[j].position), 1e-6f);
    EXPECT_NEAR(before[hips].position.x, 0.3f, 0.1f);
}

TEST(Library, GoesWhereItIsSentAndArrivesThereAlone) {
    WorldPtr w = made(plane(20), {.capacity = 5});
    auto id = add_walker(*w, {.place = Vec3{-10, 0, 0}, .wanders = true});
    ASSERT_TRUE(id);
    for (int k = 0; k < 120; ++k) step(*w);
    EXPECT_FALSE(has_arrived(*w, *id));
    ASSERT_TRUE(send_to(*w, *id, {12, 0, 5}));
    for (int k = 0; k < 60 * 60 && !has_arrived(*w, *id); ++k) {
        EXPECT_FALSE(has_arrived(*w, *id));
        step(*w);
    }
    EXPECT_TRUE(has_arrived(*w, *id));
    EXPECT_LT(length(on_ground(motion_of(*w, *id)->position) - Vec2{12, 5}), 1);
    ASSERT_TRUE(send_to(*w, *id, {-12, 0, 5}));
    EXPECT_FALSE(has_arrived(*w, *id));
    EXPECT_FALSE(send_to(*w, *id, {100, 0, 0})) << "no ground";
    EXPECT_FALSE(send_to(*w, *id, {NAN, 0, 0}));
    EXPECT_TRUE(let_wander(*w, *id));
}

TEST(Library, JumpsWhenAsked) {
    WorldPtr w = made(plane(20), {.capacity = 5});
    auto id = add_walker(*w, {.place = Vec3{0, 0, 0}});
    ASSERT_TRUE(id);
    JointPose joints[k_joint_count];
    auto highest = [&] {
        float y = 0;
        for (int k = 0; k < 120; ++k) {
            step(*w);
            EXPECT_TRUE(pose_of(*w, *id, joints));
            y = std::max(y, joints[hips].position.y);
        }
        return y;
    };
    float stands = highest();
    EXPECT_TRUE(let_jump(*w, *id));
    EXPECT_GT(highest(), stands + 0.1f);
    EXPECT_LT(highest(), stands + 0.02f) << "once";
}

constexpr float k_wave = 0.1f, k_wave_number = 0.8f;
float wave(float x) { return k_wave * std::sin(k_wave_number * x); }

TEST(Library, FeetStandOnGroundOfOnesOwn) {
    WorldOptions options;
    options.capacity = 20;
    options.around.ground = [](const void*, std::span<const Vec3> points, float up, float down,
                               std::optional<GroundHit>* hits) {
        for (size_t i = 0; i < points.size(); ++i) {
            float y = wave(points[i].x), off = y - points[i].y;
            hits[i] = std::nullopt;
            if (off > up || off < -down) continue;
            float slope = k_wave * k_wave_number * std::cos(k_wave_number * points[i].x);
            hits[i] = GroundHit{y, normalize_or(Vec3{-slope, 1, 0}, {0, 1, 0}), Surface::plaza};
        }
    };
    WorldPtr w = made(plane(20), options);
    for (int i = 0; i < 20; ++i) ASSERT_TRUE(add_walker(*w, {.wanders = i % 2 == 0}));
    int planted = 0;
    float worst = 0, worst_sole = 0;
    for (int tick = 0; tick < 900; ++tick) {
        step(*w);
        for (WalkerId id : walkers(*w)) {
            Vec3 p = motion_of(*w, id)->position;
            EXPECT_NEAR(p.y, wave(p.x), 1e-4f);
            const GaitBlock& g = w->gait.blocks[id.index / k_block];
            size_t lane = id.index % k_block;
            for (Side side : {k_left, k_right}) {
                const FootBlock& foot = g.feet[side];
                if (foot.swinging[lane]) continue;
                ++planted;
                worst = std::max(worst, std::fabs(foot.from.y[lane] - wave(foot.from.x[lane])));
                if (id.index % 2 == 0 || tick < 60) continue;  // the others stand where they are
                Sole s = sole(w->poses, w->gait, id.index, side);
                for (Vec3 at : {s.heel, s.ball})
                    worst_sole = std::max(worst_sole, std::fabs(at.y - wave(at.x)));
            }
        }
    }
    EXPECT_GT(planted, 10000);
    EXPECT_LT(worst, 0.002f) << "metres";
    EXPECT_LT(worst_sole, 0.006f) << "metres";
}

TEST(Library, WhatCannotBeIsRefusedWithASentence) {
    Plane p = plane(10);
    auto refused = [](const auto& result, const char* word) {
        ASSERT_FALSE(result);
        EXPECT_NE(result.error().message.find(word), std::string::npos) << result.error().message;
    };
    Plane bad = p;
    bad.indices[4] = 99;
    refused(make_world(bad.triangles()), "99");
    bad = p;
    bad.indices.pop_back();
    refused(make_world(bad.triangles()), "three");
    bad = p;
    bad.positions[3].y = NAN;
    refused(make_world(bad.triangles()), "finite");
    bad = p;
    for (size_t i = 0; i < bad.indices.size(); i += 3) std::swap(bad.indices[i], bad.indices[i + 1]);
    refused(make_world(bad.triangles()), "up");
    refused(make_world({}), "up");
    const Surface one[] = {Surface::road};
    refused(make_world({p.positions, p.indices, one}), "kinds");
    refused(make_world(p.triangles(), {.kinds = {}}), "kind");
    refused(make_world(p.triangles(), {.hour = 30}), "hour");
    refused(make_world(p.triangles(), {.capacity = 2000000}), "million");
    refused(make_world(p.triangles(), {.threads = -3}), "threads");
    refused(make_world_on(Ground(), {.capacity = 1}), "index_ground");
    WorldPtr w = made(p, {.capacity = 1});
    refused(add_walker(*w, {.place = Vec3{50, 0, 0}}), "ground");
    refused(add_walker(*w, {.kind = 3}), "kind");
    refused(add_walker(*w, {.scale = 9}), "range");
    refused(add_walker(*w, {.speed = NAN}), "range");
    refused(add_walker(*w, {.radius = 0}), "range");
    ASSERT_TRUE(add_walker(*w));
    refused(add_walker(*w), "full");
}

TEST(Library, TheHashKnowsWhatTheNextTickDependsOn) {
    WorldPtr w = made(plane(10), {.walkers = 20});
    for (int k = 0; k < 60; ++k) step(*w);
    uint64_t hash = hash_world(*w);
    auto changes = [&](auto& value, auto other) {
        auto before = value;
        value = other;
        EXPECT_NE(hash_world(*w), hash);
        value = before;
    };
    changes(w->crowd.motion.under[7].kind, Surface::steps);
    changes(w->crowd.decision.claim[7].since, 3u);
    changes(w->crowd.journeys[7].pause_until, 12345u);
    changes(w->idles.stood[7], uint16_t{9});
    changes(w->gait.people[0].stride[7], 3.0f);
    EXPECT_EQ(hash_world(*w), hash);
}

}  // namespace
}  // namespace flaneur
