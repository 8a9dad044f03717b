#include <algorithm>
#include <array>

#include "renderer/frame/state.h"
#include "tests/renderer/synthetic_scene.h"
#include "tests/renderer/test_renderer.h"

namespace flaneur {
namespace {

class WorkViewsTest : public testing::Test {
  protected:
    void SetUp() override {
        Result<RendererPtr> made = make_renderer(validated());
        ASSERT_TRUE(made) << made.error().message;
        renderer = std::move(*made);
        ASSERT_TRUE(upload_scene(*renderer, scene.meshes));
    }
    Image draw(const FrameInput& frame, uint32_t width = 160, uint32_t height = 90) {
        Result<Image> image = draw_image(*renderer, frame, width, height);
        if (!image) throw std::runtime_error(image.error().message);
        return std::move(*image);
    }
    bool has_stage(const std::string& name) const {
        const auto& stages = frame_stats(*renderer).stages;
        return std::any_of(stages.begin(), stages.end(),
                           [&](const auto& stage) { return stage.name == name; });
    }
    SyntheticScene scene = synthetic_scene(40);
    RendererPtr renderer;
};

const std::array<GizmoCorner, 3> k_fill = {
    {{{-4, 0.2f, 6}, 0x800000ffu}, {{4, 0.2f, 6}, 0x8000ff00u}, {{0, 0.2f, 14}, 0x80ff0000u}}};
const std::array<GizmoLine, 3> k_lines = {
    {{.a = {-2, 1, 5}, .b = {2, 1, 5}, .colour = 0xffff00ffu},
     {.a = {0, 1, 5}, .radius_a = 0.2f, .b = {0, 1, 5}, .radius_b = 0.2f},
     {.a = {0.1f, 0.1f, 0},
      .b = {0.1f, 0.1f, 0},
      .shift_a = {4, 4},
      .shift_b = {20, 4},
      .place = GizmoPlace::on_picture}}};

TEST_F(WorkViewsTest, EachChangesThePictureAndRepeats) {
    const FrameInput plain = scene.frame(street_camera());
    const Image lit = draw(plain);
    auto check = [&](const FrameInput& frame) {
        const Image image = draw(frame);
        EXPECT_NE(image.rgba, lit.rgba);
        EXPECT_EQ(image.rgba, draw(frame).rgba);
        draw(frame, 1, 1);
        draw(frame, 33, 17);
    };
    for (Surfaces surfaces : {Surfaces::wireframe, Surfaces::normals, Surfaces::overdraw})
        for (PeopleColours colours : {PeopleColours::own, PeopleColours::levels}) {
            FrameInput frame = plain;
            frame.surfaces = surfaces;
            frame.people_colours = colours;
            check(frame);
            frame.are_ghosts = true;
            frame.lines = k_lines;
            check(frame);
        }
    FrameInput frame = plain;
    frame.people_colours = PeopleColours::levels;
    check(frame);
    frame.fills = k_fill;
    frame.are_ghosts = true;
    check(frame);
    EXPECT_EQ(draw(plain).rgba, lit.rgba) << "views leave nothing behind";
    EXPECT_EQ(validation_messages(*renderer), 0u);
}

TEST_F(WorkViewsTest, AreDrawnInEveryQuality) {
    for (Quality quality : {Quality::low, Quality::high, Quality::ultra}) {
        RendererOptions options = validated();
        options.quality = quality;
        Result<RendererPtr> made = make_renderer(options);
        ASSERT_TRUE(made) << made.error().message;
        renderer = std::move(*made);
        ASSERT_TRUE(upload_scene(*renderer, scene.meshes));
        FrameInput frame = scene.frame(street_camera());
        const Image plain = draw(frame);
        frame.fills = k_fill;
        frame.lines = k_lines;
        frame.are_ghosts = true;
        const Image image = draw(frame);
        EXPECT_NE(image.rgba, plain.rgba);
        EXPECT_EQ(image.rgba, draw(frame).rgba);
        for (Surfaces surfaces : {Surfaces::wireframe, Surfaces::normals, Surfaces::overdraw}) {
            frame.surfaces = surfaces;
            draw(frame, 33, 17);
        }
        EXPECT_EQ(validation_messages(*renderer), 0u);
    }
}

TEST_F(WorkViewsTest, OffCostNothing) {
    const FrameInput plain = scene.frame(street_camera());
    draw(plain);
    for (VkPipeline pipeline : renderer->pipelines.views) EXPECT_FALSE(pipeline);
    for (const FrameSlot& slot : renderer->slots) EXPECT_FALSE(slot.lines.handle || slot.fills.handle);
    EXPECT_FALSE(has_stage("overlay") || has_stage("paint"));
    const uint32_t direct = frame_stats(*renderer).direct_draws;
    FrameInput busy = plain;
    busy.lines = k_lines;
    draw(busy);
    EXPECT_TRUE(has_stage("overlay"));
    EXPECT_EQ(frame_stats(*renderer).direct_draws, direct + 2);
}

TEST_F(WorkViewsTest, WireframeIsRefusedWhereThereIsNone) {
    FrameInput frame = scene.frame(street_camera());
    frame.surfaces = Surfaces::wireframe;
    renderer->device.has_wireframe = false;
    const Result<Image> image = draw_image(*renderer, frame, 16, 16);
    ASSERT_FALSE(image);
    EXPECT_NE(image.error().message.find("wireframe"), std::string::npos);
}

// How many pixels of a column are nearly white.
int white_in_column(const Image& image, uint32_t x) {
    int count = 0;
    for (uint32_t y = 0; y < image.height; ++y) {
        const uint8_t* p = &image.rgba[4 * (size_t{y} * image.width + x)];
        count += std::min({p[0], p[1], p[2]}) > 200;
    }
    return count;
}

TEST_F(WorkViewsTest, LinesKeepTheirWidthAndAreDimBehindThings) {
    ASSERT_TRUE(upload_scene(*renderer, {}));
    FrameInput frame;
    frame.camera = {.eye = {0, 0, 0}, .target = {0, 0, 1}};
    frame.surfaces = Surfaces::normals;  // black where there is nothing
    for (float distance : {2.0f, 200.0f}) {
        const GizmoLine line{.a = {-200, 0, distance}, .b = {200, 0, distance}, .pixels = 4};
        frame.lines = std::span(&line, 1);
        EXPECT_EQ(white_in_column(draw(frame), 80), 4) << distance;
    }
    const GizmoLine rod{.a = {-200, 0, 2}, .radius_a = 0.2f, .b = {200, 0, 2}, .radius_b = 0.2f, .pixels = 4};
    frame.lines = std::span(&rod, 1);
    EXPECT_GT(white_in_column(draw(frame), 80), 8);

    SceneMeshes wall = scene.meshes;
    for (CityVertex& vertex : wall.city.vertices) vertex = {};
    const float corners[4][2] = {{3, -3}, {3, 3}, {-3, 3}, {-3, -3}};  // counter-clockwise seen from the eye
    for (size_t i = 0; i < 4; ++i) {
        wall.city.vertices[i].position = {-corners[i][0], corners[i][1], 4};
        wall.city.vertices[i].normal[2] = -127;
        wall.city.vertices[i].material = static_cast<uint16_t>(k_material_stone);
    }
    wall.city.indices = {0, 2, 1, 0, 3, 2, 0, 1, 2, 0, 2, 3};
    wall.people.clear();
    ASSERT_TRUE(upload_scene(*renderer, wall));
    const GizmoLine far{.a = {-200, 0, 8}, .b = {200, 0, 8}, .pixels = 4};
    frame.surfaces = Surfaces::normals;
    frame.lines = {};
    const Image without = draw(frame);
    frame.lines = std::span(&far, 1);
    const Image with = draw(frame);
    EXPECT_NE(with.rgba, without.rgba);
    EXPECT_EQ(white_in_column(with, 80), white_in_column(without, 80));
    GizmoLine hidden = far;
    hidden.place = GizmoPlace::in_world_hidden;
    frame.lines = std::span(&hidden, 1);
    const size_t middle = 4 * (size_t{45} * 160 + 80);
    EXPECT_EQ(draw(frame).rgba[middle], without.rgba[middle]);
    EXPECT_EQ(validation_messages(*renderer), 0u);
}

}  // namespace
}  // namespace flaneur
