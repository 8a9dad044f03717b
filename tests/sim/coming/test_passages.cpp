// People come in and leave out of sight: behind the walls of houses, and else little by little.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "sim/base/math.h"
#include "sim/coming/passages.h"
#include "sim/state.h"
#include "sim/world.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

constexpr float k_wall = 30;  // metres from the middle of the square

// On a square with walls all round: doors in two of them, which are said to face so far off the way in, edges
// at the others.
std::unique_ptr<World> made(int threads, bool has_doors, bool has_prams = false, float off = 0) {
    WorldOptions options;
    options.walkers = 120;
    options.threads = threads;
    options.leaving = k_usual_leaving;
    options.kinds = {Kind{standard_body(1.75f)}};
    if (has_prams) {
        options.kinds.push_back({standard_body(1.7f), 0.3f});
        options.kinds[1].body.pram = standard_pram(options.kinds[1].body);
    }
    for (int k = -2; k <= 2; ++k)
        for (const float side : {-1.0f, 1.0f}) {
            const float along = static_cast<float>(k) * 11;
            if (has_doors)
                options.destinations.push_back({DestinationKind::door,
                                                {along, 0, side * 29.3f},
                                                heading_direction((side > 0 ? 0 : k_pi) + off),
                                                1});
            else
                options.destinations.push_back({DestinationKind::edge, {side * 28, 0, along}, {side, 0}, 1});
        }
    auto world = make_world(std::make_shared<const Ground>(square(2 * k_wall)), options);
    EXPECT_TRUE(world) << world.error().message;
    return std::move(*world);
}

struct Seen {
    Vec3 place;
    float presence = 1;
};

float presence_of(const World& w, uint32_t i) {
    const Passage* passage = passage_of(w.crowd, i);
    return passage ? presence(*passage, 1) : 1;
}

// By who it is: slots are taken again.
std::map<std::pair<uint32_t, uint32_t>, Seen> seen(const World& w) {
    std::map<std::pair<uint32_t, uint32_t>, Seen> all;
    for (const WalkerId id : walkers(w))
        all[{id.index, id.generation}] = {w.crowd.motion.position[id.index], presence_of(w, id.index)};
    return all;
}

float depth_of(Vec3 place) { return std::max(std::fabs(place.x), std::fabs(place.z)) - k_wall; }

// How those who come and go do so, and that nobody is seen in one tick and not in the next, or somewhere
// else.
struct Told {
    uint32_t came_by_door = 0, left_by_door = 0, appeared = 0, vanished = 0;
};
Told watch(World& w, uint32_t ticks) {
    constexpr float k_hidden = 0.9f;  // metres behind a wall
    constexpr float k_little = 1.0f / 16;
    Told told;
    auto before = seen(w);
    for (uint32_t tick = 0; tick < ticks; ++tick) {
        step(w);
        auto now = seen(w);
        for (const auto& [who, is] : now) {
            const auto was = before.find(who);
            if (was == before.end()) {
                const bool is_behind = depth_of(is.place) > k_hidden;
                EXPECT_TRUE(is_behind || is.presence <= k_little) << "comes in sight, tick " << tick;
                ++(is_behind ? told.came_by_door : told.appeared);
            } else {
                EXPECT_LT(length(is.place - was->second.place), 0.05f) << "jumps, tick " << tick;
                EXPECT_LE(std::fabs(is.presence - was->second.presence), k_little) << "tick " << tick;
            }
        }
        for (const auto& [who, was] : before) {
            if (now.contains(who)) continue;
            const bool is_behind = depth_of(was.place) > k_hidden;
            EXPECT_TRUE(is_behind || was.presence <= k_little) << "is gone in sight, tick " << tick;
            ++(is_behind ? told.left_by_door : told.vanished);
        }
        for (const Passage& p : w.crowd.passages) {
            if (!is_by_door(p)) continue;
            const Vec3 place = w.crowd.motion.position[p.walker];
            if (depth_of(place) > -0.25f) {
                EXPECT_LT(std::fabs(aside_in(p.door, on_ground(place))), 0.45f);
                EXPECT_TRUE(is_in_doorway(w.crowd, p.walker));
            }
            EXPECT_FLOAT_EQ(presence(p, 0.5f), 1);
        }
        EXPECT_LT(deepest_overlap(w.crowd), 0.05f);
        before = std::move(now);
        if (testing::Test::HasFailure()) break;
    }
    return told;
}

