// Frames for times: even ones as they are, others on even ones along straight lines.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "assets/trajectories/formats.h"

namespace flaneur {
namespace {

constexpr double k_most_frames = 1e15;  // farther on, whole numbers are no longer told apart
constexpr double k_last_frame = 100'000'000, k_late = 1'000'000;  // frames
constexpr double k_most_off = 0.1;        // of a step: what rounding does to even times
constexpr double k_finest = 25;           // frames a second that times which are not even are put on
constexpr double k_short_gap = 2;         // seconds
constexpr double k_has_not_moved = 0.05;  // metres

// Rows lie on first + k * step.
struct Clock {
    double first = 0, step = 0;  // in what `time` counts; step 0: there is one time alone
    bool is_even = false;
    double own_step = 0;  // the middle one of those between two rows of one person
};

double middle_value(std::vector<double>& values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

Clock clock_of(const FoundTracks& found) {
    Clock clock;
    std::vector<double> times, steps;
    times.reserve(found.rows.size());
    for (size_t i = 0; i < found.rows.size(); ++i) {
        times.push_back(found.rows[i].time);
        if (i > 0 && found.rows[i].who == found.rows[i - 1].who)
            steps.push_back(found.rows[i].time - found.rows[i - 1].time);
    }
    clock.own_step = middle_value(steps);
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    clock.first = times.front();
    steps.clear();
    for (size_t i = 1; i < times.size(); ++i) steps.push_back(times[i] - times[i - 1]);
    const double about = middle_value(steps);
    if (about <= 0) return clock;
    if (found.is_in_frames) {
        // Whole numbers, and so is what they have in common.
        int64_t common = 0;
        clock.is_even = std::fabs(clock.first) < k_most_frames && times.back() < k_most_frames &&
                        std::all_of(times.begin(), times.end(), [&](double t) {
                            common = std::gcd(common, std::llround(t - clock.first));
                            return t == std::round(t);
                        });
        clock.step = clock.is_even ? static_cast<double>(common) : 1;
        return clock;
    }
    // Times have few digits: so the step is found over all of them.
    double passed = 0;
    for (size_t i = 1; i < times.size(); ++i) passed += std::round((times[i] - times[i - 1]) / about);
    if (passed <= 0) return clock;
    clock.step = (times.back() - clock.first) / passed;
    double k = 0;
    clock.is_even = true;
    for (size_t i = 1; i < times.size() && clock.is_even; ++i) {
        const double steps_on = std::round((times[i] - times[i - 1]) / about);
        k += steps_on;
        clock.is_even =
            steps_on > 0 && std::fabs(times[i] - clock.first - k * clock.step) < k_most_off * clock.step;
    }
    return clock;
}

// Whole or half where it nearly is: 0.0333 s are 30 a second.
double round_rate(double fps) {
    const double whole = std::round(fps), half = std::round(fps * 2) / 2;
    if (whole > 0 && std::fabs(fps - whole) < 5e-4 * fps) return whole;
    if (half > 0 && std::fabs(fps - half) < 5e-4 * fps) return half;
    return std::round(fps * 1000) / 1000;
}

std::string frames_a_second(double fps) {
    return short_number(fps) + (fps == 1 ? " frame a second" : " frames a second");
}

double rate_for(double own_step) {
    if (own_step >= 1 || own_step <= 0) return 1;
    for (const double fps : {2.0, 4.0, 5.0, 8.0, 10.0, 20.0})
        if (fps >= 4 / own_step) return fps;
    return k_finest;
}

// Whether somebody is between two rows of theirs.
bool is_there_between(const FoundRow& a, const FoundRow& b, double longest) {
    return b.time - a.time <= longest || std::hypot(b.x - a.x, b.y - a.y) < k_has_not_moved;
}

// Each person's rows on k * step from `first` on. Seconds.
Result<void> resample(FoundTracks& found, double first, double step, double longest) {
    auto last_before = [&](double t) { return std::floor((t - first) / step + 1e-6); };
    const std::vector<FoundRow>& rows = found.rows;
    double many = 0;
    for (size_t i = 0; i + 1 < rows.size(); ++i)
        if (rows[i].who == rows[i + 1].who && is_there_between(rows[i], rows[i + 1], longest))
            many += last_before(rows[i + 1].time) - last_before(rows[i].time);
    many += static_cast<double>(found.names.size());
    if (many > static_cast<double>(k_most_sightings))
        return Error{"would have more than " + std::to_string(k_most_sightings) +
                     " positions on even times, which are too many"};
    std::vector<FoundRow> even;
    even.reserve(static_cast<size_t>(many));
    auto add = [&](FoundRow row, double k) {
        row.time = k;
        even.push_back(row);
    };
    for (size_t i = 0; i < rows.size(); ++i) {
        const FoundRow& a = rows[i];
        const double at = last_before(a.time);
        if (a.time - first - at * step < 1e-3 * step) {
            if (even.empty() || even.back().who != a.who || even.back().time < at) add(a, at);
        }
        if (i + 1 == rows.size() || rows[i + 1].who != a.who || !is_there_between(a, rows[i + 1], longest))
            continue;
        const FoundRow& b = rows[i + 1];
        for (double k = at + 1; first + k * step < b.time - 1e-3 * step; ++k) {
            const double share = (first + k * step - a.time) / (b.time - a.time);
            if (!(share > 0)) continue;
            FoundRow row = a;
            row.x += (b.x - a.x) * share;
            row.y += (b.y - a.y) * share;
            row.z += (b.z - a.z) * static_cast<float>(share);
            row.facing = normalize_or(lerp(a.facing, b.facing, static_cast<float>(share)), a.facing);
            add(row, k);
        }
    }
    found.rows = std::move(even);
    if (found.rows.empty()) return Error{"has nobody for as long as a frame"};
    return {};
}

}  // namespace

Result<void> settle_times(FoundTracks& found, const TrajectoryReading& reading) {
    const Clock clock = clock_of(found);
    const double per_second = found.is_in_frames ? found.fps : 1;  // of what `time` counts
    if (found.is_in_frames && !clock.is_even && clock.step > 0)
        return Error{"has frames that are no whole numbers"};
    double fps = clock.step > 0 ? round_rate(per_second / clock.step) : found.is_in_frames ? found.fps : 25;
    if (clock.step <= 0 && !found.is_in_frames) {
        if (reading.fps > 0) fps = static_cast<double>(reading.fps);
        found.assumed.push_back(frames_a_second(fps) + ", as there is one time alone.");
    }
    if (!(fps > 0 && fps <= 1000)) {
        if (clock.is_even || clock.step <= 0)
            return Error{"has a rate of frames that is not from 0 to 1000 a second"};
        fps = k_finest;
    }
    const bool is_sparse = clock.own_step > 1.5 * clock.step;
    const bool is_other = reading.fps > 0 && !found.is_in_frames &&
                          std::fabs(static_cast<double>(reading.fps) / fps - 1) > 1e-3;
    // Late beginnings count from the first frame.
    auto first_frame = [&](double frame) { return frame >= 0 && frame <= k_late ? std::round(frame) : 0; };
    double base = 0;
    if (clock.step > 0 && (!clock.is_even || is_sparse || is_other)) {
        const double own_step = clock.own_step / per_second;
        if (!clock.is_even) fps = rate_for(own_step);
        fps = reading.fps > 0 ? static_cast<double>(reading.fps) : std::min(fps, k_finest);
        const double start = clock.first / per_second;
        base = first_frame(std::floor(start * fps + 1e-6));
        const double first = base > 0 || start * fps < 1 ? base / fps : start;
        for (FoundRow& row : found.rows) row.time /= per_second;
        const double longest = std::max(k_short_gap, 4 * own_step);
        Result<void> even = resample(found, start >= 0 && base > 0 ? first : start, 1 / fps, longest);
        if (!even) return even.error();
        found.assumed.push_back(
            std::string(is_other        ? "The rate that was asked for"
                        : clock.is_even ? "People are seen every " + short_number(own_step) + " s or so"
                                        : "Times are not even") +
            ": places are put on " + frames_a_second(fps) + ", along straight lines between those told.");
    } else if (clock.step > 0) {
        const double first = clock.first / clock.step;
        base = first_frame(first);
        for (FoundRow& row : found.rows) row.time = std::round((row.time - clock.first) / clock.step);
        if (found.is_in_frames && clock.step > 1.5)
            found.assumed.push_back("Every frame whose number is " + short_number(clock.step) +
                                    " more than that of another is there: " + frames_a_second(fps) + ".");
    } else {
        base = first_frame(clock.first * (found.is_in_frames ? 1 : fps));
        for (FoundRow& row : found.rows) row.time = 0;
    }
    const double first_told = clock.first * per_second;
    if (base == 0 && (first_told < 0 || clock.first > k_late))
        found.assumed.push_back("Frame 0 is the first one that there is.");
    for (FoundRow& row : found.rows) {
        row.time += base;
        if (row.time > k_last_frame)
            return Error{"has more than " + short_number(k_last_frame, 0) +
                         " frames between the first and the last"};
    }
    found.fps = fps;
    found.is_in_frames = true;
    return {};
}

}  // namespace flaneur
