// The swing of a foot: its way over level ground and over steps, and what the planner keeps it clear of.
#include <gtest/gtest.h>

#include "sim/gait/curves/swing-inl.h"
#include "sim/gait/footing.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

using namespace HWY_NAMESPACE;

SwingEnds<float> ends_of(const FootPlace& from, const FootPlace& to) {
    Vec3 far = to.position - from.position;
    return {{from.position.x, from.position.y, from.position.z},
            {far.x, far.y, far.z},
            from.normal.x,
            from.normal.z,
            to.normal.x - from.normal.x,
            to.normal.z - from.normal.z};
}

TEST(Swing, GoesFromPlaceToPlaceAndOnlyAhead) {
    for (float pace : {0.0f, 0.7f, 1.0f, 1.7f}) {
        float running = pace > 0 ? 1.0f : 0.0f;
        for (float rise : {-0.3f, 0.0f, 0.02f, 0.15f, 0.4f}) {
            SwingEnds<float> ends = ends_of({{1, 2, 3}}, {{1.4f, 2 + rise, 4}});
            float before = 0;
            for (int k = 0; k <= 100; ++k) {
                SwingPath<float> path =
                    swing_path(ends, swing_time(static_cast<float>(k) / 100), running, pace);
                ASSERT_GE(path.progress, before - 1e-5f) << rise << " " << k << " " << pace;
                before = path.progress;
                ASSERT_GE(path.place.y, 2 + std::min(rise, 0.0f) - 1e-5f);
                ASSERT_LE(path.place.y, 2 + std::max(rise, 0.0f) + 1e-5f);
            }
            SwingPath<float> first = swing_path(ends, swing_time(0.0f), running, pace);
            SwingPath<float> last = swing_path(ends, swing_time(1.0f), running, pace);
            EXPECT_NEAR(first.place.z, 3, 1e-5f);
            EXPECT_NEAR(last.place.x, 1.4f, 1e-5f);
            EXPECT_NEAR(last.place.y, 2 + rise, 1e-5f);
        }
    }
}

TEST(Swing, ClimbsBeforeItGoesOnAndGoesOnBeforeItComesDown) {
    SwingEnds<float> up = ends_of({{0, 0, 0}}, {{0, 0.3f, 0.6f}}),
                     down = ends_of({{0, 0.3f, 0}}, {{0, 0, 0.6f}});
    SwingPath<float> early = swing_path(up, swing_time(0.4f), 0.0f, 1.0f);
    EXPECT_GT(early.place.y / 0.3f, early.progress + 0.3f);
    SwingPath<float> late = swing_path(down, swing_time(0.6f), 0.0f, 1.0f);
    EXPECT_GT(late.place.y / 0.3f, 1 - late.progress + 0.3f);
}

// A beam lies across the way, wherever along it: the swing of a walk and that of a run, which is farther
// ahead at the same time, both pass above it where the planner looks.
TEST(Swing, IsPlannedOnTheWayThatThePoseTakes) {
    const FootSize size{0.06f, 0.14f, 0.21f};
    const float k_height = 0.1f;
    float differs = 0;
    for (int beam = 0; beam < 30; ++beam) {
        float z = 0.3f + 0.04f * static_cast<float>(beam);
        Ground ground;
        add_floor(ground, {-2, -2}, {2, z - 0.03f}, 0, Surface::sidewalk);
        add_floor(ground, {-2, z - 0.03f}, {2, z + 0.03f}, k_height, Surface::sidewalk);
        add_floor(ground, {-2, z + 0.03f}, {2, 4}, 0, Surface::sidewalk);
        index_ground(ground);
        FootPlace from{{0, 0, 0}}, to{{0, 0, 1.8f}};
        float lifts[2];
        for (int runs = 0; runs < 2; ++runs) {
            float running = static_cast<float>(runs);
            float lift = lifts[runs] =
                clear_ground(surroundings_of(ground), from, to, size, running, 1.0f).obstacle;
            for (float u : {0.25f, 0.35f, 0.45f, 0.55f, 0.65f, 0.75f}) {
                SwingTime<float> time = swing_time(u);
                SwingPath<float> path = swing_path(ends_of(from, to), time, running, 1.0f);
                float tip = path.place.z + size.tip;
                if (tip < z - 0.03f || tip > z + 0.03f) continue;
                ASSERT_GE(path.place.y + lift * time.hop, k_height - 1e-4f) << beam << " " << u;
            }
        }
        differs = std::max(differs, std::fabs(lifts[1] - lifts[0]));
    }
    EXPECT_GT(differs, 0.03f);
}

}  // namespace
}  // namespace flaneur
