#include "tools/flaneur/window/time/clock.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "sim/base/tick.h"

namespace flaneur {
namespace {

constexpr double k_least_gap = 0.1, k_gap = 0.2;  // seconds of simulation, and that pass
constexpr float k_rates[] = {k_least_rate, 0.25f, 0.5f, 1, 2, 4, 8, k_most_rate};

constexpr double k_measured = 1;    // second
constexpr double k_noticed = 0.03;  // share of it that is lost

void measure_pace(Clock& clock, double passed, double made, double kept_back) {
    Clock::Pace& pace = clock.pace;
    if (pace.rate != clock.rate) pace = {.rate = clock.rate};
    pace.passed += passed;
    pace.made += made;
    pace.kept_back += kept_back;
    if (pace.passed < k_measured) return;
    const bool is_behind = pace.kept_back > k_noticed * (pace.made + pace.kept_back);
    pace = {.rate = clock.rate, .reached = is_behind ? static_cast<float>(pace.made / pace.passed) : 0};
}

}  // namespace

uint32_t ticks_due(Clock& clock, double seconds) {
    if (clock.is_paused) {
        const uint32_t steps = std::exchange(clock.steps, 0);
        if (steps > 0) clock.due = 0;
        clock.pace = {};
        return steps;
    }
    clock.steps = 0;
    const double rate = static_cast<double>(clock.rate), most = std::max(k_least_gap, k_gap * rate);
    const double wanted = clock.due + std::max(seconds, 0.0) * rate;
    clock.due = std::min(wanted, most);
    clock.kept_back += wanted - clock.due;
    const double ticks = std::floor(clock.due / static_cast<double>(k_tick));
    clock.due -= ticks * static_cast<double>(k_tick);
    measure_pace(clock, std::max(seconds, 0.0), ticks * static_cast<double>(k_tick),
                 wanted - std::min(wanted, most));
    return static_cast<uint32_t>(ticks);
}

std::optional<float> reached_rate(const Clock& clock) {
    constexpr float k_told = 0.97f;  // of the rate: more is told as the same number
    const bool is_told = clock.pace.reached > 0 && clock.pace.reached < k_told * clock.rate;
    return is_told ? std::optional(clock.pace.reached) : std::nullopt;
}

float between_ticks(const Clock& clock) {
    if (clock.is_paused) return 1;
    return static_cast<float>(std::clamp(clock.due / static_cast<double>(k_tick), 0.0, 1.0));
}

float slower(float rate) {
    const auto* at = std::lower_bound(std::begin(k_rates), std::end(k_rates), rate - 1e-4f);
    return at == std::begin(k_rates) ? k_least_rate : *(at - 1);
}

float faster(float rate) {
    const auto* at = std::upper_bound(std::begin(k_rates), std::end(k_rates), rate + 1e-4f);
    return at == std::end(k_rates) ? k_most_rate : *at;
}

}  // namespace flaneur
