// People come in and leave: their number is kept, nobody comes in on others, and all of it is one state.
#include <gtest/gtest.h>

#include "sim/coming/coming.h"
#include "sim/state.h"
#include "sim/world.h"
#include "tests/sim/allocations.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

// Doors along the walls, and edges in the corners.
std::vector<Destination> places() {
    std::vector<Destination> all;
    for (int k = -2; k <= 2; ++k)
        for (const float side : {-1.0f, 1.0f}) {
            const float along = static_cast<float>(k) * 11;
            all.push_back({DestinationKind::door, {along, 0, side * 29}, {0, side}, 1});
            all.push_back({DestinationKind::edge, {side * 29, 0, along}, {side, 0}, 1});
        }
    return all;
}

Kind pusher() {
    Kind kind{standard_body(1.7f), 0.2f};
    kind.body.pram = standard_pram(kind.body);
    return kind;
}

std::unique_ptr<World> made(int threads, WorldOptions options) {
    Ground ground = square(60);
    index_ground(ground);
    options.threads = threads;
    options.kinds = {Kind{standard_body(1.75f)}, pusher()};
    auto world = make_world(std::make_shared<const Ground>(std::move(ground)), options);
    EXPECT_TRUE(world) << world.error().message;
    return std::move(*world);
}

WorldOptions busy() {
    WorldOptions options;
    options.walkers = 150;
    options.destinations = places();
    options.leaving = k_usual_leaving;
    return options;
}

void run(World& w, uint32_t ticks) {
    for (uint32_t i = 0; i < ticks; ++i) step(w);
}

TEST(Coming, ThoseSentWaitForTheirPlaceToBeThereAgain) {
    Ground all = square(60), part = square(20);
    index_ground(all);
    index_ground(part);
    const Result<NavmeshPtr> whole = build_navmesh(all, {}, 1), small = build_navmesh(part, {}, 1);
    ASSERT_TRUE(whole && small);
    prepare_queries(**whole, 1);
    prepare_queries(**small, 1);
    const std::optional<NavPoint> from = nearest(**whole, 0, {25, 0, 25}, {1, 1, 1});
    const std::optional<NavPoint> to = nearest(**whole, 0, {0, 0, 0}, {1, 1, 1});
    ASSERT_TRUE(from && to);
    Coming coming;
    Entrant sent;
    sent.place = *from;
    sent.goal = *to;
    sent.sending = 0;
    coming.sent.entrants = {sent};
    change_mesh(coming, **small);
    EXPECT_EQ(coming.sent.entrants[0].place.polygon, 0u);
    change_mesh(coming, **whole);
    EXPECT_NE(coming.sent.entrants[0].place.polygon, 0u);
    EXPECT_EQ(coming.sent.entrants[0].place.position, from->position);
}

TEST(Coming, AsManyComeAsLeaveAndNobodyOnOthers) {
    auto w = made(2, busy());
    size_t allocated = 0;
    for (uint32_t i = 0; i < 60 * 120; ++i) {
        const size_t before = allocations();
        step(*w);
        allocated += allocations() - before;
        const ComingCount count = coming_count(*w);
        ASSERT_EQ(walkers(*w).size() + waiting(w->coming), 150u);
        ASSERT_EQ(kept_people(w->coming, w->crowd), 150u);
        ASSERT_EQ(count.left, count.came + waiting(w->coming));
        for (const uint32_t who : w->coming.arrivals) {
            ASSERT_TRUE(is_there(w->crowd, who));
            ASSERT_NE(w->crowd.motion.polygon[who], 0u);
        }
        ASSERT_LT(deepest_overlap(w->crowd), 0.05f) << "tick " << i;
    }
    EXPECT_EQ(allocated, 0u);
    EXPECT_GT(coming_count(*w).left, 60u);
    EXPECT_LT(waiting(w->coming), 15u);
}

TEST(Coming, NobodyByDefault) {
    WorldOptions options = busy();
    options.leaving = k_nobody_leaves;
    auto w = made(1, options);
    run(*w, 60 * 30);
    EXPECT_EQ(coming_count(*w).left, 0u);
    EXPECT_EQ(walkers(*w).size(), 150u);
}

TEST(Coming, OneStateOnAnyNumberOfThreads) {
    std::vector<uint64_t> hashes;
    for (const int threads : {1, 2, 7}) {
        auto w = made(threads, busy());
        run(*w, 60 * 75);
        EXPECT_GT(coming_count(*w).came, 10u);
        hashes.push_back(hash_world(*w));
    }
    EXPECT_EQ(hashes[0], hashes[1]);
    EXPECT_EQ(hashes[0], hashes[2]);
}

