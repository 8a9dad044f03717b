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

TEST(Figures, AreAsGoogleBenchmarkHasThem) {
    Figures figures;
    figures.setting = {{"walkers", 500}, {"quality", "high"}};
    figures.counts = {{"triangles", 1000}};
    for (double ms : {1.0, 2.0, 6.0}) add_sample(figures, "steer", ms);
    add_sample(figures, "move", 4.0);
    figures.series.push_back({"core/avx2", {0.002, 0.004}, "", "ns"});
    nlohmann::json json = nlohmann::json::parse(figures_json(figures, "flaneur bench crowd"));
    EXPECT_EQ(json["context"]["walkers"], 500);
    EXPECT_EQ(json["context"]["quality"], "high");
    EXPECT_EQ(json["context"]["command"], "flaneur bench crowd");
    EXPECT_TRUE(json["context"]["num_cpus"].is_number());
    EXPECT_TRUE(json["context"]["caches"].is_array());
    EXPECT_EQ(json["counts"]["triangles"], 1000);
    EXPECT_GT(json["counts"]["peak MB"], 0);
    ASSERT_EQ(json["benchmarks"].size(), 3u);
    const nlohmann::json& steer = json["benchmarks"][0];
    EXPECT_EQ(steer["name"], "steer");
    EXPECT_EQ(steer["run_type"], "iteration");
    EXPECT_EQ(steer["iterations"], 3);
    EXPECT_EQ(steer["time_unit"], "ms");
    EXPECT_EQ(steer["real_time"], 2.0);
    EXPECT_EQ(steer["cpu_time"], 2.0);
    EXPECT_EQ(steer["worst"], 6.0);
    EXPECT_EQ(steer["samples"], nlohmann::json({1.0, 2.0, 6.0}));
    EXPECT_EQ(json["benchmarks"][1]["p99"], 4.0);
    EXPECT_EQ(json["benchmarks"][2]["time_unit"], "ns");
    EXPECT_NEAR(json["benchmarks"][2]["real_time"], 3000, 1e-6);
}

TEST(Figures, OfAFrameHaveWhatAllThreadsWorked) {
    Figures figures;
    for (const char* name : {"frame", "with LOD/frame"}) add_sample(figures, name, 10);
    add_sample(figures, "all threads", 15);
    add_sample(figures, "with LOD/all threads", 17);
    nlohmann::json json = nlohmann::json::parse(figures_json(figures, ""));
    EXPECT_EQ(json["benchmarks"][0]["real_time"], 10.0);
    EXPECT_EQ(json["benchmarks"][0]["cpu_time"], 15.0);
    EXPECT_EQ(json["benchmarks"][1]["cpu_time"], 17.0);
}

}  // namespace
}  // namespace flaneur
