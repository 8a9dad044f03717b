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
    const double expected[] = {10, 5, 1, 20, 4};
    for (size_t i = 0; i < k_costs; ++i) EXPECT_NEAR(costs.parts[i], expected[i], 1e-6) << k_cost_names[i];
    EXPECT_NEAR(costs.record, 3, 1e-9);
    ASSERT_EQ(costs.stages.size(), 3u);
    EXPECT_NEAR(costs.stages[1].ms, 11, 1e-9);
    EXPECT_EQ(costs.wholes.size(), 100u);
    EXPECT_NEAR(spread_of(costs).median, 40, 1e-3);
    EXPECT_EQ(
        costliest(costs).rfind("50 % of a picture is drawing; scene takes 55 % of the device's time", 0), 0u)
        << costliest(costs);
    EXPECT_NE(costliest(hundred_pictures(stats, 0.2)).find("stepping people"), std::string::npos);
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
    EXPECT_EQ(spread_of(costs).worst, 0);
    EXPECT_EQ(costliest(costs), "");
    double time = 1;
    for (int i = 0; i < 400; ++i) begin_picture(costs, time), time += i < 100 ? 1 : 0.02;
    EXPECT_EQ(costs.wholes.size(), Costs::k_kept);
    EXPECT_NEAR(spread_of(costs).worst, 20, 0.1) << "the slow start is forgotten";
}

}  // namespace
}  // namespace flaneur
