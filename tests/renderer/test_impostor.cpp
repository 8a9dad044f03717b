#include <algorithm>
#include <cmath>
#include <string>

#include "renderer/loaded/impostors.h"
#include "tests/debt.h"
#include "tests/renderer/synthetic_scene.h"
#include "tests/renderer/test_renderer.h"

namespace flaneur {
namespace {

constexpr uint32_t k_width = 64, k_height = 64;
constexpr float k_pi = 3.14159265f;

SyntheticScene empty_plaza() {
    SyntheticScene scene = synthetic_scene(0);
    CityMesh& city = scene.meshes.city;
    city = {};
    for (glm::vec2 at : {glm::vec2(-90, 90), {90, 90}, {90, -90}, {-90, -90}}) {
        CityVertex vertex{};
        vertex.position = {at.x, 0, at.y};
        vertex.colour = 0xff959ea3u;
        vertex.normal[1] = 127;
        vertex.material = static_cast<uint16_t>(k_material_path);
        city.vertices.push_back(vertex);
    }
    city.indices = {0, 1, 2, 0, 2, 3};
    return scene;
}

// Looks from `tilt` radians above the horizon at a body in the origin that is to be `pixels` high.
Camera camera_at(float tilt, float pixels) {
    const float distance = 40, tan_half = 1.74f * k_height / (2 * pixels * distance);
    const glm::vec3 middle(0, 0.9f, 0);
    return {.eye = middle + distance * glm::vec3(0, std::sin(tilt), -std::cos(tilt)),
            .target = middle,
            .vertical_fov = 2 * std::atan(tan_half),
            .near_plane = 0.5f};
}

// The greatest difference of a channel.
int change(const Image& a, const Image& b, size_t pixel) {
    int most = 0;
    for (size_t i = 4 * pixel; i < 4 * pixel + 3; ++i) most = std::max(most, std::abs(a.rgba[i] - b.rgba[i]));
    return most;
}

struct Look {
    std::vector<bool> body;  // pixels that show it
    glm::dvec3 colour{0};    // mean of those, 0..255
    double pixels = 0;
};

// What a walker shows before a background that shows `empty` without it.
Look look_at(const Image& image, const Image& empty) {
    Look look;
    for (size_t i = 0; i < image.rgba.size() / 4; ++i) {
        look.body.push_back(change(image, empty, i) > 16);
        if (!look.body.back()) continue;
        for (int c = 0; c < 3; ++c) look.colour[c] += image.rgba[4 * i + static_cast<size_t>(c)];
        ++look.pixels;
    }
    look.colour /= std::max(look.pixels, 1.0);
    return look;
}

struct Difference {
    double silhouette = 0;  // pixels of one body alone, of those of both
    double size = 0;        // of the numbers of pixels, of the mesh's
    double colour = 0;      // of the mean colours, 0..255
    double picture = 0;     // mean over pixels of either body, 0..255
};

class Pair {
  public:
    explicit Pair(bool has_ground) {
        if (!has_ground) with_.meshes.city = {};
        without_ = with_;
        for (SyntheticScene* scene : {&with_, &without_})
            scene->meshes.people[0].lods.resize(3);  // the last one has gaps
        without_.meshes.people[0].strides.clear();
        for (auto [renderer, scene] : {std::pair(&mesh_, &without_), std::pair(&impostor_, &with_)}) {
            Result<RendererPtr> made = make_renderer(validated());
            if (!made) throw std::runtime_error(made.error().message);
            *renderer = std::move(*made);
            if (Result<void> done = upload_scene(**renderer, scene->meshes); !done)
                throw std::runtime_error(done.error().message);
        }
    }

    // One walker drawn as its mesh and as its impostor.
    Difference compare(float tilt, float yaw, float phase, uint32_t who, float pixels = 26) {
        const Camera camera = camera_at(tilt, pixels);
        const Sun sun{{0.4f, 0.42f, -0.8f}};
        auto draw = [&](Renderer& renderer, const FrameInput& frame) {
            Result<Image> image = draw_image(renderer, frame, k_width, k_height);
            if (!image) throw std::runtime_error(image.error().message);
            return std::move(*image);
        };
        with_.walkers.clear();
        with_.palette.clear();
        const Image empty = draw(*mesh_, with_.frame(camera, sun));
        add_walker(with_, {0, 0, 0}, yaw, phase, who);
        const FrameInput frame = with_.frame(camera, sun);
        const Image a = draw(*mesh_, frame), b = draw(*impostor_, frame);
        EXPECT_EQ(frame_stats(*mesh_).impostors, 0u);
        EXPECT_EQ(frame_stats(*impostor_).impostors, 1u);
        EXPECT_EQ(frame_stats(*impostor_).walkers_drawn, 1u);

        const Look mesh = look_at(a, empty), impostor = look_at(b, empty);
        Difference out;
        double either = 0, apart = 0, far = 0;
        for (size_t i = 0; i < mesh.body.size(); ++i) {
            if (!mesh.body[i] && !impostor.body[i]) continue;
            ++either;
            apart += mesh.body[i] != impostor.body[i];
            for (size_t c = 0; c < 3; ++c) far += std::abs(a.rgba[4 * i + c] - b.rgba[4 * i + c]) / 3.0;
        }
        out.silhouette = apart / either;
        out.size = std::fabs(impostor.pixels - mesh.pixels) / mesh.pixels;
        out.colour = glm::length(impostor.colour - mesh.colour);
        out.picture = far / either;
        return out;
    }

