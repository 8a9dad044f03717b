#include "sim/body/personality.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace flaneur {

Personality usual_personality(float age, bool woman) {
    const float decades = (clamp(age, 16, 80) - 40) * 0.1f, sex = woman ? 0.5f : -0.5f;
    return {.openness = 0,
            .conscientiousness = 0.15f * decades + 0.1f * sex,
            .extraversion = 0.1f * sex,
            .agreeableness = 0.12f * decades + 0.15f * sex,
            .neuroticism = 0.4f * sex - (woman ? 0.1f : 0.0f) * decades};
}

Personality draw_personality(float age, bool woman, RandomKey key) {
    const Personality usual = usual_personality(age, woman);
    auto draw = [&](float mean, uint32_t index) { return clamp(mean + random_normal(key, index), -3, 3); };
    return {.openness = draw(usual.openness, 0),
            .conscientiousness = draw(usual.conscientiousness, 1),
            .extraversion = draw(usual.extraversion, 2),
            .agreeableness = draw(usual.agreeableness, 3),
            .neuroticism = draw(usual.neuroticism, 4)};
}

float pace_score(const Personality& p, const Personality& usual, float own) {
    // A half of people differ from the other half by 1.6 standard scores: 0.06 m/s of 0.26.
    constexpr float k_extraversion = 0.145f, k_conscientiousness = 0.145f, k_openness = 0.07f,
                    k_neuroticism = -0.1f;
    constexpr float k_told = k_extraversion * k_extraversion + k_conscientiousness * k_conscientiousness +
                             k_openness * k_openness + k_neuroticism * k_neuroticism;
    // So that people spread as before.
    static const float k_rest = std::sqrt(1 - k_told);
    return k_extraversion * (p.extraversion - usual.extraversion) +
           k_conscientiousness * (p.conscientiousness - usual.conscientiousness) +
           k_openness * (p.openness - usual.openness) + k_neuroticism * (p.neuroticism - usual.neuroticism) +
           k_rest * own;
}

float room_share(const Personality& p) {
    return clamp(1 + 0.05f * (p.neuroticism - p.extraversion), 0.85f, 1.2f);
}

float patience_share(const Personality& p) {
    return clamp(1 + 0.1f * p.agreeableness + 0.05f * p.conscientiousness, 0.8f, 1.4f);
}

float linger_share(const Personality& p) {
    return clamp(1 + 0.1f * (p.openness + p.extraversion - p.conscientiousness), 0.6f, 1.5f);
}

void add_personality(Manner& m, const Personality& p) {
    const float low = std::max(p.neuroticism - 1, 0.0f), shy = clamp(-p.extraversion * 0.5f, -0.8f, 0.8f);
    for (float& swing : m.arm_swing) swing *= clamp(1 + 0.09f * p.extraversion - 0.12f * low, 0.6f, 1.3f);
    m.sway *= clamp(1 + 0.06f * p.extraversion, 0.8f, 1.2f);
    m.stoop += clamp(1.2f * low - 0.5f * p.extraversion, -1, 3) * k_radians;
    m.curiosity = clamp(m.curiosity + 0.07f * p.openness + 0.04f * p.extraversion, 0.05f, 0.7f);
    m.touches = clamp(m.touches + 0.1f * p.openness - 0.05f * p.conscientiousness, 0.1f, 0.9f);
    auto likes = [&](Posture posture, float share) { m.postures[static_cast<size_t>(posture)] *= share; };
    for (Posture hides : {Posture::pocket, Posture::pockets, Posture::fold, Posture::across})
        likes(hides, 1 + shy);
    for (Posture shows : {Posture::hip, Posture::hips, Posture::behind}) likes(shows, 1 - shy);
}

}  // namespace flaneur
