#include <gtest/gtest.h>

#include <cmath>

#include "assets/scene.h"
#include "renderer/view.h"
#include "tests/tools/loaded.h"
#include "tools/flaneur/load/load.h"
#include "tools/flaneur/view/camera.h"
#include "tools/flaneur/window/cameras/map.h"

namespace flaneur {
namespace {

constexpr Size k_size{1000, 500};

CameraChoice map_of(Vec2 middle, float across, float bearing) {
    CameraChoice map;
    map.kind = CameraChoice::Kind::map;
    map.middle = middle, map.across = across, map.bearing = bearing;
    return map;
}

TEST(Map, HasNorthUpAndTurns) {
    // Of the picture's right border and of its upper one, from the middle.
    auto right = [](float bearing) {
        return place_under(map_of({0, 0}, 200, bearing), k_size, {999.5f, 249.5f});
    };
    auto up = [](float bearing) {
        return place_under(map_of({0, 0}, 200, bearing), k_size, {499.5f, -0.5f});
    };
    auto is = [](Vec2 a, Vec2 b) { return length(a - b) < 1e-3f; };
    EXPECT_TRUE(is(right(0), {100, 0})) << "east";
    EXPECT_TRUE(is(up(0), {0, -50})) << "north is -z";
    EXPECT_TRUE(is(up(90), {50, 0})) << "east is up";
    EXPECT_TRUE(is(right(90), {0, 100})) << "and south right";
    CameraChoice map = map_of({0, 0}, 200, 0);
    turn_map(map, k_pi / 2);
    EXPECT_NEAR(map.bearing, 90, 1e-3f) << "turned counter-clockwise, east comes up";
    for (int i = 0; i < 40; ++i) turn_map(map, 0.7f);
    EXPECT_LE(std::fabs(map.bearing), 180.001f);
}

TEST(Map, ZoomsAndPansWithWhatIsUnderTheCursor) {
    for (const float bearing : {0.0f, 37.0f, -170.0f}) {
        CameraChoice map = map_of({12, -40}, 200, bearing);
        const glm::vec2 pixel(800, 100);
        const Vec2 place = place_under(map, k_size, pixel);
        zoom_map(map, k_size, pixel, 3);
        EXPECT_LT(map.across, 200);
        EXPECT_LT(length(place_under(map, k_size, pixel) - place), 1e-3f);
        pan_map(map, k_size, pixel, {300, 444});
        EXPECT_LT(length(place_under(map, k_size, {300, 444}) - place), 1e-3f);
        zoom_map(map, k_size, pixel, 1000);
        EXPECT_EQ(map.across, k_least_across);
        zoom_map(map, k_size, pixel, -1000);
        EXPECT_EQ(map.across, k_most_across);
    }
}

TEST(Map, ScaleIsRoundAndTrue) {
    for (float metres = 1e-3f; metres < 50; metres *= 1.37f) {
        const ScaleBar bar = scale_bar(metres, 150);
        EXPECT_LE(bar.pixels, 150.01f) << metres;
        EXPECT_GT(bar.pixels, 150 / 2.51f) << metres << ": no longer one fits";
        EXPECT_NEAR(bar.pixels * metres, bar.metres, 1e-3f * bar.metres);
        const double ten = std::pow(10.0, std::floor(std::log10(static_cast<double>(bar.metres)) + 1e-4));
        const double digit = static_cast<double>(bar.metres) / ten;
        EXPECT_TRUE(std::fabs(digit - 1) < 1e-4 || std::fabs(digit - 2) < 1e-4 || std::fabs(digit - 5) < 1e-4)
            << bar.metres;
    }
    EXPECT_EQ(told_length(50), "50 m");
    EXPECT_EQ(told_length(0.5f), "0.5 m");
    EXPECT_EQ(told_length(2000), "2 km");
}

TEST(Map, CameraSeesThePlacesThatTheMapSays) {
    const Loaded loaded = loaded_scene("corner", 1);
    const World& world = *loaded.world;
    for (const float bearing : {0.0f, 90.0f, -133.0f})
        for (const float across : {20.0f, 200.0f, 4000.0f}) {
            const CameraChoice map = map_of({5, 7}, across, bearing);
            const Camera camera = map_camera(world, map, k_size);
            const View view = make_view(camera, k_size.width, k_size.height);
            for (const glm::vec2 pixel : {glm::vec2(0, 0), glm::vec2(499.5f, 249.5f), glm::vec2(999, 100)}) {
                const Vec2 place = place_under(map, k_size, pixel);
                const glm::vec4 at = view.clip_from_world * glm::vec4(place.x, camera.target.y, place.z, 1);
                const glm::vec2 seen((at.x / at.w * 0.5f + 0.5f) * 1000 - 0.5f,
                                     (at.y / at.w * 0.5f + 0.5f) * 500 - 0.5f);
                EXPECT_LT(glm::length(seen - pixel), 0.6f) << bearing << " " << across;
            }
            EXPECT_GT(camera.clear_air, glm::length(camera.target - camera.eye))
                << "no haze before the ground";
        }
    const CameraChoice all = map_of_all(world, k_size);
    for (const Vec2 corner : {world.ground->low, world.ground->high}) {
        const Vec2 off = corner - all.middle;
        EXPECT_LE(std::fabs(off.x), all.across / 2);
        EXPECT_LE(std::fabs(off.z), all.across / 4);
    }
}

TEST(Map, OfAllLiesBetweenPanels) {
    const Loaded loaded = loaded_scene("corner", 1);
    const World& world = *loaded.world;
    const CameraChoice map = map_between(world, k_size, 100, 460);
    const Vec2 above = place_under(map, k_size, {499.5f, 99.5f}),
               below = place_under(map, k_size, {499.5f, 459.5f});
    EXPECT_LE(above.z, world.ground->low.z);
    EXPECT_GE(below.z, world.ground->high.z);
    EXPECT_NEAR(above.z + below.z, world.ground->low.z + world.ground->high.z, 0.01f)
        << "in the middle of it";
}

}  // namespace
}  // namespace flaneur
