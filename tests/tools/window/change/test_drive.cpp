// Somebody is driven by turns, as in "The Walker Report"; and limbs are led otherwise while people walk.
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/math.h"
#include "tests/tools/loaded.h"
#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/actions.h"
#include "tools/flaneur/window/ask/curves.h"
#include "tools/flaneur/window/change/drive.h"
#include "tools/flaneur/window/change/save.h"
#include "tools/flaneur/window/viewer.h"

namespace flaneur {
namespace {

struct Driven {
    Show show;
    Viewer viewer;

    World& world() { return *show.loaded.world; }
    float heading() { return world().crowd.motion.heading[0]; }
    void press(int key, int mods = 0) {
        viewer.presses.push_back({key, mods, false});
        act_on_presses(show, viewer);
    }
    // As the window does, a picture for every third tick.
    void go(float seconds) {
        for (int tick = 0; tick < static_cast<int>(seconds * 60); ++tick) {
            if (tick % 3 == 0) {
                Driving& driving = viewer.change.driving;
                world().crowd.driven.wish = wish_by_turns(world(), driving, std::nullopt);
            }
            step(show);
        }
    }
};

std::unique_ptr<Driven> driven() {
    auto d = std::make_unique<Driven>();
    d->show.loaded = loaded_scene("walker-curves", 1, 1);
    begin_run(d->viewer.time, d->world());
    d->viewer.change.scene.habit = Habit::ramble;
    d->viewer.change.scene.limbs = LimbLead::curves;
    d->viewer.change.driving.is_by_turns = true;
    d->viewer.selected = 0;
    drive_asked(d->show, d->viewer);
    EXPECT_TRUE(is_driving(d->show));
    d->press(GLFW_KEY_DOWN);
    d->go(2);
    EXPECT_LT(length(d->world().crowd.motion.velocity[0]), 0.05f);
    return d;
}

// From where there is room for two turns to that side.
float free_heading(const World& w, float side) {
    for (float yaw = 0; yaw < 6; yaw += 0.1f) {
        float least = 9;
        for (const float degrees : {0.0f, 45.0f, 90.0f})
            least = std::min(
                least, clear_way(w.crowd, *w.navmesh, 0, 0, wrap_angle(yaw + side * degrees * k_radians), 9));
        if (least >= 9) return wrap_angle(yaw);
    }
    ADD_FAILURE() << "there is none";
    return 0;
}

TEST(Drive, UpGoesOnAndDownStops) {
    auto d = driven();
    d->press(GLFW_KEY_UP);
    d->go(3);
    const float pace = d->world().crowd.march.pace[0];
    EXPECT_NEAR(length(d->world().crowd.motion.velocity[0]), pace, 0.1f * pace) << "without a key held";
    d->press(GLFW_KEY_S);
    d->go(2);
    EXPECT_LT(length(d->world().crowd.motion.velocity[0]), 0.05f);
}

TEST(Drive, LeftAndRightTurnBy45DegreesOneTurnAtATimeOnTheWay) {
    for (const int key : {GLFW_KEY_LEFT, GLFW_KEY_D}) {
        auto d = driven();
        const float side = key == GLFW_KEY_LEFT ? 1.0f : -1.0f;
        d->viewer.change.driving.heading = free_heading(d->world(), side);
        d->press(GLFW_KEY_UP);
        d->go(2);
        const float before = d->viewer.change.driving.heading;
        d->press(key);
        d->go(1.5f);
        EXPECT_NEAR(side * wrap_angle(d->viewer.change.driving.heading - before) / k_radians, 22.5f, 1)
            << "half of it after half of three seconds";
        d->press(key);
        d->press(key == GLFW_KEY_LEFT ? GLFW_KEY_RIGHT : GLFW_KEY_A);
        d->go(2.5f);
        EXPECT_NEAR(side * wrap_angle(d->heading() - before) / k_radians, 45, 3) << "one turn at a time";
        EXPECT_GT(length(d->world().crowd.motion.velocity[0]), 0.3f) << "it walks on meanwhile";
        d->press(key);
        d->go(4);
        EXPECT_NEAR(side * wrap_angle(d->heading() - before) / k_radians, 90, 3);
    }
}

TEST(Drive, OtherKeysAndOtherWaysStayAsTheyAre) {
    auto d = driven();
    EXPECT_FALSE(press_in_drive(GLFW_KEY_LEFT, GLFW_MOD_ALT, d->show, d->viewer)) << "to the mark before";
    EXPECT_FALSE(press_in_drive(GLFW_KEY_H, 0, d->show, d->viewer));
    drive_by_turns(d->show, d->viewer, false);
    EXPECT_FALSE(press_in_drive(GLFW_KEY_LEFT, 0, d->show, d->viewer)) << "it is held";
    d->press(GLFW_KEY_X, GLFW_MOD_SHIFT);
    EXPECT_TRUE(press_in_drive(GLFW_KEY_LEFT, GLFW_MOD_SHIFT, d->show, d->viewer)) << "Shift runs";
    d->press(GLFW_KEY_ESCAPE);
    EXPECT_FALSE(press_in_drive(GLFW_KEY_LEFT, 0, d->show, d->viewer)) << "nobody is driven";
}

TEST(Drive, AnotherSceneIsDrivenInItsWay) {
    auto d = driven();
    for (const char* scene : {"walker-curves", "walker-report"}) {
        Options options;
        options.scene = load_scene(scene).value();
        start_changes(options, d->show, d->viewer);
        EXPECT_EQ(d->viewer.change.driving.is_by_turns, std::string(scene) == "walker-curves");
    }
}

TEST(Drive, LimbsAreLedOtherwiseFromThisTickOn) {
    auto d = driven();
    d->press(GLFW_KEY_ESCAPE);
    Viewer& v = d->viewer;
    v.change.late = 0;
    LimbCurves how = d->world().crowd.march.how;
    lead_limbs(d->show, v, LimbLead::curves, how);
    EXPECT_EQ(v.change.late, 0u) << "nothing has changed";
    how.period = 0.75f;
    const float pace = d->world().crowd.march.pace[0];
    lead_limbs(d->show, v, LimbLead::curves, how);
    EXPECT_NEAR(d->world().crowd.march.pace[0], 2 * pace, 1e-5f);
    EXPECT_GT(v.change.late, 0u);
    EXPECT_EQ(v.time.changes.back(), d->world().tick);
    EXPECT_EQ(changed_scene(d->show, v, "").limbs, LimbLead::curves);
    lead_limbs(d->show, v, LimbLead::gait, how);
    EXPECT_FALSE(is_on(d->world().crowd.march));
    EXPECT_EQ(changed_scene(d->show, v, "").limbs, LimbLead::gait);
}

}  // namespace
}  // namespace flaneur
