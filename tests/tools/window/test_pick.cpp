#include <gtest/gtest.h>

#include "renderer/view.h"
#include "tests/tools/loaded.h"
#include "tools/flaneur/window/pick.h"

namespace flaneur {
namespace {

class Pick : public testing::Test {
  protected:
    void SetUp() override {
        loaded = loaded_scene("corner", 60);
        for (int i = 0; i < 60; ++i) step(*loaded.world);
    }
    // Where a place is seen, pixels.
    static glm::vec2 pixel_of(const Camera& camera, glm::vec3 place) {
        const glm::vec4 at =
            make_view(camera, k_size.width, k_size.height).clip_from_world * glm::vec4(place, 1);
        return {(at.x / at.w * 0.5f + 0.5f) * k_size.width, (at.y / at.w * 0.5f + 0.5f) * k_size.height};
    }
    static constexpr Size k_size{640, 360};
    Loaded loaded;
};

TEST_F(Pick, FindsWhoIsUnderTheCursor) {
    const Crowd& crowd = loaded.world->crowd;
    int found = 0;
    for (uint32_t i = 0; i < crowd.count; ++i) {
        const Vec3 at = crowd.motion.position[i];
        const float height =
            loaded.world->kinds[crowd.identity.body[i]].body.height * crowd.identity.scale[i];
        const Camera camera{.eye = {at.x + 1.5f, at.y + 1.7f, at.z + 1}, .target = {at.x, at.y + 1, at.z}};
        for (const float up : {0.1f, 0.5f, 0.95f}) {
            const glm::vec2 pixel = pixel_of(camera, {at.x, at.y + up * height, at.z});
            const auto who = walker_along(*loaded.world, camera, ray_through(camera, k_size, pixel), 0);
            if (!who) continue;  // behind a wall
            ++found;
            // Another may stand before; then it is nearer.
            const Vec3 other = crowd.motion.position[*who];
            EXPECT_LE(glm::length(glm::vec3(other.x, other.y + 1, other.z) - camera.eye), 3.5f);
            if (*who == i) continue;
            EXPECT_LT(
                glm::length(glm::vec3(other.x, 0, other.z) - glm::vec3(camera.eye.x, 0, camera.eye.z)),
                glm::length(glm::vec3(at.x, 0, at.z) - glm::vec3(camera.eye.x, 0, camera.eye.z)) + 0.6f);
        }
    }
    EXPECT_GT(found, 150);
}

TEST_F(Pick, NobodyIsBesideTheWayOrBehindTheEye) {
    const Crowd& crowd = loaded.world->crowd;
    for (uint32_t i = 0; i < crowd.count; i += 7) {
        const Vec3 at = crowd.motion.position[i];
        const Camera up{.eye = {at.x, at.y + 40, at.z}, .target = {at.x, at.y + 80, at.z + 0.1f}};
        EXPECT_FALSE(walker_along(*loaded.world, up, {0, 1, 0}, 0));
        const Camera within{.eye = {at.x + 0.1f, at.y + 1.6f, at.z}, .target = {at.x + 5, at.y, at.z}};
        EXPECT_NE(walker_along(*loaded.world, within, {1, 0, 0}, 0.01f), i) << "one is not seen from within";
    }
}

}  // namespace
}  // namespace flaneur
