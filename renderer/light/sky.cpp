#include "renderer/light/sky.h"

#include <algorithm>
#include <cmath>

namespace flaneur {
namespace {

constexpr float k_pi = 3.14159265f;

glm::vec3 distribution(const std::array<glm::vec3, 5>& p, float cos_zenith, float gamma) {
    const float cos_gamma = std::cos(gamma);
    return (1.0f + p[0] * glm::exp(p[1] / std::max(cos_zenith, 0.01f))) *
           (1.0f + p[2] * glm::exp(p[3] * gamma) + p[4] * cos_gamma * cos_gamma);
}

glm::vec3 rgb_from_yxy(glm::vec3 c) {
    const float x = c.x * c.y / c.z, z = c.x * (1 - c.y - c.z) / c.z;
    return glm::max(
        glm::vec3(3.2406f * x - 1.5372f * c.x - 0.4986f * z, -0.9689f * x + 1.8758f * c.x + 0.0415f * z,
                  0.0557f * x - 0.2040f * c.x + 1.0570f * z),
        glm::vec3(0));
}

// Sunlight above the air is 128 klx; Rayleigh scattering and Angstrom's haze dim it (the paper's appendix 1).
glm::vec3 sunlight(float elevation, float turbidity) {
    const float degrees = elevation * 180 / k_pi;
    const float air_mass = 1 / (std::sin(elevation) + 0.15f * std::pow(degrees + 3.885f, -1.253f));
    const glm::vec3 micrometres(0.65f, 0.55f, 0.45f);
    const float beta = 0.04608f * turbidity - 0.04586f;
    const glm::vec3 depth =
        0.008735f * glm::pow(micrometres, glm::vec3(-4.08f)) + beta * glm::pow(micrometres, glm::vec3(-1.3f));
    return 128.0f * glm::exp(-depth * air_mass);
}

}  // namespace

float luminance(glm::vec3 linear) { return glm::dot(linear, glm::vec3(0.2126f, 0.7152f, 0.0722f)); }

SkyModel make_sky(glm::vec3 to_sun, float turbidity) {
    const float t = turbidity;
    SkyModel sky;
    sky.to_sun = to_sun;
    sky.perez = {glm::vec3(0.1787f * t - 1.4630f, -0.0193f * t - 0.2592f, -0.0167f * t - 0.2608f),
                 glm::vec3(-0.3554f * t + 0.4275f, -0.0665f * t + 0.0008f, -0.0950f * t + 0.0092f),
                 glm::vec3(-0.0227f * t + 5.3251f, -0.0004f * t + 0.2125f, -0.0079f * t + 0.2102f),
                 glm::vec3(0.1206f * t - 2.5771f, -0.0641f * t - 0.8989f, -0.0441f * t - 1.6537f),
                 glm::vec3(-0.0670f * t + 0.3703f, -0.0033f * t + 0.0452f, -0.0109f * t + 0.0529f)};
    const float theta = std::acos(std::clamp(to_sun.y, 0.0f, 1.0f));
    const float theta2 = theta * theta, theta3 = theta2 * theta;
    const float chi = (4.0f / 9 - t / 120) * (k_pi - 2 * theta);
    const glm::vec3 zenith(std::max((4.0453f * t - 4.9710f) * std::tan(chi) - 0.2155f * t + 2.4192f, 0.1f),
                           t * t * (0.00166f * theta3 - 0.00375f * theta2 + 0.00209f * theta) +
                               t * (-0.02903f * theta3 + 0.06377f * theta2 - 0.03202f * theta + 0.00394f) +
                               (0.11693f * theta3 - 0.21196f * theta2 + 0.06052f * theta + 0.25886f),
                           t * t * (0.00275f * theta3 - 0.00610f * theta2 + 0.00317f * theta) +
                               t * (-0.04214f * theta3 + 0.08970f * theta2 - 0.04153f * theta + 0.00516f) +
                               (0.15346f * theta3 - 0.26756f * theta2 + 0.06670f * theta + 0.26688f));
    sky.scale = zenith / distribution(sky.perez, 1, theta);
    sky.sun = sunlight(k_pi / 2 - theta, t);
    return sky;
}

glm::vec3 daylit_sky(const SkyModel& sky, glm::vec3 direction) {
    const float gamma = std::acos(std::clamp(glm::dot(direction, sky.to_sun), -1.0f, 1.0f));
    return rgb_from_yxy(sky.scale * distribution(sky.perez, direction.y, gamma));
}

glm::vec3 added_sky(const SkyModel& sky, glm::vec3 direction) {
    const float height = std::clamp(direction.y, 0.0f, 1.0f);
    const float towards = (direction.x * sky.to_sun.x + direction.z * sky.to_sun.z) * 0.5f + 0.5f;
    return glm::mix(sky.low, sky.high, height) + sky.dusk * (towards * towards * std::exp(-7 * height));
}

glm::vec3 sky_luminance(const SkyModel& sky, glm::vec3 direction) {
    return daylit_sky(sky, direction) + added_sky(sky, direction);
}

AmbientLight ambient_light(const SkyModel& sky, glm::vec3 ground) {
    // Over the sphere: average A and first moment M of luminance. Illuminance over pi of its linear part is
    // A + 2 dot(M, n) (Ramamoorthi & Hanrahan 2001).
    constexpr int rings = 12, sectors = 24;
    glm::vec3 average(0), on_ground(0);
    std::array<glm::vec3, 3> moment = {};
    auto add = [&](glm::vec3 colour, glm::vec3 direction, float weight) {
        average += colour * weight;
        for (int c = 0; c < 3; ++c) moment[c] += direction * (colour[c] * weight);
    };
    constexpr float weight = 1.0f / (2 * rings * sectors);
    for (int pass = 0; pass < 2; ++pass)  // the sky, then the ground that it lights
        for (int ring = 0; ring < rings; ++ring)
            for (int sector = 0; sector < sectors; ++sector) {
                const float y = (static_cast<float>(ring) + 0.5f) / rings;
                const float turn = (static_cast<float>(sector) + 0.5f) / sectors * 2 * k_pi;
                const float across = std::sqrt(1 - y * y);
                const glm::vec3 direction(across * std::cos(turn), pass == 0 ? y : -y,
                                          across * std::sin(turn));
                if (pass == 0) {
                    const glm::vec3 colour = sky_luminance(sky, direction);
                    on_ground += colour * y * (2.0f / (rings * sectors));
                    add(colour, direction, weight);
                } else {
                    add(ground * (on_ground + sky.sun * (sky.to_sun.y / k_pi)), direction, weight);
                }
            }
    AmbientLight light;
    for (int c = 0; c < 3; ++c) light.slope[c] = 2.0f * moment[c];
    light.level = average;
    return light;
}

}  // namespace flaneur
