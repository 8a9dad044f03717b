#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "renderer/shapes.h"
#include "tests/renderer/synthetic_scene.h"
#include "tests/renderer/test_renderer.h"

namespace flaneur {
namespace {

constexpr uint32_t k_width = 160, k_height = 90;

class IdsTest : public ByLightAndQuality {
  protected:
    Image draw(const FrameInput& frame) {
        Result<Image> image = draw_image(*renderer, frame, k_width, k_height);
        if (!image) throw std::runtime_error(image.error().message);
        return std::move(*image);
    }
};

// What a shape added is given an id.
void mark(CityMesh& city, size_t from, uint32_t id) {
    for (size_t i = from; i < city.vertices.size(); ++i) city.vertices[i].id = id;
}

constexpr uint32_t k_ground = 0x100001, k_wall = 0xffffff, k_sheet = 0x7fff80;

// Ground, a wall across the left half of the picture and, before its right half, an upright sheet whose upper
// half its picture cuts away.
CityMesh marked_city() {
    CityMesh city;
    add_ground(city, {-4000, -4000}, {4000, 4000}, 0, k_material_plaza, vertex_colour(0xb0a48f));
    mark(city, 0, k_ground);
    size_t before = city.vertices.size();
    add_wall(city, {20, 0, 20}, {0, 0, 20}, 4, k_material_stone, vertex_colour(0xb0a48f));
    mark(city, before, k_wall);
    before = city.vertices.size();
    add_quad(city, {{{-0.5f, 0, 10}, {-3, 0, 10}, {-3, 4, 10}, {-0.5f, 4, 10}}},
             {{{0.5f, 1}, {0.5f, 1}, {0.5f, 0}, {0.5f, 0}}}, k_material_scenery, vertex_colour(0xffffff), 1);
    mark(city, before, k_sheet);
    city.textures.push_back({1, 2, {255, 255, 255, 0, 20, 20, 20, 255}});
    return city;
}

TEST_P(IdsTest, AreOfWhatIsNearest) {
    SceneMeshes meshes;
    meshes.city = marked_city();
    ASSERT_TRUE(upload_scene(*renderer, meshes));
    FrameInput frame;
    frame.camera = {.eye = {0, 2, 0}, .target = {0, 2, 1}};
    const Image plain = draw(frame);
    EXPECT_TRUE(plain.ids.empty());
    frame.wants_ids = true;
    const Image image = draw(frame);
    EXPECT_EQ(image.rgba, plain.rgba);
    EXPECT_TRUE(image.depths.empty());
    frame.surfaces = Surfaces::normals;
    EXPECT_EQ(draw(frame).ids, image.ids);
    ASSERT_EQ(image.ids.size(), size_t{k_width} * k_height);
    const View view = make_view(frame.camera, k_width, k_height);
    auto at = [&](glm::vec3 place) {
        const glm::vec4 clip = view.clip_from_world * glm::vec4(place, 1);
        const auto x = static_cast<size_t>((clip.x / clip.w * 0.5f + 0.5f) * k_width);
        const auto y = static_cast<size_t>((clip.y / clip.w * 0.5f + 0.5f) * k_height);
        return image.ids[y * k_width + x];
    };
    EXPECT_EQ(at({4, 3, 20}), k_wall);
    EXPECT_EQ(at({4, 0.5f, 20}), k_wall);
    EXPECT_EQ(at({1.2f, 0, 15}), k_ground);
    EXPECT_EQ(at({-2, 0.5f, 10}), k_sheet);
    EXPECT_EQ(at({-2, 3.5f, 10}), 0u) << "the sky, through what is cut away";
    EXPECT_EQ(at({-2, 2.0f - 0.1f, 10}), k_sheet);
    EXPECT_EQ(at({0, 6, 20}), 0u);
    for (const uint32_t id : image.ids)
        EXPECT_TRUE(id == 0 || id == k_ground || id == k_wall || id == k_sheet) << std::hex << id;
    frame.wants_ids = false;
    frame.surfaces = Surfaces::lit;
    EXPECT_EQ(draw(frame).rgba, plain.rgba) << "ids leave nothing behind";
    EXPECT_EQ(validation_messages(*renderer), 0u);
}

// What a pixel of somebody's id shows is within the sphere that holds the body.
TEST_P(IdsTest, AgreeWithDepths) {
    SyntheticScene scene = synthetic_scene(60);
    mark(scene.meshes.city, 0, 7);
    for (size_t i = 0; i < scene.walkers.size(); ++i)
        scene.walkers[i].id = 0x800000 + static_cast<uint32_t>(i);
    ASSERT_TRUE(upload_scene(*renderer, scene.meshes));
    std::set<uint32_t> met;
    for (const Camera& camera : {street_camera(), overview_camera()}) {
        FrameInput frame = scene.frame(camera);
        frame.wants_ids = frame.wants_depths = true;
        frame.people_colours = PeopleColours::levels;
        const Image image = draw(frame);
        const View view = make_view(camera, k_width, k_height);
        std::map<uint32_t, int> pixels;
        for (uint32_t y = 0; y < k_height; ++y)
            for (uint32_t x = 0; x < k_width; ++x) {
                const size_t at = size_t{y} * k_width + x;
                const uint32_t id = image.ids[at];
                EXPECT_EQ(id == 0, std::isinf(image.depths[at]));
                ++pixels[id];
                met.insert(id);
                if (id == 0 || id == 7) continue;
                ASSERT_GE(id, 0x800000u);
                ASSERT_LT(id - 0x800000u, scene.walkers.size());
                const WalkerDraw& walker = scene.walkers[id - 0x800000u];
                const float across = 2 * (static_cast<float>(x) + 0.5f) / k_width - 1,
                            down = 2 * (static_cast<float>(y) + 0.5f) / k_height - 1;
                const glm::vec3 place =
                    view.eye + (view.forward + view.right * across + view.down * down) * image.depths[at];
                const float pixel = image.depths[at] / view.pixels_at_one_metre;
                EXPECT_LT(glm::length(place - walker.centre), walker.radius + 2 * pixel);
            }
        EXPECT_GT(pixels.size(), 5u);
        EXPECT_GT(pixels[7], 3000);
    }
    EXPECT_GT(met.size(), 12u);
    EXPECT_EQ(validation_messages(*renderer), 0u);
}

INSTANTIATE_TEST_SUITE_P(Light, IdsTest,
                         testing::Combine(testing::Bool(), testing::Values(Quality::medium, Quality::high)),
                         [](const auto& how) {
                             return std::string(std::get<0>(how.param) ? "Host" : "Device") +
                                    (std::get<1>(how.param) == Quality::high ? "High" : "Medium");
                         });

}  // namespace
}  // namespace flaneur
