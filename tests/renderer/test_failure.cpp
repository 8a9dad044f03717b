// What becomes of failures of the driver: for each call that can fail, in turn, that call fails.
#include <set>

#include "renderer/frame/state.h"
#include "tests/renderer/faults.h"
#include "tests/renderer/synthetic_scene.h"
#include "tests/renderer/test_renderer.h"

namespace flaneur {
namespace {

std::map<std::string, int> alive() {
    std::map<std::string, int> out;
    for (const auto& [kind, count] : faults().live)
        if (count != 0) out[kind] = count;
    return out;
}

TEST(Failure, ARendererThatCannotBeMadeLeavesNothingBehind) {
    const auto before = (faults(), alive());
    RendererPtr renderer;
    auto attempt = [&]() -> Result<void> {
        Result<RendererPtr> made = make_renderer(on_lavapipe());
        if (!made) return made.error();
        renderer = std::move(*made);
        return {};
    };
    const int calls = fail_everywhere(attempt, [&] { EXPECT_EQ(alive(), before); });
    EXPECT_GT(calls, 60);
    renderer.reset();
    EXPECT_EQ(alive(), before);
}

TEST(Failure, ASceneThatCannotBeUploadedLeavesTheOldOne) {
    const auto before = (faults(), alive());
    const SyntheticScene scene = synthetic_scene(12);
    {
        const RendererPtr renderer = std::move(*make_renderer(on_lavapipe()));
        ASSERT_TRUE(upload_scene(*renderer, scene.meshes));
        const FrameInput frame = scene.frame(street_camera());
        const Image image = draw_image(*renderer, frame, 64, 48).value();
        const auto held = alive();
        const int calls = fail_everywhere([&] { return upload_scene(*renderer, scene.meshes); },
                                          [&] { EXPECT_EQ(alive(), held); });
        EXPECT_GT(calls, 20);
        EXPECT_EQ(draw_image(*renderer, frame, 64, 48).value().rgba, image.rgba);
        EXPECT_EQ(alive(), held);
    }
    EXPECT_EQ(alive(), before);
}

// A window shows one city after the other.
TEST(Failure, OneSceneAfterAnotherLeavesNothingBehind) {
    const auto before = (faults(), alive());
    const SyntheticScene first = synthetic_scene(12);
    SyntheticScene second = synthetic_scene(40);
    second.meshes.people.push_back(second.meshes.people[0]);
    second.meshes.lamps = {2, 2, {-5, -5}, 5, std::vector<glm::vec4>(4, glm::vec4(0.5f, 0.5f, 0.5f, 0))};
    {
        const RendererPtr renderer = std::move(*make_renderer(validated()));
        std::vector<std::vector<uint8_t>> pictures;
        std::map<std::string, int> held;
        for (int i = 0; i < 6; ++i) {
            const SyntheticScene& scene = i % 2 == 0 ? first : second;
            ASSERT_TRUE(upload_scene(*renderer, scene.meshes));
            for (int k = 0; k < 3; ++k) {
                const Image image = draw_image(*renderer, scene.frame(street_camera()), 64, 48).value();
                if (k == 0) pictures.push_back(image.rgba);
                EXPECT_EQ(image.rgba, pictures.back());
            }
            if (i < 2) continue;
            EXPECT_EQ(pictures[static_cast<size_t>(i)], pictures[static_cast<size_t>(i) - 2]) << i;
            if (i == 2) held = alive();
            if (i % 2 == 0) {
                EXPECT_EQ(alive(), held) << i;
            }
        }
        EXPECT_NE(pictures[0], pictures[1]);
    }
    EXPECT_EQ(alive(), before);
}

TEST(Failure, WhatIsLeftBehindIsHeard) {
    int messages = 0;
    RendererOptions options;
    options.validation = true;
    options.on_message = [&](const std::string&) { ++messages; };
    for (bool is_left : {false, true}) {
        RendererPtr renderer = std::move(*make_renderer(options));
        const VkFenceCreateInfo info{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO, nullptr, 0};
        VkFence fence = {};
        if (is_left) {
            ASSERT_EQ(vkCreateFence(renderer->device.handle, &info, nullptr, &fence), VK_SUCCESS);
            --faults().live["Fence"];
        }
        renderer.reset();
        EXPECT_EQ(messages > 0, is_left);
    }
}

// Pictures of a new size with all that is made on the way: targets, buffers, the views' pipelines.
TEST(Failure, APictureThatFailsCanBeDrawnAgain) {
    const auto before = (faults(), alive());
    const SyntheticScene scene = synthetic_scene(12);
    FrameInput frame = scene.frame(street_camera());
    const GizmoLine line{.a = {-1, 1, 5}, .b = {1, 1, 5}};
    frame.lines = std::span(&line, 1);
    frame.are_ghosts = true;
    {
        for (const bool is_host : {true, false}) {
            RendererOptions options = on_lavapipe();
            options.lights_on_host = is_host;
            const RendererPtr fresh = std::move(*make_renderer(options));
            ASSERT_TRUE(upload_scene(*fresh, scene.meshes));
            const Image image = draw_image(*fresh, frame, 64, 48).value();
            const RendererPtr renderer = std::move(*make_renderer(options));
            ASSERT_TRUE(upload_scene(*renderer, scene.meshes));
            uint32_t width = 64;
            auto attempt = [&]() -> Result<void> {
                const Result<Image> drawn = draw_image(*renderer, frame, ++width, 48);
                if (drawn) return {};
                EXPECT_TRUE(draw_image(*renderer, frame, width, 48)) << "at once, and as large";
                return drawn.error();
            };
            const int calls = fail_everywhere(attempt, [] {});
            EXPECT_GT(calls, 20);
            EXPECT_EQ(draw_image(*renderer, frame, 64, 48).value().rgba, image.rgba);
        }
    }
    EXPECT_EQ(alive(), before);
}

// Devices that offer less than lavapipe draw what it draws.
TEST(Failure, APoorDeviceDrawsTheSamePicture) {
    SyntheticScene scene = synthetic_scene(60);
    scene.meshes.people.push_back(scene.meshes.people[0]);  // impostors are baked by several draws
    const Poverty all[] = {{.has_own_memory = true}, {.has_own_memory = true, .shared = 100'000},
                           {.timestamp_bits = 36},   {.timestamp_bits = 0},
                           {.draws_no_rows = true},  {.lacks_options = true}};
    for (const bool is_host : {false, true}) {
        RendererOptions options = validated();
        options.lights_on_host = is_host;
        options.skins_on_host = is_host;
        Image rich;
        for (const Poverty& offered : all) {
            auto draw = [&]() -> Image {
                Result<RendererPtr> renderer = make_renderer(options);
                EXPECT_TRUE(renderer) << renderer.error().message;
                EXPECT_TRUE(upload_scene(**renderer, scene.meshes));
                Image image = draw_image(**renderer, scene.frame(street_camera()), 200, 120).value();
                for (const FrameStats::Stage& stage : frame_stats(**renderer).stages) {
                    EXPECT_GE(stage.gpu_ms, 0);
                    EXPECT_LT(stage.gpu_ms, 60'000);
                }
                return image;
            };
            if (rich.rgba.empty()) rich = draw();
            poverty() = offered;
            const Image image = draw();
            size_t differing = 0;
            for (size_t i = 0; i < image.rgba.size(); ++i) differing += image.rgba[i] != rich.rgba[i];
            // Without depth clamping, what reaches out of a shadow map throws a shadow that is a little off.
            EXPECT_LE(differing, offered.lacks_options ? image.rgba.size() / 100 : 0);
            poverty() = {};
        }
    }
}

// Off-screen, with all that a picture and its channels take, in every quality.
TEST(Names, AreOfAllThatIsOnTheDevice) {
    faults();
    const SyntheticScene scene = synthetic_scene(12);
    for (const Quality quality : {Quality::medium, Quality::ultra})
        for (const bool on_host : {false, true}) {
            RendererOptions options = on_lavapipe();
            options.quality = quality;
            options.lights_on_host = options.skins_on_host = on_host;
            const RendererPtr renderer = std::move(*make_renderer(options));
            ASSERT_TRUE(upload_scene(*renderer, scene.meshes));
            FrameInput frame = scene.frame(street_camera());
            frame.wants_depths = frame.wants_ids = true;
            ASSERT_TRUE(draw_image(*renderer, frame, 64, 48));
            size_t made = 0;
            for (const auto& [kind, count] : alive()) made += static_cast<size_t>(count);
            EXPECT_EQ(faults().names.size(), made - 1) << "all but the instance";
            std::set<std::string> names;
            for (const auto& [handle, name] : faults().names) names.insert(name);
            for (const char* name : {"palette", "memory of palette", "shadow maps", "depth", "crowd",
                                     "stage times", "city vertices"})
                EXPECT_TRUE(names.contains(name)) << name;
            EXPECT_FALSE(names.contains("buffer"));
            EXPECT_FALSE(names.contains("image"));
        }
}

}  // namespace
}  // namespace flaneur
