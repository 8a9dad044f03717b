#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/body/pace.h"
#include "sim/crowd/crowd.h"
#include "sim/crowd/deciders.h"
#include "sim/crowd/half_planes.h"
#include "tests/sim/allocations.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

struct World {
    Ground ground;
    NavmeshPtr mesh;
    WorkersPtr workers;
    Crowd crowd;
    uint32_t tick = 0;
};

World make_world(Ground ground, uint32_t capacity, int threads = 2) {
    World w;
    w.ground = std::move(ground);
    w.mesh = std::move(build_navmesh(w.ground, {}, threads)).value();
    w.workers = make_workers(threads);
    prepare_queries(*w.mesh, threads);
    w.crowd = make_crowd(capacity);
    w.crowd.traffic = make_traffic(*w.mesh);
    return w;
}

NavPoint on_mesh(const World& w, float x, float z) {
    auto p = nearest(*w.mesh, 0, {x, 0, z});
    EXPECT_TRUE(p) << x << " " << z;
    return *p;
}

uint32_t add(World& w, float x, float z, float heading, float goal_x, float goal_z, float speed = 1.34f) {
    Walker walker;
    walker.place = on_mesh(w, x, z);
    walker.heading = heading;
    walker.preferred_speed = speed;
    walker.errand = Errand::arrive;
    uint32_t i = add_walker(w.crowd, surroundings_of(w.ground), walker);
    send_to(w.crowd, i, on_mesh(w, goal_x, goal_z));
    return i;
}

void step(World& w) { step_crowd(w.crowd, surroundings_of(w.ground), *w.mesh, *w.workers, w.tick++, 1); }

float deepest_overlap_of_all(const Crowd& c) {
    float deepest = -1;
    for (uint32_t i = 0; i < c.count; ++i) {
        for (uint32_t j = i + 1; j < c.count; ++j) {
            float d = length(on_ground(c.motion.position[i] - c.motion.position[j]));
            deepest = std::max(deepest, c.identity.radius[i] + c.identity.radius[j] - d);
        }
    }
    return deepest;
}

// Every walker stands on ground, and its centre keeps clear of walls.
int outside(const World& w) {
    int n = 0;
    for (uint32_t i = 0; i < w.crowd.count; ++i) {
        Vec3 p = w.crowd.motion.position[i];
        auto wall = closest_wall(w.ground, p, 0.2f);
        n += !ground_at(w.ground, p, 0.01f, 0.01f) || wall;
    }
    return n;
}

TEST(HalfPlanes, NearestAllowedVelocity) {
    Vec2 v = best_velocity(nullptr, 0, 0, 1, {3, 0});
    EXPECT_NEAR(v.x, 1, 1e-6f);
    HalfPlane right[] = {{{1, 0}, 0.5f}};
    v = best_velocity(right, 1, 0, 1, {0, 0.2f});
    EXPECT_NEAR(v.x, 0.5f, 1e-6f);
    EXPECT_NEAR(v.z, 0.2f, 1e-6f);
}

TEST(HalfPlanes, BeatsEveryVelocityOfASearch) {
    for (uint32_t trial = 0; trial < 300; ++trial) {
        RandomKey key{3, trial, 0, Purpose::city};
        HalfPlane planes[8];
        for (uint32_t k = 0; k < 8; ++k) {
            Vec2 n = heading_direction(random_between(key, -3, 3, k * 2));
            planes[k] = {n, random_between(key, -1, 0.45f, k * 2 + 1)};
        }
        Vec2 wish{random_between(key, -1, 1, 20), random_between(key, -1, 1, 21)};
        Vec2 best = best_velocity(planes, 8, 2, 1, wish);
        EXPECT_LE(length(best), 1 + 1e-4f);
        auto trespass = [&](Vec2 v, int begin, int end) {
            float worst = 0;
            for (int k = begin; k < end; ++k)
                worst = std::max(worst, planes[k].offset - dot(v, planes[k].normal));
            return worst;
        };
        // Of the velocities that keep to the firm planes none trespasses less, and none that trespasses
        // nowhere is nearer.
        bool firm_possible = false;
        for (int ix = -40; ix <= 40; ++ix) {
            for (int iz = -40; iz <= 40; ++iz) {
                Vec2 v = Vec2{static_cast<float>(ix), static_cast<float>(iz)} / 40;
                if (length(v) > 1 || trespass(v, 0, 2) > 0) continue;
                firm_possible = true;
                EXPECT_LE(trespass(best, 2, 8), trespass(v, 2, 8) + 1e-3f) << trial;
                if (trespass(v, 2, 8) == 0) {
                    EXPECT_LE(length(best - wish), length(v - wish) + 1e-3f) << trial;
                }
            }
        }
        if (firm_possible) {
            EXPECT_LE(trespass(best, 0, 2), 1e-4f) << trial;
        }
    }
}

