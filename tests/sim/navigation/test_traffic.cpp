// Ways round where people crowd.
#include <gtest/gtest.h>

#include "sim/crowd/crowd.h"
#include "sim/navigation/traffic.h"
#include "sim/sim.h"
#include "sim/state.h"
#include "sim/world.h"
#include "tests/sim/allocations.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

// A field with a house in its middle, and lanes on both sides of it. From (-20, 3) to (20, 3) the way by the
// upper one is shorter.
Ground field() {
    Ground g = square(60);
    add_solid_box(g, {-9, 0, -22}, {9, 3, 22});
    index_ground(g);
    return g;
}

NavmeshPtr mesh_of(const Ground& ground) {
    NavmeshPtr mesh = std::move(build_navmesh(ground, {}, 1)).value();
    prepare_queries(*mesh, 1);
    return mesh;
}

struct Way {
    Vec3 corners[32];
    int count = 0;
    float highest = -100, lowest = 100;  // z
};

Way way_of(const Navmesh& mesh, const Traffic& traffic) {
    const auto from = nearest(mesh, 0, {-20, 0, 3}), to = nearest(mesh, 0, {20, 0, 3});
    Way way;
    way.count = find_path(mesh, traffic, 0, *from, *to, way.corners, 32, By::feet);
    for (int k = 0; k < way.count; ++k) {
        way.highest = std::max(way.highest, way.corners[k].z);
        way.lowest = std::min(way.lowest, way.corners[k].z);
    }
    return way;
}

// A throng where the shorter way passes.
void crowd_at(Traffic& t, const Navmesh& mesh, float low_z, float times) {
    for (float x = -8; x <= 8; x += 1)
        for (float z = low_z; z < low_z + 8; z += 1)
            if (const auto p = nearest(mesh, 0, {x, 0, z}, {0.4f, 1, 0.4f}))
                t.coming[number_of(mesh, p->polygon)] = times;
}

TEST(Traffic, TheWayLeadsRoundAThrongAndBackWhenItIsGone) {
    const NavmeshPtr mesh = mesh_of(field());
    Traffic traffic = make_traffic(*mesh);
    const Way free = way_of(*mesh, traffic);
    ASSERT_GT(free.count, 1);
    EXPECT_GT(free.highest, 21);
    EXPECT_GT(free.lowest, -5);

    crowd_at(traffic, *mesh, 22, 5);
    begin(traffic, *mesh);
    for (int k = 0; k < 50 && traffic.done > 0; ++k) {
        EXPECT_GT(way_of(*mesh, traffic).highest, 21) << "not before all is put in, " << k;
        go_on(traffic, *mesh, 0.05f);
    }
    EXPECT_EQ(traffic.done, 0u);
    const Way round = way_of(*mesh, traffic);
    EXPECT_LT(round.lowest, -21);
    EXPECT_LT(round.highest, 5);

    std::fill(traffic.coming.begin(), traffic.coming.end(), 1.0f);
    begin(traffic, *mesh);
    while (traffic.done > 0) go_on(traffic, *mesh, 1);
    EXPECT_GT(way_of(*mesh, traffic).highest, 21);
    EXPECT_FALSE(traffic.is_slow);
}

// A throng on a detour that is much longer still is not worth it.
TEST(Traffic, ALittleThrongIsNotWorthADetour) {
    const NavmeshPtr mesh = mesh_of(field());
    Traffic traffic = make_traffic(*mesh);
    crowd_at(traffic, *mesh, 22, 1.1f);
    begin(traffic, *mesh);
    while (traffic.done > 0) go_on(traffic, *mesh, 0.3f);
    EXPECT_GT(way_of(*mesh, traffic).highest, 21);
}

TEST(Traffic, IsTheSameWhereItIsTakenBackHalfWay) {
    const NavmeshPtr mesh = mesh_of(field());
    Traffic traffic = make_traffic(*mesh);
    crowd_at(traffic, *mesh, 22, 5);
    begin(traffic, *mesh);
    for (int k = 0; k < 9; ++k) go_on(traffic, *mesh, 0.05f);
    Traffic again = make_traffic(*mesh);
    again.slow = traffic.slow, again.coming = traffic.coming, again.done = traffic.done;
    restore(again, *mesh);
    for (Traffic* t : {&traffic, &again})
        while (t->done > 0) go_on(*t, *mesh, 0.05f);
    const Way a = way_of(*mesh, traffic), b = way_of(*mesh, again);
    ASSERT_EQ(a.count, b.count);
    for (int k = 0; k < a.count; ++k) EXPECT_EQ(a.corners[k], b.corners[k]);
    EXPECT_LT(a.lowest, -21);
}

TEST(Traffic, AMetreTakesAsLongAsWeidmannsPeopleDo) {
    EXPECT_EQ(slowness(0), 1);
    EXPECT_EQ(slowness(0.5f), 1);
    EXPECT_NEAR(slowness(1), 1.23f, 0.03f);
    EXPECT_NEAR(slowness(2), 2.1f, 0.1f);
    EXPECT_EQ(slowness(5), 5);
    EXPECT_EQ(slowness(100), 5);
}

TEST(Traffic, AllocatesNothingInATick) {
    const NavmeshPtr mesh = mesh_of(field());
    Traffic traffic = make_traffic(*mesh);
    for (const float times : {5.0f, 3.0f, 1.0f}) {
        crowd_at(traffic, *mesh, 22, times);
        const size_t before = allocations();
        begin(traffic, *mesh);
        while (traffic.done > 0) go_on(traffic, *mesh, 0.1f);
        EXPECT_EQ(allocations(), before) << times;
        EXPECT_EQ(traffic.is_slow, times > 1);
    }
}

// Those who set out while many stand in the shorter way take the longer one.
TEST(Traffic, PeopleGoRoundThoseWhoStandInTheWay) {
    WorldOptions options;
    options.capacity = 400;
    options.threads = 2;
    auto made = make_world(std::make_shared<const Ground>(field()), options);
    ASSERT_TRUE(made) << made.error().message;
    World& w = **made;
    uint32_t standing = 0;
    for (float x = -8; x <= 8; x += 0.7f)
        for (float z = 22.5f; z < 29.5f; z += 0.7f)
            standing += static_cast<bool>(add_walker(w, {.place = Vec3{x, 0, z}}));
    ASSERT_GT(standing, 150u);
    for (int tick = 0; tick < 26 * 60; ++tick) step(w);
    const auto late = add_walker(w, {.place = Vec3{-20, 0, 3}});
    ASSERT_TRUE(late) << late.error().message;
    ASSERT_TRUE(send_to(w, *late, {20, 0, 3}));
    float lowest = 0, highest = 0;
    for (int tick = 0; tick < 60 * 60 && !has_arrived(w, *late); ++tick) {
        step(w);
        lowest = std::min(lowest, motion_of(w, *late)->position.z);
        highest = std::max(highest, motion_of(w, *late)->position.z);
    }
    EXPECT_TRUE(has_arrived(w, *late));
    EXPECT_LT(lowest, -19);
    EXPECT_LT(highest, 5);
}

}  // namespace
}  // namespace flaneur
