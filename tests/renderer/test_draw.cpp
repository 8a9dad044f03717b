#include <algorithm>
#include <cmath>

#include "renderer/shapes.h"
#include "tests/renderer/synthetic_scene.h"
#include "tests/renderer/test_renderer.h"

namespace flaneur {
namespace {

RendererPtr renderer_with(const SyntheticScene& scene) {
    Result<RendererPtr> renderer = make_renderer(validated());
    if (!renderer) throw std::runtime_error(renderer.error().message);
    if (Result<void> done = upload_scene(**renderer, scene.meshes); !done)
        throw std::runtime_error(done.error().message);
    return std::move(*renderer);
}

Image draw(Renderer& renderer, const FrameInput& frame, uint32_t width = 320, uint32_t height = 180) {
    Result<Image> image = draw_image(renderer, frame, width, height);
    if (!image) throw std::runtime_error(image.error().message);
    return std::move(*image);
}

float luma(const Image& image, uint32_t x, uint32_t y) {
    const uint8_t* p = &image.rgba[4 * (size_t{y} * image.width + x)];
    return 0.299f * p[0] + 0.587f * p[1] + 0.114f * p[2];
}

// The mean of a square of pixels.
float luma_about(const Image& image, uint32_t x, uint32_t y, uint32_t reach) {
    float sum = 0;
    for (uint32_t j = y - reach; j <= y + reach; ++j)
        for (uint32_t i = x - reach; i <= x + reach; ++i) sum += luma(image, i, j);
    return sum / static_cast<float>((2 * reach + 1) * (2 * reach + 1));
}

// A wide plaza seen from above, with the sun at the left (+x).
SyntheticScene plaza() {
    SyntheticScene scene = synthetic_scene(0);
    CityMesh& city = scene.meshes.city;
    city = {};
    for (glm::vec2 at : {glm::vec2(-50, 50), {50, 50}, {50, -50}, {-50, -50}}) {
        CityVertex vertex{};
        vertex.position = {at.x, 0, at.y};
        vertex.colour = 0xff959ea3u;
        vertex.uv = at;
        vertex.normal[1] = 127;
        vertex.material = static_cast<uint16_t>(k_material_plaza);
        city.vertices.push_back(vertex);
    }
    city.indices = {0, 1, 2, 0, 2, 3};
    return scene;
}
const Camera k_above{.eye = {0, 10, -0.01f}, .target = {0, 0, 0}, .vertical_fov = 0.6f, .near_plane = 0.1f};
const Sun k_side_sun{{0.9f, 0.42f, 0}};

TEST(Draw, TwoRenderersGiveTheSameBytes) {
    const SyntheticScene scene = synthetic_scene(200);
    const RendererPtr a = renderer_with(scene), b = renderer_with(scene);
    const FrameInput street = scene.frame(street_camera()), overview = scene.frame(overview_camera());
    const Image first = draw(*a, street);
    EXPECT_EQ(first.rgba, draw(*a, street).rgba);
    draw(*b, overview);  // other history, same picture
    EXPECT_EQ(first.rgba, draw(*b, street).rgba);
    EXPECT_GT(frame_stats(*a).walkers_drawn, 20u);
    EXPECT_LE(frame_stats(*a).sub_draws, 300u);
    EXPECT_EQ(validation_messages(*a), 0u);
}

// A sheet 2 m above the plaza whose right half is there and whose left half its texture cuts away.
void add_sheet(CityMesh& city) {
    const auto first = static_cast<uint32_t>(city.vertices.size());
    for (glm::vec2 at : {glm::vec2(-3, 1), {3, 1}, {3, -1}, {-3, -1}}) {
        CityVertex vertex{};
        vertex.position = {at.x, 2, at.y};
        vertex.colour = 0xffffffffu;
        vertex.uv = {(at.x + 3) / 6, 0.5f};
        vertex.normal[1] = 127;
        vertex.material = static_cast<uint16_t>(k_material_scenery);
        vertex.extra = 1;
        city.vertices.push_back(vertex);
    }
    for (uint32_t i : {0, 1, 2, 0, 2, 3}) city.indices.push_back(first + i);
    city.textures.push_back({2, 1, {20, 20, 20, 255, 255, 255, 255, 0}});
}

TEST(Draw, SceneryShowsItsTextureAndThrowsItsShadow) {
    const SyntheticScene bare = plaza();
    SyntheticScene covered = plaza();
    add_sheet(covered.meshes.city);
    const RendererPtr a = renderer_with(bare), b = renderer_with(covered);
    const Image without = draw(*a, bare.frame(k_above, k_side_sun));
    const Image with = draw(*b, covered.frame(k_above, k_side_sun));
    auto differs = [&](uint32_t x) { return luma_about(without, x, 90, 2) - luma_about(with, x, 90, 2); };
    EXPECT_GT(differs(215), 30) << "the sheet";
    EXPECT_NEAR(differs(105), 0, 1) << "what is cut away";
    EXPECT_GT(differs(305), 15) << "its shadow";
    EXPECT_NEAR(differs(274), 0, 2) << "no shadow of what is cut away";
    EXPECT_EQ(frame_stats(*a).sub_draws + 3, frame_stats(*b).sub_draws) << "seen, and in both shadow maps";
    EXPECT_EQ(validation_messages(*b), 0u);

    covered.meshes.city.vertices.back().extra = 2;
    EXPECT_FALSE(upload_scene(*b, covered.meshes)) << "a texture that is not there";
}

TEST(Draw, EveryStageIsTimed) {
    const SyntheticScene scene = synthetic_scene(50);
    const RendererPtr renderer = renderer_with(scene);
    bool is_counted = false;
    auto names = [&] {
        std::vector<std::string> out;
        for (const auto& stage : frame_stats(*renderer).stages) {
            EXPECT_GT(stage.gpu_ms, 0);
            EXPECT_LT(stage.gpu_ms, 60'000);
            EXPECT_EQ(stage.fragments > 0,
                      is_counted && stage.name != "surfaces to host" && stage.name != "light");
            out.push_back(stage.name);
        }
        return out;
    };
    FrameInput frame = scene.frame(street_camera());
    draw(*renderer, frame);
    EXPECT_EQ(names(), (std::vector<std::string>{"city shadows", "crowd shadows", "scene", "surfaces to host",
                                                 "light"}));
    const Image image = draw(*renderer, frame);  // the city's shadows are kept
    EXPECT_EQ(names(), (std::vector<std::string>{"crowd shadows", "scene", "surfaces to host", "light"}));
    frame.times_passes = is_counted = true;
    EXPECT_EQ(draw(*renderer, frame).rgba, image.rgba);
    EXPECT_EQ(names(), (std::vector<std::string>{"crowd shadows", "crowd", "city", "sky", "surfaces to host",
                                                 "light"}));
    EXPECT_EQ(validation_messages(*renderer), 0u);
}

TEST(Draw, SunlitPavementIsMidGrey) {
    const SyntheticScene scene = plaza();
    const RendererPtr renderer = renderer_with(scene);
    const Image image = draw(*renderer, scene.frame(k_above));
    EXPECT_NEAR(luma_about(image, 160, 90, 40), 135, 25);
    for (size_t i = 3; i < image.rgba.size(); i += 4) ASSERT_EQ(image.rgba[i], 255);
}

TEST(Draw, WalkerStandsWhereItIsAndThrowsAShadowAwayFromTheSun) {
    SyntheticScene scene = plaza();
    const RendererPtr renderer = renderer_with(scene);
    const Image empty = draw(*renderer, scene.frame(k_above, k_side_sun));
    add_walker(scene, {0, 0, 0}, 0, 0, 3);
    const Image image = draw(*renderer, scene.frame(k_above, k_side_sun));
    EXPECT_EQ(frame_stats(*renderer).walkers_drawn, 1u);
    EXPECT_EQ(frame_stats(*renderer).walkers_in_shadow, 1u);
    auto change = [&](uint32_t x, uint32_t y) {
        return std::fabs(luma_about(image, x, y, 2) - luma_about(empty, x, y, 2));
    };
    // Looking straight down with +z up the page, +x is to the left.
    const float pixels = 90 / (10 * std::tan(0.3f));  // a metre on the ground
    auto across = [&](float metres) { return static_cast<uint32_t>(160 - metres * pixels); };
    EXPECT_GT(change(160, 90), 10);
    EXPECT_GT(luma_about(empty, across(-2), 90, 2) - luma_about(image, across(-2), 90, 2), 10);
    EXPECT_LT(change(across(2), 90), 4);
    EXPECT_LT(change(160, 30), 4);
}

TEST(Draw, ShadowsOfPeopleFadeBeforeTheyEnd) {
    SyntheticScene scene = plaza();
    scene.meshes.city = {};
    add_ground(scene.meshes.city, {-200, -200}, {200, 200}, 0, k_material_plaza, 0xff959ea3u);
    const RendererPtr renderer = renderer_with(scene);
    // From 40 m above the ground they reach 180 m. How dark one is, whose owner is so far away:
    auto darkness = [&](float distance) {
        const glm::vec3 eye(0, 40, -100), place(0, 0, std::sqrt(distance * distance - 1600) - 100);
        const Camera camera{.eye = eye,
                            .target = place - glm::vec3(2, 0, 0),
                            .vertical_fov = 2 / distance,
                            .near_plane = 0.1f};
        scene.walkers.clear();
        scene.palette.clear();
        const Image without = draw(*renderer, scene.frame(camera, k_side_sun));
        add_walker(scene, place, 0, 0, 3);
        const Image with = draw(*renderer, scene.frame(camera, k_side_sun));
        float sum = 0;  // right of the body, which stands 2 m left of the middle
        for (uint32_t y = 60; y < 120; ++y)
            for (uint32_t x = 120; x < 240; ++x)
                sum += std::max(luma(without, x, y) - luma(with, x, y), 0.0f);
        return sum * distance;  // the ground is seen the flatter
    };
    const float whole = (darkness(120) + darkness(130)) / 2;
    EXPECT_GT(whole, 1e6f);
    EXPECT_NEAR(darkness(140) / whole, 1, 0.15f);
    EXPECT_NEAR(darkness(163) / whole, 0.5f, 0.15f);
    EXPECT_LT(darkness(178) / whole, 0.15f);
    EXPECT_EQ(validation_messages(*renderer), 0u);
}

TEST(Draw, HousesOfOneColourHaveTasteOfTheirOwn) {
    const Camera camera{.eye = {0, 5, -14}, .target = {0, 5, 0}, .vertical_fov = 0.9f, .near_plane = 0.1f};
    const Sun down{{0.9f, -0.3f, 0}};
    const RendererPtr renderer = std::move(*make_renderer(validated()));
    std::vector<std::vector<uint8_t>> days, nights;
    for (uint32_t house : {5u, 6u, 7u, 8u, 5u}) {
        SceneMeshes scene;
        add_wall(scene.city, {14, 0, 0}, {-14, 0, 0}, 10, k_material_facade, vertex_colour(0xd8c9ae),
                 facade_extra(3.2f, false, 1), house);
        ASSERT_TRUE(upload_scene(*renderer, scene));
        FrameInput frame{camera, {{0.2f, 0.5f, -0.8f}}, {}, {}};
        days.push_back(draw(*renderer, frame).rgba);
        frame.sun = down;
        nights.push_back(draw(*renderer, frame).rgba);
    }
    for (size_t i = 1; i < 4; ++i) {
        EXPECT_NE(days[0], days[i]) << i;
        EXPECT_NE(nights[0], nights[i]) << i;
    }
    EXPECT_EQ(days[0], days[4]);
    EXPECT_EQ(nights[0], nights[4]);
}

TEST(Draw, LampsLightTheNightWhereTheirMapSays) {
    SyntheticScene scene = plaza();
    LampMap& lamps = scene.meshes.lamps;
    lamps.width = lamps.height = 16;
    lamps.low = {0, -8};  // half of what is seen, at the left
    lamps.texels.assign(256, {0, 1, 0, 0});
    const RendererPtr renderer = renderer_with(scene);
    const Sun down{{0.9f, -0.3f, 0}};
    const Image day = draw(*renderer, scene.frame(k_above));
    const Image night = draw(*renderer, scene.frame(k_above, down));
    EXPECT_GT(luma_about(night, 80, 90, 20), 1.6f * luma_about(night, 240, 90, 20));
    EXPECT_GT(luma_about(night, 240, 90, 20), 8) << "it can be read";
    EXPECT_LT(luma_about(night, 80, 90, 20), luma_about(day, 80, 90, 20));
    EXPECT_NEAR(luma_about(day, 80, 90, 20), luma_about(day, 240, 90, 20), 3) << "they are off by day";
    EXPECT_EQ(draw(*renderer, scene.frame(k_above)).rgba, day.rgba) << "the morning after";
    EXPECT_EQ(validation_messages(*renderer), 0u);

    lamps.texels.pop_back();
    EXPECT_FALSE(upload_scene(*renderer, scene.meshes));
}

TEST(Draw, CloudsThrowNoShadows) {
    SyntheticScene scene = plaza();
    const RendererPtr renderer = renderer_with(scene);
    add_walker(scene, {0, 0, 0}, 0, 0, 3);
    FrameInput frame = scene.frame(k_above, k_side_sun);
    const Image clear = draw(*renderer, frame);
    frame.is_overcast = true;
    const Image overcast = draw(*renderer, frame);
    EXPECT_EQ(frame_stats(*renderer).walkers_in_shadow, 0u);
    const uint32_t shaded = 160 + static_cast<uint32_t>(2 * 90 / (10 * std::tan(0.3f)));
    EXPECT_LT(luma_about(clear, shaded, 90, 2) + 10, luma_about(clear, shaded, 30, 2));
    EXPECT_NEAR(luma_about(overcast, shaded, 90, 2), luma_about(overcast, shaded, 30, 2), 4);
    frame.is_overcast = false;
    EXPECT_EQ(draw(*renderer, frame).rgba, clear.rgba) << "the shadows come back";
    EXPECT_EQ(validation_messages(*renderer), 0u);
}

TEST(Draw, EveryQualityShowsTheSamePicture) {
    const SyntheticScene scene = synthetic_scene(40);
    std::vector<Image> images;
    for (const char* name : {"medium", "low", "high", "ultra"}) {
        RendererOptions options = validated();
        options.quality = quality_named(name);
        const RendererPtr renderer = std::move(*make_renderer(options));
        EXPECT_EQ(quality_name(*renderer), name);
        ASSERT_TRUE(upload_scene(*renderer, scene.meshes));
        draw(*renderer, scene.frame(street_camera()), 1, 1);
        images.push_back(draw(*renderer, scene.frame(street_camera())));
        EXPECT_EQ(draw(*renderer, scene.frame(street_camera())).rgba, images.back().rgba) << name;
        double change = 0;
        for (uint32_t y = 0; y < 180; ++y)
            for (uint32_t x = 0; x < 320; ++x)
                change += std::fabs(luma(images.back(), x, y) - luma(images[0], x, y));
        EXPECT_LT(change / (320 * 180), 8) << name;
        EXPECT_TRUE(images.size() == 1 || change / (320 * 180) > 0.2) << name << " changes nothing";
        draw(*renderer, scene.frame(street_camera(), {{0.9f, -0.3f, 0}}));  // at night
        FrameInput plain = scene.frame(street_camera());
        plain.backdrop = glm::vec3{1, 0, 0};
        const Image without_sky = draw(*renderer, plain);
        uint32_t red = 0;
        for (size_t i = 0; i < without_sky.rgba.size(); i += 4)
            red += without_sky.rgba[i] == 255 && without_sky.rgba[i + 1] == 0;
        EXPECT_GT(red, 1000u) << name;
        EXPECT_LT(red, 320u * 180 / 2) << name;
        EXPECT_EQ(validation_messages(*renderer), 0u);
    }
    EXPECT_LT(luma_about(images[3], 160, 90, 80), luma_about(images[2], 160, 90, 80)) << "corners are darker";
}

TEST(Draw, WarmingUpLeavesNoTrace) {
    const SyntheticScene scene = synthetic_scene(40);
    const Sun down{{0.9f, -0.3f, 0}};
    for (const char* name : {"medium", "ultra"}) {
        Image days[2], nights[2];
        for (const bool warms_up : {false, true}) {
            RendererOptions options = validated();
            options.quality = quality_named(name);
            options.warms_up = warms_up;
            const RendererPtr renderer = std::move(*make_renderer(options));
            ASSERT_TRUE(upload_scene(*renderer, scene.meshes));
            days[warms_up] = draw(*renderer, scene.frame(street_camera()));
            nights[warms_up] = draw(*renderer, scene.frame(street_camera(), down));
            EXPECT_EQ(validation_messages(*renderer), 0u);
        }
        EXPECT_EQ(days[0].rgba, days[1].rgba) << name;
        EXPECT_EQ(nights[0].rgba, nights[1].rgba) << name;
    }
    RendererOptions options = validated();
    options.lights_on_host = false;
    const RendererPtr renderer = std::move(*make_renderer(options));
    EXPECT_TRUE(draw_image(*renderer, {}, 67, 37)) << "as large as what warms up";
}

TEST(Draw, ACameraThatMovesSeesWhatOneThatComesFromNowhereSees) {
    const SyntheticScene scene = synthetic_scene(40);
    const RendererPtr renderer = renderer_with(scene);
    uint32_t slices = 0;
    for (int i = 0; i < 480; ++i) {  // at five metres a second
        const glm::vec3 eye(0.02f * static_cast<float>(i) - 16, 1.7f, 0.08f * static_cast<float>(i) - 60);
        const FrameInput frame = scene.frame({.eye = eye, .target = eye + glm::vec3(0.3f, 0, 1)});
        const Image image = draw(*renderer, frame, 64, 36);
        EXPECT_LE(frame_stats(*renderer).shadow_slices_drawn, i == 0 ? 16u : 4u) << i;
        slices += frame_stats(*renderer).shadow_slices_drawn;
        if (i % 60 < 59) continue;
        EXPECT_EQ(draw(*renderer_with(scene), frame, 64, 36).rgba, image.rgba) << i;
    }
    EXPECT_GT(slices, 30u);
    EXPECT_EQ(validation_messages(*renderer), 0u);
}

TEST(Draw, FourBonesBendAndOneMoves) {
    // The same walker, near (level 0, four joints) and far (level 2, one joint): a picture of each, where
    // expected.
    for (float distance : {4.0f, 25.0f}) {
        SyntheticScene scene = plaza();
        add_walker(scene, {0, 0, distance - 30}, 0, 1.2f, 5);
        const RendererPtr renderer = renderer_with(scene);
        const Camera camera{
            .eye = {0, 0.9f, -30}, .target = {0, 0.9f, 0}, .vertical_fov = 0.6f, .near_plane = 0.1f};
        const Image with = draw(*renderer, scene.frame(camera), 640, 360);
        scene.walkers.clear();
        const Image without = draw(*renderer, scene.frame(camera), 640, 360);
        uint32_t low = 360, high = 0;
        for (uint32_t y = 0; y < 180; ++y)  // above the ground
            for (uint32_t x = 0; x < 640; ++x)
                if (std::fabs(luma(with, x, y) - luma(without, x, y)) > 6)
                    low = std::min(low, y), high = std::max(high, y);
        const float pixels = 180 / std::tan(0.3f) / distance;
        ASSERT_LT(low, high);
        EXPECT_NEAR(180 - static_cast<float>(low), 0.84f * pixels, 0.16f * pixels + 1.5f) << distance;
    }
}

TEST(Draw, FourCallsMakeAPicture) {
    Result<RendererPtr> renderer = make_renderer(validated());
    ASSERT_TRUE(renderer);
    SceneMeshes scene;
    add_ground(scene.city, {-20, -20}, {20, 20}, 0, k_material_plaza, vertex_colour(0xb0a48f));
    add_block(scene.city, {-3, 4}, {3, 9}, 0, 6,
              {k_material_facade, vertex_colour(0x9a3020), facade_extra(3, false)},
              {k_material_roof, vertex_colour(0x8b8983)});
    ASSERT_TRUE(upload_scene(**renderer, scene));
    FrameInput frame;
    frame.camera = {.eye = {0, 1.7f, -8}, .target = {0, 1.7f, 0}};
    Result<Image> image = draw_image(**renderer, frame, 320, 180);
    ASSERT_TRUE(image);
    const uint8_t* house = &image->rgba[4 * (100 * 320 + 160)];
    EXPECT_GT(house[0], house[2] + 30) << "red";
    EXPECT_GT(luma_about(*image, 20, 20, 5), 60) << "sky beside it";
    EXPECT_NEAR(luma_about(*image, 160, 165, 5), 110, 60) << "the plaza before it";
}

TEST(Draw, SceneWithoutAnythingIsSky) {
    const RendererPtr renderer = std::move(*make_renderer(validated()));
    const Image image = draw(*renderer, {});  // no scene at all
    EXPECT_GT(luma(image, 160, 20), 60);
    const SceneMeshes nothing;
    ASSERT_TRUE(upload_scene(*renderer, nothing));
    EXPECT_EQ(draw(*renderer, {}).rgba, image.rgba);
}

TEST(Draw, SizesFromOnePixelToFourThousand) {
    const SyntheticScene scene = synthetic_scene(30);
    const RendererPtr renderer = renderer_with(scene);
    const uint32_t sizes[][2] = {{1, 1},     {1, 7},       {7, 1}, {64, 64},
                                 {333, 111}, {4096, 2160}, {1, 1}, {320, 180}};
    for (const auto& size : sizes) {
        const Image image = draw(*renderer, scene.frame(street_camera()), size[0], size[1]);
        EXPECT_EQ(image.rgba.size(), size_t{4} * size[0] * size[1]);
    }
    for (const auto& size :
         {std::pair(0u, 1u), std::pair(1u, 0u), std::pair(8193u, 1u), std::pair(1u, ~0u)}) {
        const Result<Image> image =
            draw_image(*renderer, scene.frame(street_camera()), size.first, size.second);
        ASSERT_FALSE(image);
        EXPECT_NE(image.error().message.find("8192"), std::string::npos);
    }
}

TEST(Draw, OddInputsDoNoHarm) {
    SyntheticScene scene = synthetic_scene(20);
    const RendererPtr renderer = renderer_with(scene);
    scene.walkers[0].mesh = 99;
    scene.walkers[1].instance.palette = k_no_palette - 1;
    scene.walkers[2].centre = glm::vec3(std::nanf(""));
    draw(*renderer, scene.frame({.eye = {0, 5, 0}, .target = {0, 5, 0}}, {{0, -1, 0}}));
    draw(*renderer, scene.frame({.eye = glm::vec3(std::nanf(""))}, {glm::vec3(0)}));
    draw(*renderer, {.camera = street_camera(), .sun = {}, .walkers = scene.walkers, .palette = {}});
    EXPECT_EQ(frame_stats(*renderer).walkers_drawn, 0u);
}

TEST(Draw, BrokenMeshesAreRefusedAndTheOldSceneStays) {
    const SyntheticScene scene = synthetic_scene(20);
    const RendererPtr renderer = renderer_with(scene);
    const Image before = draw(*renderer, scene.frame(street_camera()));
    auto refused = [&](auto&& spoil) {
        SceneMeshes meshes = scene.meshes;
        spoil(meshes.people[0]);
        const Result<void> done = upload_scene(*renderer, meshes);
        return !done && done.error().message.find("Person mesh 0") == 0;
    };
    EXPECT_TRUE(refused([](PersonMesh& mesh) { mesh.lods[1][4] = 1u << 30; }));
    EXPECT_TRUE(refused([](PersonMesh& mesh) { mesh.lods[0].pop_back(); }));
    EXPECT_TRUE(refused([](PersonMesh& mesh) { mesh.vertices[7].joints[2] = k_palette_joints; }));
    EXPECT_TRUE(refused([](PersonMesh& mesh) { mesh.vertices[7].texture = 0; }));
    EXPECT_TRUE(refused([](PersonMesh& mesh) { mesh.vertices[7].normal[3] = 7; }));
    EXPECT_TRUE(refused([](PersonMesh& mesh) { mesh.strides.pop_back(); }));
    EXPECT_TRUE(refused([](PersonMesh& mesh) { mesh.textures.push_back({2, 2, {1, 2, 3}}); }));
    EXPECT_EQ(draw(*renderer, scene.frame(street_camera())).rgba, before.rgba);
}

TEST(Draw, ALevelMayStandInForCoarserOnes) {
    SyntheticScene scene = synthetic_scene(60);
    for (PersonMesh& mesh : scene.meshes.people) mesh.lods.resize(1);
    const RendererPtr renderer = renderer_with(scene);
    const Image alone = draw(*renderer, scene.frame(street_camera()));
    const uint64_t triangles = frame_stats(*renderer).triangles;
    for (PersonMesh& mesh : scene.meshes.people) mesh.lods.assign(k_max_lods, mesh.lods[0]);
    ASSERT_TRUE(upload_scene(*renderer, scene.meshes));
    EXPECT_EQ(draw(*renderer, scene.frame(street_camera())).rgba, alone.rgba);
    EXPECT_EQ(frame_stats(*renderer).triangles, triangles);
}

TEST(Draw, TexturesColourPeople) {
    SyntheticScene scene = plaza();
    add_walker(scene, {0, 0, 0}, 0, 0, 3);
    auto redness = [](const Image& image) {
        double sum = 0;
        for (size_t i = 0; i < image.rgba.size(); i += 4) sum += image.rgba[i] - image.rgba[i + 2];
        return sum;
    };
    const Camera near{.eye = {0, 1, -3}, .target = {0, 1, 0}};
    const double plain = redness(draw(*renderer_with(scene), scene.frame(near)));
    PersonMesh& mesh = scene.meshes.people[0];
    mesh.textures.push_back({3, 5, std::vector<uint8_t>(60, 0)});
    for (size_t i = 0; i < 15; ++i)
        mesh.textures[0].rgba[4 * i] = mesh.textures[0].rgba[4 * i + 3] = 255;  // red
    for (PersonVertex& vertex : mesh.vertices) vertex.texture = 0;
    for (uint32_t& tint : scene.walkers[0].instance.tints) tint = 0xffffffffu;
    EXPECT_GT(redness(draw(*renderer_with(scene), scene.frame(near))), plain + 100'000);
}

}  // namespace
}  // namespace flaneur
