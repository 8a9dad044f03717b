#include <gtest/gtest.h>

#include "renderer/view.h"
#include "tools/flaneur/window/navigate.h"
#include "tools/flaneur/window/pick.h"

namespace flaneur {
namespace {

constexpr Size k_size{800, 450};

glm::vec2 pixel_of(const Camera& camera, glm::vec3 place) {
    const glm::vec4 at = make_view(camera, k_size.width, k_size.height).clip_from_world * glm::vec4(place, 1);
    return {(at.x / at.w * 0.5f + 0.5f) * k_size.width - 0.5f,
            (at.y / at.w * 0.5f + 0.5f) * k_size.height - 0.5f};
}

Viewer viewer() {
    Viewer v;
    v.choice.kind = CameraChoice::Kind::fixed;
    v.camera = {.eye = {0, 10, -20}, .target = {0, 9.5f, -19}};
    return v;
}

TEST(Navigate, ZoomsToWhatIsUnderTheCursorAndBack) {
    const glm::vec3 place(3, 0, 5);
    Viewer v = viewer();
    const glm::vec2 pixel = pixel_of(v.camera, place);
    const glm::vec3 eye = v.camera.eye;
    float last = glm::length(place - eye);
    for (int i = 0; i < 60; ++i) {
        zoom(place, 1, v);
        const float now = glm::length(place - v.camera.eye);
        EXPECT_LE(now, last + 1e-4f);
        EXPECT_GE(now, 0.59f) << "never through it";
        EXPECT_LT(glm::length(pixel_of(v.camera, place) - pixel), 0.5f) << "it stays under the cursor";
        last = now;
    }
    EXPECT_LT(last, 0.61f);
    Viewer there = viewer();
    zoom(place, 3, there), zoom(place, -3, there);
    EXPECT_LT(glm::length(there.camera.eye - eye), 1e-3f);
}

TEST(Navigate, PansSoThatThePlaceStaysUnderTheCursor) {
    const glm::vec3 place(3, 0, 5);
    Viewer v = viewer();
    const glm::vec2 from = pixel_of(v.camera, place), to = from + glm::vec2(120, -60);
    pan(place, from, to, k_size, v);
    EXPECT_LT(glm::length(pixel_of(v.camera, place) - to), 0.1f);
}

TEST(Navigate, OrbitsAtOneDistanceWithThePlaceInSight) {
    const glm::vec3 place(0, 0, 0);
    Viewer v = viewer();
    const glm::vec2 pixel = pixel_of(v.camera, place);
    const float distance = glm::length(v.camera.eye);
    for (int i = 0; i < 100; ++i) {
        orbit(place, {13, 0}, v);
        EXPECT_NEAR(glm::length(v.camera.eye), distance, 1e-2f);
        EXPECT_LT(glm::length(pixel_of(v.camera, place) - pixel), 2) << i;
    }
    for (int i = 0; i < 100; ++i) {
        orbit(place, {0, i < 50 ? 40.0f : -40.0f}, v);
        EXPECT_NEAR(glm::length(v.camera.eye), distance, 1e-2f);
        EXPECT_GT(v.camera.eye.y, 0) << "never under the ground that is looked at";
        const glm::vec3 ahead = v.camera.target - v.camera.eye;
        EXPECT_NEAR(glm::length(ahead), 1, 1e-3f);
    }
}

}  // namespace
}  // namespace flaneur