TEST(Crowd, NeighboursAreTheNearest) {
    World w = make_world(square(60), 400);
    auto made =
        populate(w.ground, surroundings_of(w.ground), {}, *w.mesh, *w.workers, 400, std::vector<Folk>(3), 5);
    ASSERT_TRUE(made);
    Crowd& c = *made;
    find_neighbours(c, *w.workers, 0);
    const SeenRows& rows = c.scratch.seen;
    for (uint32_t at = 0; at < c.count; ++at) {
        Deciders d;
        d.count = 1;
        d.at[0] = at;
        find_nearest(c.scratch, d);
        std::vector<uint32_t> found;
        for (int k = 0; k < d.near_count[0]; ++k) found.push_back(rows.all[d.near[0][k]].id);
        std::sort(found.begin(), found.end());
        const uint32_t i = rows.all[at].id;
        std::vector<std::pair<float, uint32_t>> all;
        for (uint32_t j = 0; j < c.count; ++j) {
            float d2 = length_squared(on_ground(c.motion.position[j]) - on_ground(c.motion.position[i]));
            if (j != i && d2 <= k_neighbour_reach * k_neighbour_reach) all.push_back({d2, j});
        }
        std::sort(all.begin(), all.end());
        all.resize(std::min<size_t>(all.size(), k_neighbours));
        std::vector<uint32_t> nearest;
        for (auto [d2, j] : all) nearest.push_back(j);
        std::sort(nearest.begin(), nearest.end());
        ASSERT_EQ(found, nearest) << i;
    }
}

TEST(Crowd, PopulateSpreadsWithoutTouchingAndRefusesTooMany) {
    World w = make_world(street(), 0);
    auto c =
        populate(w.ground, surroundings_of(w.ground), {}, *w.mesh, *w.workers, 300, std::vector<Folk>(4), 9);
    ASSERT_TRUE(c);
    EXPECT_LT(deepest_overlap_of_all(*c), 0);
    for (uint32_t i = 0; i < c->count; ++i) {
        EXPECT_LT(c->identity.body[i], 4u);
        EXPECT_GE(c->identity.preferred_speed[i], 0.7f);
        EXPECT_LE(c->identity.preferred_speed[i], 1.9f);
        EXPECT_GT(c->journeys[i].corner_count, 0);
    }
    auto too_many = populate(w.ground, surroundings_of(w.ground), {}, *w.mesh, *w.workers, 100000,
                             std::vector<Folk>(4), 9);
    ASSERT_FALSE(too_many);
    EXPECT_NE(too_many.error().message.find("fit"), std::string::npos);
    EXPECT_TRUE(
        populate(w.ground, surroundings_of(w.ground), {}, *w.mesh, *w.workers, 0, std::vector<Folk>(0), 9));
}

TEST(Crowd, FolkHaveTheirSharesAndSpeeds) {
    World w = make_world(square(60), 0);
    const Folk folk[] = {{1, 1.4f}, {6, 1.2f}, {3, 1.0f}};
    auto c = populate(w.ground, surroundings_of(w.ground), {}, *w.mesh, *w.workers, 1000, folk, 9);
    ASSERT_TRUE(c);
    int count[3] = {};
    float speeds[3] = {};
    for (uint32_t i = 0; i < c->count; ++i) {
        ++count[c->identity.body[i]];
        speeds[c->identity.body[i]] += c->identity.preferred_speed[i];
    }
    for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(static_cast<float>(count[k]), 100 * folk[k].share, 50) << k;
        EXPECT_NEAR(speeds[k] / static_cast<float>(count[k]), folk[k].speed, 0.07f) << k;
    }
}

