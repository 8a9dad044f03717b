#include "assets/traced/sway.h"

#include <cmath>

#include "assets/traced/path.h"
#include "assets/traced/spline.h"
#include "sim/base/math.h"

namespace flaneur {

namespace {

constexpr double k_window = 3, k_least_window = 2;                                 // seconds
constexpr double k_course = 0.35;                                                  // Hz, of what is no sway
constexpr double k_slowest_stride = 0.5, k_quickest_stride = 1.3, k_apart = 0.05;  // Hz
constexpr double k_least_sway = 0.006, k_most_sway = 0.08, k_most_ripple = 0.04;   // metres, to a side
constexpr double k_share = 0.5;    // of the squares of what leaves the way
constexpr double k_walks = 0.25;   // m/s
constexpr double k_sparse = 0.15;  // seconds

// What leaves the way, in the way's own directions.
struct Residual {
    double time = 0, across = 0, along = 0;
    double ahead_x = 0, ahead_z = 1, speed = 0;
};

struct Wave {
    double cosine = 0, sine = 0;  // metres
    double explains = 0;          // of the weighted squares
};
double amplitude(const Wave& w) { return std::sqrt(w.cosine * w.cosine + w.sine * w.sine); }

struct Window {
    double middle = 0;
    size_t first = 0, last = 0;  // of the residuals within
};
double hann(const Window& w, double time) {
    return 0.5 +
           0.5 * static_cast<double>(
                     sin_cos(static_cast<float>((time - w.middle) * (2 * 3.14159265 / k_window))).cosine);
}
SinCos phase(const Window& w, double time, double hertz) {
    return sin_cos(static_cast<float>((time - w.middle) * hertz * 6.28318531));
}

// The wave of so many hertz that is nearest to what leaves the way.
Wave nearest_wave(const std::vector<Residual>& all, const Window& w, double hertz, double Residual::*which) {
    double cc = 0, cs = 0, ss = 0, ec = 0, es = 0;
    for (size_t i = w.first; i < w.last; ++i) {
        const SinCos p = phase(w, all[i].time, hertz);
        const double weight = hann(w, all[i].time), e = all[i].*which;
        const auto c = static_cast<double>(p.cosine), s = static_cast<double>(p.sine);
        cc += weight * c * c, cs += weight * c * s, ss += weight * s * s;
        ec += weight * e * c, es += weight * e * s;
    }
    const double det = cc * ss - cs * cs;
    if (det < 1e-9) return {};
    Wave wave{(ec * ss - es * cs) / det, (es * cc - ec * cs) / det, 0};
    wave.explains = wave.cosine * ec + wave.sine * es;
    return wave;
}

std::vector<Residual> leaves_way(const std::vector<SeenAt>& spots) {
    const Path course = smooth_path(spots, k_course);
    std::vector<Residual> all;
    all.reserve(spots.size());
    for (const SeenAt& s : spots) {
        const double vx = slope_at(course.x, s.time), vz = slope_at(course.z, s.time),
                     speed = std::sqrt(vx * vx + vz * vz);
        const double ax = speed > 1e-6 ? vx / speed : 0, az = speed > 1e-6 ? vz / speed : 1;
        const double ex = s.x - value_at(course.x, s.time), ez = s.z - value_at(course.z, s.time);
        all.push_back({s.time, ex * az - ez * ax, ex * ax + ez * az, ax, az, speed});
    }
    return all;
}

// The stride that a window shows; 0: none.
double stride_in(const std::vector<Residual>& all, const Window& w, Wave& sway) {
    double squares = 0, speed = 0;
    for (size_t i = w.first; i < w.last; ++i) {
        squares += hann(w, all[i].time) * all[i].across * all[i].across;
        speed += all[i].speed / static_cast<double>(w.last - w.first);
    }
    if (speed < k_walks) return 0;
    const int steps = static_cast<int>((k_quickest_stride - k_slowest_stride) / k_apart + 0.5);
    int best = 0;
    for (int k = 0; k <= steps; ++k) {
        const Wave wave = nearest_wave(all, w, k_slowest_stride + k * k_apart, &Residual::across);
        if (wave.explains > sway.explains) sway = wave, best = k;
    }
    const double to_side = amplitude(sway);
    const bool is_sway = best > 0 && best < steps && sway.explains > k_share * squares &&
                         to_side > k_least_sway && to_side < k_most_sway;
    return is_sway ? k_slowest_stride + best * k_apart : 0;
}

}  // namespace

size_t take_out_sway(std::vector<SeenAt>& spots) {
    const size_t n = spots.size();
    if (n < 8 || spots[n - 1].time - spots[0].time < k_least_window) return 0;
    if ((spots[n - 1].time - spots[0].time) / static_cast<double>(n - 1) > k_sparse) return 0;
    const std::vector<Residual> all = leaves_way(spots);
    std::vector<bool> sways(n);
    const double hop = k_window / 2;
    size_t first = 0;
    for (double middle = spots[0].time; middle < spots[n - 1].time + hop; middle += hop) {
        Window w{middle, 0, 0};
        while (first < n && all[first].time < middle - hop) ++first;
        w.first = w.last = first;
        while (w.last < n && all[w.last].time < middle + hop) ++w.last;
        if (w.last - w.first < 8 || all[w.last - 1].time - all[w.first].time < k_least_window) continue;
        Wave sway;
        const double hertz = stride_in(all, w, sway);
        if (hertz == 0) continue;
        Wave ripple = nearest_wave(all, w, 2 * hertz, &Residual::along);
        if (amplitude(ripple) > k_most_ripple) ripple = {};
        for (size_t i = w.first; i < w.last; ++i) {
            const Residual& r = all[i];
            const SinCos p = phase(w, r.time, hertz), q = phase(w, r.time, 2 * hertz);
            const double weight = hann(w, r.time);
            auto of = [&](const Wave& wave, const SinCos& at) {
                return weight * (wave.cosine * static_cast<double>(at.cosine) +
                                 wave.sine * static_cast<double>(at.sine));
            };
            const double across = of(sway, p), along = of(ripple, q);
            spots[i].x -= across * r.ahead_z + along * r.ahead_x;
            spots[i].z -= -across * r.ahead_x + along * r.ahead_z;
            sways[i] = true;
        }
    }
    size_t count = 0;
    for (const bool is : sways) count += is;
    return count;
}

}  // namespace flaneur
