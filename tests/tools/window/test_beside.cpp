// Two runs side by side in cities that differ, drawn.
#include <gtest/gtest.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "renderer/renderer.h"
#include "tests/renderer/test_renderer.h"
#include "tools/flaneur/overlay/overlay.h"
#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/change/room.h"
#include "tools/flaneur/window/time/time.h"
#include "tools/flaneur/window/viewer.h"

namespace flaneur {
namespace {

constexpr Size k_size{642, 240}, k_half{320, 240};

class BesideTest : public testing::Test {
  protected:
    void SetUp() override {
        ImGui::CreateContext();
        Options options;
        options.scene = load_scene("corner").value();
        options.scene.walkers = 40;
        show = make_show(make_renderer(on_lavapipe()).value(), options).value();
        v.is_loading = false;
        start_changes(options, show, v);
        begin_run(v.time, *show.loaded.world);
        const Vec3 at = show.loaded.world->crowd.motion.position[0];
        v.camera = {.eye = {at.x + 9, at.y + 14, at.z + 9},
                    .target = {at.x, at.y, at.z},
                    .vertical_fov = 0.9f,
                    .near_plane = 0.1f};
        wall = {AddedKind::wall, at + Vec3{2, 0, -2}, at + Vec3{2, 0, 2}, 0};
    }
    void TearDown() override { ImGui::DestroyContext(); }

    Image alone() {
        return draw_image(*show.renderer, extract_frame(show, v.camera, k_half, 1), 320, 240).value();
    }
    // The left and the right half of what is shown.
    std::pair<std::vector<uint8_t>, std::vector<uint8_t>> halves() {
        const Image both =
            draw_side_by_side(show, v, extract_frame(show, v.camera, k_half, 1), k_size, 1).value();
        std::pair<std::vector<uint8_t>, std::vector<uint8_t>> out;
        for (uint32_t y = 0; y < both.height; ++y) {
            const uint8_t* row = &both.rgba[size_t{4} * y * both.width];
            out.first.insert(out.first.end(), row, row + 4 * 320);
            out.second.insert(out.second.end(), row + 4 * (both.width - 320), row + 4 * both.width);
        }
        return out;
    }
    void take_beside() {
        ASSERT_TRUE(v.time.anew);
        v.time.anew->ready.wait();
        take_people_anew(show, v);
        ASSERT_TRUE(v.time.beside) << v.note;
    }
    void carry() {
        for (int i = 0; i < 3000 && v.change.carried.added != current(v.change.designs).added; ++i) {
            ASSERT_TRUE(carry_on(show, v));
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        ASSERT_EQ(v.change.carried.added, current(v.change.designs).added) << v.note;
    }
    void put_wall() {
        Design design = current(v.change.designs);
        design.added.push_back(wall);
        want(v, design);
        carry();
    }
    Show show;
    Viewer v;
    Addition wall;
};

TEST_F(BesideTest, ARunKeepsTheCityThatItWalksIn) {
    const Image before = alone();
    set_beside(show, v, {1, 40});
    take_beside();
    EXPECT_EQ(halves().first, before.rgba);
    EXPECT_EQ(halves().second, before.rgba) << "the same run";
    put_wall();
    EXPECT_NE(halves().first, before.rgba);
    EXPECT_EQ(halves().second, before.rgba) << "no wall stands in that one";
    EXPECT_EQ(halves().first, alone().rgba) << "and what is exchanged for a picture is given back";
    undo_last(show, v);
    carry();
    EXPECT_EQ(halves().first, before.rgba);
    EXPECT_EQ(halves().second, before.rgba);
}

TEST_F(BesideTest, WhatWasChangedStandsBesideTheCityAsOpened) {
    const Image before = alone();
    set_beside_as_opened(show, v);
    EXPECT_FALSE(v.time.anew) << "nothing differs yet";
    EXPECT_FALSE(v.note.empty());
    put_wall();
    Design later = current(v.change.designs);
    later.hour = 22, later.is_overcast = true;
    want(v, later);
    ASSERT_TRUE(carry_on(show, v));
    set_beside_as_opened(show, v);
    take_beside();
    const auto [left, right] = halves();
    EXPECT_NE(left, before.rgba);
    EXPECT_EQ(right, before.rgba) << "neither wall nor night";
    EXPECT_TRUE(is_dark(show));
    EXPECT_EQ(v.time.beside->world->crowd.demand.hour, v.change.scene.hour);
}

TEST_F(BesideTest, StreetsBeforeAndAfterWithAsManyPeople) {
    put_wall();
    Design more = current(v.change.designs);
    more.people = 60;
    want(v, more);
    for (int i = 0; i < 10; ++i) ASSERT_TRUE(carry_on(show, v));
    ASSERT_EQ(walkers(*show.loaded.world).size(), 60u);
    set_beside_before(show, v);
    take_beside();
    EXPECT_EQ(walkers(*v.time.beside->world).size(), 60u) << "as many people";
    EXPECT_NE(hash_ground(*v.time.beside->world->ground), hash_ground(*show.loaded.world->ground))
        << "no wall";
    v.time.beside.reset();
    undo_last(show, v), undo_last(show, v);
    carry();
    for (int i = 0; i < 10; ++i) ASSERT_TRUE(carry_on(show, v));
    set_beside_before(show, v);
    take_beside();
    EXPECT_EQ(v.time.beside->city_told, "as opened") << "nothing was put into the streets";
}

TEST_F(BesideTest, DensitiesAreSetAgainstEachOther) {
    set_beside(show, v, {1, 40});
    take_beside();
    auto differs = [&](std::vector<GizmoCorner>& fills) {
        Overlay overlay;
        add_density_difference({*show.loaded.world, show.loaded.characters, v.camera}, *v.time.beside->world,
                               overlay);
        fills = overlay.fills;
        return !fills.empty();
    };
    std::vector<GizmoCorner> fills;
    EXPECT_FALSE(differs(fills)) << "the same people at the same places";
    Vec3& at = show.loaded.world->crowd.motion.position[0];
    const Vec3 was = at;
    at = show.loaded.world->crowd.motion.position[1];
    EXPECT_TRUE(differs(fills));
    auto colours_near = [&](Vec3 place, uint32_t rgb) {
        return std::any_of(fills.begin(), fills.end(), [&](const GizmoCorner& corner) {
            return glm::length(corner.place - glm::vec3(place.x, place.y, place.z)) < 1 &&
                   (corner.colour & 0xffffffu) == (ink(rgb) & 0xffffffu) && corner.colour >> 24 != 0;
        });
    };
    EXPECT_TRUE(colours_near(at, k_more_people));
    EXPECT_TRUE(colours_near(was, k_fewer_people));
    EXPECT_FALSE(colours_near(was, k_more_people));
}

}  // namespace
}  // namespace flaneur
