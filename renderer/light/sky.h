// The daylight sky of Preetham, Shirley and Smits, "A Practical Analytic Model for Daylight" (SIGGRAPH 1999),
// and the sun's light through the same air. Luminances in kcd/m2, illuminances in klx, as linear sRGB.
#pragma once

#include <array>
#include <glm/glm.hpp>

namespace flaneur {

struct SkyModel {
    glm::vec3 to_sun;
    std::array<glm::vec3, 5> perez;  // A..E for Y, x, y
    glm::vec3 scale;                 // zenith Y, x, y over the distribution at the zenith
    // Added to it, linear in the sine of the height: at the horizon, overhead; and a glow over the horizon
    // where the sun is.
    glm::vec3 low{0}, high{0}, dusk{0};
    glm::vec3 sun;  // on a surface square to the sun
};

// `turbidity` 2 is clear mountain air, 3 a clear day, 6 haze. `to_sun` is a unit vector above the horizon.
SkyModel make_sky(glm::vec3 to_sun, float turbidity);

// In a unit direction; below the horizon, that of the horizon. Preetham's part of it, the added part, and
// both.
glm::vec3 daylit_sky(const SkyModel& sky, glm::vec3 direction);
glm::vec3 added_sky(const SkyModel& sky, glm::vec3 direction);
glm::vec3 sky_luminance(const SkyModel& sky, glm::vec3 direction);

// Light of the sky, and of a ground that reflects `ground` of it and of the sun, on a surface of normal n:
// illuminance over pi is dot(slope[c], n) + level[c] for colour c.
struct AmbientLight {
    std::array<glm::vec3, 3> slope;
    glm::vec3 level;
};
AmbientLight ambient_light(const SkyModel& sky, glm::vec3 ground);

float luminance(glm::vec3 linear);

}  // namespace flaneur
