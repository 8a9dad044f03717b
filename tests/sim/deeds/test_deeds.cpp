// People who carry, open doors and climb: bodies, weights, heights.
#include <gtest/gtest.h>

#include <cstring>

#include "tests/sim/allocations.h"
#include "tests/sim/deeds/watch.h"

namespace flaneur {
namespace {

using What = Deed::What;

// Seven years to grown up; the old are as tall as the grown.
constexpr float k_heights[] = {1.22f, 1.45f, 1.66f, 1.78f, 1.93f};

Deeds doing(DoerPlan plan, Things things, Body body, uint64_t seed) {
    return make_deeds({std::move(plan)}, std::move(things), level_ground(), {body}, seed);
}
Deeds doing(DoerPlan plan, Things things, float height, uint64_t seed) {
    return doing(std::move(plan), std::move(things), standard_body(height), seed);
}

// As tall, and half as big again about the belly.
Body heavy_body(float height) {
    Body body = standard_body(height);
    body.girth = girth_of(body);
    body.girth.hip *= 1.2f, body.girth.belly *= 1.5f, body.girth.back *= 1.2f, body.girth.chest *= 1.25f;
    return body;
}

DeedWatch watch(Deeds& d, uint64_t seed, uint32_t ticks) {
    DeedWatch w;
    uint32_t done = 0, since = 0;
    for (uint32_t tick = 0; tick < ticks; ++tick) {
        step_deeds(d, seed, tick);
        see(d, 0, tick, w);
        since = d.doers[0].done == done ? since + 1 : 0, done = d.doers[0].done;
        EXPECT_LT(since, 20 * k_ticks_a_second) << "no deed takes for ever";
        if (since >= 20 * k_ticks_a_second) break;
    }
    return w;
}

std::string told(const DeedWorst& w) { return w.what + " at tick " + std::to_string(w.tick); }

Deeds carrying(float height, float mass, float top, uint64_t seed) {
    const float k = std::min(height / 1.75f, 1.0f);
    Things t;
    t.shelves = {{{0, 2}, top, 0, top > 0 ? 0.04f : 0}, {{0.6f, -2}, 0.6f, k_pi, 0.04f}};
    t.parcels = {{{0.2f * k, 0.15f * k, 0.15f * k}, mass, 1}};
    DoerPlan plan;
    plan.round = {{What::take, 1, {}}, {What::put, 0, {}}, {What::take, 0, {}}, {What::put, 1, {}}};
    return doing(plan, t, height, seed);
}

TEST(Deeds, BoxesAreHeldAndTouchNothingElse) {
    uint64_t seed = 1;
    for (const float height : k_heights)
        for (const float mass : {2.0f, 10.0f, 18.0f})
            for (const float top : {0.0f, 0.45f, 0.75f, 1.0f}) {
                if ((height < 1.6f && mass > 2) || top > 0.75f * height) continue;
                SCOPED_TRACE(testing::Message()
                             << height << " m, " << mass << " kg, " << top << " m, seed " << seed);
                Deeds d = carrying(height, mass, top, seed);
                const DeedWatch w = watch(d, seed++, 30 * k_ticks_a_second);
                EXPECT_LT(w.palms.value, 0.005f) << told(w.palms);
                EXPECT_LT(w.into.value, 0.02f) << told(w.into);
                EXPECT_LT(w.slides.value, 0.005f) << told(w.slides);
                EXPECT_LT(w.beyond.value, 2) << told(w.beyond);
                EXPECT_LT(w.fastest.value, 21) << told(w.fastest);
            }
}

// The speed of a reaching hand has one hump, about half-way.
TEST(Deeds, HandsReachWithABellShapedSpeed) {
    for (const float height : k_heights)
        for (const float top : {0.0f, 0.75f}) {
            Deeds d = carrying(height, 2, top, 3);
            std::vector<float> speeds;
            Vec3 before{};
            for (uint32_t tick = 0; tick < 40 * k_ticks_a_second && d.doers[0].done < 3; ++tick) {
                step_deeds(d, 3, tick);
                const Vec3 hand = joint_at(d, 0, left_hand);
                if (d.doers[0].done == 2 && d.doers[0].stage == DoerStage::reach)
                    speeds.push_back(length(hand - before));
                before = hand;
            }
            ASSERT_GT(speeds.size(), 30u);
            const auto peak = std::ranges::max_element(speeds);
            const float at = static_cast<float>(peak - speeds.begin()) / static_cast<float>(speeds.size());
            EXPECT_GT(at, 0.25f) << height << ", " << top;
            EXPECT_LT(at, 0.75f) << height << ", " << top;
            EXPECT_LT(speeds.front(), 0.25f * *peak);
            EXPECT_LT(speeds.back(), 0.25f * *peak);
        }
}

TEST(Deeds, WhoCarriesMoreGoesSlowerAndLeansBackMore) {
    float speed = 9, lean = -1;
    for (const float load : {0.0f, 2.0f, 5.0f, 10.0f, 18.0f, 25.0f}) {
        const float v = laden_speed(1.25f, 72, load), back = laden_lean(72, 1.78f, load, 0.3f);
        EXPECT_LT(v, speed) << load;
        EXPECT_GT(back, lean) << load;
        speed = v, lean = back;
    }
    EXPECT_NEAR(laden_speed(1.25f, 72, 0), 1.25f, 1e-4f);
    EXPECT_GT(speed, 0.4f);
    EXPECT_LT(lean, 15 * k_radians);
    // And so they do: the same way in more steps.
    uint32_t ticks[2] = {};
    for (const int heavy : {0, 1}) {
        Deeds d = carrying(1.78f, heavy ? 18.0f : 2.0f, 0.75f, 1);
        for (uint32_t tick = 0; d.doers[0].done < 2; ++tick) {
            step_deeds(d, 1, tick);
            ticks[heavy] += d.doers[0].done == 1 && d.doers[0].stage == DoerStage::go;
        }
    }
    EXPECT_GT(ticks[1], ticks[0] + 15);
}

// Who has lifted something and goes on with it is turned to where it goes about as soon as people are.
TEST(Deeds, TurnsAfterALiftTakeTwoSeconds) {
    for (const float height : k_heights)
        for (const float mass : {2.0f, 10.0f}) {
            Deeds d = carrying(height, mass, 0.45f, 3);
            uint32_t since = 0, turns = 0;
            for (uint32_t tick = 0; tick < 60 * k_ticks_a_second; ++tick) {
                const DoerStage was = d.doers[0].stage;
                step_deeds(d, 3, tick);
                const Doer& doer = d.doers[0];
                if (was == DoerStage::act && doer.stage == DoerStage::leave) since = 1;
                if (since == 0) continue;
                ASSERT_LT(since++, 150u) << height << " m, " << mass << " kg";
                const Spot goal = before_shelf(d, 0, d.things.shelves[deed_of(d, 0).thing]);
                const Vec2 way = goal.at - on_ground(doer.position);
                if (doer.stage != DoerStage::go ||
                    std::fabs(wrap_angle(heading_of(way) - doer.motion.heading)) > 0.6f)
                    continue;
                since = 0, ++turns;
            }
            EXPECT_GE(turns, 3u);
        }
}

Deeds at_a_door(const Body& body, bool left, uint64_t seed) {
    Things t;
    SwingDoor door;
    door.hinge = {left ? 0.475f : -0.475f, 0};
    door.hinge_left = left;
    t.doors = {door};
    DoerPlan plan;
    plan.at = {0, -2};
    plan.speed = 1.25f * std::sqrt(body.height / 1.75f);
    plan.round = {
        {What::push, 0, {}}, {What::walk, 0, {0, 2.6f}}, {What::pull, 0, {}}, {What::walk, 0, {0, -2.6f}}};
    return doing(plan, t, body, seed);
}

TEST(Deeds, AHandStaysOnTheHandleAndTheLeafOffTheBody) {
    uint64_t seed = 1;
    for (const float height : k_heights)
        for (const int variant : {0, 1, 2, 3, 4, 5, 6, 7}) {
            const bool left = variant % 2 != 0, heavy = variant % 4 > 1;
            SCOPED_TRACE(testing::Message()
                         << height << " m, hinge " << left << ", heavy " << heavy << ", seed " << seed);
            Deeds d = at_a_door(heavy ? heavy_body(height) : standard_body(height), left, seed);
            float widest = 0;
            const DeedWatch w = watch(d, seed++, 30 * k_ticks_a_second);
            EXPECT_LT(w.palms.value, height < 1.4f ? 0.03f : 0.005f) << told(w.palms);
            EXPECT_LT(w.into.value, 0.03f) << told(w.into);
            EXPECT_LT(w.beyond.value, 2) << told(w.beyond);
            EXPECT_LT(w.fastest.value, 21) << told(w.fastest);
            EXPECT_GE(d.doers[0].done, 6u);
            for (uint32_t tick = 0; tick < 400; ++tick) {
                step_deeds(d, seed, tick);
                widest = std::max(widest, d.leaves[0].angle);
            }
            EXPECT_GT(widest, 1.1f) << "it opens";
            d.plans[0].round = {{What::walk, 0, {0, 9}}};
            d.doers[0].deed = 0, d.doers[0].has = 0;
            for (uint32_t tick = 0; tick < 420; ++tick) step_deeds(d, seed, tick);
            EXPECT_EQ(d.leaves[0].angle, 0) << "and falls shut";
        }
}

TEST(Deeds, WallsAreClimbedWithHandsAndFeetWhereTheyHold) {
    uint64_t seed = 1;
    for (const float height : k_heights)
        for (const float high : {0.5f, 0.65f, 0.8f, 0.95f, 1.1f}) {
            if (high > k_highest_wall * leg_length(standard_body(height))) continue;
            SCOPED_TRACE(testing::Message() << height << " m, wall " << high << " m, seed " << seed);
            LowWall wall;
            wall.height = high, wall.thick = 0.28f, wall.heading = 0.4f;
            Things t;
            t.walls = {wall};
            DoerPlan plan;
            const Vec2 way = heading_direction(wall.heading);
            plan.at = way * -2;
            plan.heading = wall.heading;
            plan.round = {{What::climb, 0, {}},
                          {What::walk, 0, way * 2.6f},
                          {What::climb, 0, {}},
                          {What::walk, 0, way * -2.6f}};
            Deeds d = doing(plan, t, height, seed);
            const DeedWatch w = watch(d, seed++, 26 * k_ticks_a_second);
            EXPECT_GE(d.doers[0].done, 3u);
            EXPECT_LT(w.palms.value, 0.035f) << told(w.palms);
            EXPECT_LT(w.into.value, 0.035f) << told(w.into);
            EXPECT_LT(w.crossed.value, 0.04f) << told(w.crossed);
            EXPECT_LT(w.slides.value, 0.005f) << told(w.slides);
            EXPECT_LT(w.beyond.value, 2) << told(w.beyond);
            EXPECT_LT(w.fastest.value, 21) << told(w.fastest);
        }
}

Deeds all_of_them() {
    Deeds box = carrying(1.7f, 10, 0.75f, 1), door = at_a_door(standard_body(1.7f), true, 1);
    Things t = box.things;
    t.doors = door.things.doors;
    t.doors[0].hinge = {8, 0};
    LowWall wall;
    wall.at = {-8, 0};
    t.walls = {wall};
    DoerPlan climber;
    climber.at = {-8, -2};
    climber.round = {{What::climb, 0, {-8, 0}},
                     {What::walk, 0, {-8, 2}},
                     {What::climb, 0, {-8, 0}},
                     {What::walk, 0, {-8, -2}}};
    DoerPlan through = door.plans[0];
    through.at = {7.5f, -2};
    through.round[1].at = {7.5f, 2.6f}, through.round[3].at = {7.5f, -2.6f};
    return make_deeds({box.plans[0], through, climber}, t, level_ground(), {standard_body(1.7f)}, 7);
}

TEST(Deeds, ATickAllocatesNothing) {
    Deeds d = all_of_them();
    for (uint32_t tick = 0; tick < 10; ++tick) step_deeds(d, 7, tick);
    const size_t before = allocations();
    for (uint32_t tick = 10; tick < 1500; ++tick) step_deeds(d, 7, tick);
    EXPECT_EQ(allocations() - before, 0u);
}

// What is kept of a state is all that the next tick reads.
TEST(Deeds, GoOnFromWhatAStateKeeps) {
    for (const uint32_t at : {400u, 700u, 1130u}) {
        Deeds a = all_of_them(), b = all_of_them();
        for (uint32_t tick = 0; tick < at; ++tick) step_deeds(a, 7, tick);
        b.doers = a.doers, b.parcels = a.parcels, b.leaves = a.leaves;
        b.gait.blocks = a.gait.blocks, b.whole = a.whole, b.poses = a.poses;
        forget_previous(b);
        for (uint32_t tick = at; tick < at + 300; ++tick) {
            step_deeds(a, 7, tick), step_deeds(b, 7, tick);
            for (size_t i = 0; i < a.doers.size(); ++i)
                for (size_t j = 0; j < k_joint_count; ++j)
                    ASSERT_EQ(joint_at(a, i, static_cast<Joint>(j)), joint_at(b, i, static_cast<Joint>(j)));
            ASSERT_EQ(std::memcmp(a.parcels.data(), b.parcels.data(), a.parcels.size() * sizeof a.parcels[0]),
                      0);
        }
    }
}

TEST(Deeds, GoOnForTenMinutes) {
    Deeds d = all_of_them();
    uint32_t done[3] = {}, since[3] = {};
    for (uint32_t tick = 0; tick < 600 * k_ticks_a_second; ++tick) {
        step_deeds(d, 7, tick);
        for (size_t i = 0; i < 3; ++i) {
            since[i] = d.doers[i].done == done[i] ? since[i] + 1 : 0, done[i] = d.doers[i].done;
            ASSERT_LT(since[i], 15 * k_ticks_a_second) << what_it_does(d, i) << " at tick " << tick;
        }
    }
    for (const uint32_t n : done) EXPECT_GT(n, 60u);
}

TEST(Deeds, AreToldInWords) {
    Deeds d = all_of_them();
    std::string all;
    for (uint32_t tick = 0; tick < 1500; ++tick) {
        step_deeds(d, 7, tick);
        for (size_t i = 0; i < 3; ++i) {
            const std::string words = what_it_does(d, i);
            ASSERT_FALSE(words.empty());
            if (all.find(words) == std::string::npos) all += words + "; ";
        }
    }
    for (const char* words : {"lifts 10 kg", "carries 10 kg", "puts 10 kg down", "pushes the door open",
                              "pulls the door open", "climbs over a wall"})
        EXPECT_NE(all.find(words), std::string::npos) << words << " of " << all;
}

}  // namespace
}  // namespace flaneur
