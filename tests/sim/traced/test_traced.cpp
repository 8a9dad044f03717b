// A world of people who follow ways that are known.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/sim.h"
#include "sim/state.h"
#include "sim/world.h"
#include "tests/sim/allocations.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

// Straight on, from standing in the lead; seen from tick `from` of the world to tick `to`.
void add_way(Traces& t, uint32_t id, uint32_t from, uint32_t to, Vec2 at, Vec2 velocity, float height = 0) {
    TracedWay way{.id = id, .height = height};
    way.begin = from, way.seen = from + k_trace_lead, way.gone = way.end = to + k_trace_lead;
    way.knots = static_cast<uint32_t>(t.knots.size());
    const uint32_t count = (way.end - way.begin) / way.stretch + 4;
    const float step = static_cast<float>(way.stretch) * k_tick, lead = k_trace_lead * k_tick;
    for (uint32_t k = 0; k < count; ++k) {
        const float time = (static_cast<float>(k) - 1) * step - lead, begins = std::max(time + 1, 0.0f);
        const float gone = time > 0 ? time : std::min(0.5f * begins * begins - 0.5f, time);
        t.knots.push_back({at_height(at + velocity * gone, 0), heading_of(velocity)});
    }
    t.ways.push_back(way);
}

void settle(Traces& t, uint32_t most) {
    std::ranges::sort(t.ways, [](const TracedWay& a, const TracedWay& b) {
        return std::pair(a.begin, a.id) < std::pair(b.begin, b.id);
    });
    t.most = most;
}

// Five at a time, one after another in lanes, `people` in all.
std::shared_ptr<const Traces> lanes_of(uint32_t people) {
    Traces t;
    for (uint32_t n = 0; n < people; ++n)
        add_way(t, n, n / 5 * 100, n / 5 * 100 + 200, {-6, static_cast<float>(n % 5) - 2}, {1.2f, 0});
    settle(t, 15);
    return std::make_shared<const Traces>(std::move(t));
}

std::unique_ptr<World> made(const std::shared_ptr<const Traces>& traces, int threads = 1) {
    WorldOptions options;
    options.capacity = traces->most;
    options.threads = threads;
    options.kinds = {Kind{standard_body(1.8f), 1, 30, false}, Kind{standard_body(1.66f), 1, 30, true}};
    options.kinds.push_back(options.kinds[0]);
    options.kinds[2].body.pram = standard_pram(options.kinds[2].body);
    Ground ground = square(30);
    index_ground(ground);
    auto world = make_world(std::make_shared<const Ground>(std::move(ground)), options);
    EXPECT_TRUE(world) << world.error().message;
    follow_traces(**world, traces);
    return std::move(*world);
}

TEST(Traced, TheyAreWhereTheirWaysAre) {
    const auto traces = lanes_of(20);
    auto w = made(traces);
    uint32_t seen = 0;
    for (int tick = 0; tick < 500; ++tick) {
        for (const WalkerId id : walkers(*w)) {
            const TracedWay& way = traces->ways[w->traced.way_of[id.index]];
            const TracePoint p = trace_at(*traces, way, w->tick + k_trace_lead);
            const Vec3 at = w->crowd.motion.position[id.index];
            EXPECT_LT(length(at - p.at), 1e-5f);
            seen += w->crowd.passages.empty();
        }
        step(*w);
    }
    EXPECT_GT(seen, 100u);
}

TEST(Traced, InFullStrideWhenTheyAreSeenFirst) {
    auto w = made(lanes_of(5));
    for (const WalkerId id : walkers(*w)) {
        EXPECT_NEAR(length(w->crowd.motion.velocity[id.index]), 1.2f, 0.02f);
        EXPECT_EQ(w->gait.blocks[0].standing[id.index], 0);
        EXPECT_GT(w->gait.blocks[0].amplitude[id.index], 0.8f);
    }
}