TEST(Passages, ByDoorsPeopleComeAndGoBehindTheWall) {
    auto w = made(2, true);
    const Told told = watch(*w, 60 * 120);
    EXPECT_GT(told.left_by_door, 40u);
    EXPECT_GT(told.came_by_door, 40u);
    EXPECT_EQ(told.appeared, 0u);
    EXPECT_LT(told.vanished, told.left_by_door / 10);  // who did not get before its door
}

// As doors of maps do, on walls that are not quite where they were drawn.
TEST(Passages, ADoorThatIsSaidToFaceAskewIsGoneThroughToo) {
    auto w = made(1, true, false, 0.55f);
    const Told told = watch(*w, 60 * 120);
    EXPECT_GT(told.left_by_door, 40u);
    EXPECT_LT(told.vanished, told.left_by_door / 10);
}

TEST(Passages, WhereNoWallHidesThemTheyComeIntoSightLittleByLittle) {
    auto w = made(1, false);
    const Told told = watch(*w, 60 * 120);
    EXPECT_EQ(told.left_by_door + told.came_by_door, 0u);
    EXPECT_GT(told.appeared, 40u);
    EXPECT_GT(told.vanished, 40u);
}

TEST(Passages, PramsDoNotGoThroughDoors) {
    auto w = made(2, true, true);
    const Told told = watch(*w, 60 * 90);
    EXPECT_GT(told.vanished, 3u);
    EXPECT_GT(told.left_by_door, 10u);
}

// Feet behind the door stand as high as those before it, and nobody falls or jumps there.
TEST(Passages, TheFloorGoesOnBehindTheDoor) {
    auto w = made(1, true);
    uint32_t looked = 0;
    for (uint32_t tick = 0; tick < 60 * 60; ++tick) {
        step(*w);
        for (const Passage& p : w->crowd.passages) {
            if (!is_by_door(p)) continue;
            EXPECT_NEAR(w->crowd.motion.position[p.walker].y, 0, 1e-4f);
            const float hips_up = joint_between(*w, p.walker, hips, 1).position.y;
            EXPECT_GT(hips_up, 0.75f) << "tick " << tick;  // as low as a long first step
            EXPECT_LT(hips_up, 1.1f) << "tick " << tick;
            for (const Joint toes : {left_toes, right_toes})
                EXPECT_LT(joint_between(*w, p.walker, toes, 1).position.y, 0.35f) << "tick " << tick;
            ++looked;
        }
    }
    EXPECT_GT(looked, 1000u);
}

TEST(Passages, OneAtATimeGoesThroughADoor) {
    auto w = made(2, true);
    for (uint32_t tick = 0; tick < 60 * 90; ++tick) {
        step(*w);
        const auto& all = w->crowd.passages;
        for (size_t a = 0; a < all.size(); ++a)
            for (size_t b = 0; b < a; ++b)
                if (is_by_door(all[a]) && is_by_door(all[b])) {
                    ASSERT_GT(length(all[a].door.at - all[b].door.at), 2.9f);
                }
    }
}

