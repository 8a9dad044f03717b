#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tools/flaneur/output/figures.h"

namespace flaneur {
namespace {

TEST(Quantile, LiesBetweenTheClosestRanks) {
    EXPECT_DOUBLE_EQ(quantile({7}, 0.99), 7);
    EXPECT_DOUBLE_EQ(quantile({3, 1, 2}, 0.5), 2);
    EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 0.5), 2.5);
    EXPECT_DOUBLE_EQ(quantile({0, 10}, 0.95), 9.5);
    EXPECT_DOUBLE_EQ(quantile({5, 9, 1}, 0), 1);
    EXPECT_DOUBLE_EQ(quantile({5, 9, 1}, 1), 9);
}

TEST(Figures, AsJson) {
    Figures figures;
    figures.setting = {{"walkers", 500}, {"quality", "high"}};
    figures.counts = {{"triangles", 1000}};
    for (double ms : {1.0, 2.0, 6.0}) add_sample(figures, "steer", ms);
    add_sample(figures, "move", 4.0);
    nlohmann::json json = nlohmann::json::parse(figures_json(figures));
    EXPECT_EQ(json["setting"]["walkers"], 500);
    EXPECT_EQ(json["setting"]["quality"], "high");
    EXPECT_EQ(json["counts"]["triangles"], 1000);
    ASSERT_EQ(json["stages"].size(), 2u);
    EXPECT_EQ(json["stages"][0]["name"], "steer");
    EXPECT_EQ(json["stages"][0]["count"], 3);
    EXPECT_EQ(json["stages"][0]["median_ms"], 2.0);
    EXPECT_EQ(json["stages"][1]["p99_ms"], 4.0);
}

}  // namespace
}  // namespace flaneur
