#include <cmath>
#include <tuple>

#include "renderer/shapes.h"
#include "tests/renderer/test_renderer.h"

namespace flaneur {
namespace {

class DepthsTest : public ByLightAndQuality {};

// One looks along the ground: whatever the pixel, its depth is where its way meets the ground.
TEST_P(DepthsTest, AreMetresAheadAndCoverWhatIsNoSky) {
    SceneMeshes meshes;
    add_ground(meshes.city, {-4000, -4000}, {4000, 4000}, 0, k_material_plaza, vertex_colour(0xb0a48f));
    ASSERT_TRUE(upload_scene(*renderer, meshes));
    constexpr uint32_t k_width = 60, k_height = 40;
    FrameInput frame;
    frame.camera = {.eye = {0, 2, 0}, .target = {0, 2, 1}};
    const Image plain = draw_image(*renderer, frame, k_width, k_height).value();
    EXPECT_TRUE(plain.depths.empty());
    frame.wants_depths = true;
    const Image image = draw_image(*renderer, frame, k_width, k_height).value();
    ASSERT_EQ(image.depths.size(), size_t{k_width} * k_height);
    const float reach = std::tan(frame.camera.vertical_fov / 2);
    for (uint32_t y = 0; y < k_height; ++y)
        for (uint32_t x = 0; x < k_width; ++x) {
            const size_t at = size_t{y} * k_width + x;
            const float depth = image.depths[at];
            const int cover = image.rgba[4 * at + 3];
            for (size_t c = 0; c < 3; ++c) EXPECT_EQ(image.rgba[4 * at + c], plain.rgba[4 * at + c]);
            EXPECT_EQ(plain.rgba[4 * at + 3], 255);
            // The lower half of the picture, from its edge to its middle.
            const float low = 2 * (static_cast<float>(y) + 1) / k_height - 1, high = low - 2.0f / k_height;
            if (y < k_height / 2) {
                EXPECT_TRUE(std::isinf(depth)) << x << " " << y;
                EXPECT_EQ(cover, 0);
            } else if (y > k_height / 2) {
                EXPECT_GE(depth, 2 / (reach * low) * 0.999f) << x << " " << y;
                EXPECT_LE(depth, 2 / (reach * high) * 1.001f) << x << " " << y;
                EXPECT_EQ(cover, 255);
            }
        }
}

INSTANTIATE_TEST_SUITE_P(Light, DepthsTest,
                         testing::Combine(testing::Bool(), testing::Values(Quality::medium, Quality::high)),
                         [](const auto& how) {
                             return std::string(std::get<0>(how.param) ? "Host" : "Device") +
                                    (std::get<1>(how.param) == Quality::high ? "High" : "Medium");
                         });

}  // namespace
}  // namespace flaneur
