#include "assets/traced/path.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/base/vec.h"

namespace flaneur {

namespace {

constexpr double k_step = 0.1;     // seconds, of a course
constexpr int k_rounds = 14;       // of fits at most
constexpr double k_spreads = 0.3;  // seconds to each side that what has to be livelier takes along
// Of headings: 1/s; seconds, of a window to look along the path; metres that are a direction; m/s of one who
// walks; rad/s, that nobody turns faster.
constexpr double k_turns = 0.35, k_pull = 0.12;
constexpr double k_shortest_look = 0.5, k_longest_look = 2.5, k_looks = 0.3;
constexpr double k_fastest_turn = 1.9;
constexpr double k_stays = 0.12;  // metres

std::vector<TimedValue> measured(const std::vector<SeenAt>& spots, double SeenAt::*which,
                                 const std::vector<double>& times_weight) {
    std::vector<TimedValue> all;
    all.reserve(spots.size());
    for (size_t i = 0; i < spots.size(); ++i)
        all.push_back(
            {spots[i].time, spots[i].*which, spots[i].weight * (times_weight.empty() ? 1 : times_weight[i])});
    return all;
}

Path fit_path(const std::vector<SeenAt>& spots, const std::vector<double>& weights, double begin, double step,
              size_t stretches, double cutoff) {
    return {fit_spline(measured(spots, &SeenAt::x, weights), begin, step, stretches, {cutoff, 0}),
            fit_spline(measured(spots, &SeenAt::z, weights), begin, step, stretches, {cutoff, 0})};
}

// How far spots lie from a path, k_mean seconds of them taken together, against k_off; or each, against
// k_off_alone.
std::vector<double> distances(const std::vector<SeenAt>& spots, const Path& path) {
    const size_t n = spots.size();
    std::vector<double> ex(n), ez(n), off(n);
    for (size_t i = 0; i < n; ++i) {
        ex[i] = spots[i].x - value_at(path.x, spots[i].time);
        ez[i] = spots[i].z - value_at(path.z, spots[i].time);
    }
    size_t first = 0, last = 0;
    double x = 0, z = 0;
    for (size_t i = 0; i < n; ++i) {
        while (last < n && spots[last].time <= spots[i].time + k_mean / 2)
            x += ex[last], z += ez[last], ++last;
        while (spots[first].time < spots[i].time - k_mean / 2) x -= ex[first], z -= ez[first], ++first;
        const double count = static_cast<double>(last - first);
        const double alone = std::sqrt(ex[i] * ex[i] + ez[i] * ez[i]) / k_off_alone;
        off[i] = std::max(std::sqrt(x * x + z * z) / count / k_off, alone);
    }
    return off;
}

double wrapped(double angle) { return static_cast<double>(wrap_angle(static_cast<float>(angle))); }

// A curve through yaws, whose weights become less where it would turn too fast.
Spline fit_heading(const Path& path, std::vector<TimedValue> all) {
    const double step = path.x.step;
    const size_t stretches = path.x.points.size() - 3;
    Spline heading;
    constexpr int k_calmer = 6;
    for (int round = 0; round < k_calmer; ++round) {
        heading = fit_spline(all, path.x.begin, step, stretches, {k_turns, k_pull});
        bool is_calm = true;
        for (TimedValue& m : all) {
            if (std::fabs(slope_at(heading, m.time)) < k_fastest_turn) continue;
            is_calm = false;
            m.weight *= 0.3;
        }
        if (is_calm) break;
    }
    return heading;
}

}  // namespace

Path smooth_path(const std::vector<SeenAt>& spots, double cutoff) {
    const double begin = spots.front().time;
    const auto stretches = static_cast<size_t>((spots.back().time - begin) / k_step) + 1;
    return fit_path(spots, {}, begin, k_step, stretches, cutoff);
}

Path follow_spots(const std::vector<SeenAt>& spots, double begin, double step, size_t stretches) {
    const double ratio = k_liveliest / k_calmest, most = ratio * ratio * ratio * ratio * ratio * ratio;
    const size_t n = spots.size();
    std::vector<double> weights(n, 1), more(n);
    Path path;
    for (int round = 0; round < k_rounds; ++round) {
        path = fit_path(spots, weights, begin, step, stretches, k_calmest);
        const std::vector<double> off = distances(spots, path);
        bool is_near = true;
        for (size_t i = 0; i < n; ++i) {
            const double beyond = off[i];
            more[i] = beyond > 1.05 ? std::min(beyond * beyond, 6.0) : 1;
            is_near = is_near && more[i] == 1;
        }
        if (is_near) break;
        for (size_t i = 0; i < n; ++i) {
            double times = more[i];
            for (size_t k = i; k-- > 0 && spots[k].time > spots[i].time - k_spreads;)
                times = std::max(times, more[k]);
            for (size_t k = i + 1; k < n && spots[k].time < spots[i].time + k_spreads; ++k)
                times = std::max(times, more[k]);
            weights[i] = std::min(weights[i] * times, most);
        }
    }
    return path;
}

Spline heading_along(const Path& path, double stands) {
    const double begin = path.x.begin, step = path.x.step,
                 end = begin + step * static_cast<double>(path.x.points.size() - 3);
    std::vector<TimedValue> all;
    double before = 0;
    for (double time = begin; time < end + step / 2; time += step) {
        double look = k_shortest_look, x = 0, z = 0, way = 0;
        for (; look <= k_longest_look; look *= 1.5) {
            const double from = std::max(time - look, begin), to = std::min(time + look, end);
            x = value_at(path.x, to) - value_at(path.x, from);
            z = value_at(path.z, to) - value_at(path.z, from);
            way = std::sqrt(x * x + z * z);
            if (way >= k_looks) break;
        }
        if (way < k_stays) continue;  // else noise would turn it round
        const double clear = std::min(way / k_looks, 1.0);
        const auto yaw = static_cast<double>(heading_of({static_cast<float>(x), static_cast<float>(z)}));
        if (all.empty()) before = yaw;
        before += wrapped(yaw - before);
        all.push_back({time, before, step * clear * clear * clear});
    }
    if (all.empty()) all.push_back({begin, stands, 1});
    return fit_heading(path, std::move(all));
}

Spline heading_of_measured(const Path& path, const std::vector<double>& times, const std::vector<float>& yaws,
                           const std::vector<double>& weights) {
    std::vector<TimedValue> all;
    double before = static_cast<double>(yaws[0]);
    for (size_t i = 0; i < times.size(); ++i) {
        before += wrapped(static_cast<double>(yaws[i]) - before);
        all.push_back({times[i], before, weights[i]});
    }
    return fit_heading(path, std::move(all));
}

}  // namespace flaneur
