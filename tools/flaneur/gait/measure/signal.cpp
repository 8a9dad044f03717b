#include "tools/flaneur/gait/measure/signal.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flaneur {

namespace {

constexpr double k_tau = 2 * std::numbers::pi;

// One pass of a second-order Butterworth low-pass by the bilinear transform, in place.
void pass(Samples& v, double rate, double cutoff) {
    double c = 1 / std::tan(std::numbers::pi * cutoff / rate);
    double a0 = 1 / (1 + std::numbers::sqrt2 * c + c * c);
    double b1 = 2 * a0 * (1 - c * c), b2 = a0 * (1 - std::numbers::sqrt2 * c + c * c);
    double x1 = v[0], x2 = v[0], y1 = v[0], y2 = v[0];
    for (double& value : v) {
        double x = value;
        double y = a0 * (x + 2 * x1 + x2) - b1 * y1 - b2 * y2;
        x2 = x1, x1 = x, y2 = y1, y1 = y;
        value = y;
    }
}

Peak extreme(const Cycle& c, int first, int last, double sign) {
    auto at = [&](int p) { return c[static_cast<size_t>((p % 100 + 100) % 100)]; };
    int best = first;
    for (int p = first; p <= last; ++p) {
        if (sign * at(p) > sign * at(best)) best = p;
    }
    double before = at(best - 1), here = at(best), after = at(best + 1);
    double bend = before - 2 * here + after, shift = 0;
    bool inside = best > first && best < last;
    if (inside && bend * sign < 0) shift = 0.5 * (before - after) / bend;
    return {best + shift, here - 0.25 * (before - after) * shift};
}

}  // namespace

Samples low_pass(const Samples& values, double rate, double cutoff) {
    if (values.size() < 2) return values;
    double corrected =
        rate / std::numbers::pi * std::atan(std::tan(std::numbers::pi * cutoff / rate) / 0.802);
    size_t n = values.size(), pad = std::min<size_t>(n - 1, 60);
    Samples padded;
    for (size_t i = pad; i > 0; --i) padded.push_back(2 * values[0] - values[i]);
    padded.insert(padded.end(), values.begin(), values.end());
    for (size_t i = 1; i <= pad; ++i) padded.push_back(2 * values[n - 1] - values[n - 1 - i]);
    for (int direction = 0; direction < 2; ++direction) {
        pass(padded, rate, corrected);
        std::reverse(padded.begin(), padded.end());
    }
    auto begin = padded.begin() + static_cast<std::ptrdiff_t>(pad);
    return {begin, begin + static_cast<std::ptrdiff_t>(n)};
}

double mean_jerk(const std::vector<Vec3>& path, double rate, size_t begin, size_t end) {
    Samples axis[3];
    for (Vec3 p : path) {
        axis[0].push_back(static_cast<double>(p.x));
        axis[1].push_back(static_cast<double>(p.y));
        axis[2].push_back(static_cast<double>(p.z));
    }
    for (Samples& s : axis) s = low_pass(s, rate, 10);
    begin = std::max<size_t>(begin, 2);
    end = std::min(end, path.size() < 2 ? 0 : path.size() - 2);
    double sum = 0;
    for (size_t i = begin; i < end; ++i) {
        double square = 0;
        for (const Samples& s : axis) {
            double third = (s[i + 2] - 2 * s[i + 1] + 2 * s[i - 1] - s[i - 2]) / 2 * rate * rate * rate;
            square += third * third;
        }
        sum += std::sqrt(square);
    }
    return end > begin ? sum / static_cast<double>(end - begin) : 0;
}

double sample_at(const Samples& values, double tick) {
    double last = static_cast<double>(values.size() - 1);
    tick = std::clamp(tick, 0.0, last);
    auto i = static_cast<size_t>(std::min(std::floor(tick), std::max(last - 1, 0.0)));
    size_t next = std::min(i + 1, values.size() - 1);
    return values[i] + (values[next] - values[i]) * (tick - static_cast<double>(i));
}

Cycle cycle_of(const Samples& values, double begin, double end) {
    Cycle c;
    for (size_t p = 0; p < c.size(); ++p)
        c[p] = sample_at(values, begin + (end - begin) * static_cast<double>(p) / 100);
    return c;
}

double mean(const Cycle& c) {
    double sum = 0;
    for (size_t p = 0; p < 100; ++p) sum += c[p];
    return sum / 100;
}

Cycle centred(const Cycle& c) {
    Cycle out = c;
    double m = mean(c);
    for (double& v : out) v -= m;
    return out;
}

double range(const Cycle& c) {
    auto [low, high] = std::minmax_element(c.begin(), c.end());
    return *high - *low;
}

double rmse(const Cycle& a, const Cycle& b) {
    double sum = 0;
    for (size_t p = 0; p < 100; ++p) sum += (a[p] - b[p]) * (a[p] - b[p]);
    return std::sqrt(sum / 100);
}

double correlation(const Cycle& a, const Cycle& b) {
    double ma = mean(a), mb = mean(b), ab = 0, aa = 0, bb = 0;
    for (size_t p = 0; p < 100; ++p) {
        ab += (a[p] - ma) * (b[p] - mb);
        aa += (a[p] - ma) * (a[p] - ma);
        bb += (b[p] - mb) * (b[p] - mb);
    }
    return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0;
}

Peak highest(const Cycle& c, int first, int last) { return extreme(c, first, last, 1); }
Peak lowest(const Cycle& c, int first, int last) { return extreme(c, first, last, -1); }

Wave harmonic(const Cycle& c, int k) {
    double cosine = 0, sine = 0;
    for (size_t p = 0; p < 100; ++p) {
        double angle = k_tau * k * static_cast<double>(p) / 100;
        cosine += c[p] * std::cos(angle) / 50;
        sine += c[p] * std::sin(angle) / 50;
    }
    double phase = std::atan2(sine, cosine) / k_tau * 360;
    return {std::hypot(cosine, sine), phase < 0 ? phase + 360 : phase};
}

double phase_between(Wave a, Wave b) {
    double d = b.phase - a.phase;
    return d < 0 ? d + 360 : d;
}

}  // namespace flaneur
