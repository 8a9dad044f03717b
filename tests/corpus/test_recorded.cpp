// People who go where others were measured: near to the points, feet on the ground and still.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "assets/traced/hall.h"
#include "assets/traced/ways.h"
#include "sim/world.h"

namespace flaneur {
namespace {

struct Recorded {
    const char* file;
    uint32_t people, most;  // most: at once, with those who are about to come
    float least_sway, most_sway;
};

constexpr Recorded k_recorded[] = {{"bi_corr_400_b_03.txt", 480, 60, 0.85f, 1},
                                   {"040_c_56_h-.txt", 75, 75, 0.1f, 0.5f},
                                   {"00_01a.h5", 46, 46, 0.1f, 0.5f},
                                   {"trajectories.sqlite", 30, 30, 0, 0.3f}};

// How far planted feet move in a tick, and how far the ground is from them, metres.
struct Feet {
    std::vector<float> moves;
    float off = 0;
    Sole last[2]{};
    bool stood[2]{};
    uint32_t generation = 0;
};

void look_at_feet(const World& w, uint32_t i, Feet& feet) {
    const bool is_new = feet.generation != w.crowd.slots.generation[i];
    feet.generation = w.crowd.slots.generation[i];
    for (const Side side : {k_left, k_right}) {
        const bool stands = w.gait.blocks[i / k_block].feet[side].swinging[i % k_block] == 0;
        const Sole now = sole(w.poses, w.gait, i, side);
        if (stands && feet.stood[side] && !is_new)
            feet.moves.push_back(
                std::min({length(now.heel - feet.last[side].heel), length(now.ball - feet.last[side].ball),
                          length(now.tip - feet.last[side].tip)}));
        if (stands) {
            const float low = std::min({now.heel.y, now.ball.y, now.tip.y});
            feet.off = std::max(feet.off, std::fabs(low - w.crowd.motion.position[i].y));
        }
        feet.last[side] = now, feet.stood[side] = stands;
    }
}

class RecordedPeople : public testing::TestWithParam<Recorded> {};

TEST_P(RecordedPeople, KeepToThePointsOnFeetThatStand) {
    const Recorded& file = GetParam();
    const std::string path = std::string(FLANEUR_SHARED_DIR "/corpus/trajectories/") + file.file;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
    const Result<Trajectories> read = read_trajectories(path);
    ASSERT_TRUE(read) << read.error().message;
    RecordedWays ways = make_ways(*read);
    EXPECT_EQ(ways.figures.people, file.people);
    EXPECT_LE(ways.traces.most, file.most);
    EXPECT_GE(ways.figures.sways, file.least_sway);
    EXPECT_LE(ways.figures.sways, file.most_sway);
    EXPECT_LE(ways.figures.near, 0.05f);
    EXPECT_LE(ways.figures.farthest, 0.15f);
    EXPECT_LE(ways.figures.farthest_raw, 0.2f);

    const City city = build_hall(*read, file.file);
    WorldOptions options;
    options.capacity = ways.traces.most;
    options.kinds = {{standard_body(1.62f)}, {standard_body(1.78f)}};
    auto made = make_world(std::make_shared<const Ground>(city.ground), options);
    ASSERT_TRUE(made) << made.error().message;
    World& w = **made;
    follow_traces(w, std::make_shared<const Traces>(std::move(ways.traces)));
    std::vector<Feet> feet(w.crowd.capacity);
    constexpr uint32_t k_watched = 15 * 60;
    while (w.tick < k_watched) {
        step(w);
        for (const WalkerId id : w.crowd.slots.living) look_at_feet(w, id.index, feet[id.index]);
    }
    std::vector<float> moves;
    float off = 0;
    for (const Feet& f : feet) {
        moves.insert(moves.end(), f.moves.begin(), f.moves.end());
        off = std::max(off, f.off);
    }
    ASSERT_GT(moves.size(), 1000u);
    std::ranges::sort(moves);
    EXPECT_LT(moves[moves.size() * 999 / 1000], 0.0005f);
    EXPECT_LT(moves.back(), 0.01f);
    EXPECT_LT(off, 0.01f);
}

INSTANTIATE_TEST_SUITE_P(Corpus, RecordedPeople, testing::ValuesIn(k_recorded), [](const auto& of) {
    std::string name = of.param.file;
    std::erase_if(name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); });
    return name;
});

}  // namespace
}  // namespace flaneur
