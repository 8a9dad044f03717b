#include <gtest/gtest.h>

#include <cmath>

#include "tools/flaneur/view/sun.h"

namespace flaneur {
namespace {

Sun sun_at(float hour, float latitude) {
    Scene scene;
    scene.hour = hour;
    return scene_sun(scene, latitude);
}

float height(const Sun& sun) { return std::asin(sun.direction.y) * 57.29578f; }

TEST(SceneSun, StandsLowInTheWestLateInTheAfternoon) {
    const Sun sun = sun_at(17.5f, 48);
    EXPECT_NEAR(glm::length(sun.direction), 1, 1e-5f);
    EXPECT_NEAR(height(sun), 25, 1.5f);
    EXPECT_LT(sun.direction.x, -0.7f);
}

TEST(SceneSun, IsHighestInTheSouthAtTheSunsNoon) {
    const float noon = 12 + 4.0f / 3;
    for (float hour = 0; hour < 24; hour += 0.25f)
        EXPECT_LE(height(sun_at(hour, 48)), height(sun_at(noon, 48)));
    EXPECT_NEAR(height(sun_at(noon, 48)), 90 - 48 + 10.2f, 0.3f);  // the declination of 26 August
    EXPECT_GT(sun_at(noon, 48).direction.z, 0.5f);
    EXPECT_LT(sun_at(noon, -35).direction.z, -0.5f) << "in the north, south of the equator";
    EXPECT_LT(height(sun_at(noon + 12, 48)), -20);
}

TEST(SceneSun, IsAtTheHorizonAtDawnAndDusk) {
    for (float latitude : {40.0f, 48.0f, 52.0f}) {
        for (const char* word : {"dawn", "dusk"})
            EXPECT_NEAR(height(sun_at(*parse_time(word), latitude)), 0, 5) << word;
        EXPECT_GT(height(sun_at(*parse_time("noon"), latitude)), 45);
        EXPECT_LT(height(sun_at(*parse_time("night"), latitude)), -20);
    }
}

TEST(SceneSun, IsWhereTheSceneSaysIfItDoes) {
    Scene scene;
    scene.sun_height = 30.0f;
    scene.sun_heading = 90.0f;
    const Sun sun = scene_sun(scene, 48);
    EXPECT_NEAR(sun.direction.x, 0.866f, 1e-3f);
    EXPECT_NEAR(sun.direction.y, 0.5f, 1e-3f);
    EXPECT_NEAR(sun.direction.z, 0, 1e-3f);
}

TEST(LitWindows, AreMostInTheEveningAndFewBeforeDawn) {
    for (float hour = -3; hour < 30; hour += 0.1f) {
        EXPECT_GE(lit_windows(hour), 0);
        EXPECT_LE(lit_windows(hour), lit_windows(18.5f));
        EXPECT_NEAR(lit_windows(hour), lit_windows(hour + 0.1f), 0.03f);
    }
    EXPECT_LT(lit_windows(3), 0.05f);
}

}  // namespace
}  // namespace flaneur
