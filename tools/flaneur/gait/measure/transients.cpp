#include "tools/flaneur/gait/measure/transients.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/flaneur/gait/measure/signal.h"

namespace flaneur {

namespace {

constexpr double k_degrees = 180 / std::numbers::pi;

int contacts(const Walk& walk, size_t from, size_t to) {
    int n = 0;
    for (size_t t = std::max<size_t>(from, 1); t <= to && t < walk.ticks.size(); ++t) {
        for (Side side : {k_left, k_right})
            n += walk.ticks[t - 1].feet[side].swinging && !walk.ticks[t].feet[side].swinging;
    }
    return n;
}

// Horizontal speed of the pelvis below `cutoff` Hz, m/s.
Samples pelvis_speed(const Walk& walk, double cutoff) {
    Samples axis[2], speed;
    for (const Instant& now : walk.ticks) {
        axis[0].push_back(static_cast<double>(place(now, hips).x));
        axis[1].push_back(static_cast<double>(place(now, hips).z));
    }
    for (Samples& s : axis) s = low_pass(s, walk.rate, cutoff);
    for (size_t t = 0; t < walk.ticks.size(); ++t) {
        size_t a = t > 0 ? t - 1 : 0, b = std::min(t + 1, walk.ticks.size() - 1);
        double span = static_cast<double>(b - a) / walk.rate;
        speed.push_back(std::hypot(axis[0][b] - axis[0][a], axis[1][b] - axis[1][a]) / std::max(span, 1e-9));
    }
    return speed;
}

// Yaw of joints, averaged, in degrees without jumps.
Samples yaw_of(const Walk& walk, std::initializer_list<Joint> joints) {
    Samples yaw;
    for (const Instant& now : walk.ticks) {
        double x = 0, z = 0;
        for (Joint joint : joints) {
            Vec3 front = rotate(now.joints[joint].rotation, Vec3{0, 0, 1});
            x += static_cast<double>(front.x);
            z += static_cast<double>(front.z);
        }
        double angle = std::atan2(x, z) * k_degrees;
        if (!yaw.empty()) angle = yaw.back() + std::remainder(angle - yaw.back(), 360);
        yaw.push_back(angle);
    }
    return yaw;
}

Samples rate_of(const Samples& values, double rate) {
    Samples out(values.size(), 0.0);
    for (size_t t = 1; t + 1 < values.size(); ++t) out[t] = (values[t + 1] - values[t - 1]) / 2 * rate;
    return out;
}

// Ticks by which `first` runs ahead of `second`, at most half a second.
double lead(const Samples& first, const Samples& second, size_t begin, size_t end, double rate) {
    int most = static_cast<int>(rate / 2);
    std::vector<double> agreement;
    for (int shift = -most; shift <= most; ++shift) {
        double sum = 0, a = 0, b = 0;
        for (size_t t = begin; t < end; ++t) {
            auto later = static_cast<std::ptrdiff_t>(t) + shift;
            if (later < 0 || later >= static_cast<std::ptrdiff_t>(second.size())) continue;
            double x = first[t], y = second[static_cast<size_t>(later)];
            sum += x * y, a += x * x, b += y * y;
        }
        agreement.push_back(a > 0 && b > 0 ? sum / std::sqrt(a * b) : 0);
    }
    auto best = std::max_element(agreement.begin(), agreement.end()) - agreement.begin();
    return static_cast<double>(best - most);
}

}  // namespace

Quantities measure_start(const Walk& walk, size_t asked, double steady) {
    Samples speed = pelvis_speed(walk, 1.5);
    size_t t = asked;
    while (t < speed.size() && speed[t] < 0.9 * steady) ++t;
    return {{"start.steps", static_cast<double>(contacts(walk, asked, t) + 1)},
            {"start.s", static_cast<double>(t - asked) / walk.rate}};
}

Quantities measure_stop(const Walk& walk, size_t asked) {
    size_t last = asked;
    for (size_t t = asked; t < walk.ticks.size(); ++t) {
        if (walk.ticks[t].feet[k_left].swinging || walk.ticks[t].feet[k_right].swinging) last = t + 1;
    }
    return {{"stop.steps", static_cast<double>(contacts(walk, asked, last))},
            {"stop.s", static_cast<double>(last - asked) / walk.rate}};
}

Quantities measure_turn(const Walk& walk, size_t asked) {
    Samples trunk = low_pass(yaw_of(walk, {hips, upper_chest}), walk.rate, 3);
    Samples gaze = low_pass(yaw_of(walk, {head}), walk.rate, 3);
    double from = trunk[asked], angle = trunk.back() - from, sign = angle < 0 ? -1 : 1;
    Samples trunk_rate = rate_of(trunk, walk.rate), head_rate = rate_of(gaze, walk.rate);
    Samples speed = pelvis_speed(walk, 3);
    size_t fastest = asked;
    for (size_t t = asked; t < trunk.size(); ++t) {
        if (sign * trunk_rate[t] > sign * trunk_rate[fastest]) fastest = t;
    }
    double least = 0.1 * sign * trunk_rate[fastest];
    size_t begin = fastest, end = fastest;
    while (begin > asked && sign * trunk_rate[begin] > least) --begin;
    while (end + 1 < trunk.size() && sign * trunk_rate[end] > least) ++end;
    double slowest = *std::min_element(speed.begin() + static_cast<std::ptrdiff_t>(begin),
                                       speed.begin() + static_cast<std::ptrdiff_t>(end) + 1);
    auto half_second = static_cast<size_t>(walk.rate / 2);
    size_t early = begin > half_second ? begin - half_second : 0;
    double ahead = lead(head_rate, trunk_rate, early, std::min(end + half_second, trunk.size()), walk.rate);
    return {{"turn.deg", sign * angle},
            {"turn.s", static_cast<double>(end - begin) / walk.rate},
            {"turn_peak.deg_s", sign * trunk_rate[fastest]},
            {"turn_least_speed.m_s", slowest},
            {"turn.steps", static_cast<double>(contacts(walk, begin, end))},
            {"head_lead.ms", 1000 * ahead / walk.rate}};
}

Quantities measure_leap(const Walk& walk, size_t first) {
    auto flies = [&](size_t t) {
        const FootInstant(&feet)[2] = walk.ticks[t].feet;
        return feet[k_left].swinging && feet[k_right].swinging;
    };
    size_t begin = first, end = first;
    for (size_t t = first; t < walk.ticks.size(); ++t) {
        size_t from = t;
        while (t < walk.ticks.size() && flies(t)) ++t;
        if (t - from > end - begin) begin = from, end = t;
    }
    if (end == begin || begin == 0 || end == walk.ticks.size()) return {{"flight.s", 0}, {"leapt.m", 0}};
    const Instant &left = walk.ticks[begin - 1], &lands = walk.ticks[end];
    const FootInstant& last = left.feet[left.feet[k_left].swinging ? k_right : k_left];
    const FootInstant& next = lands.feet[lands.feet[k_left].swinging ? k_right : k_left];
    return {{"flight.s", static_cast<double>(end - begin) / walk.rate},
            {"leapt.m", static_cast<double>(next.sole.heel.z - last.sole.tip.z)}};
}

}  // namespace flaneur
