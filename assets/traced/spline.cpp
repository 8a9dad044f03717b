#include "assets/traced/spline.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace flaneur {

namespace {

constexpr double k_two_pi = 6.283185307179586;
constexpr size_t k_band = 4;  // of the equations: the diagonal and three beside it

using Weights = std::array<double, 4>;

// Of the four control points that a time lies between, the first; and what each counts.
struct Place {
    size_t first = 0;
    double within = 0;  // 0..1
};
Place place_of(const Spline& s, double time) {
    const double at = std::max((time - s.begin) / s.step, 0.0);
    const size_t first = std::min(static_cast<size_t>(at), s.points.size() - 4);
    return {first, std::min(at - static_cast<double>(first), 1.0)};
}
Weights values(double u) {
    const double v = 1 - u;
    return {v * v * v / 6, (3 * u * u * u - 6 * u * u + 4) / 6, (3 * v * v * v - 6 * v * v + 4) / 6,
            u * u * u / 6};
}
Weights slopes(double u) {
    const double v = 1 - u;
    return {-v * v / 2, (3 * u * u - 4 * u) / 2, (4 * v - 3 * v * v) / 2, u * u / 2};
}
double sum_at(const Spline& s, size_t first, const Weights& w) {
    double sum = 0;
    for (size_t i = 0; i < 4; ++i) sum += w[i] * s.points[first + i];
    return sum;
}

// Symmetric equations, `rows[i][d]` of unknowns i and i + d.
struct Equations {
    std::vector<std::array<double, k_band>> rows;
    std::vector<double> right;
};

template <size_t N>
void add_square(Equations& e, size_t first, const std::array<double, N>& of, double weight) {
    for (size_t i = 0; i < N; ++i)
        for (size_t k = i; k < N; ++k) e.rows[first + i][k - i] += weight * of[i] * of[k];
}

// By Cholesky's L D L^T.
std::vector<double> solve(Equations e) {
    const size_t n = e.rows.size();
    for (size_t i = 0; i < n; ++i)
        for (size_t d = 1; d < k_band && i + d < n; ++d) {
            const double share = e.rows[i][d] / e.rows[i][0];
            for (size_t f = d; f < k_band && i + f < n; ++f) e.rows[i + d][f - d] -= share * e.rows[i][f];
            e.right[i + d] -= share * e.right[i];
        }
    for (size_t i = n; i-- > 0;) {
        for (size_t d = 1; d < k_band && i + d < n; ++d) e.right[i] -= e.rows[i][d] * e.right[i + d];
        e.right[i] /= e.rows[i][0];
    }
    return std::move(e.right);
}

}  // namespace

double value_at(const Spline& s, double time) {
    const Place p = place_of(s, time);
    return sum_at(s, p.first, values(p.within));
}

double slope_at(const Spline& s, double time) {
    const Place p = place_of(s, time);
    return sum_at(s, p.first, slopes(p.within)) / s.step;
}

Spline fit_spline(std::span<const TimedValue> measured, double begin, double step, size_t stretches,
                  Smoothing how) {
    Spline s{begin, step, std::vector<double>(stretches + 3)};
    Equations e{std::vector<std::array<double, k_band>>(stretches + 3), std::vector<double>(stretches + 3)};
    const double base = measured.empty() ? 0 : measured[0].value;  // so that numbers are small
    for (const TimedValue& m : measured) {
        const Place p = place_of(s, m.time);
        const Weights w = values(p.within);
        add_square(e, p.first, w, m.weight);
        for (size_t i = 0; i < 4; ++i) e.right[p.first + i] += m.weight * w[i] * (m.value - base);
    }
    const double turn = 1 / (k_two_pi * how.cutoff),
                 third = turn * turn * turn * turn * turn * turn / (step * step * step * step * step);
    for (size_t i = 0; i + 3 < s.points.size(); ++i)
        add_square(e, i, std::array<double, 4>{-1, 3, -3, 1}, third);
    // And by a hair always, so that one place alone stays where it is.
    const double first = std::max(how.pull, 1e-9) / step;
    for (size_t i = 0; i + 1 < s.points.size(); ++i) add_square(e, i, std::array<double, 2>{-1, 1}, first);
    s.points = solve(std::move(e));
    for (double& point : s.points) point += base;
    return s;
}

}  // namespace flaneur
