// Pictures without some of what makes them, for measurements of what that costs.
#include <algorithm>

#include "tests/renderer/synthetic_scene.h"
#include "tests/renderer/test_renderer.h"

namespace flaneur {
namespace {

class WithoutTest : public ByLightAndQuality {
  protected:
    void SetUp() override {
        ByLightAndQuality::SetUp();
        ASSERT_TRUE(upload_scene(*renderer, scene.meshes));
    }
    std::vector<uint8_t> draw(const Spared& without) {
        FrameInput frame = scene.frame(street_camera());
        frame.without = without;
        Result<Image> image = draw_image(*renderer, frame, 160, 90);
        if (!image) throw std::runtime_error(image.error().message);
        return std::move(image->rgba);
    }
    SyntheticScene scene = synthetic_scene(40);
};

double brightness(const std::vector<uint8_t>& rgba) {
    double sum = 0;
    for (const uint8_t byte : rgba) sum += byte;
    return sum;
}

TEST_P(WithoutTest, ChangesThePictureAndLeavesNothingBehind) {
    const std::vector<uint8_t> whole = draw({});
    EXPECT_NE(draw({.smoothing = true}), whole);
    EXPECT_EQ(draw({}), whole);
    EXPECT_NE(draw({.shadows = true}), whole);
    EXPECT_EQ(draw({}), whole) << "shadows come back, people's too";
    EXPECT_NE(draw({.contacts = true}), whole);
    EXPECT_EQ(draw({.lamps = true}), whole) << "by day";
    EXPECT_EQ(draw({}), whole);
}

TEST_P(WithoutTest, WithoutShadowsAllIsInTheSun) {
    const std::vector<uint8_t> whole = draw({}), sunny = draw({.shadows = true});
    EXPECT_GT(brightness(sunny), brightness(whole));
    size_t darker = 0;
    for (size_t i = 0; i < whole.size(); ++i) darker += sunny[i] + 8 < whole[i];
    EXPECT_LT(darker, whole.size() / 200);  // edges are smoothed otherwise
    for (const FrameStats::Stage& stage : frame_stats(*renderer).stages)
        EXPECT_EQ(stage.name.find("shadows"), std::string::npos) << stage.name;
}

INSTANTIATE_TEST_SUITE_P(Ways, WithoutTest,
                         testing::Combine(testing::Bool(), testing::Values(Quality::medium, Quality::high)));

}  // namespace
}  // namespace flaneur
