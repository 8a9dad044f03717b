// What the window's pictures cost.
#include <gtest/gtest.h>

#include "renderer/renderer.h"
#include "tools/flaneur/window/frame/costs.h"

namespace flaneur {
namespace {

// Pictures of 40 ms: 10 of ticks, 5 of people, 1 of panels, 20 of drawing, and what is left.
Costs hundred_pictures(const FrameStats& stats, double ticks = 0.010) {
    Costs costs;
    double time = 5;
    for (int i = 0; i < 100; ++i) {
        begin_picture(costs, time);
        end_part(costs, CostOf::asked, time);
        end_part(costs, CostOf::ticks, time + ticks);
        end_part(costs, CostOf::people, time + ticks + 0.005);
        end_part(costs, CostOf::panels, time + ticks + 0.006);
        end_part(costs, CostOf::draw, time + ticks + 0.026);
        end_picture(costs, stats);
        time += ticks + 0.030;
    }
    begin_picture(costs, time);
    return costs;
}

TEST(Costs, EachPartIsWhatItTook) {
    FrameStats stats;
    stats.cpu_record_ms = 3;
    stats.stages = {{"crowd shadows", 2}, {"scene", 11}, {"light", 7}};
    const Costs costs = hundred_pictures(stats);
    const float expected[] = {0, 10, 5, 1, 20, 4};
    for (size_t i = 0; i < k_costs; ++i)
        EXPECT_NEAR(mean_of(costs).parts[i], expected[i], 1e-3) << k_cost_names[i];
    EXPECT_NEAR(costs.record, 3, 1e-9);
    ASSERT_EQ(costs.stages.size(), 3u);
    EXPECT_NEAR(costs.stages[1].ms, 11, 1e-9);
    EXPECT_EQ(costs.pictures.size(), 100u);
    EXPECT_NEAR(spread_of(costs).median, 40, 1e-3);
    EXPECT_EQ(
        costliest(costs).rfind("50 % of a picture is drawing; scene takes 55 % of the device's time", 0), 0u)
        << costliest(costs);
    EXPECT_NE(costliest(hundred_pictures(stats, 0.2)).find("stepping people"), std::string::npos);
}

// One that took long is found, with what made it so, and is forgotten by the mean soon.
TEST(Costs, AHitchIsTold) {
    FrameStats stats;
    Costs costs = hundred_pictures(stats);
    double time = costs.began;
    end_part(costs, CostOf::asked, time + 0.5);
    time += 0.53;
    begin_picture(costs, time);
    EXPECT_EQ(told(spread_of(costs).worst), "530 ms, of it what was asked for 500");
    EXPECT_GT(mean_of(costs).whole, 80);
    for (int i = 0; i < 10; ++i) begin_picture(costs, time += 0.04);
    EXPECT_NEAR(mean_of(costs).whole, 40, 0.1);
    EXPECT_NEAR(spread_of(costs).median, 40, 0.1);
}

TEST(Costs, AdvisesNoLowerQualityThanThereIs) {
    FrameStats stats;
    stats.stages = {{"light", 7}};
    const Costs costs = hundred_pictures(stats);
    EXPECT_NE(costliest(costs).find("lower quality"), std::string::npos);
    EXPECT_EQ(costliest(costs, true).find("lower quality"), std::string::npos);
}

TEST(Costs, RowsStayWhereTheyAre) {
    FrameStats stats;
    stats.stages = {{"scene", 11}, {"overlay", 2}, {"light", 7}};
    Costs costs;
    end_picture(costs, stats);
    stats.stages = {{"scene", 11}, {"light", 7}, {"paint", 1}};
    for (int i = 0; i < 100; ++i) end_picture(costs, stats);
    std::vector<std::string> names;
    for (const Costs::Stage& stage : costs.stages) names.push_back(stage.name);
    EXPECT_EQ(names, (std::vector<std::string>{"scene", "overlay", "light", "paint"}));
    EXPECT_LT(costs.stages[1].ms, 0.01) << "what is no longer drawn costs nothing";
    EXPECT_NEAR(costs.stages[2].ms, 7, 1e-9);
}

TEST(Costs, OnlyTheLastPicturesAreKept) {
    Costs costs;
    EXPECT_EQ(spread_of(costs).worst.whole, 0);
    EXPECT_EQ(costliest(costs), "");
    double time = 1;
    for (int i = 0; i < 400; ++i) begin_picture(costs, time), time += i < 100 ? 1 : 0.02;
    EXPECT_EQ(costs.pictures.size(), Costs::k_kept);
    EXPECT_NEAR(spread_of(costs).worst.whole, 20, 0.1) << "the slow start is forgotten";
}

}  // namespace
}  // namespace flaneur
