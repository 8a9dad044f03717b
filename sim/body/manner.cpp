#include "sim/body/manner.h"

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace flaneur {

static constexpr struct {
    float years, stride, step_width, arm_swing, unevenness, stoop, linger;  // stoop in degrees
} k_ages[] = {
    {5, 1.10f, 0.073f, 1, 0.02f, 0, -0.03f},      {13, 1.10f, 0.057f, 1, 0.013f, 0, -0.022f},
    {17, 1, 0.055f, 1, 0.011f, 0, -0.01f},        {30, 1, 0.055f, 1, 0.011f, 0, 0},
    {55, 1, 0.053f, 0.9f, 0.011f, 0, 0.005f},     {72, 1, 0.052f, 0.8f, 0.013f, 4, 0.022f},
    {87, 0.95f, 0.058f, 0.8f, 0.017f, 10, 0.03f},
};

Manner manner_at_age(float years) {
    years = clamp(years, k_ages[0].years, k_ages[std::size(k_ages) - 1].years);
    size_t i = 1;
    while (i + 1 < std::size(k_ages) && k_ages[i].years < years) ++i;
    const auto &a = k_ages[i - 1], &b = k_ages[i];
    float t = (years - a.years) / (b.years - a.years);
    Manner m;
    m.stride = lerp(a.stride, b.stride, t);
    m.step_width = lerp(a.step_width, b.step_width, t);
    m.arm_swing[0] = m.arm_swing[1] = lerp(a.arm_swing, b.arm_swing, t);
    m.unevenness = lerp(a.unevenness, b.unevenness, t);
    m.stoop = lerp(a.stoop, b.stoop, t) * k_radians;
    m.linger = lerp(a.linger, b.linger, t);
    return m;
}

std::array<float, k_posture_count> postures_at_age(float years, bool woman) {
    // In the order of Posture.
    static constexpr std::array<float, k_posture_count> k_child = {60, 6, 7, 5, 3, 4, 7, 3, 4, 25},
                                                        k_woman = {46, 7, 6, 6, 4, 11, 4, 11, 10, 40},
                                                        k_man = {46, 9, 17, 4, 6, 7, 6, 10, 3, 40},
                                                        k_old_woman = {44, 4, 3, 4, 5, 17, 8, 9, 6, 40},
                                                        k_old_man = {44, 6, 8, 3, 5, 10, 18, 7, 2, 40};
    const auto &grown = woman ? k_woman : k_man, &old = woman ? k_old_woman : k_old_man;
    float grows = smoothstep(11, 18, years), ages = smoothstep(58, 72, years);
    std::array<float, k_posture_count> postures;
    for (size_t i = 0; i < postures.size(); ++i)
        postures[i] = lerp(lerp(k_child[i], grown[i], grows), old[i], ages);
    return postures;
}

void vary_postures(Manner& m, RandomKey key) {
    for (uint32_t i = 0; i < m.postures.size(); ++i) {
        float likes = random_unit(key, 200 + i);
        m.postures[i] *= i == 0 ? 0.6f + 0.8f * likes : 0.15f + 2.5f * likes * likes;
    }
}

Manner draw_manner(const Manner& middle, RandomKey key) {
    Manner m = middle;
    m.stride *= 1 + 0.05f * clamp(random_normal(key, 0), -2.0f, 2.0f);
    m.lead *= 1 + 0.075f * clamp(random_normal(key, 8), -2.0f, 2.0f);
    float arms = clamp(1 + 0.25f * random_normal(key, 1), 0.4f, 1.6f);
    float favoured = clamp(0.17f * random_normal(key, 9), -0.35f, 0.35f);
    m.arm_swing[0] *= std::min(arms * (1 + favoured), 1.6f);
    m.arm_swing[1] *= std::min(arms * (1 - favoured), 1.6f);
    m.sway *= clamp(1 + 0.2f * random_normal(key, 2), 0.5f, 1.6f);
    m.toe_out = clamp(m.toe_out + 2.5f * k_radians * random_normal(key, 3), k_radians, 12 * k_radians);
    m.step_width = std::max(m.step_width + 0.007f * random_normal(key, 4), 0.025f);
    m.lean = clamp(m.lean + 1.5f * k_radians * random_normal(key, 5), k_radians, 11 * k_radians);
    m.carriage =
        clamp(m.carriage + 1.5f * k_radians * random_normal(key, 6), 6.5f * k_radians, 13 * k_radians);
    m.elbow = clamp(3.2f * k_radians * random_normal(key, 10), -7 * k_radians, 9 * k_radians);
    m.stoop = std::max(m.stoop + (2 * k_radians + 0.35f * m.stoop) * random_normal(key, 11), -3 * k_radians);
    m.unevenness *= clamp(1 + 0.3f * random_normal(key, 12), 0.4f, 2.0f);
    m.strike *= clamp(1 + 0.2f * random_normal(key, 14), 0.55f, 1.4f);
    m.clearance += clamp(0.005f * random_normal(key, 15), -0.005f, 0.012f);
    m.limp = clamp(0.008f * random_normal(key, 13), -0.02f, 0.02f);
    m.stance_width = clamp(m.stance_width * random_between(key, 0.78f, 1.45f, 300), 0.08f, 0.155f);
    m.stance_ahead *= 0.25f + 1.6f * random_unit(key, 301);
    m.stance_turn *= random_between(key, 0.4f, 1.6f, 302);
    vary_postures(m, key);
    m.crouch = clamp(m.crouch + 0.009f * random_normal(key, 7), -0.002f, 0.018f);
    return m;
}

void add_drink(Manner& m, float drunk) {
    m.stride *= 1 - 0.08f * drunk;
    m.step_width *= 1 + 0.9f * drunk;
    m.unevenness += 0.06f * drunk;
    m.sway = std::min(m.sway * (1 + 0.8f * drunk), 2.2f);
    m.toe_out += 5 * k_radians * drunk;
    m.carriage += 9 * k_radians * drunk;
    m.reel += 0.15f * drunk;
    m.crouch += 0.015f * drunk;
    m.stance_width = std::min(m.stance_width * (1 + 0.4f * drunk), 0.18f);
    m.curiosity *= 1 - 0.5f * drunk;
}

}  // namespace flaneur
