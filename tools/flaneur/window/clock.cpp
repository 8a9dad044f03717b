#include "tools/flaneur/window/clock.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "sim/base/tick.h"

namespace flaneur {
namespace {

constexpr double k_least_gap = 0.1, k_gap = 0.2;  // seconds of simulation, and that pass
constexpr float k_rates[] = {k_least_rate, 0.25f, 0.5f, 1, 2, 4, 8, k_most_rate};

}  // namespace

uint32_t ticks_due(Clock& clock, double seconds) {
    if (clock.is_paused) {
        const uint32_t steps = std::exchange(clock.steps, 0);
        if (steps > 0) clock.due = 0;
        return steps;
    }
    clock.steps = 0;
    const double rate = static_cast<double>(clock.rate), most = std::max(k_least_gap, k_gap * rate);
    const double wanted = clock.due + std::max(seconds, 0.0) * rate;
    clock.due = std::min(wanted, most);
    clock.kept_back += wanted - clock.due;
    const double ticks = std::floor(clock.due / static_cast<double>(k_tick));
    clock.due -= ticks * static_cast<double>(k_tick);
    return static_cast<uint32_t>(ticks);
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
