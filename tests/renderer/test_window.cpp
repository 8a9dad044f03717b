#include <GLFW/glfw3.h>
#include <volk.h>

#include <cmath>

#include "renderer/frame/state.h"
#include "tests/renderer/faults.h"
#include "tests/renderer/synthetic_scene.h"
#include "tests/renderer/test_renderer.h"

namespace flaneur {
namespace {

// Where there is no display (or none to be had from xvfb-run), these tests are left out, aloud.
class Window : public testing::Test {
  protected:
    void SetUp() override {
        if (!glfwInit()) GTEST_SKIP() << "there is no display: run under xvfb-run to test windows";
        faults();
        glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
        window = glfwCreateWindow(320, 200, "flaneur test", nullptr, nullptr);
        ASSERT_TRUE(window);
        make(validated());
    }
    void make(const RendererOptions& options) {
        Result<RendererPtr> made = make_window_renderer(options, window);
        ASSERT_TRUE(made) << made.error().message;
        renderer = std::move(*made);
        ASSERT_TRUE(upload_scene(*renderer, scene.meshes));
    }
    void TearDown() override {
        if (renderer) {
            EXPECT_EQ(validation_messages(*renderer), 0u);
        }
        renderer.reset();
        if (window) glfwDestroyWindow(window);
        glfwTerminate();
    }
    void draw_some(int frames) {
        for (int i = 0; i < frames; ++i) {
            glfwPollEvents();
            const Result<void> drawn = draw_window(*renderer, scene.frame(street_camera()));
            ASSERT_TRUE(drawn) << drawn.error().message;
        }
    }
    SyntheticScene scene = synthetic_scene(20);
    GLFWwindow* window = nullptr;
    RendererPtr renderer;
};

TEST_F(Window, DrawsManyFrames) {
    draw_some(12);
    EXPECT_GT(frame_stats(*renderer).walkers_drawn, 0u);
    EXPECT_FALSE(frame_stats(*renderer).stages.empty());
}

TEST_F(Window, IsResized) {
    const int sizes[][2] = {{400, 300}, {64, 48}, {1, 1}, {640, 360}, {320, 200}};
    for (const auto& size : sizes) {
        draw_some(2);
        glfwSetWindowSize(window, size[0], size[1]);
        draw_some(3);
    }
}

TEST_F(Window, IsResizedAThousandTimes) {
    for (int i = 0; i < 1000; ++i) {
        glfwSetWindowSize(window, 1 + i * 37 % 190, 1 + i * 61 % 130);
        draw_some(1);
        if (HasFailure()) break;
    }
}

TEST_F(Window, LostAndOutdatedSurfacesAreMadeAnew) {
    for (const char* call : {"vkAcquireNextImageKHR", "vkQueuePresentKHR"})
        for (VkResult code : {VK_ERROR_OUT_OF_DATE_KHR, VK_ERROR_SURFACE_LOST_KHR}) {
            draw_some(1);
            fail_at(1, code, call);
            draw_some(3);
            EXPECT_EQ(faults().failed, call);
        }
}

TEST_F(Window, WhatCannotBeMendedGetsASentence) {
    draw_some(1);
    fail_at(1, VK_ERROR_DEVICE_LOST, "vkQueuePresentKHR");
    const Result<void> drawn = draw_window(*renderer, scene.frame(street_camera()));
    ASSERT_FALSE(drawn);
    EXPECT_NE(drawn.error().message.find("device was lost"), std::string::npos) << drawn.error().message;
    draw_some(2);
}

TEST_F(Window, AFrameThatFailsCanBeDrawnAgain) {
    draw_some(2);
    auto attempt = [&] {
        renderer->is_swapchain_stale = true;
        return draw_window(*renderer, scene.frame(street_camera()));
    };
    EXPECT_GT(fail_everywhere(attempt, [&] { draw_some(3); }), 15);
    draw_some(2);
}

TEST_F(Window, IsIconifiedAndRestored) {
    draw_some(2);
    glfwIconifyWindow(window);
    draw_some(3);
    glfwRestoreWindow(window);
    draw_some(2);
    glfwHideWindow(window);
    draw_some(2);
    glfwShowWindow(window);
    draw_some(2);
}

// A picture that was drawn before, of any size, with and without panels, in turns with frames; and where
// something fails, again.
TEST_F(Window, PicturesDrawnBeforeAreShown) {
    const PanelVertex corners[3] = {{{0, 0}, {0, 0}, ~0u}, {{90, 0}, {1, 0}, ~0u}, {{0, 60}, {0, 1}, ~0u}};
    const uint16_t indices[3] = {0, 1, 2};
    const PanelDraw draws[1] = {{0, 3, 0, {0, 0, 50, 50}}};
    const uint8_t letters[16] = {255, 255, 255, 255, 255, 255, 255, 0, 255, 255, 255, 128, 9, 90, 200, 255};
    for (const bool is_host : {true, false}) {
        renderer.reset();
        RendererOptions options = validated();
        options.lights_on_host = is_host;
        ASSERT_NO_FATAL_FAILURE(make(options));
        ASSERT_TRUE(upload_letters(*renderer, {2, 2, letters}));
        EXPECT_FALSE(show_image(*renderer, {2, 2, std::vector<uint8_t>(16)}, {}))
            << "nothing has been drawn yet";
        draw_some(2);
        for (const uint32_t width : {320u, 64u, 500u}) {
            Result<Image> image = draw_image(*renderer, scene.frame(street_camera()), width, 100);
            ASSERT_TRUE(image) << image.error().message;
            for (const Panels& panels : {Panels{}, Panels{corners, indices, draws}}) {
                glfwPollEvents();
                Result<void> shown = show_image(*renderer, *image, panels);
                ASSERT_TRUE(shown) << shown.error().message;
            }
            glfwSetWindowSize(window, static_cast<int>(width) / 2 + 40, 200);
            draw_some(1);
        }
        EXPECT_FALSE(show_image(*renderer, {2, 2, {}}, {})) << "no pixels";
        Result<Image> image = draw_image(*renderer, scene.frame(street_camera()), 90, 60);
        ASSERT_TRUE(image);
        auto attempt = [&] {
            renderer->is_swapchain_stale = true;
            return show_image(*renderer, *image, {corners, indices, draws});
        };
        EXPECT_GT(fail_everywhere(attempt, [&] { draw_some(2); }), 8);
        draw_some(1);
    }
}

// Sharp panels over a picture that is drawn coarser and scaled, by host and device, and through changes of
// size.
TEST_F(Window, PicturesAreScaledUnderPanels) {
    const PanelVertex corners[3] = {
        {{0, 0}, {0, 0}, ~0u}, {{90, 0}, {1, 0}, ~0u}, {{0, 60}, {0, 1}, 0x80ffffffu}};
    const uint16_t indices[3] = {0, 1, 2};
    const PanelDraw draws[2] = {{0, 3, 0, {0, 0, 50, 50}}, {0, 3, 0, {-5, -5, 1e6f, 1e6f}}};
    const uint8_t letters[16] = {255, 255, 255, 255, 255, 255, 255, 0, 255, 255, 255, 128, 9, 90, 200, 255};
    for (const bool is_host : {true, false}) {
        renderer.reset();
        RendererOptions options = validated();
        options.lights_on_host = is_host;
        ASSERT_NO_FATAL_FAILURE(make(options));
        ASSERT_TRUE(upload_letters(*renderer, {2, 2, letters}));
        auto draw = [&](float resolution) {
            FrameInput frame = scene.frame(street_camera());
            frame.panels = {corners, indices, draws};
            frame.resolution = resolution;
            glfwPollEvents();
            return draw_window(*renderer, frame);
        };
        int width = 320;
        for (const float resolution :
             {1.0f, 0.6f, 0.6f, 0.31f, 1.0f, 0.0f, -1.0f, std::nanf(""), 2.0f, 0.5f}) {
            for (int i = 0; i < 2; ++i) ASSERT_TRUE(draw(resolution)) << resolution;
            glfwSetWindowSize(window, width = width % 400 + 37, 200);
        }
        EXPECT_GT(fail_everywhere(
                      [&] {
                          renderer->is_swapchain_stale = true;
                          return draw(0.4f);
                      },
                      [&] { ASSERT_TRUE(draw(0.7f)); }),
                  10);
        EXPECT_EQ(validation_messages(*renderer), 0u);
    }
}

TEST_F(Window, IsClosedWhileFramesAreInFlight) {
    draw_some(3);
    glfwSetWindowShouldClose(window, GLFW_TRUE);
    glfwPollEvents();
    EXPECT_TRUE(glfwWindowShouldClose(window));
}

TEST_F(Window, DrawsOffScreenToo) {
    draw_some(2);
    const Result<Image> image = draw_image(*renderer, scene.frame(street_camera()), 160, 90);
    ASSERT_TRUE(image) << image.error().message;
    const RendererPtr other = std::move(*make_renderer(validated()));
    ASSERT_TRUE(upload_scene(*other, scene.meshes));
    const Result<Image> same = draw_image(*other, scene.frame(street_camera()), 160, 90);
    ASSERT_TRUE(same) << same.error().message;
    EXPECT_EQ(image->rgba, same->rgba);
    draw_some(2);
}

TEST_F(Window, TakesAnotherScene) {
    draw_some(2);
    scene = synthetic_scene(5);
    ASSERT_TRUE(upload_scene(*renderer, scene.meshes));
    draw_some(2);
}

// Presenting by another family of queues; windows that always mix; the device lighting; and all of it.
TEST_F(Window, IsDrawnIntoByPoorDevices) {
    renderer.reset();
    const Poverty all[] = {{.presents_elsewhere = true},
                           {.is_never_opaque = true},
                           {.has_own_memory = true,
                            .shared = 100'000,
                            .presents_elsewhere = true,
                            .timestamp_bits = 36,
                            .lacks_options = true,
                            .is_never_opaque = true}};
    for (const bool is_host : {false, true})
        for (const Poverty& offered : all) {
            poverty() = offered;
            RendererOptions options = on_lavapipe();
            options.lights_on_host = is_host;
            ASSERT_NO_FATAL_FAILURE(make(options));
            draw_some(4);
            renderer.reset();
            poverty() = {};
        }
}

TEST_F(Window, IsLitByTheDeviceToo) {
    renderer.reset();
    RendererOptions options = validated();
    options.lights_on_host = false;
    renderer = std::move(*make_window_renderer(options, window));
    ASSERT_TRUE(upload_scene(*renderer, scene.meshes));
    draw_some(4);
    glfwSetWindowSize(window, 400, 300);
    draw_some(4);
}

}  // namespace
}  // namespace flaneur
