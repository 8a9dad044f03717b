#include "tools/flaneur/view/sun.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "sim/base/math.h"

namespace flaneur {

namespace {

constexpr float k_day = 238;         // of the year: 26 August
constexpr float k_clock = 4.0f / 3;  // hours that clocks are before the sun: summer time at 10 degrees east
                                     // of the meridian of a zone of one hour

}  // namespace

Sun scene_sun(const Scene& scene, float latitude) {
    const SinCos tilt = sin_cos(23.45f * k_radians * sin_cos(2 * k_pi * (284 + k_day) / 365).sine);
    const SinCos place = sin_cos(latitude * k_radians);
    const SinCos turn = sin_cos((scene.hour - k_clock - 12) * (k_pi / 12));
    const float east = -tilt.cosine * turn.sine;
    const float north = place.cosine * tilt.sine - place.sine * tilt.cosine * turn.cosine;
    const float up = place.sine * tilt.sine + place.cosine * tilt.cosine * turn.cosine;
    glm::vec3 direction(east, up, -north);
    if (!scene.sun_height && !scene.sun_heading) return {direction};
    const float height = scene.sun_height.value_or(std::asin(clamp(up, -1, 1)) / k_radians);
    const float heading = scene.sun_heading.value_or(std::atan2(east, north) / k_radians);
    const SinCos h = sin_cos(height * k_radians), a = sin_cos(heading * k_radians);
    return {{h.cosine * a.sine, h.sine, -h.cosine * a.cosine}};
}

float lit_windows(float hour) {
    struct Known {
        float hour, share;
    };
    constexpr Known k_known[] = {{0, 0.10f},  {1.5f, 0.03f},  {5, 0.03f},  {7, 0.25f}, {9, 0.12f},
                                 {16, 0.15f}, {18.5f, 0.34f}, {22, 0.32f}, {24, 0.10f}};
    const float h = hour - 24 * std::floor(hour / 24);
    const Known* next = std::find_if(std::begin(k_known) + 1, std::end(k_known) - 1,
                                     [&](const Known& k) { return k.hour > h; });
    const Known* last = next - 1;
    return lerp(last->share, next->share, (h - last->hour) / (next->hour - last->hour));
}

}  // namespace flaneur
