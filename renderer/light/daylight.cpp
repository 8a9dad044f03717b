#include "renderer/light/daylight.h"

#include <algorithm>
#include <cmath>

#include "renderer/view.h"

namespace flaneur {
namespace {

constexpr float k_pi = 3.14159265f, k_degrees = 180 / k_pi;
constexpr float k_turbidity = 2.8f;
constexpr float k_lowest = 2;         // degrees: from here on down the model's sky only grows dimmer
constexpr float k_per_decade = 2.6f;  // degrees of sun for a tenth of the light
constexpr float k_moon_rises = -5;    // degrees of sun
constexpr float k_moon_height = 38;   // degrees
constexpr float k_moon_turn = 2.4f;   // radians from the sun, about the vertical

// Luminances of a city's night at the horizon and overhead, kcd/m2, and the moon's illuminance, klx: more
// than a full moon gives (0.0003), so that streets without lamps can be read.
const glm::vec3 k_night_low(5.5e-4f, 6.2e-4f, 9.2e-4f), k_night_high(1.7e-4f, 2.8e-4f, 6.6e-4f);
const glm::vec3 k_moonlight(2.6e-3f, 3.3e-3f, 4.6e-3f);
// Of the sky after sunset, against its luminance before: at the horizon, overhead, and what is added where
// the sun went down.
const glm::vec3 k_dusk_low(0.52f, 0.67f, 1.06f), k_dusk_high(0.17f, 0.34f, 0.96f),
    k_dusk_glow(1.7f, 0.72f, 0.26f);
const glm::vec3 k_cloud(0.95f, 1.0f, 1.07f);  // colour of overcast skies
constexpr float k_cloud_horizon = 0.6f;       // their luminance there, against the zenith's

float smooth(float from, float to, float x) {
    const float t = std::clamp((x - from) / (to - from), 0.0f, 1.0f);
    return t * t * (3 - 2 * t);
}

glm::vec3 turned(glm::vec3 v, float angle) {
    return {v.x * std::cos(angle) + v.z * std::sin(angle), v.y,
            v.z * std::cos(angle) - v.x * std::sin(angle)};
}

}  // namespace

glm::vec3 sun_direction(const Sun& sun) {
    glm::vec3 direction = sun.direction;
    const float length = glm::length(direction);
    if (!std::isfinite(length) || length < 1e-6f) direction = Sun{}.direction;
    return glm::normalize(direction);
}

glm::vec3 above_horizon(glm::vec3 direction, float lowest) {
    if (direction.y >= std::sin(lowest)) return direction;
    const glm::vec3 level(direction.x, 0, direction.z);
    const float across = glm::length(level);
    return (across > 1e-6f ? level / across : glm::vec3(1, 0, 0)) * std::cos(lowest) +
           glm::vec3(0, std::sin(lowest), 0);
}

Daylight make_daylight(const Sun& sun, bool is_overcast) {
    const glm::vec3 to_sun = sun_direction(sun);
    const float height = std::asin(std::clamp(to_sun.y, -1.0f, 1.0f)) * k_degrees;
    const glm::vec3 raised = above_horizon(to_sun, k_lowest / k_degrees);
    const float down = std::min((height - k_lowest) / k_per_decade, 0.0f);
    const float dim = std::pow(10.0f, std::max(down, -6.0f));

    Daylight day;
    day.sky = make_sky(raised, k_turbidity);
    day.sky.scale.x *= dim;
    // As the sun sinks, what is left of its sky turns into a blue one with a glow where it was.
    const float level = luminance(sky_luminance(day.sky, glm::normalize(glm::vec3(0, 1, 1))));
    const float dusk = smooth(4, -4, height), night = smooth(0, -8, height);
    day.sky.scale.x *= 1 - 0.9f * dusk;
    day.sky.low = k_dusk_low * (level * dusk) + k_night_low * night;
    day.sky.high = k_dusk_high * (level * dusk) + k_night_high * night;
    day.sky.dusk = k_dusk_glow * (level * dusk * smooth(-14, -5, height));
    day.lamps = smooth(2.5f, -4, height);
    day.disc = 6;
    day.to_light = above_horizon(to_sun, 1 / k_degrees);
    day.sky.sun *= smooth(-1, 1.5f, height);
    if (height < k_moon_rises) {
        const glm::vec3 away = turned(glm::normalize(glm::vec3(raised.x, 0, raised.z)), k_moon_turn);
        const float rise = k_moon_height / k_degrees;
        day.to_light = away * std::cos(rise) + glm::vec3(0, std::sin(rise), 0);
        day.sky.sun = k_moonlight * smooth(k_moon_rises, -10, height);
        day.disc = 60;
    }
    if (is_overcast) {
        const float fallen = std::pow(10.0f, std::min(height / k_per_decade, 0.0f));
        const float klx = (0.3f + 21 * std::max(to_sun.y, 0.0f)) * fallen;
        const float zenith = klx / (k_pi * (2 + k_cloud_horizon) / 3);
        day.sky.scale.x = 0;
        day.sky.low = k_cloud * (zenith * k_cloud_horizon) + k_night_low * (2 * night);
        day.sky.high = k_cloud * zenith + k_night_low * night;
        day.sky.dusk = day.sky.sun = glm::vec3(0);
    }
    return day;
}

float exposure_key(float luminance) { return 1.03f - 2 / (2 + std::log10(luminance + 1)); }

}  // namespace flaneur
