// What lights a scene from far away, by where the sun stands and by the weather: sun or moon, and the sky.
#pragma once

#include "renderer/light/sky.h"
#include "renderer/scene.h"

namespace flaneur {

// A unit vector towards the sun; for no direction at all, the default Sun's.
glm::vec3 sun_direction(const Sun& sun);
// A unit vector turned upwards to at least `lowest` radians above the horizon.
glm::vec3 above_horizon(glm::vec3 direction, float lowest);

struct Daylight {
    // Towards what throws the shadows, the sun or, once it is well down, the moon: a unit vector, at least
    // one degree above the horizon.
    glm::vec3 to_light;
    SkyModel sky;     // sky.sun is what comes from there; none at dusk and under clouds
    float disc = 0;   // luminance of sun or moon, against sky.sun
    float lamps = 0;  // how far streets and windows are lit: 0 by day, 1 at night
};

// By a clear day the sky is Preetham's. Under clouds it grows brighter towards the zenith as those of the CIE
// do (S 011; between its types 1 and 5), with the illuminance of Krochmann & Seidl, "Quantitative data on
// daylight for illuminating engineering" (Lighting Research & Technology 1974). When the sun is down the sky
// loses a decade of light for each 2.6 degrees, as twilight does, until a city's night is left.
Daylight make_daylight(const Sun& sun, bool is_overcast);

// The share of the light there is that eyes used to it see it by: dim places look dim, as they should.
// Krawczyk, Myszkowski & Seidel, "Perceptual effects in real-time tone mapping" (2005). cd/m2.
float exposure_key(float luminance);

}  // namespace flaneur
