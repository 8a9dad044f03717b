#include "sim/fall/balance.h"

#include <algorithm>

#include "sim/base/math.h"

namespace flaneur {

float bearable_push(const Sturdiness& who, Vec2 along) {
    constexpr float k_leg = 0.9f, k_ahead = 1.5f, k_back = 1.05f, k_aside = 1.1f;
    const Vec2 facing = heading_direction(who.heading), way = normalize_or(along, facing);
    const float ahead = dot(way, facing), aside2 = 1 - std::min(ahead * ahead, 1.0f);
    const float fore = ahead > 0 ? k_ahead : k_back;
    // An ellipse through the three.
    const float bears = 1 / std::sqrt(ahead * ahead / (fore * fore) + aside2 / (k_aside * k_aside));
    return clamp(bears * who.steadiness * std::sqrt(std::max(who.leg, 0.1f) / k_leg), k_harmless_push,
                 k_felling_push);
}

float staggers_for(float times) { return 0.5f * (1 - smoothstep(1, 1.8f, times)); }

void shove(TrunkSway& sway, Vec2 change) {
    constexpr float k_turns = 1.6f, k_most = 2.6f;  // rad/s of the trunk for each m/s; rad/s
    sway.rate += change * k_turns;
    const float rate = length(sway.rate);
    if (rate > k_most) sway.rate = sway.rate * (k_most / rate);
}

void advance(TrunkSway& sway, float dt) {
    // rad/s: back within a second, past the middle once.
    constexpr float k_frequency = 5.5f, k_damping = 0.55f;
    constexpr float k_arms = 3, k_arms_most = 0.9f, k_arms_take = 0.12f;  // of the sway; radians; seconds
    sway.rate += (sway.lean * -(k_frequency * k_frequency) - sway.rate * (2 * k_damping * k_frequency)) * dt;
    sway.lean += sway.rate * dt;
    const Vec2 goes = sway.rate * (1 / k_frequency);
    const float sways = std::sqrt(length_squared(sway.lean) + length_squared(goes));
    sway.arms += (std::min(k_arms * sways, k_arms_most) - sway.arms) * (dt / k_arms_take);
}

bool is_over(const TrunkSway& sway) {
    constexpr float k_unseen = 0.002f;
    return length_squared(sway.lean) < k_unseen * k_unseen &&
           length_squared(sway.rate) < 25 * k_unseen * k_unseen && sway.arms < 2 * k_unseen;
}

}  // namespace flaneur
