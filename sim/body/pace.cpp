#include "sim/body/pace.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"

namespace flaneur {

// By decade of age from the twenties on, m/s, at the decade's middle.
static constexpr float k_women[] = {1.34f, 1.34f, 1.39f, 1.31f, 1.24f, 1.13f, 0.94f};
static constexpr float k_men[] = {1.36f, 1.43f, 1.43f, 1.43f, 1.34f, 1.26f, 0.97f};
static constexpr float k_grown_leg = 0.8f;  // of the short among grown people, metres

float usual_speed(float age, bool woman, float leg) {
    const float* table = woman ? k_women : k_men;
    float decade = clamp((age - 25) / 10, 0, 6);
    int i = static_cast<int>(std::min(decade, 5.0f));
    float speed = lerp(table[i], table[i + 1], decade - static_cast<float>(i));
    return speed * std::sqrt(clamp(leg / k_grown_leg, 0.1f, 1));
}

float fastest_walk(float leg) { return std::min(std::sqrt(0.45f * k_gravity * leg), 1.9f); }

}  // namespace flaneur