  private:
    SyntheticScene with_ = empty_plaza(), without_;
    RendererPtr mesh_, impostor_;
};

// From all sides and in all phases of the walk.
Difference mean_difference(Pair& pair, float tilt, float yaw_off, float phase_off) {
    Difference sum;
    constexpr int sides = 8, phases = 4;
    for (int i = 0; i < sides * phases; ++i) {
        const int side = i / phases, step = i % phases;
        const float yaw = 2 * k_pi * static_cast<float>(side) / sides + yaw_off * static_cast<float>(step);
        const float phase =
            2 * k_pi * (static_cast<float>(step) / phases + phase_off * static_cast<float>(side % 3));
        const Difference d = pair.compare(tilt, yaw, phase, static_cast<uint32_t>(i % 7));
        sum.silhouette += d.silhouette / (sides * phases), sum.size += d.size / (sides * phases);
        sum.colour += d.colour / (sides * phases), sum.picture += d.picture / (sides * phases);
    }
    return sum;
}

// Bodies are drawn 26 pixels high, some 8 wide: an outline that is a pixel off all round is a third of them.
constexpr double k_half_a_pixel = 0.16, k_pixel = 0.33;

TEST(Impostor, LooksLikeTheMesh) {
    Pair pair(false);
    for (float tilt : {0.05f, 0.4f, 0.75f, 1.05f}) {
        const Difference d = mean_difference(pair, tilt, 0.1f, 0.03f);
        const std::string seen =
            " of impostors seen from " + std::to_string(std::lround(tilt * 57.3f)) + " deg above";
        expect_at_most("outline" + seen, d.silhouette, k_half_a_pixel, k_pixel);
        EXPECT_LT(d.size, 0.1) << tilt;
        EXPECT_LT(d.colour, 8) << tilt;
        expect_at_most("colour of pixels" + seen, d.picture, 255 / 20.0, 33);
    }
}

TEST(Impostor, LooksMoreLikeTheMeshWhereItsPictureWasTaken) {
    Pair pair(false);
    for (float tilt : {0.0f, 0.3927f, 0.87266f}) {
        const Difference d = mean_difference(pair, tilt, 0, 0);
        EXPECT_LT(d.silhouette, k_half_a_pixel) << tilt;
        EXPECT_LT(d.colour, 8) << tilt;
    }
}

TEST(Impostor, StandsOnTheGroundAndThrowsTheMeshsShadow) {
    Pair pair(true);
    for (float tilt : {0.05f, 0.4f, 0.75f, 1.05f}) {
        const Difference d = mean_difference(pair, tilt, 0.1f, 0.03f);
        expect_at_most("outline of shadows from " + std::to_string(std::lround(tilt * 57.3f)) + " deg above",
                       d.silhouette, k_half_a_pixel, 0.25);
        EXPECT_LT(d.size, 0.1) << tilt;
    }
}

TEST(Impostor, AtlasStaysWithinItsBounds) {
    uint32_t last = ~0u;
    for (size_t people : {1u, 6u, 24u, 25u, 48u, 70u, 100u, 4096u}) {
        const CellGrid grid = cell_grid(people);
        EXPECT_LE(grid.height, last);
        last = grid.height;
        if (grid.height == 0) continue;
        EXPECT_GE(size_t{grid.columns} * grid.rows, people * k_person_cells);
        EXPECT_LE(grid.columns * grid.width, k_atlas_width);
        EXPECT_LE(grid.rows * grid.height, k_atlas_height);
    }
    EXPECT_GE(cell_grid(24).height, 36u);
    EXPECT_EQ(last, 0u);
}

TEST(Impostor, PeopleWhoReachTooFarStayMeshes) {
    for (float spoilt : {std::nanf(""), 50.0f}) {
        SyntheticScene scene = empty_plaza();
        scene.meshes.people[0].strides[30].translation.x = spoilt;
        Result<RendererPtr> renderer = make_renderer(validated());
        ASSERT_TRUE(renderer);
        ASSERT_TRUE(upload_scene(**renderer, scene.meshes));
        add_walker(scene, {0, 0, 0}, 0, 0, 1);
        ASSERT_TRUE(draw_image(**renderer, scene.frame(camera_at(0.3f, 10)), k_width, k_height));
        EXPECT_EQ(frame_stats(**renderer).walkers_drawn, 1u);
        EXPECT_EQ(frame_stats(**renderer).impostors, 0u);
    }
}

TEST(Impostor, OnceBakedIsTakenAsItIs) {
    SyntheticScene scene = synthetic_scene(400);
    const FrameInput frame = scene.frame(street_camera());
    auto renderer_of = [&] {
        RendererPtr renderer = std::move(*make_renderer(validated()));
        EXPECT_TRUE(upload_scene(*renderer, scene.meshes));
        return renderer;
    };
    const RendererPtr baking = renderer_of();
    const Image image = *draw_image(*baking, frame, 320, 180);
    EXPECT_GT(frame_stats(*baking).impostors, 10u);
    const uint64_t key = impostors_key(*baking, scene.meshes.people);
    scene.meshes.impostors = *baked_impostors(*baking);
    const RendererPtr taking = renderer_of();
    EXPECT_EQ(draw_image(*taking, frame, 320, 180)->rgba, image.rgba);
    EXPECT_EQ(*baked_impostors(*taking), scene.meshes.impostors);
    EXPECT_EQ(impostors_key(*taking, scene.meshes.people), key);

    std::fill(scene.meshes.impostors.begin(), scene.meshes.impostors.end(), ~0u);  // of nothing
    EXPECT_NE(draw_image(*renderer_of(), frame, 320, 180)->rgba, image.rgba) << "they are not looked at";
    scene.meshes.impostors.resize(7);
    EXPECT_EQ(draw_image(*renderer_of(), frame, 320, 180)->rgba, image.rgba) << "of another size";
    scene.meshes.people[0].vertices[0].position.x += 0.01f;
    EXPECT_NE(impostors_key(*taking, scene.meshes.people), key);
}

}  // namespace
}  // namespace flaneur
