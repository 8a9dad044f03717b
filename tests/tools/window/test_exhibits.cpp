// Targets of the gallery's exhibits under a hand, and methods that are switched.
#include <gtest/gtest.h>

#include "renderer/view.h"
#include "sim/base/rng.h"
#include "sim/state.h"
#include "tests/tools/loaded.h"
#include "tools/extract/convert.h"
#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/change/room.h"
#include "tools/flaneur/window/exhibits/exhibits.h"
#include "tools/flaneur/window/input.h"
#include "tools/flaneur/window/viewer.h"

namespace flaneur {
namespace {

constexpr Size k_size{640, 360};

glm::vec2 pixel_of(const Camera& camera, Vec3 place) {
    const glm::vec4 at =
        make_view(camera, k_size.width, k_size.height).clip_from_world * glm::vec4(to_glm(place), 1);
    return {(at.x / at.w * 0.5f + 0.5f) * k_size.width - 0.5f,
            (at.y / at.w * 0.5f + 0.5f) * k_size.height - 0.5f};
}

class Exhibits : public testing::Test {
  protected:
    void SetUp() override {
        show.loaded = loaded_scene("ik-gallery", 0);
        Options options;
        options.scene = load_scene("ik-gallery").value();
        options.scene.walkers = 0;
        start_changes(options, show, v);
        begin_run(v.time, world());
        v.camera = {.eye = {0, 3, 12}, .target = {0, 1.5f, -1}};
        for (int i = 0; i < 30; ++i) pass();
    }
    World& world() { return *show.loaded.world; }
    const Linkages& linkages() { return world().linkages; }
    // What the window does between two pictures.
    void pass() {
        ASSERT_TRUE(carry_on(show, v));
        make_tick(show, v);
    }
    bool move(glm::vec2 to, bool is_held) {
        const Mouse before = mouse;
        Pointer pointer;
        pointer.x = to.x, pointer.y = to.y;
        pointer.is_down[0] = is_held;
        read_mouse(pointer, false, mouse);
        return drag_target(show, before, mouse, k_size, false, v);
    }
    // From where it is by so many pixels, in steps, with a tick after each.
    void drag(size_t target, glm::vec2 by) {
        const glm::vec2 from = pixel_of(v.camera, linkages().targets[target]);
        move(from, false);
        for (int i = 0; i <= 10; ++i) {
            EXPECT_TRUE(move(from + by * (0.1f * static_cast<float>(i)), true));
            pass();
        }
        EXPECT_TRUE(move(from + by, false)) << "letting go asks about nobody";
    }
    Show show;
    Viewer v;
    Mouse mouse;
};

TEST(FacingPlane, IsMetBelowTheCursorAsFarAheadAsBefore) {
    for (uint32_t seed = 0; seed < 500; ++seed) {
        uint32_t draw = 0;
        auto some = [&](float least, float most) { return random_between({seed}, least, most, draw++); };
        const Camera camera{.eye = {some(-9, 9), some(1, 9), some(-9, 9)},
                            .target = {some(-9, 9), some(-1, 1), some(-9, 9)}};
        const glm::vec3 ahead = glm::normalize(camera.target - camera.eye);
        const glm::vec3 at = camera.eye + ahead * some(1, 20);
        const glm::vec2 pixel{some(0, k_size.width), some(0, k_size.height)};
        const Vec3 there = in_facing_plane(camera, k_size, pixel, {at.x, at.y, at.z});
        EXPECT_NEAR(glm::dot(to_glm(there) - at, ahead), 0, 1e-3f);
        EXPECT_LT(glm::length(pixel_of(camera, there) - pixel), 0.1f);
    }
}

TEST_F(Exhibits, TheTargetUnderTheCursorIsFound) {
    size_t found = 0;
    for (size_t t = 0; t < linkages().targets.size(); ++t) {
        const auto at = target_at(world(), v.camera, k_size, pixel_of(v.camera, linkages().targets[t]));
        if (!at) continue;  // behind a plinth
        found += *at == t;
        EXPECT_LT(glm::length(pixel_of(v.camera, linkages().targets[*at]) -
                              pixel_of(v.camera, linkages().targets[t])),
                  16 + 20);
    }
    EXPECT_GT(found, linkages().targets.size() * 3 / 4);
    EXPECT_FALSE(target_at(world(), v.camera, k_size, {320, 2})) << "sky";
}

TEST_F(Exhibits, WhatIsDraggedIsUnderTheHandAndStaysThere) {
    for (const size_t target : {0u, 3u, 6u}) {
        const Vec3 was = linkages().targets[target];
        const glm::vec2 from = pixel_of(v.camera, was);
        drag(target, {20, -15});
        EXPECT_LT(glm::length(pixel_of(v.camera, linkages().targets[target]) - (from + glm::vec2(20, -15))),
                  1);
        const Vec3 there = linkages().targets[target];
        for (int i = 0; i < 200; ++i) pass();
        EXPECT_EQ(linkages().targets[target], there);
        EXPECT_EQ(v.exhibits.chosen, linkage_of(linkages(), target));
    }
    EXPECT_GT(v.change.late, 0u) << "a scene begins without";
    EXPECT_FALSE(move({320, 2}, true)) << "elsewhere the button looks about";
}

TEST_F(Exhibits, ADragIsUndoneAsOneAndDoneAgain) {
    drag(1, {25, 10});
    const Vec3 there = linkages().targets[1];
    undo_last(show, v);
    for (int i = 0; i < 200; ++i) pass();
    EXPECT_FALSE(linkages().held[1].is_held);
    EXPECT_EQ(linkages().targets[1], sway_at(linkages().all[1].leads[0], world().tick));
    redo_last(show, v);
    pass();
    EXPECT_EQ(linkages().targets[1], there);
}

// The run that is gone back to and played again is the same to the last byte, with what was changed in it.
TEST_F(Exhibits, BackInTimeTheySwayAndAreHeldAgainWhereTheyWere) {
    const uint32_t before = world().tick - 5;
    std::vector<std::byte> first, again;
    Method other = linkages().methods[0];
    other.solver = Solver::ccd;
    drag(2, {-20, 12});
    Design next = current(v.change.designs);
    next.methods[0] = other;
    want(v, std::move(next));
    for (int i = 0; i < 100; ++i) pass();
    EXPECT_EQ(linkages().methods[0], other);
    save_state(world(), first);
    const uint32_t end = world().tick;
    auto go = [&](uint32_t tick) {
        go_to(v, world(), tick);
        for (double now = 1; v.time.going; now += 0.1) go_on(show, v, now);
        ASSERT_EQ(world().tick, tick);
    };
    go(before);
    EXPECT_FALSE(linkages().held[2].is_held);
    EXPECT_EQ(linkages().methods[0].solver, Solver::fabrik);
    go(end);
    save_state(world(), again);
    EXPECT_TRUE(first == again);
    EXPECT_TRUE(linkages().held[2].is_held);
}

}  // namespace
}  // namespace flaneur
