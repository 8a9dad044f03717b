#include "tools/flaneur/bench/significance.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tools/flaneur/output/figures.h"

namespace flaneur {
namespace {

constexpr size_t k_stretches = 14;
constexpr double k_z_of_99 = 2.575829;  // standard deviations

std::vector<double> medians_of_stretches(std::span<const double> samples) {
    const size_t count = std::min(samples.size(), k_stretches);
    std::vector<double> medians;
    for (size_t i = 0; i < count; ++i) {
        const size_t begin = i * samples.size() / count, end = (i + 1) * samples.size() / count;
        medians.push_back(quantile({samples.begin() + static_cast<std::ptrdiff_t>(begin),
                                    samples.begin() + static_cast<std::ptrdiff_t>(end)},
                                   0.5));
    }
    return medians;
}

// Mann and Whitney's U of `a` is how many of the pairs have the larger one in it, ties for a half. Without a
// difference it is spread about half of the pairs.
double p_value(const std::vector<double>& a, const std::vector<double>& b) {
    double u = 0;
    for (double x : a)
        for (double y : b) u += x > y ? 1 : x == y ? 0.5 : 0;
    std::vector<double> all = a;
    all.insert(all.end(), b.begin(), b.end());
    std::sort(all.begin(), all.end());
    double ties = 0;
    for (size_t i = 0, j = 0; i < all.size(); i = j) {
        while (j < all.size() && all[j] == all[i]) ++j;
        const auto t = static_cast<double>(j - i);
        ties += t * t * t - t;
    }
    const auto n = static_cast<double>(a.size()), m = static_cast<double>(b.size());
    const double spread = n * m / 12 * (n + m + 1 - ties / ((n + m) * (n + m - 1)));
    if (!(spread > 0)) return 1;
    const double z = std::max(std::abs(u - n * m / 2) - 0.5, 0.0) / std::sqrt(spread);
    return std::erfc(z / std::sqrt(2.0));
}

}  // namespace

Difference difference_of(std::span<const double> earlier, std::span<const double> later) {
    Difference d;
    if (earlier.empty() || later.empty()) return d;
    const std::vector<double> a = medians_of_stretches(earlier), b = medians_of_stretches(later);
    std::vector<double> ratios;
    for (double x : a)
        for (double y : b) ratios.push_back(x > 0 ? y / x : y > 0 ? INFINITY : 1);
    std::sort(ratios.begin(), ratios.end());
    const auto n = static_cast<double>(a.size()), m = static_cast<double>(b.size());
    const double outside = n * m / 2 - k_z_of_99 * std::sqrt(n * m * (n + m + 1) / 12);
    const auto first = static_cast<size_t>(std::max(std::floor(outside), 0.0));
    d.ratio = quantile(ratios, 0.5);
    d.low = ratios[first];
    d.high = ratios[ratios.size() - 1 - first];
    d.is_enough = std::min(earlier.size(), later.size()) >= static_cast<size_t>(k_least_samples);
    if (d.is_enough) d.p = p_value(a, b);
    return d;
}

}  // namespace flaneur