TEST(Passages, OneStateOnAnyNumberOfThreadsAndTakenBack) {
    std::vector<uint64_t> hashes;
    for (const int threads : {1, 2, 7}) {
        auto w = made(threads, true, true);
        for (int i = 0; i < 60 * 40; ++i) step(*w);
        while (w->crowd.passages.size() < 2) step(*w);
        std::vector<std::byte> bytes;
        save_state(*w, bytes);
        for (int i = 0; i < 200; ++i) step(*w);
        hashes.push_back(hash_world(*w));
        auto other = made(threads, true, true);
        ASSERT_TRUE(load_state(*other, bytes));
        for (int i = 0; i < 200; ++i) step(*other);
        EXPECT_EQ(hash_world(*other), hashes.back());
    }
    EXPECT_EQ(hashes[0], hashes[1]);
    EXPECT_EQ(hashes[0], hashes[2]);
}

// Who is sent elsewhere in the door comes out again, and who is half gone is whole again.
TEST(Passages, WhoIsSentElsewhereComesBack) {
    for (const bool has_doors : {true, false}) {
        auto w = made(1, has_doors);
        WalkerId who{};
        auto is_half_gone = [&] {
            for (const Passage& p : w->crowd.passages) {
                const bool is_out =
                    p.kind == Passage::Kind::out && depth_of(w->crowd.motion.position[p.walker]) > 0.3f;
                if (!is_out && !(p.kind == Passage::Kind::vanish && p.shown < 16)) continue;
                who = {p.walker, w->crowd.slots.generation[p.walker]};
                return true;
            }
            return false;
        };
        while (!is_half_gone()) step(*w);
        ASSERT_TRUE(send_to(*w, who, {0, 0, 0}));
        float last = presence_of(*w, who.index);
        for (int i = 0; i < 60 * 5; ++i) {
            step(*w);
            ASSERT_TRUE(is_alive(*w, who));
            ASSERT_NEAR(presence_of(*w, who.index), last, 1.0f / 16);
            last = presence_of(*w, who.index);
        }
        EXPECT_EQ(last, 1);
        EXPECT_FALSE(passage_of(w->crowd, who.index));
        EXPECT_LT(depth_of(w->crowd.motion.position[who.index]), -0.25f);
    }
}

// One cannot step aside in a door: not to get past those who stand before it either, some with a pram.
TEST(Passages, WhoComesInGoesStraightOnTowardsThoseWhoStandThere) {
    Ground ground = square(2 * k_wall);
    index_ground(ground);
    WorldOptions options;
    options.capacity = 8;
    options.threads = 1;
    options.kinds = {Kind{standard_body(1.75f)}, {standard_body(1.7f)}};
    options.kinds[1].body.pram = standard_pram(options.kinds[1].body);
    for (int turn = 0; turn < 8; ++turn) {
        auto made = make_world_on(ground, options);
        ASSERT_TRUE(made) << made.error().message;
        World& w = **made;
        const auto door = door_at(w.around, {0, 0, 29.3f}, {0, 1});
        ASSERT_TRUE(door);
        const auto who = add_walker(w, {.place = Vec3{0, 0, 29.3f}, .heading = k_pi, .kind = 0});
        ASSERT_TRUE(who);
        for (const Vec2 stands : {Vec2{-2.89f, 28.56f}, {-1.35f, 28.8f}, {-1.93f, 28.93f}, {0.26f, 27.86f}})
            ASSERT_TRUE(add_walker(w, {.place = at_height(stands, 0), .kind = 0}));
        const float heading = static_cast<float>(turn) * (k_pi / 4);
        ASSERT_TRUE(add_walker(w, {.place = Vec3{-0.66f, 0, 28.28f}, .heading = heading, .kind = 1}));
        come_by_door(w.crowd, who->index, *door, 0);
        float deepest = 9;
        for (int tick = 0; tick < 60 * 12; ++tick) {
            step(w);
            const float depth = depth_of(w.crowd.motion.position[who->index]);
            ASSERT_LT(depth, deepest + 0.02f) << "turns back, tick " << tick << ", pram " << turn;
            deepest = std::min(deepest, depth);
        }
        EXPECT_FALSE(passage_of(w.crowd, who->index)) << "still in the door, pram " << turn;
    }
}

