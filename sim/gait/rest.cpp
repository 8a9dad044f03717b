#include "sim/gait/rest.h"

#include <cmath>

#include "sim/base/math.h"

namespace flaneur {

static constexpr float k_breaths = 0.25f;       // a second, of grown people; the small are quicker
static constexpr float k_grown_leg = 0.94f;     // metres
static constexpr float k_breaths_to_shift = 7;  // from leg to leg
static constexpr float k_least_shift = 0.12f, k_most_shift = 0.33f;  // of the body

// Quiet standing goes to and fro by some ten millimetres, mostly slower than one breathes (Winter 1995): sums
// of two slow waves, whole ones in a round. Radians of the body over its ankles.
static constexpr float k_ahead = 0.0065f, k_aside = 0.004f;

// A wave that goes `times` through a round.
static float wave(float breath, float times, float from) {
    float cycles = breath * (times / k_breath_round) + from;
    return sin_cos(2 * k_pi * (cycles - std::floor(cycles))).sine;
}

void advance_rest(GaitBlock& g, const Stepper& s) {
    int lane = s.lane;
    float& breath = g.breath[lane];
    breath += k_breaths * std::sqrt(k_grown_leg / s.leg_length) * s.dt;
    if (breath >= k_breath_round) breath -= k_breath_round;
    if (g.amplitude[lane] >= 1) return;  // nobody sees it in a walk
    g.inhaled[lane] = wave(breath, k_breath_round, 0);
    g.tilt_ahead[lane] = k_ahead * (0.6f * wave(breath, 37, 0) + 0.4f * wave(breath, 83, 0.2f));
    g.tilt_aside[lane] = k_aside * (0.6f * wave(breath, 29, 0.4f) + 0.4f * wave(breath, 61, 0.1f));
}

float resting_load(const GaitBlock& g, int lane, RandomKey chance) {
    chance.when = static_cast<uint32_t>(g.breath[lane] / k_breaths_to_shift);
    float shift = random_between(chance, k_least_shift, k_most_shift, 2);
    return random_unit(chance, 3) < 0.5f ? 0.5f - shift : 0.5f + shift;
}

}  // namespace flaneur
