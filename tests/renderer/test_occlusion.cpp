#include <cmath>

#include "renderer/visible/occlusion.h"
#include "tests/renderer/synthetic_scene.h"
#include "tests/renderer/test_renderer.h"

namespace flaneur {
namespace {

// Two walls side by side across +z, 10 m ahead of the default camera, 20 m wide together and 8 m high; seen
// from outside where `outwards` is true.
OcclusionMap walls_ahead(const View& view, bool outwards = true) {
    std::vector<Wall> walls;
    for (float x : {-10.0f, 0.0f}) {
        const glm::vec3 a(x + 10, 0, 10), b(x, 0, 10), up(0, 8, 0);
        walls.push_back(outwards ? Wall{{a, b, b + up, a + up}} : Wall{{b, a, a + up, b + up}});
    }
    const WallGroup group{{-10, 0, 10}, {10, 8, 10}, 0, 2};
    OcclusionMap map;
    draw_walls(std::span(&group, 1), walls, view, map);
    return map;
}

bool is_hidden_at(const OcclusionMap& map, const View& view, glm::vec3 centre, float half) {
    return is_hidden(map, view, centre - half, centre + half);
}

TEST(Occlusion, WallsHideWhatIsBehindThem) {
    const View view = make_view({}, 1280, 720);
    const OcclusionMap map = walls_ahead(view);
    for (float x : {-4.0f, -1.0f, 0.0f, 3.0f}) EXPECT_TRUE(is_hidden_at(map, view, {x, 1.5f, 14}, 1)) << x;
    EXPECT_TRUE(is_hidden_at(map, view, {0, 2, 60}, 2));
    EXPECT_FALSE(is_hidden_at(map, view, {0, 1.5f, 8}, 1)) << "before the wall";
    EXPECT_FALSE(is_hidden_at(map, view, {0, 1.5f, 10}, 1)) << "through the wall";
    EXPECT_FALSE(is_hidden_at(map, view, {0, 1.5f, 0}, 1)) << "about the eye";
    EXPECT_FALSE(is_hidden(map, view, {-10, 0, 10}, {10, 8, 10})) << "the wall itself";
    const View high = make_view({.eye = {0, 12, 0}, .target = {0, 12, 10}}, 1280, 720);
    const OcclusionMap below = walls_ahead(high);
    EXPECT_FALSE(is_hidden_at(below, high, {0, 10, 30}, 1)) << "above the wall";
}

TEST(Occlusion, WallsHideNothingFromInside) {
    const View view = make_view({}, 1280, 720);
    EXPECT_FALSE(is_hidden_at(walls_ahead(view, false), view, {0, 1.5f, 14}, 1));
}

TEST(Occlusion, WhatPeepsOutBesideAWallIsSeen) {
    const View view = make_view({.vertical_fov = 1.2f}, 320, 180);
    const OcclusionMap map = walls_ahead(view);
    // At twice the distance the wall's end at x = 10 hides what lies within 20 m.
    EXPECT_TRUE(is_hidden(map, view, {14, 1, 20}, {19, 2, 21}));
    EXPECT_FALSE(is_hidden(map, view, {14, 1, 20}, {20.2f, 2, 20.1f}));
}

TEST(Occlusion, ThePictureIsTheSameWithoutIt) {
    SyntheticScene scene = synthetic_scene(300);
    Result<RendererPtr> renderer = make_renderer(validated());
    ASSERT_TRUE(renderer);
    ASSERT_TRUE(upload_scene(**renderer, scene.meshes));
    uint32_t fewer = 0;
    for (float turn = 0; turn < 6.2f; turn += 0.7f) {
        const Camera camera{.eye = {60 * std::sin(turn), 1.7f, 60 * std::cos(turn)}, .target = {0, 1.7f, 0}};
        FrameInput frame = scene.frame(camera);
        ASSERT_TRUE(draw_image(**renderer, frame, 240, 135));  // and the city's shadows
        Result<Image> with = draw_image(**renderer, frame, 240, 135);
        ASSERT_TRUE(with);
        const FrameStats stats = frame_stats(**renderer);
        frame.skips_hidden = false;
        Result<Image> without = draw_image(**renderer, frame, 240, 135);
        ASSERT_TRUE(without);
        EXPECT_EQ(with->rgba, without->rgba) << turn;
        const FrameStats& all = frame_stats(**renderer);
        EXPECT_LE(stats.triangles, all.triangles);
        fewer += stats.triangles < all.triangles && stats.walkers_drawn < all.walkers_drawn;
    }
    EXPECT_GE(fewer, 2u);
}

}  // namespace
}  // namespace flaneur