// Between decisions and at them, with people waiting at the only entrance.
TEST(Coming, SavedMidwayItGoesOnTheSameWay) {
    for (const uint32_t at : {1200u, 1201u, 1203u}) {
        WorldOptions options = busy();
        options.destinations.resize(4);
        options.sendings = {{{{{0, 0}}, {}}, {{{20, 20}}, {}}, 40, 1, 15, 25, 0}};
        options.capacity = 170;
        auto w = made(2, options);
        run(*w, at);
        EXPECT_GT(coming_count(*w).waiting, 0u);
        std::vector<std::byte> bytes;
        save_state(*w, bytes);
        run(*w, 600);
        const uint64_t end = hash_world(*w);
        auto other = made(3, options);
        ASSERT_TRUE(load_state(*other, bytes));
        run(*other, 600);
        EXPECT_EQ(hash_world(*other), end) << at;
        run(*w, 100);
        ASSERT_TRUE(load_state(*w, bytes));
        run(*w, 600);
        EXPECT_EQ(hash_world(*w), end) << at;
    }
}

// A square of three metres where thirty come in one after another, and a corner where they leave.
TEST(Coming, SentPeopleComeGoAndLeave) {
    WorldOptions options;
    options.capacity = 100;
    options.sendings = {
        {{{{-22, -22}, {-19, -22}, {-19, -19}, {-22, -19}}, {}}, {{{10, 10}}, {}}, 30, 1, 2, 32, 1.5f}};
    auto w = made(2, options);
    EXPECT_TRUE(walkers(*w).empty());
    run(*w, 60);
    EXPECT_TRUE(walkers(*w).empty()) << "before their time";
    uint32_t most = 0;
    for (int i = 0; i < 60 * 75; ++i) {
        step(*w);
        ASSERT_EQ(kept_people(w->coming, w->crowd), 0u);
        most = std::max(most, static_cast<uint32_t>(walkers(*w).size()));
        for (const uint32_t k : w->coming.arrivals) {
            const Vec3 p = w->crowd.motion.position[k];
            EXPECT_LT(std::max(std::fabs(p.x + 20.5f), std::fabs(p.z + 20.5f)), 1.6f);
            EXPECT_EQ(w->crowd.identity.preferred_speed[k], 1.5f);
        }
    }
    const ComingCount count = coming_count(*w);
    EXPECT_EQ(count.came, 30u);
    EXPECT_EQ(count.left, 30u);
    EXPECT_EQ(count.waiting, 0u);
    EXPECT_TRUE(walkers(*w).empty());
    EXPECT_GT(most, 15u);
}

TEST(Coming, WhoFindsNoRoomWaits) {
    WorldOptions options;
    options.capacity = 100;
    options.sendings = {{{{{0, 0}}, {}}, {{{0.5f, 0}}, {}}, 5, 1, 0, 0, 0}};
    auto w = made(1, options);
    ASSERT_TRUE(add_walker(*w, {.place = Vec3{0, 0, 0}}));
    run(*w, 300);
    EXPECT_EQ(coming_count(*w).waiting, 5u);
    EXPECT_EQ(walkers(*w).size(), 1u);
    ASSERT_TRUE(remove_walker(*w, walkers(*w)[0]));
    run(*w, 1200);
    EXPECT_EQ(coming_count(*w).left, 5u);
    EXPECT_EQ(coming_count(*w).waiting, 0u);
}

TEST(Coming, NoMoreThanThereIsRoomFor) {
    WorldOptions options;
    options.capacity = 8;
    options.sendings = {
        {{{{-20, -20}, {20, -20}, {20, 20}, {-20, 20}}, {}}, {{{25, 25}}, {}}, 50, 1, 0, 0, 0}};
    auto w = made(1, options);
    run(*w, 30);
    EXPECT_EQ(walkers(*w).size(), 8u);
    EXPECT_EQ(coming_count(*w).waiting, 42u);
    EXPECT_EQ(coming_count(*w).lost, 0u);
}