TEST(Pace, GrownPeopleAreFastestAndShortLegsSlow) {
    EXPECT_NEAR(usual_speed(30, false, 0.93f), 1.395f, 1e-3f);
    EXPECT_NEAR(usual_speed(85, true, 0.85f), 0.94f, 1e-3f);
    EXPECT_EQ(usual_speed(20, true, 0.85f), usual_speed(25, true, 0.85f));
    for (bool woman : {false, true}) {
        for (float age = 55; age < 85; ++age)
            EXPECT_GT(usual_speed(age, woman, 0.9f), usual_speed(age + 1, woman, 0.9f)) << age;
        // A child of six, 1.15 m tall, at the Froude number of its mother.
        float child = usual_speed(6, woman, 0.61f);
        EXPECT_NEAR(child, usual_speed(25, woman, 0.9f) * 0.87f, 0.02f);
    }
}

TEST(Crowd, RimeaR1CorridorTime) {
    World w = make_world(corridor(44, 2), 1);
    uint32_t i = add(w, 1, 0, k_pi / 2, 43, 0, 1.33f);
    uint32_t begin = 0, end = 0;
    while (!end && w.tick < 60 * 60) {
        step(w);
        if (!begin && w.crowd.motion.position[i].x >= 1.5f) begin = w.tick;
        if (w.crowd.motion.position[i].x >= 41.5f) end = w.tick;
    }
    float seconds = static_cast<float>(end - begin) * k_tick;
    EXPECT_GE(seconds, 26);
    EXPECT_LE(seconds, 34);
}

TEST(Crowd, HeadOnPairPasses) {
    for (float width : {2.0f, 3.0f}) {
        World w = make_world(corridor(30, width), 2);
        uint32_t a = add(w, 2, 0, k_pi / 2, 28, 0), b = add(w, 28, 0, -k_pi / 2, 2, 0);
        float deepest = -1;
        for (int k = 0; k < 30 * 60; ++k) {
            step(w);
            deepest = std::max(deepest, deepest_overlap_of_all(w.crowd));
            ASSERT_EQ(outside(w), 0);
        }
        EXPECT_GT(w.crowd.motion.position[a].x, 27);
        EXPECT_LT(w.crowd.motion.position[b].x, 3);
        EXPECT_LT(deepest, 0.05f);
        EXPECT_TRUE(has_arrived(w.crowd, a) && has_arrived(w.crowd, b));
    }
}

TEST(Crowd, HundredCrossAtASquare) {
    World w = make_world(square(50), 100);
    for (int k = 0; k < 100; ++k) {
        int side = k % 4, row = k / 4;
        float across = static_cast<float>(row % 5) * 1.6f - 3.2f,
              back = 12 + static_cast<float>(row / 5) * 1.6f;
        Vec2 d = heading_direction(static_cast<float>(side) * k_pi / 2), r{-d.z, d.x};
        Vec2 from = r * across - d * back, to = r * across + d * back;
        add(w, from.x, from.z, static_cast<float>(side) * k_pi / 2, to.x, to.z,
            1.2f + 0.003f * static_cast<float>(k));
    }
    float deepest = -1;
    for (int k = 0; k < 60 * 60; ++k) {
        step(w);
        deepest = std::max(deepest, deepest_overlap_of_all(w.crowd));
    }
    int arrived = 0;
    for (uint32_t i = 0; i < 100; ++i) {
        // Later comers may have asked one who stands there to step aside.
        float off = length(on_ground(w.crowd.journeys[i].goal.position - w.crowd.motion.position[i]));
        arrived += has_arrived(w.crowd, i) && off < 3;
    }
    EXPECT_EQ(arrived, 100);
    EXPECT_LT(deepest, 0.05f);
}

