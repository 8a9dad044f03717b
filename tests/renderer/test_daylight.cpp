#include <gtest/gtest.h>

#include <cmath>

#include "renderer/light/daylight.h"

namespace flaneur {
namespace {

Sun sun_at(float degrees) {
    const float angle = degrees * 0.0174533f;
    return {{std::cos(angle), std::sin(angle), 0}};
}

float level_light(const Daylight& day) {
    const AmbientLight light = ambient_light(day.sky, glm::vec3(0));
    const glm::vec3 sky = light.level + glm::vec3(light.slope[0].y, light.slope[1].y, light.slope[2].y);
    return luminance(3.14159265f * sky + day.sky.sun * day.to_light.y);
}

TEST(Daylight, IsPreethamsSkyWhileTheSunIsUp) {
    const Daylight day = make_daylight(sun_at(25), false);
    const SkyModel sky = make_sky(day.to_light, 2.8f);
    for (glm::vec3 direction : {glm::vec3(0, 1, 0), glm::vec3(0.6f, 0.8f, 0), glm::vec3(-1, 0, 0)})
        EXPECT_EQ(sky_luminance(day.sky, direction), sky_luminance(sky, direction));
    EXPECT_EQ(day.sky.sun, sky.sun);
    EXPECT_EQ(day.lamps, 0);
}

TEST(Daylight, FadesWithoutAStepFromNoonToNight) {
    float before = level_light(make_daylight(sun_at(60), false));
    for (float height = 59.9f; height > -20; height -= 0.1f) {
        const Daylight day = make_daylight(sun_at(height), false);
        const float light = level_light(day);
        EXPECT_LT(light, before * 1.04f) << height;
        EXPECT_GT(light, before * 0.85f) << height;
        EXPECT_GE(day.to_light.y, 0.017f);
        EXPECT_NEAR(glm::length(day.to_light), 1, 1e-5f);
        before = light;
    }
    EXPECT_LT(before, 0.01f);
    EXPECT_GT(before, 0.001f);
}

TEST(Daylight, LampsAreLitWhenTheSunIsDown) {
    EXPECT_EQ(make_daylight(sun_at(5), false).lamps, 0);
    EXPECT_EQ(make_daylight(sun_at(-10), false).lamps, 1);
    EXPECT_EQ(make_daylight(sun_at(-10), true).lamps, 1);
}

TEST(Daylight, CloudsHideTheSunAndBrightenOverhead) {
    const Daylight day = make_daylight(sun_at(40), true);
    EXPECT_EQ(day.sky.sun, glm::vec3(0));
    EXPECT_NEAR(level_light(day), 0.3f + 21 * std::sin(40 * 0.0174533f), 0.8f);
    EXPECT_GT(luminance(sky_luminance(day.sky, {0, 1, 0})), luminance(sky_luminance(day.sky, {0, 0, 1})));
    EXPECT_EQ(sky_luminance(day.sky, {1, 0, 0}), sky_luminance(day.sky, {-1, 0, 0}));
}

TEST(Daylight, DimPlacesAreSeenDimly) {
    EXPECT_LT(exposure_key(0.01f), 0.05f);
    EXPECT_GT(exposure_key(1000), 0.6f);
    EXPECT_LT(exposure_key(0.1f), exposure_key(1));
}

}  // namespace
}  // namespace flaneur
