#include "sim/lamps/lamps.h"

#include <algorithm>
#include <cmath>

#include "sim/base/tick.h"

namespace flaneur {

static constexpr float k_shortest = 60, k_longest = 90;  // seconds, of a cycle
static constexpr float k_walks = 0.42f;                  // of it, where there is one direction
static constexpr float k_all_red = 1;                    // seconds

static uint32_t ticks_of(float seconds) {
    return static_cast<uint32_t>(std::ceil(seconds / (k_tick * k_lamp_ticks))) * k_lamp_ticks;
}

// How long ago `then` was in a cycle at `now`; and how long it is to it, never 0.
static uint32_t since(uint32_t then, uint32_t now, uint32_t cycle) { return (now + cycle - then) % cycle; }
static uint32_t until(uint32_t then, uint32_t now, uint32_t cycle) { return cycle - since(then, now, cycle); }

static uint32_t now_of(const LampPlan& plan, uint32_t tick) {
    return static_cast<uint32_t>((uint64_t{tick} + plan.shift) % plan.cycle);
}

// Lit from `from` to `to`, with red else.
static Lamp lamp_between(uint32_t from, uint32_t to, uint32_t now, uint32_t cycle, Light light) {
    const uint32_t passed = since(from, now, cycle), lasts = since(from, to, cycle);
    if (passed < lasts) return {light, passed, lasts - passed};
    return {Light::red, since(to, now, cycle), until(from, now, cycle)};
}

Lamp lamp_at(const LampPlan& plan, uint32_t tick) {
    return lamp_between(plan.walk, plan.walk_ends, now_of(plan, tick), plan.cycle, Light::green);
}

Lamp lamp_of_drivers(const LampPlan& plan, uint32_t tick) {
    const uint32_t now = now_of(plan, tick);
    const Lamp lamp = lamp_between(plan.drive, plan.drive_ends, now, plan.cycle, Light::green);
    if (lamp.light == Light::green) return lamp;
    if (lamp.since < k_amber) return {Light::amber, lamp.since, k_amber - lamp.since};
    return {Light::red, lamp.since - k_amber, lamp.left};
}

uint32_t clearance(const LampPlan& plan) { return since(plan.walk_ends, plan.drive, plan.cycle); }

std::vector<LampPlan> plan_junction(std::span<const float> breadths, RandomKey key) {
    const uint32_t cycle = ticks_of(random_between(key, k_shortest, k_longest)),
                   shift = static_cast<uint32_t>(random_unit(key, 1) * static_cast<float>(cycle)) /
                           k_lamp_ticks * k_lamp_ticks;
    const auto stages = std::max<uint32_t>(static_cast<uint32_t>(breadths.size()), 2);
    auto begin_of = [&](uint32_t stage) -> uint32_t {
        if (stage % stages == 0) return 0;
        const float share = breadths.size() == 1
                                ? 1 - k_walks
                                : static_cast<float>(stage % stages) / static_cast<float>(stages);
        return static_cast<uint32_t>(static_cast<float>(cycle) * share) / k_lamp_ticks * k_lamp_ticks;
    };
    auto end_of = [&](uint32_t stage) { return stage % stages + 1 == stages ? cycle : begin_of(stage + 1); };
    const uint32_t all_red = ticks_of(k_all_red);
    std::vector<LampPlan> plans;
    for (uint32_t direction = 0; direction < breadths.size(); ++direction) {
        LampPlan plan{.cycle = cycle, .shift = shift};
        plan.drive = begin_of(direction) + all_red;
        plan.drive_ends = end_of(direction) - all_red - k_amber;
        plan.walk = begin_of(direction + 1) + all_red;
        plan.walk_ends = end_of(direction + 1) - ticks_of(breadths[direction] / k_clearing_speed);
        plans.push_back(plan);
    }
    return plans;
}

}  // namespace flaneur