// People both ways in a corridor: by chance `seed` which way, how fast and where each begins.
struct TwoWayFlow {
    double relative_speed = 0;  // sum of speeds over those preferred
    int samples = 0, slow = 0, crossings = 0;
    float deepest = -1;
};
static void add_two_way_flow(uint64_t seed, TwoWayFlow& flow) {
    constexpr float k_length = 100, k_width = 6;
    World w = make_world(corridor(k_length, k_width), 180);
    auto number = [&](uint32_t i, uint32_t k) { return random_unit({seed, i, 0, Purpose::spawn}, k); };
    for (uint32_t i = 0; i < 180; ++i) {
        // Jittered places on a lattice of one walker for each 3.3 square metres.
        float x = 1 + (static_cast<float>(i / 3) + 0.5f * number(i, 0)) * 1.63f;
        float z = -1.8f + static_cast<float>(i % 3) * 1.8f + number(i, 1) * 0.8f - 0.4f;
        bool east = number(i, 2) < 0.5f;
        float v = clamp(1.34f + 0.26f * random_normal({seed, i, 0, Purpose::body}), 0.7f, 1.9f);
        add(w, x, z, east ? k_pi / 2 : -k_pi / 2, east ? k_length - 1 : 1, number(i, 3) * 4 - 2, v);
    }
    for (int k = 0; k < 20 * 60; ++k) {
        step(w);
        Crowd& c = w.crowd;
        for (uint32_t i = 0; i < c.count; ++i) {
            // Those who come to an end turn round, so that the density holds.
            float x = c.motion.position[i].x, goal = c.journeys[i].goal.position.x;
            if (std::fabs(x - goal) < 4)
                send_to(c, i, on_mesh(w, k_length - goal, number(i, w.tick) * 4 - 2));
            if (k < 5 * 60 || x < 20 || x > k_length - 20) continue;
            ++flow.samples;
            float speed = length(c.motion.velocity[i]);
            flow.relative_speed += speed / c.identity.preferred_speed[i];
            flow.slow += speed < 0.3f;
        }
        flow.deepest = std::max(flow.deepest, deepest_overlap_of_all(c));
        flow.crossings += outside(w);
    }
}

// The behaviour gate: two-way flow at 0.3 people a square metre.
TEST(Crowd, TwoWayFlowKeepsItsSpeed) {
    TwoWayFlow flow;
    for (uint64_t seed = 11; seed < 16; ++seed) add_two_way_flow(seed, flow);
    const double speed = flow.relative_speed / flow.samples,
                 slow = static_cast<double>(flow.slow) / flow.samples;
    ASSERT_GT(flow.samples, 250000);
    EXPECT_GE(speed, 0.93);
    EXPECT_LT(slow, 0.02);
    EXPECT_EQ(flow.crossings, 0);
    EXPECT_LT(flow.deepest, 0.05f);
    RecordProperty("relative_speed", std::to_string(speed));
    RecordProperty("slow_share", std::to_string(slow));
    RecordProperty("deepest_overlap", std::to_string(flow.deepest));
}

TEST(Crowd, MovesAsLegsCan) {
    World w = make_world(street(), 0);
    auto made =
        populate(w.ground, surroundings_of(w.ground), {}, *w.mesh, *w.workers, 150, std::vector<Folk>(4), 2);
    ASSERT_TRUE(made);
    w.crowd = std::move(*made);
    int samples = 0, askew = 0, jumps = 0;
    auto before = w.crowd.motion.velocity;
    auto rate = w.crowd.motion.turn_rate;
    auto place = w.crowd.motion.position;
    for (int k = 0; k < 60 * 60; ++k) {
        step(w);
        const Crowd& c = w.crowd;
        for (uint32_t i = 0; i < c.count; ++i) {
            ++samples;
            Vec2 v = c.motion.velocity[i];
            if (length(v) > 0.35f)
                askew += std::fabs(wrap_angle(heading_of(v) - c.motion.heading[i])) > 26 * k_radians;
            jumps += length(v - before[i]) > 5 * k_tick;
            ASSERT_LE(std::fabs(c.motion.turn_rate[i]), 2.6f);
            ASSERT_LE(std::fabs(c.motion.turn_rate[i] - rate[i]), 12 * k_tick);
            ASSERT_LT(length(on_ground(c.motion.position[i] - place[i])), 2.6f * k_tick);
            ASSERT_LE(std::fabs(c.motion.position[i].y - place[i].y), 0.121f);
        }
        before = c.motion.velocity;
        rate = c.motion.turn_rate;
        place = c.motion.position;
        ASSERT_EQ(outside(w), 0);
        ASSERT_LT(deepest_overlap_of_all(c), 0.05f);
    }
    EXPECT_LT(static_cast<double>(askew) / samples, 0.005);
    EXPECT_LT(static_cast<double>(jumps) / samples, 0.002);
}

