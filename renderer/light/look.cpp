#include "renderer/light/look.h"

#include <algorithm>
#include <cmath>

namespace flaneur {
namespace {

constexpr float k_ground_albedo = 0.22f;
constexpr float k_haze = 1.0f / 2200;  // a metre
constexpr float k_haze_begins = 60;    // metres
// What a white level surface in sun and sky shows before the tone curve: puts pavement at mid-grey.
constexpr float k_white_level = 0.72f;
// How far the light's colour is taken out of the picture: not all the way, so that afternoons stay warm.
constexpr float k_white_balance = 0.8f;

// How much of the sky's colour shadows keep: walls and haze between them and the sky take the rest.
constexpr float k_blue_of_shadow = 0.45f;
// How much brighter walls and ground make the shadows of a street than open sky would, while the sun is low
// and when it is high.
constexpr float k_bounce = 1.5f, k_noon_bounce = 2;

// Against pavement at mid-grey the model's sky comes out dim and mauve, at noon most, and too bright about a
// sun that sets.
const vec3 k_sky_tint(1.3f, 1.95f, 2.8f), k_noon_sky_tint(1.75f, 2.45f, 3.1f),
    k_dusk_sky_tint(0.8f, 0.72f, 0.84f);

// What a white pavement below a street lamp reflects, kcd/m2: 32 lux over pi. Against it: how much of it eyes
// grow used to, and how bright lit rooms are.
constexpr float k_lamp_level = 0.032f / 3.14159265f, k_lamps_seen = 0.35f, k_window_level = 2.2f,
                k_dusk_windows = 4;
const vec3 k_lamp_colour(1.18f, 0.98f, 0.70f), k_window_colour(1.38f, 0.93f, 0.46f);
constexpr float k_pavement = 0.3f;  // albedo of what eyes grow used to
constexpr float k_bright = 1000;    // cd/m2 from where on nothing looks dim
constexpr float k_readable = 0.9f;  // below 1 nights are drawn brighter than eyes see them

vec4 v4(vec3 v, float w = 0) { return {v, w}; }

vec3 sky_seen(const SkyModel& sky, vec3 sky_white, vec3 white, vec3 ray) {
    const vec3 direction = glm::normalize(ray);
    return daylit_sky(sky, direction) * sky_white + added_sky(sky, direction) * white;
}

}  // namespace

Look look_of(const Daylight& light, float lit_windows) {
    const SkyModel& sky = light.sky;
    const vec3 to_light = light.to_light;
    const AmbientLight ambient = ambient_light(sky, vec3(k_ground_albedo));
    const float high = glm::smoothstep(0.45f, 0.9f, sky.to_sun.y);
    const float bounce = glm::mix(k_bounce, k_noon_bounce, high);
    auto ambient_on = [&](vec3 normal) {
        vec3 on = ambient.level;
        for (int c = 0; c < 3; ++c) on[c] += glm::dot(ambient.slope[c], normal);
        return on * bounce;
    };
    const vec3 sun = sky.sun / 3.14159265f;
    const vec3 level_white = ambient_on({0, 1, 0}) + sun * to_light.y;
    // Lamps are as bright as they are: eyes grow used to them, and see their colour.
    const float lamps = light.lamps * k_lamp_level;
    const float colourless = k_white_balance * (1 - light.lamps);
    const vec3 balance = glm::pow(vec3(luminance(level_white)) / level_white, vec3(colourless));
    const float seen = luminance(level_white * balance) + k_lamps_seen * lamps;
    const float key = exposure_key(k_pavement * 1000 * seen) / exposure_key(k_bright);
    const float dim = std::min(std::pow(key, k_readable), 1.0f);
    const float exposure = k_white_level * dim / seen;
    const vec3 white = balance * exposure;
    const vec3 low_tint = glm::mix(k_dusk_sky_tint, k_sky_tint, glm::smoothstep(0.06f, 0.38f, sky.to_sun.y));
    const vec3 sky_white = white * glm::mix(low_tint, k_noon_sky_tint, high);
    auto sky_at = [&](vec3 direction) { return sky_seen(sky, sky_white, white, direction); };
    const vec3 level_sun(sky.to_sun.x, 0, sky.to_sun.z);
    const vec3 ahead = glm::length(level_sun) > 1e-3f ? glm::normalize(level_sun) : vec3(0, 0, 1);

    Look look{.constants = {}, .sky_white = sky_white, .white = white};
    FrameConstants& out = look.constants;
    out.sun_light = v4(sun * white, light.disc);
    const vec3 grey(0.2126f, 0.7152f, 0.0722f);
    vec4 ambient_grey(0);
    for (int c = 0; c < 3; ++c) {
        out.ambient[c] = v4(ambient.slope[c], ambient.level[c]) * (white[c] * bounce);
        ambient_grey += grey[c] * out.ambient[c];
    }
    for (vec4& colour : out.ambient) colour = glm::mix(ambient_grey, colour, k_blue_of_shadow);
    out.haze_towards = v4(sky_at(ahead + vec3(0, 0.12f, 0)), k_haze);
    out.haze_away = v4(sky_at(-ahead + vec3(0, 0.12f, 0)), k_haze_begins);
    out.zenith = v4(sky_at({0, 1, 0}));
    out.lamp_light = v4(k_lamp_colour * (lamps * exposure), lit_windows);
    // Against a sky that is still light, rooms are those whose lamps are brightest.
    const float windows = lamps * (k_window_level + k_dusk_windows * (1 - k_lamps_seen * lamps / seen));
    out.window_light =
        v4(k_window_colour * (windows * exposure), luminance(sky.sun) > 0 ? light.lamps * light.lamps : 0);
    return look;
}

std::vector<vec4> sky_corners(const Daylight& light, const Look& look, const FrameConstants& rays) {
    std::vector<vec4> corners;
    corners.reserve((k_sky_columns + 1) * (k_sky_rows + 1));
    for (int row = 0; row <= k_sky_rows; ++row)
        for (int column = 0; column <= k_sky_columns; ++column) {
            const float x = static_cast<float>(column) * (2.0f / k_sky_columns) - 1;
            const float y = static_cast<float>(row) * (2.0f / k_sky_rows) - 1;
            const vec3 ray(rays.ray_forward + x * rays.ray_right + y * rays.ray_down);
            corners.push_back(v4(sky_seen(light.sky, look.sky_white, look.white, ray)));
        }
    return corners;
}

}  // namespace flaneur
