#include <gtest/gtest.h>

#include <array>

#include "renderer/panels.h"
#include "tests/renderer/synthetic_scene.h"
#include "tests/renderer/test_renderer.h"

namespace flaneur {
namespace {

constexpr uint32_t k_width = 120, k_height = 80;

// A rectangle of one colour, two triangles.
struct Sheet {
    std::array<PanelVertex, 4> vertices;
    std::array<uint16_t, 6> indices = {0, 1, 2, 0, 2, 3};
    std::vector<PanelDraw> draws;
    Panels panels() const { return {vertices, indices, draws}; }
};
Sheet sheet(glm::vec4 box, uint32_t colour, glm::vec4 clip) {
    Sheet s;
    s.vertices = {{{{box.x, box.y}, {0.5f, 0.5f}, colour},
                   {{box.z, box.y}, {0.5f, 0.5f}, colour},
                   {{box.z, box.w}, {0.5f, 0.5f}, colour},
                   {{box.x, box.w}, {0.5f, 0.5f}, colour}}};
    s.draws = {{0, 6, 0, clip}};
    return s;
}

class PanelsTest : public testing::TestWithParam<bool> {
  protected:
    void SetUp() override {
        RendererOptions options = validated();
        options.lights_on_host = GetParam();
        Result<RendererPtr> made = make_renderer(options);
        ASSERT_TRUE(made) << made.error().message;
        renderer = std::move(*made);
        ASSERT_TRUE(upload_scene(*renderer, scene.meshes));
        const std::vector<uint8_t> full(size_t{4} * 2 * 2, 255);
        ASSERT_TRUE(upload_letters(*renderer, {2, 2, full}));
    }
    Image draw(const Panels& panels) {
        FrameInput frame = scene.frame(street_camera());
        frame.panels = panels;
        Result<Image> image = draw_image(*renderer, frame, k_width, k_height);
        EXPECT_TRUE(image) << image.error().message;
        return std::move(*image);
    }
    SyntheticScene scene = synthetic_scene(10);
    RendererPtr renderer;
};

std::array<int, 3> pixel(const Image& image, uint32_t x, uint32_t y) {
    const size_t at = 4 * (size_t{y} * image.width + x);
    return {image.rgba[at], image.rgba[at + 1], image.rgba[at + 2]};
}

TEST_P(PanelsTest, LieOverThePictureWithinTheirClip) {
    const Image bare = draw({});
    const Image covered = draw(sheet({10, 20, 60, 70}, 0xff2010f0u, {0, 0, 50, 60}).panels());
    for (uint32_t y = 0; y < k_height; ++y)
        for (uint32_t x = 0; x < k_width; ++x) {
            const bool is_in = x >= 10 && x < 50 && y >= 20 && y < 60;
            const std::array<int, 3> wanted = is_in ? std::array{0xf0, 0x10, 0x20} : pixel(bare, x, y);
            ASSERT_EQ(pixel(covered, x, y), wanted) << x << " " << y;
        }
    EXPECT_EQ(draw({}).rgba, bare.rgba) << "and nothing is left of them";
}

TEST_P(PanelsTest, AreSeenThroughByTheirAlphaAndLetters) {
    const Image bare = draw({});
    const Image half = draw(sheet({0, 0, 120, 80}, 0x80ffffffu, {0, 0, 120, 80}).panels());
    for (uint32_t x = 0; x < k_width; x += 7)
        for (size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(pixel(half, x, 40)[c], (255 * 128 + pixel(bare, x, 40)[c] * 127) / 255, 1);
    const std::array<uint8_t, 4> nothing = {255, 255, 255, 0};
    ASSERT_TRUE(upload_letters(*renderer, {1, 1, nothing}));
    EXPECT_EQ(draw(sheet({0, 0, 120, 80}, 0xffffffffu, {0, 0, 120, 80}).panels()).rgba, bare.rgba);
}

TEST_P(PanelsTest, ShowPicturesBesideTheirLetters) {
    // Four texels: white letters on the left, a picture of two colours on the right.
    const std::array<uint8_t, 16> texels = {255, 255, 255, 255, 200, 40, 10,  255,
                                            255, 255, 255, 255, 20,  90, 240, 255};
    ASSERT_TRUE(upload_letters(*renderer, {2, 2, texels}));
    auto shown = [&](glm::vec2 uv, uint32_t colour) {
        Sheet s = sheet({0, 0, 120, 80}, colour, {0, 0, 120, 80});
        for (PanelVertex& v : s.vertices) v.uv = uv;
        return pixel(draw(s.panels()), 60, 40);
    };
    EXPECT_EQ(shown({0.75f, 0.25f}, ~0u), (std::array{200, 40, 10})) << "colours as they are";
    EXPECT_EQ(shown({0.75f, 0.75f}, ~0u), (std::array{20, 90, 240}));
    EXPECT_EQ(shown({0.25f, 0.25f}, 0xff0000ffu), (std::array{255, 0, 0}))
        << "letters in the vertices' colour";
}

TEST_P(PanelsTest, OddOnesDoNoHarm) {
    const Image bare = draw({});
    for (const glm::vec4 clip : {glm::vec4(50, 50, 10, 10), glm::vec4(-1e9f, -1e9f, -5, -5),
                                 glm::vec4(500, 500, 1e9f, 1e9f), glm::vec4(std::nanf(""))})
        EXPECT_EQ(draw(sheet({0, 0, 120, 80}, ~0u, clip).panels()).rgba, bare.rgba);
    Sheet broken = sheet({0, 0, 120, 80}, ~0u, {0, 0, 120, 80});
    broken.draws[0].index_count = 7;
    FrameInput frame = scene.frame(street_camera());
    frame.panels = broken.panels();
    EXPECT_FALSE(draw_image(*renderer, frame, k_width, k_height));
    EXPECT_FALSE(upload_letters(*renderer, {3, 3, {}}));
    EXPECT_EQ(draw({}).rgba, bare.rgba);
}

INSTANTIATE_TEST_SUITE_P(Light, PanelsTest, testing::Values(true, false),
                         [](const auto& light) { return light.param ? "Host" : "Device"; });

}  // namespace
}  // namespace flaneur
