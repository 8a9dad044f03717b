#include "tools/flaneur/bench/study/fit.h"

#include <algorithm>
#include <cmath>

namespace flaneur {

namespace {

// y = rise * x + base, by least squares; none where all x are equal.
struct Straight {
    double rise = 0, base = 0;
};
template <class X, class Y>
std::optional<Straight> fit_line(std::span<const PlotPoint> points, const X& x_of, const Y& y_of) {
    const auto count = static_cast<double>(points.size());
    double x_mean = 0, y_mean = 0, xx = 0, xy = 0;
    for (const PlotPoint& p : points) x_mean += x_of(p.x) / count, y_mean += y_of(p.y) / count;
    for (const PlotPoint& p : points) {
        const double x = x_of(p.x) - x_mean;
        xx += x * x;
        xy += x * (y_of(p.y) - y_mean);
    }
    if (!(xx > 0)) return {};
    return Straight{xy / xx, y_mean - xy / xx * x_mean};
}

double log_of(double value) { return std::log(value); }

}  // namespace

std::optional<PowerLaw> fit_power(std::span<const PlotPoint> points) {
    constexpr size_t k_least = 3;
    if (points.size() < k_least) return {};
    const std::span<const PlotPoint> upper = points.last(std::max(k_least, (points.size() + 1) / 2));
    if (!std::all_of(upper.begin(), upper.end(), [](const PlotPoint& p) { return p.x > 0 && p.y > 0; }))
        return {};
    const std::optional<Straight> line = fit_line(upper, log_of, log_of);
    if (!line) return {};
    return PowerLaw{line->rise, std::exp(line->base), upper.front().x, upper.back().x};
}

std::optional<double> crossing(std::span<const PlotPoint> points, double level) {
    for (size_t i = 1; i < points.size(); ++i) {
        const PlotPoint &a = points[i - 1], &b = points[i];
        if (!(a.y < level && b.y >= level && a.x > 0 && a.y > 0)) continue;
        const double share = std::log(level / a.y) / std::log(b.y / a.y);
        return a.x * std::pow(b.x / a.x, share);
    }
    return {};
}

std::optional<Amdahl> fit_amdahl(std::span<const PlotPoint> points) {
    const std::optional<Straight> line = fit_line(
        points, [](double threads) { return 1 / threads; }, [](double ms) { return ms; });
    if (!line) return {};
    double mean_y = 0, y_over_x = 0, one_over_xx = 0;
    for (const PlotPoint& p : points) {
        mean_y += p.y / static_cast<double>(points.size());
        y_over_x += p.y / p.x;
        one_over_xx += 1 / (p.x * p.x);
    }
    if (!(mean_y > 0)) return {};
    if (line->base < 0) return Amdahl{0, y_over_x / one_over_xx};  // shared all of it
    if (line->rise < 0) return Amdahl{mean_y, 0};                  // threads are of no use
    return Amdahl{line->base, line->rise};
}

}  // namespace flaneur
