// Verdicts of `bench compare`, on times that are made up: what is slower is found, what is not is left alone.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/base/rng.h"
#include "tools/flaneur/bench/compare.h"

namespace flaneur {
namespace {

double unit(uint64_t seed, uint32_t i, uint32_t which) {
    return static_cast<double>(random_unit({seed, i, 0, Purpose::spawn}, which));
}

// Times as a shared machine gives them: never below what the work takes, some longer, now and then much
// longer, and for stretches of 15 all a little longer.
std::vector<double> noisy(double ms, uint64_t seed, uint32_t count = 120) {
    std::vector<double> times;
    for (uint32_t i = 0; i < count; ++i) {
        double time = ms * (1 + 0.03 * -std::log(1 - 0.999 * unit(seed, i, 0)));
        time *= 1 + 0.02 * unit(seed, 1000 + i / 15, 1);
        if (unit(seed, i, 2) < 0.02) time *= 2;
        times.push_back(time);
    }
    return times;
}

BenchFile run_of(uint64_t seed, double steer_times = 1) {
    BenchFile file;
    const std::pair<const char*, double> stages[] = {{"frame", 30}, {"think", 1},     {"steer", 4},
                                                     {"gait", 6},   {"draw", 15},     {"light", 7},
                                                     {"city", 9},   {"shadows", 1.5}, {"tiny", 0.01}};
    uint64_t salt = 0;
    for (const auto& [name, ms] : stages) {
        const double times = std::string(name) == "steer" ? steer_times : 1;
        file.times.push_back({name, noisy(ms * times, 100 * seed + ++salt)});
    }
    return file;
}

size_t count_of(const std::vector<Compared>& all, BenchVerdict verdict) {
    size_t count = 0;
    for (const Compared& c : all) count += c.verdict == verdict;
    return count;
}

TEST(Compare, PassesPairsOfTheSame) {
    for (uint64_t pair = 1; pair <= 10; ++pair) {
        const std::vector<Compared> all = compare_times(run_of(2 * pair), run_of(2 * pair + 1), 5);
        EXPECT_EQ(count_of(all, BenchVerdict::slower), 0u) << pair;
        EXPECT_EQ(count_of(all, BenchVerdict::faster), 0u) << pair;
    }
}

TEST(Compare, FindsFivePercent) {
    for (uint64_t pair = 1; pair <= 10; ++pair) {
        const std::vector<Compared> all = compare_times(run_of(2 * pair), run_of(2 * pair + 1, 1.05), 5);
        EXPECT_EQ(count_of(all, BenchVerdict::slower), 1u) << pair;
        for (const Compared& c : all)
            if (c.name == "steer") {
                EXPECT_EQ(c.verdict, BenchVerdict::slower) << pair << ": " << c.difference.ratio;
                EXPECT_NEAR(c.difference.ratio, 1.05, 0.02);
            }
        // And the other way round.
        EXPECT_EQ(
            count_of(compare_times(run_of(2 * pair, 1.05), run_of(2 * pair + 1), 5), BenchVerdict::faster),
            1u);
    }
}

TEST(Compare, LeavesWhatIsWithinTheTolerance) {
    for (uint64_t pair = 1; pair <= 10; ++pair) {
        const std::vector<Compared> all = compare_times(run_of(2 * pair), run_of(2 * pair + 1, 1.1), 20);
        EXPECT_EQ(count_of(all, BenchVerdict::slower), 0u) << pair;
    }
}

TEST(Compare, SaysNothingOfTooFewAndOfWhatIsSmall) {
    BenchFile before, after;
    before.times = {{"frame", noisy(30, 1, 5)}, {"tiny", noisy(0.01, 2, 5)}, {"gone", {1}}};
    after.times = {{"frame", noisy(60, 3, 5)}, {"tiny", noisy(0.02, 4, 5)}, {"added", {1}}};
    const std::vector<Compared> all = compare_times(before, after, 5);
    ASSERT_EQ(all.size(), 4u);
    EXPECT_EQ(all[0].verdict, BenchVerdict::unsure);
    EXPECT_EQ(all[1].verdict, BenchVerdict::small);
    EXPECT_EQ(all[2].verdict, BenchVerdict::gone);
    EXPECT_EQ(all[3].verdict, BenchVerdict::added);
}

TEST(Difference, IsAsTheTestByHandSaysIt) {
    // Ten and ten wholly apart: U = 0, z = (50 - 0.5) / sqrt(175), both ways.
    std::vector<double> low, high;
    for (int i = 0; i < 10; ++i) low.push_back(1 + 0.01 * i), high.push_back(2 + 0.01 * i);
    EXPECT_NEAR(difference_of(low, high).p, std::erfc(49.5 / std::sqrt(175.0) / std::sqrt(2.0)), 1e-12);
    EXPECT_NEAR(difference_of(low, high).p, 0.000183, 1e-6);
    EXPECT_NEAR(difference_of(low, low).ratio, 1, 1e-12);
    EXPECT_EQ(difference_of(low, low).p, 1);
    const Difference d = difference_of(low, high);
    EXPECT_NEAR(d.ratio, 2.045 / 1.045, 0.01);
    EXPECT_LT(d.low, d.ratio);
    EXPECT_GT(d.high, d.ratio);
}

TEST(BenchFile, OfGoogleBenchmarkIsReadToo) {
    const Result<BenchFile> file =
        parse_bench_file(R"({"context": {"date": "x", "num_cpus": 2}, "benchmarks": [
        {"name": "a", "run_type": "iteration", "real_time": 2000, "time_unit": "us"},
        {"name": "a", "run_type": "iteration", "real_time": 3, "time_unit": "ms"},
        {"name": "a_mean", "run_type": "aggregate", "real_time": 2.5, "time_unit": "ms"},
        {"name": "b", "real_time": 5, "time_unit": "ns", "samples": [4, 5, 6]}]})");
    ASSERT_TRUE(file) << file.error().message;
    ASSERT_EQ(file->times.size(), 2u);
    EXPECT_EQ(file->times[0].ms, (std::vector<double>{2, 3}));
    EXPECT_EQ(file->times[1].ms.size(), 3u);
    EXPECT_NEAR(file->times[1].ms[0], 4e-6, 1e-18);
    ASSERT_EQ(file->setting.size(), 1u);
    EXPECT_EQ(file->setting[0].second, "2");
}

TEST(BenchFile, ThatIsNoneIsRefused) {
    for (const char* text :
         {"", "[]", "{}", R"({"benchmarks": 3})", R"({"benchmarks": [3]})",
          R"({"benchmarks": [{"name": "a"}]})", R"({"benchmarks": [{"name": 3, "real_time": 1}]})",
          R"({"benchmarks": [{"name": "a", "real_time": 1, "samples": ["x"]}]})"})
        EXPECT_FALSE(parse_bench_file(text)) << text;
    EXPECT_TRUE(parse_bench_file(
        R"({"benchmarks": [{"name": "a", "real_time": 1, "run_type": 3, "time_unit": {}}]})"));
}

}  // namespace
}  // namespace flaneur