TEST(Crowd, NobodyIsStuckOnTheStreetOrTheSteps) {
    for (bool stairs : {false, true}) {
        World w = make_world(stairs ? steps() : street(), 0);
        auto made = populate(w.ground, surroundings_of(w.ground), {}, *w.mesh, *w.workers, 80,
                             std::vector<Folk>(4), 3);
        ASSERT_TRUE(made);
        w.crowd = std::move(*made);
        std::vector<Vec2> anchor(80);
        std::vector<uint32_t> since(80, 0);
        for (uint32_t k = 0; k < 150 * 60; ++k) {
            step(w);
            for (uint32_t i = 0; i < 80; ++i) {
                Vec2 p = on_ground(w.crowd.motion.position[i]);
                if (length(p - anchor[i]) > 1) anchor[i] = p, since[i] = k;
                ASSERT_LT(k - since[i], 30 * 60u) << "walker " << i << " at " << p.x << " " << p.z;
            }
        }
        for (uint32_t i = 0; i < 80; ++i) EXPECT_GE(w.crowd.journeys[i].trip, 2u);
    }
}

// After Tobler's rule (see wish_on), however often one decides.
TEST(Crowd, SlopesAreWalkedAtTheirSpeed) {
    constexpr float k_rise = 0.3f, k_speed = 1.3f;
    Ground hill;
    add_quad(hill, {60, 60 * k_rise, 6}, {60, 60 * k_rise, -6}, {0, 0, -6}, {0, 0, 6}, Surface::sidewalk);
    index_ground(hill);
    World w = make_world(std::move(hill), 2);
    for (float from : {5.0f, 55.0f}) {
        Walker walker;
        float z = from < 30 ? -3.0f : 3.0f;
        walker.place = *nearest(*w.mesh, 0, {from, from * k_rise, z});
        walker.heading = from < 30 ? k_pi / 2 : -k_pi / 2;
        walker.preferred_speed = k_speed;
        walker.errand = Errand::arrive;
        uint32_t i = add_walker(w.crowd, surroundings_of(w.ground), walker);
        send_to(w.crowd, i, *nearest(*w.mesh, 0, {60 - from, (60 - from) * k_rise, z}));
    }
    for (int k = 0; k < 300; ++k) step(w);
    float up = w.crowd.motion.position[0].x, down = w.crowd.motion.position[1].x;
    for (int k = 0; k < 1200; ++k) step(w);
    EXPECT_NEAR((w.crowd.motion.position[0].x - up) / 20, k_speed * std::exp(-3.5f * k_rise), 0.03f);
    EXPECT_NEAR((down - w.crowd.motion.position[1].x) / 20, k_speed * std::exp(-3.5f * (k_rise - 0.1f)),
                0.03f);
}

// Two rooms of 8 x 16 m with a door of 1.6 m between them, in a wall 0.4 m thick.
Ground door() {
    constexpr float k_room = 8, k_wall = 0.2f, k_half = 0.8f;
    Ground g;
    g.name = "door";
    add_floor(g, {-k_room, -k_room}, {-k_wall, k_room}, 0, Surface::plaza);
    add_floor(g, {k_wall, -k_room}, {k_room, k_room}, 0, Surface::plaza);
    add_floor(g, {-k_wall, -k_half}, {k_wall, k_half}, 0, Surface::plaza);
    for (float side : {-1.0f, 1.0f}) {
        Vec2 low{-k_wall, side < 0 ? -k_room : k_half}, high{k_wall, side < 0 ? -k_half : k_room};
        add_wall(g, {high.x, 0, low.z}, {low.x, 0, low.z}, 3);
        add_wall(g, {high.x, 0, high.z}, {high.x, 0, low.z}, 3);
        add_wall(g, {low.x, 0, high.z}, {high.x, 0, high.z}, 3);
        add_wall(g, {low.x, 0, low.z}, {low.x, 0, high.z}, 3);
    }
    index_ground(g);
    return g;
}

// A plaza of 24 x 24 m round a block of 4 x 4 m.
Ground round_a_block() {
    Ground g;
    g.name = "block";
    add_floor(g, {-12, -12}, {12, -2}, 0, Surface::plaza);
    add_floor(g, {-12, 2}, {12, 12}, 0, Surface::plaza);
    add_floor(g, {-12, -2}, {-2, 2}, 0, Surface::plaza);
    add_floor(g, {2, -2}, {12, 2}, 0, Surface::plaza);
    add_wall(g, {2, 0, -2}, {-2, 0, -2}, 3);
    add_wall(g, {2, 0, 2}, {2, 0, -2}, 3);
    add_wall(g, {-2, 0, 2}, {2, 0, 2}, 3);
    add_wall(g, {-2, 0, -2}, {-2, 0, 2}, 3);
    index_ground(g);
    return g;
}