// Five times as many are sent, all of them at one place, as have room there.
TEST(Coming, ThoseSentKeepNobodyOutWhoComesInsteadOfOthers) {
    WorldOptions options = busy();
    options.sendings = {{{{{0, 0}}, {}}, {{{20, 20}}, {}}, 50'000, 1, 0, 0, 0}};
    for (const uint32_t room : {151u, 400u}) {
        options.capacity = room;
        auto w = made(2, options);
        for (int i = 0; i < 60 * 90; ++i) {
            step(*w);
            ASSERT_EQ(kept_people(w->coming, w->crowd), 150u);
        }
        const SentCount sent = sent_counts(*w)[0];
        EXPECT_LT(waiting(w->coming) - sent.waiting, 15u) << room;
        EXPECT_GT(coming_count(*w).came - sent.came, 30u) << room;
        EXPECT_GT(sent.came, 0u) << room;
        EXPECT_LE(walkers(*w).size(), room);
    }
}

TEST(Coming, EachSendingIsCounted) {
    WorldOptions options;
    options.capacity = 40;
    options.sendings = {{{{{-20, -20}}, {}}, {{{-10, -20}}, {}}, 3, 1, 0, 6, 1.5f},
                        {{{{20, -20}}, {}}, {{{20, 20}}, {}}, 2, 1, 5, 5, 0},
                        {{{{-20, 20}}, {}}, {{{250, 20}}, {}}, 4, 1, 0, 0, 0},
                        {{{{0, 20}}, {}}, {{{0, 25}}, {}}, 9, 1, 100, 200, 0}};
    auto w = made(1, options);
    auto expect = [&](size_t sending, const SentCount& is) {
        const SentCount count = sent_counts(*w)[sending];
        EXPECT_EQ(count.came, is.came) << sending;
        EXPECT_EQ(count.under_way, is.under_way) << sending;
        EXPECT_EQ(count.arrived, is.arrived) << sending;
        EXPECT_EQ(count.waiting, is.waiting) << sending;
        EXPECT_EQ(count.lost, is.lost) << sending;
        EXPECT_EQ(count.later, is.later) << sending;
    };
    run(*w, 60 * 5 + 2);
    expect(0, {.came = 3, .under_way = 3});
    expect(1, {.came = 1, .under_way = 1, .waiting = 1});
    expect(2, {.lost = 4});
    expect(3, {.later = 9});
    std::vector<std::byte> bytes;
    save_state(*w, bytes);
    run(*w, 60 * 15);
    expect(0, {.came = 3, .arrived = 3});
    ASSERT_TRUE(load_state(*w, bytes));
    expect(0, {.came = 3, .under_way = 3});
    ASSERT_TRUE(remove_walker(*w, walkers(*w)[0]));
    expect(0, {.came = 3, .under_way = 2});
}

// Half of the people push prams, none of which gets up there.
TEST(Coming, ThoseSentUpStepsGetThere) {
    WorldOptions options;
    options.capacity = 40;
    options.sendings = {{{{{-6, -8}, {6, -8}, {6, -4}, {-6, -4}}, {}}, {{{0, 8}}, 1.5f}, 30, 1, 0, 60, 0}};
    options.kinds = {Kind{standard_body(1.75f)}, pusher()};
    options.kinds[1].share = 1;
    auto w = make_world(std::make_shared<const Ground>(steps()), options);
    ASSERT_TRUE(w) << w.error().message;
    run(**w, 60 * 150);
    EXPECT_EQ(sent_counts(**w)[0].arrived, 30u);
    const auto up = send_to(**w, *add_walker(**w, {.place = Vec3{0, 0, -6}, .kind = 1}), {0, 1.5f, 8});
    ASSERT_FALSE(up);
    EXPECT_NE(up.error().message.find("that a pram can take"), std::string::npos) << up.error().message;
}

TEST(Coming, WhyNobodyCanBeSentIsKnownBefore) {
    auto w = made(1, {});
    auto why = [&](SentPlace from, SentPlace to) {
        return why_unwalkable({.from = std::move(from), .to = std::move(to)}, *w->navmesh);
    };
    const SentPlace here{{{0, 0}}, {}}, there{{{9, 9}}, {}}, outside{{{500, 0}}, {}},
        area{{{490, 0}, {500, 0}, {500, 9}}, {}};
    EXPECT_EQ(why(here, there), Unwalkable::no);
    EXPECT_EQ(why(outside, there), Unwalkable::from);
    EXPECT_EQ(why(here, outside), Unwalkable::to);
    EXPECT_EQ(why(area, here), Unwalkable::from);
    EXPECT_EQ(why({{{-5, 0}, {5, 0}, {0, 5}}, {}}, here), Unwalkable::no);
    Ground ground = square(20);
    add_wall(ground, {-10, 0, 3}, {10, 0, 3}, 0.8f, FaceKind::garden_wall);
    index_ground(ground);
    const Result<NavmeshPtr> divided = build_navmesh(ground, {}, 1);
    ASSERT_TRUE(divided);
    prepare_queries(**divided, 1);
    EXPECT_EQ(why_unwalkable({.from = here, .to = {{{0, 6}}, {}}}, **divided), Unwalkable::way);
}

TEST(Coming, AHeightAtWhichNobodyWalksIsToldFromOthers) {
    auto w = made(1, {});
    const SentPlace place{{{0, 0}}, 8.0f}, area{{{-5, 0}, {5, 0}, {0, 5}}, -9.0f};
    ASSERT_TRUE(other_height(place, *w->navmesh));
    EXPECT_NEAR(*other_height(place, *w->navmesh), 0, 0.2f);
    EXPECT_TRUE(other_height(area, *w->navmesh));
    EXPECT_FALSE(other_height({{{0, 0}}, 1.0f}, *w->navmesh));
    EXPECT_FALSE(other_height({{{0, 0}}, {}}, *w->navmesh));
    EXPECT_FALSE(other_height({{{500, 0}}, 8.0f}, *w->navmesh)) << "where nobody walks at all";
}

TEST(Coming, WhoHasNoWayIsCounted) {
    WorldOptions options;
    options.capacity = 8;
    options.sendings = {{{{{-20, -20}}, {}}, {{{250, 25}}, {}}, 3, 1, 0, 0, 0}};
    auto w = made(1, options);
    run(*w, 30);
    EXPECT_EQ(coming_count(*w).lost, 3u);
    EXPECT_TRUE(walkers(*w).empty());
}

TEST(Coming, FlowsAreEven) {
    const Sending sending{{}, {}, 6, 1, 10, 70, 0};
    EXPECT_EQ(due_by(sending, 9.9), 0u);
    EXPECT_EQ(due_by(sending, 10), 1u);
    EXPECT_EQ(due_by(sending, 19.9), 1u);
    EXPECT_EQ(due_by(sending, 20.1), 2u);
    EXPECT_EQ(due_by(sending, 69), 6u);
    EXPECT_EQ(due_by(sending, 1e9), 6u);
    EXPECT_EQ(due_by({{}, {}, 4, 1, 3, 3, 0}, 3), 4u);
    const Sending pairs{{}, {}, 5, 2, 0, 30, 0};
    EXPECT_EQ(due_by(pairs, 0), 2u);
    EXPECT_EQ(due_by(pairs, 11), 4u);
    EXPECT_EQ(due_by(pairs, 21), 5u);
}

TEST(Coming, RefusesWhatIsOutOfRange) {
    const Vec3 corners[] = {{-5, 0, -5}, {-5, 0, 5}, {5, 0, 5}, {5, 0, -5}};
    const uint32_t triangles[] = {0, 1, 2, 0, 2, 3};
    auto is_taken = [&](const WorldOptions& options) {
        return bool(make_world({corners, triangles, {}}, options));
    };
    WorldOptions options;
    options.capacity = 3;
    EXPECT_TRUE(is_taken(options));
    options.leaving[0] = 1.5f;
    EXPECT_FALSE(is_taken(options));
    options.leaving[0] = 1;
    options.destinations = {{static_cast<DestinationKind>(k_destination_count), {0, 0, 0}, {0, 1}, 1}};
    EXPECT_FALSE(is_taken(options));
    options.destinations[0].kind = DestinationKind::square;
    EXPECT_TRUE(is_taken(options));
    options.sendings = {{{{{0, 0}}, {}}, {{{1, 1}}, {}}, 3, 1, 5, 9, 1}};
    EXPECT_TRUE(is_taken(options));
    for (const auto& breaks : std::initializer_list<void (*)(Sending&)>{
             [](Sending& f) { f.from.corners.clear(); }, [](Sending& f) { f.to.corners.resize(2); },
             [](Sending& f) { f.end = 4; }, [](Sending& f) { f.begin = -1; }, [](Sending& f) { f.speed = 9; },
             [](Sending& f) { f.people = 2'000'000; }}) {
        WorldOptions broken = options;
        breaks(broken.sendings[0]);
        EXPECT_FALSE(is_taken(broken));
    }
}

}  // namespace
}  // namespace flaneur
