#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sim/base/math.h"
#include "tests/tools/loaded.h"
#include "tools/flaneur/view/camera.h"
#include "tools/flaneur/window/cameras/walk.h"

namespace flaneur {
namespace {

class OnFoot : public testing::Test {
  protected:
    void SetUp() override { loaded = loaded_scene("corner", 10); }
    const World& world() const { return *loaded.world; }
    Stroll set_down(uint32_t where = 0) const {
        const Vec3 at = world().crowd.motion.position[where];
        return set_foot(world(), make_camera(at + Vec3{0, 1.7f, 0}, at + Vec3{1, 1.7f, 0})).value();
    }
    Loaded loaded;
};

TEST_F(OnFoot, NeverGoesThroughWallsNorUnderTheGround) {
    const Ground& ground = *world().ground;
    std::mt19937 chance(3);
    auto share = [&] { return static_cast<float>(chance() % 1000) / 1000; };
    Steering hands;
    int walls_met = 0;
    float way = 0;
    for (uint32_t start = 0; start < 10; ++start) {
        Stroll stroll = set_down(start);
        for (int step = 0; step < 1000; ++step) {
            if (step % 40 == 0)
                hands = {.ahead = 0.6f + share(), .left = share() - 0.5f, .is_fast = step % 80 == 0};
            hands.turn = step % 40 == 0 ? 5 * (share() - 0.5f) : 0.02f * (share() - 0.5f);
            const Vec3 before = stroll.at.position;
            walk(world(), hands, 0.02f + 0.2f * share(), stroll);
            const Vec3 now = stroll.at.position;
            way += length(on_ground(now - before));
            // One tick's way is short against any wall's thickness, and no wall is between its ends.
            const Vec3 chest{0, 1, 0};
            EXPECT_TRUE(sees(ground, before + chest, now + chest)) << step;
            const auto wall = closest_wall(ground, now + chest, 0.8f);
            EXPECT_FALSE(wall && wall->distance < 0.15f) << step << ": " << wall->distance;
            walls_met += wall.has_value();
            const auto under = ground_at(ground, now, 0.6f, 1.5f);
            ASSERT_TRUE(under) << step << ": inside a building, or off the ground, at " << now.x << " "
                               << now.y << " " << now.z;
            EXPECT_GT(stroll.height.value, under->height + 1.1f) << step;
            EXPECT_LT(stroll.height.value, under->height + 2.1f) << step;
        }
    }
    EXPECT_GT(walls_met, 10) << "or nothing was tried";
    EXPECT_GT(way, 1000);
}

TEST_F(OnFoot, StandsAtEyeHeightAndStopsWhenLetGo) {
    Stroll stroll = set_down();
    const auto under = ground_at(*world().ground, stroll.at.position);
    ASSERT_TRUE(under);
    EXPECT_NEAR(stroll.height.value, under->height + k_walking_eye, 0.02f);
    for (int i = 0; i < 30; ++i) walk(world(), {.ahead = 1}, 1.0f / 60, stroll);
    for (int i = 0; i < 60; ++i) walk(world(), {}, 1.0f / 60, stroll);
    EXPECT_FALSE(walk(world(), {}, 1.0f / 60, stroll)) << "it stands still";
    // It goes on as fast as one walks, whatever the pictures take.
    for (const float seconds : {1.0f / 120, 1.0f / 30, 0.2f}) {
        Stroll fast = set_down();
        for (float t = 0; t < 0.4f; t += seconds) walk(world(), {.turn = 0.01f}, seconds, fast);
        EXPECT_EQ(length(fast.velocity), 0);
    }
}

TEST_F(OnFoot, ComesDownWhereOneLooksAndOnlyWhereThereIsGround) {
    const Vec3 at = world().crowd.motion.position[3];
    const auto down = set_foot(world(), make_camera(at + Vec3{30, 40, 0}, at));
    ASSERT_TRUE(down);
    EXPECT_LT(length(on_ground(down->at.position - at)), 15);
    EXPECT_EQ(down->pitch, 0) << "and looks ahead";
    // Above a house, too, one comes down beside it.
    for (const Face& face : world().ground->faces) {
        if (face.kind != FaceKind::facade) continue;
        const Vec3 inside =
            (face.a + face.b) * 0.5f - cross(face.b - face.a, {0, 1, 0}) / length(face.b - face.a);
        const auto beside =
            set_foot(world(), make_camera(inside + Vec3{0, 300, 0}, inside + Vec3{0, 0, 0.2f}));
        ASSERT_TRUE(beside);
        EXPECT_LT(length(on_ground(beside->at.position - inside)), 45);
    }
    EXPECT_FALSE(set_foot(world(), make_camera({5000, 50, 5000}, {5000, 100, 6000}))) << "beyond the city";
}

}  // namespace
}  // namespace flaneur
