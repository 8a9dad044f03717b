// Two files of figures, and whether the later one is slower.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sim/base/result.h"
#include "tools/flaneur/bench/significance.h"

namespace flaneur {

// As `flaneur bench --json` and Google Benchmark write them.
struct BenchTimes {
    std::string name;
    std::vector<double> ms;  // all that were taken, in order
};
struct BenchFile {
    std::vector<BenchTimes> times;
    std::vector<std::pair<std::string, std::string>> setting;  // what was measured, and on what
};
Result<BenchFile> parse_bench_file(std::string_view text);

enum class BenchVerdict { same, faster, slower, unsure, gone, added, small };
inline constexpr const char* k_verdict_words[] = {"same",        "faster",     "SLOWER", "too few samples",
                                                  "only before", "only after", "small"};

struct Compared {
    std::string name;
    double before_ms = 0, after_ms = 0;  // medians; 0: it is not there
    Difference difference;
    BenchVerdict verdict = BenchVerdict::same;
};

// Everything that is in either. Slower is what differs beyond chance, by all that are compared at once
// (Holm's way, 1 %), and, as far as the samples can tell, takes longer by the tolerance or more; faster the
// other way round. What takes less than a hundredth of the longest is small, and nothing is said of it.
std::vector<Compared> compare_times(const BenchFile& before, const BenchFile& after,
                                    double tolerance_percent);

// A table, on standard output; an Error if something is slower.
Result<void> bench_compare(const std::string& before, const std::string& after, double tolerance_percent);

}  // namespace flaneur