// Whom others keep from the door that it goes to is no longer in line before it: it makes way, gets before
// the door again and goes.
TEST(Passages, WhoIsHeldUpBeforeADoorLetsGoOfIt) {
    auto w = made(1, true);
    Crowd& c = w->crowd;
    WalkerId who{};
    auto is_before_a_door = [&] {
        for (const Passage& p : c.passages)
            if (who = {p.walker, c.slots.generation[p.walker]};
                p.kind == Passage::Kind::out && !is_in_doorway(c, p.walker))
                return true;
        return false;
    };
    while (!is_before_a_door()) step(*w);
    const uint32_t i = who.index;
    const Vec3 place = c.motion.position[i];
    const uint8_t tries = c.journeys[i].door_tries;
    int held = 0;
    for (; passage_of(c, i) && held < 60 * 10; ++held) {
        c.motion.position[i] = place;
        c.motion.velocity[i] = {0, 0};
        step(*w);
        ASSERT_TRUE(is_alive(*w, who));
    }
    EXPECT_GT(held, 60 * 6);
    EXPECT_LT(held, 60 * 10) << "is still in line";
    EXPECT_EQ(c.way_back[i].polygon, 0u);
    EXPECT_EQ(c.journeys[i].insists_since, k_never);
    EXPECT_EQ(c.journeys[i].door_tries, tries - 1);
    Vec3 last = place;
    for (int tick = 0; tick < 60 * 60 && is_alive(*w, who); ++tick) {
        last = c.motion.position[i];
        step(*w);
    }
    EXPECT_FALSE(is_alive(*w, who));
    EXPECT_GT(depth_of(last), 0.9f);
}

// A house at z = 5 whose front is `width` wide and that is `depth` deep, with ground before it.
Ground house(float width, float depth, float height = 3) {
    Ground ground;
    add_floor(ground, {-20, -20}, {20, 5}, 0, Surface::plaza);
    const float h = width / 2;
    add_wall(ground, {h, 0, 5}, {-h, 0, 5}, height);
    add_wall(ground, {-h, 0, 5}, {-h, 0, 5 + depth}, height);
    add_wall(ground, {-h, 0, 5 + depth}, {h, 0, 5 + depth}, height);
    add_wall(ground, {h, 0, 5 + depth}, {h, 0, 5}, height);
    index_ground(ground);
    return ground;
}

TEST(Passages, ADoorIsOneWhereAHouseHidesPeople) {
    auto door_of = [](const Ground& ground, Vec3 place, Vec2 facing) {
        return door_at(surroundings_of(ground), place, facing);
    };
    const Vec3 before{0, 0, 4.3f};
    const auto door = door_of(house(8, 6), before, {0, 1});
    ASSERT_TRUE(door);
    EXPECT_NEAR(door->at.z, 5, 1e-4f);
    EXPECT_NEAR(door->way.z, 1, 1e-4f);
    EXPECT_FALSE(door_of(house(8, 6), before, {0, -1})) << "looks away from it";
    EXPECT_FALSE(door_of(house(8, 6), before, {1, 0})) << "looks along it";
    EXPECT_FALSE(door_of(house(8, 6), {0, 0, 2}, {0, 1})) << "is too far";
    EXPECT_FALSE(door_of(house(8, 6), {3.8f, 0, 4.3f}, {0, 1})) << "is at a corner";
    EXPECT_FALSE(door_of(house(8, 1.2f), before, {0, 1})) << "is too thin";
    EXPECT_FALSE(door_of(house(8, 6, 1.5f), before, {0, 1})) << "is too low";
    Ground arcade = house(8, 6);
    add_floor(arcade, {-4, 5}, {4, 11}, 0, Surface::plaza);
    index_ground(arcade);
    EXPECT_FALSE(door_of(arcade, before, {0, 1})) << "people walk behind it";
    Ground square_of_grass = square(20);
    EXPECT_FALSE(door_of(square_of_grass, {0, 0, 0}, {0, 1})) << "there is no wall";
}

}  // namespace
}  // namespace flaneur