// Walkers of all sizes who go to and fro between places on two sides; every pair is looked at every tick.
void go_to_and_fro(Ground ground, uint32_t count,
                   const std::function<Vec2(uint32_t, bool, float, float)>& place) {
    constexpr uint32_t k_seconds = 180;
    std::string name = ground.name;
    World w = make_world(std::move(ground), count, 1);
    auto number = [](uint32_t i, uint32_t trip, uint32_t k) {
        return random_unit({7, i, trip, Purpose::spawn}, k);
    };
    auto goal = [&](uint32_t i, uint32_t trip, bool far) {
        Vec2 p = place(i, far, number(i, trip, 0), number(i, trip, 1));
        return on_mesh(w, p.x, p.z);
    };
    std::vector<uint32_t> trips(count), since(count);
    std::vector<bool> far(count);
    for (uint32_t i = 0; i < count; ++i) {
        Walker walker;
        walker.errand = Errand::arrive;
        walker.radius = 0.18f + 0.09f * number(i, 0, 2);
        walker.preferred_speed = 0.8f + 0.7f * number(i, 0, 3);
        far[i] = i % 2 == 0;
        for (uint32_t k = 100; walker.place.polygon == 0; ++k) {
            NavPoint p = goal(i, k, far[i]);
            if (has_room(w.crowd, p.position, walker.radius)) walker.place = p;
        }
        add_walker(w.crowd, surroundings_of(w.ground), walker);
        far[i] = !far[i];
        send_to(w.crowd, i, goal(i, 0, far[i]));
    }
    float deepest = -1;
    uint32_t longest = 0;
    for (uint32_t tick = 0; tick < k_seconds * 60; ++tick) {
        step(w);
        deepest = std::max(deepest, deepest_overlap_of_all(w.crowd));
        for (uint32_t i = 0; i < count; ++i) {
            longest = std::max(longest, tick - since[i]);
            if (!has_arrived(w.crowd, i)) continue;
            since[i] = tick;
            far[i] = !far[i];
            send_to(w.crowd, i, goal(i, ++trips[i], far[i]));
        }
    }
    EXPECT_LT(deepest, 0.05f) << name;
    for (uint32_t i = 0; i < count; ++i) EXPECT_GE(trips[i], 1u) << name << ": walker " << i << " is stuck";
    testing::Test::RecordProperty(name + "_deepest", std::to_string(deepest));
    testing::Test::RecordProperty(name + "_longest_trip", std::to_string(longest / 60));
}

TEST(Crowd, NobodyIsAGhostAtADoor) {
    go_to_and_fro(door(), 10, [](uint32_t, bool far, float u, float v) {
        return Vec2{far ? 3 + u * 4 : -3 - u * 4, -6 + 12 * v};
    });
}

TEST(Crowd, NobodyIsAGhostInCounterflow) {
    go_to_and_fro(corridor(40, 2), 16, [](uint32_t, bool far, float u, float v) {
        return Vec2{far ? 35 + u * 4 : 1 + u * 4, v - 0.5f};
    });
}

TEST(Crowd, NobodyIsAGhostRoundABlock) {
    go_to_and_fro(round_a_block(), 80, [](uint32_t i, bool far, float u, float v) {
        Vec2 p{far ? 4 + u * 7 : -4 - u * 7, -11 + 22 * v};
        return i % 4 < 2 ? p : Vec2{p.z, p.x};
    });
}