TEST(Traced, TheirFeetStandStill) {
    auto w = made(lanes_of(5));
    float most = 0;
    std::array<std::array<Vec2, 2>, 5> last{};
    std::array<std::array<bool, 2>, 5> stood{};
    for (int tick = 0; tick < 190; ++tick) {
        step(*w);
        for (const WalkerId id : walkers(*w))
            for (const Side side : {k_left, k_right}) {
                const FootBlock& foot = w->gait.blocks[0].feet[side];
                const Vec2 at{foot.to.x[id.index], foot.to.z[id.index]};
                const bool stands = !foot.swinging[id.index];
                if (stands && stood[id.index][side]) most = std::max(most, length(at - last[id.index][side]));
                last[id.index][side] = at, stood[id.index][side] = stands;
            }
    }
    EXPECT_LT(most, 1e-5f);
}

TEST(Traced, ManyComeAndGoInRoomForAFew) {
    const auto traces = lanes_of(200);
    auto w = made(traces);
    size_t most = 0;
    while (w->traced.next < traces->ways.size() || !walkers(*w).empty()) {
        step(*w);
        most = std::max(most, walkers(*w).size());
        ASSERT_LT(w->tick, 10000u);
    }
    EXPECT_LE(most, 15u);
    EXPECT_EQ(w->crowd.capacity, 15u);
}

TEST(Traced, TheSameOnAnyThreadsAndTakenBack) {
    uint64_t hashes[2];
    for (const int threads : {1, 4}) {
        auto w = made(lanes_of(60), threads);
        for (int tick = 0; tick < 300; ++tick) step(*w);
        std::vector<std::byte> bytes;
        save_state(*w, bytes);
        for (int tick = 0; tick < 200; ++tick) step(*w);
        hashes[threads > 1] = hash_world(*w);
        ASSERT_TRUE(load_state(*w, bytes));
        for (int tick = 0; tick < 200; ++tick) step(*w);
        EXPECT_EQ(hash_world(*w), hashes[threads > 1]);
    }
    EXPECT_EQ(hashes[0], hashes[1]);
    auto other = made(lanes_of(20));
    std::vector<std::byte> bytes;
    save_state(*other, bytes);
    auto w = made(lanes_of(60));
    EXPECT_FALSE(load_state(*w, bytes));
}

TEST(Traced, TicksAskForNoMemory) {
    auto w = made(lanes_of(100));
    const size_t before = allocations();
    for (int tick = 0; tick < 600; ++tick) step(*w);
    EXPECT_EQ(allocations(), before);
}

TEST(Traced, BodiesHaveTheHeightsThatAreKnownAndNoPrams) {
    Traces t;
    for (uint32_t n = 0; n < 30; ++n)
        add_way(t, n, 0, 100, {0, static_cast<float>(n % 5)}, {1, 0}, n % 2 == 0 ? 1.72f : 0);
    settle(t, 30);
    const auto traces = std::make_shared<const Traces>(std::move(t));
    auto w = made(traces);
    uint32_t small = 0;
    for (const WalkerId id : walkers(*w)) {
        const uint32_t kind = w->crowd.identity.body[id.index];
        const TracedWay& way = traces->ways[w->traced.way_of[id.index]];
        EXPECT_NE(kind, 2u);
        small += kind == 1;
        if (way.height > 0) {
            EXPECT_NEAR(w->crowd.identity.scale[id.index] * w->kinds[kind].body.height, 1.72f, 1e-3f);
        }
    }
    EXPECT_GT(small, 5u);
    EXPECT_LT(small, 25u);
}

TEST(Traced, NobodyIsPushedOrComesBesideThem) {
    auto w = made(lanes_of(5));
    EXPECT_FALSE(add_walker(*w));
    make_room(*w, 40);
    for (int tick = 0; tick < 30; ++tick) step(*w);
    EXPECT_FALSE(push(*w, walkers(*w)[0], {200, 0}));
}

}  // namespace
}  // namespace flaneur