// A path of more corners than are kept: it goes on by another without a halt, and arrives at the goal alone.
TEST(Crowd, ArrivesAtTheEndOfAPathThatWasCut) {
    constexpr int k_rows = 24;
    constexpr float k_long = 8, k_pitch = 3, k_wide = 2;
    Ground g;
    for (int row = 0; row < k_rows; ++row) {
        float z = static_cast<float>(row) * k_pitch, x = row % 2 ? 0 : k_long - k_wide;
        add_floor(g, {0, z}, {k_long, z + k_wide}, 0, Surface::sidewalk);
        if (row + 1 < k_rows) add_floor(g, {x, z + k_wide}, {x + k_wide, z + k_pitch}, 0, Surface::sidewalk);
    }
    index_ground(g);
    World w = make_world(std::move(g), 1);
    float end = (k_rows - 1) * k_pitch + 1;
    uint32_t i = add(w, 1, 1, 0, 1, end, 1.9f);
    int halts = 0;
    for (int k = 0; k < 300 * 60 && !has_arrived(w.crowd, i); ++k) {
        step(w);
        if (has_arrived(w.crowd, i)) {
            EXPECT_LT(length(on_ground(w.crowd.motion.position[i]) - Vec2{1, end}), 1);
        } else if (k > 8) {
            halts += w.crowd.decision.wanted[i] == Vec2{0, 0};
        }
    }
    EXPECT_TRUE(has_arrived(w.crowd, i));
    EXPECT_EQ(halts, 0);
}

TEST(Crowd, WhoIsSentForgetsTheErrandBefore) {
    World w = make_world(square(30), 1);
    uint32_t i = add(w, 0, 0, 0, 5, 5);
    Journey& j = w.crowd.journeys[i];
    j.facing = {1, 0};
    j.stay = {20, 60};
    j.insists_since = 5;
    j.stuck = 3;
    send_to(w.crowd, i, on_mesh(w, -5, 5));
    EXPECT_EQ(j.facing, (Vec2{0, 0}));
    EXPECT_EQ(j.stay.most, 0);
    EXPECT_EQ(j.insists_since, k_never);
    EXPECT_EQ(j.stuck, 0);
    EXPECT_FALSE(has_arrived(w.crowd, i));
}

// As where the ground under one was taken from the mesh: it waits, and goes as soon as there is a path.
TEST(Crowd, WhoFindsNoPathAsksAgain) {
    World w = make_world(square(30), 1);
    uint32_t i = add(w, 0, 0, 0, 8, 0);
    uint32_t polygon = w.crowd.motion.polygon[i];
    w.crowd.motion.polygon[i] = 0;
    for (int k = 0; k < 120; ++k) step(w);
    EXPECT_NE(w.crowd.journeys[i].path_due, PathDue::no);
    w.crowd.motion.polygon[i] = polygon;
    for (int k = 0; k < 1200; ++k) step(w);
    EXPECT_TRUE(has_arrived(w.crowd, i));
}

TEST(Crowd, WhoseGoalIsGoneGoesElsewhere) {
    World w = make_world(square(60), 1);
    uint32_t i = add(w, 0, 0, 0, 8, 0);
    Journey& j = w.crowd.journeys[i];
    j.errand = Errand::wander;
    j.goal.polygon = 0;
    for (int k = 0; k < 180; ++k) step(w);
    EXPECT_NE(j.goal.polygon, 0u);
    EXPECT_GT(length(on_ground(w.crowd.motion.position[i])), 0.5f);
}

TEST(Crowd, StepAllocatesNothing) {
    World w = make_world(street(), 0);
    auto made =
        populate(w.ground, surroundings_of(w.ground), {}, *w.mesh, *w.workers, 200, std::vector<Folk>(4), 4);
    ASSERT_TRUE(made);
    w.crowd = std::move(*made);
    size_t before = allocations();
    for (int k = 0; k < 1200; ++k) step(w);
    EXPECT_EQ(allocations() - before, 0u);
    uint32_t trips = 0;
    for (uint32_t i = 0; i < 200; ++i) trips = std::max(trips, w.crowd.journeys[i].trip);
    EXPECT_GE(trips, 2u) << "no path was sought";
}

TEST(Crowd, TheSameOnAnyNumberOfThreads) {
    uint64_t expected = 0;
    for (int threads : {1, 2, 7}) {
        World w = make_world(street(), 0, threads);
        auto made = populate(w.ground, surroundings_of(w.ground), {}, *w.mesh, *w.workers, 200,
                             std::vector<Folk>(4), 4);
        ASSERT_TRUE(made);
        w.crowd = std::move(*made);
        for (int k = 0; k < 600; ++k) step(w);
        uint64_t hash = hash_crowd(w.crowd);
        if (threads == 1) expected = hash;
        EXPECT_EQ(hash, expected) << threads << " threads";
    }
}

}  // namespace
}  // namespace flaneur
