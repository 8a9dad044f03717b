// Light: the same colours whoever lights, on every instruction set and by any number of threads.
#include <algorithm>
#include <cstdlib>
#include <set>
#include <string>
#include <utility>

#include "renderer/light/look.h"
#include "renderer/light/shadow_box.h"
#include "renderer/light/sweep.h"
#include "sim/base/isa.h"
#include "sim/base/rng.h"
#include "tests/renderer/synthetic_scene.h"
#include "tests/renderer/test_renderer.h"

namespace flaneur {
namespace {

struct Both {
    RendererPtr device, host;
};

Both make_both(const SyntheticScene& scene, Quality quality) {
    Both both;
    for (const bool is_host : {false, true}) {
        RendererOptions options = validated();
        options.quality = quality;
        options.lights_on_host = is_host;
        RendererPtr renderer = std::move(*make_renderer(options));
        EXPECT_TRUE(upload_scene(*renderer, scene.meshes));
        (is_host ? both.host : both.device) = std::move(renderer);
    }
    return both;
}

int largest_difference(const Image& a, const Image& b) {
    EXPECT_EQ(a.rgba.size(), b.rgba.size());
    int largest = 0;
    for (size_t i = 0; i < a.rgba.size(); ++i) largest = std::max(largest, std::abs(a.rgba[i] - b.rgba[i]));
    return largest;
}

int difference(const Both& both, const FrameInput& frame, uint32_t width = 320, uint32_t height = 180) {
    return largest_difference(*draw_image(*both.device, frame, width, height),
                              *draw_image(*both.host, frame, width, height));
}

TEST(Light, HostAndDeviceLightToTheSameColours) {
    const SyntheticScene scene = synthetic_scene(60);
    for (const Quality quality : {Quality::low, Quality::medium, Quality::high, Quality::ultra}) {
        const Both both = make_both(scene, quality);
        for (const glm::vec3 to_sun :
             {glm::vec3(0.4f, 0.42f, 0.8f), glm::vec3(-0.2f, 0.9f, -0.3f), glm::vec3(0.9f, 0.02f, 0.2f),
              glm::vec3(0.9f, -0.05f, 0.2f), glm::vec3(0.9f, -0.5f, 0)})
            for (const bool is_overcast : {false, true}) {
                FrameInput frame = scene.frame(street_camera(), {to_sun});
                frame.is_overcast = is_overcast;
                EXPECT_LE(difference(both, frame), 1) << to_sun.y << (is_overcast ? " overcast" : "");
            }
        FrameInput frame = scene.frame(street_camera());
        frame.backdrop = glm::vec3{1, 0, 0};
        EXPECT_LE(difference(both, frame), 1) << "plain";
        frame.backdrop.reset();
        const GizmoLine line{.a = {-2, 1, 5}, .b = {2, 1.3f, 5}, .colour = 0x80ff00ffu};
        frame.lines = std::span(&line, 1);
        EXPECT_LE(difference(both, frame), 1) << "a line over it";
        frame.are_ghosts = true;
        frame.surfaces = Surfaces::normals;
        EXPECT_LE(difference(both, frame), 1) << "painted";
        EXPECT_EQ(validation_messages(*both.device) + validation_messages(*both.host), 0u);
    }
}

TEST(Light, HostLightsPicturesNarrowerThanItsLanes) {
    const SyntheticScene scene = synthetic_scene(20);
    for (const Quality quality : {Quality::medium, Quality::high}) {
        const Both both = make_both(scene, quality);
        for (const auto& [width, height] : {std::pair{1u, 1u},
                                            {1u, 40u},
                                            {2u, 3u},
                                            {3u, 2u},
                                            {15u, 9u},
                                            {16u, 1u},
                                            {17u, 33u},
                                            {31u, 8u},
                                            {33u, 17u}})
            EXPECT_LE(difference(both, scene.frame(street_camera()), width, height), 1)
                << width << "x" << height;
    }
}

// A picture of surfaces drawn by lot: every kind and every number, each a few pixels wide.
struct Lot {
    static constexpr uint32_t k_width = 149, k_height = 67, k_resolution = 64;
    FrameConstants frame;
    std::vector<int32_t> colours, surfaces, overlay;
    std::vector<float> depths;
    std::vector<uint16_t> shadows;
    std::vector<vec4> lamps, sky;

    Lot(uint64_t seed, int samples, bool is_night) {
        const Daylight light =
            make_daylight({is_night ? glm::vec3(0.9f, -0.1f, 0) : glm::vec3(0.4f, 0.42f, 0.8f)}, false);
        const Look look = look_of(light, 0.3f);
        frame = look.constants;
        const View view = make_view({}, k_width, k_height);
        frame.clip_from_world = view.clip_from_world;
        frame.eye = vec4(view.eye, 0);
        frame.ray_forward = vec4(view.forward, 1 / view.pixels_at_one_metre);
        frame.ray_right = vec4(view.right, 0);
        frame.ray_down = vec4(view.down, 0);
        const ShadowBox near = fit_shadow(view, light.to_light, {0, 60}, k_resolution),
                        far = fit_shadow(view, light.to_light, {0, 250}, k_resolution);
        const float ratio = near.size / far.size;
        frame.shadow_from_world = near.map_from_world;
        frame.far_scale = vec4(ratio);
        frame.far_offset = far.map_from_world[3] - near.map_from_world[3] * ratio;
        frame.shadow_texels = {near.texel, far.texel, k_resolution, 1.0f / k_resolution};
        frame.people_shadows = {2.8f, 0.0008f, 0, 0};
        frame.sun_direction = vec4(light.to_light, 0);
        frame.lamp_map = {1, 1, 8, 8};
        frame.screen = {k_width, k_height, 1.0f / k_width, 1.0f / k_height};
        const auto along = static_cast<float>(samples);
        frame.samples = {along, 1 / along, 1 / (along * k_width), 1 / (along * k_height)};
        frame.way = {is_night, 0, 0, 1};
        sky = sky_corners(light, look, frame);

        uint32_t drawn = 0;
        auto word = [&] { return static_cast<uint32_t>(random_bits({.seed = seed}, ++drawn) >> 32); };
        const size_t width = k_width * static_cast<size_t>(samples),
                     count = width * k_height * static_cast<size_t>(samples);
        uint32_t colour = 0, normal = 0, rest = 0, over = 0;
        float depth = 0;
        for (size_t i = 0; i < count; ++i) {
            if (word() % 3 == 0) {
                colour = word(), rest = word(), depth = 1 / (1 + static_cast<float>(word() % 100000) * 0.01f);
                normal = word() % 4095 | word() % 4095 << 12 | word() % 6 << 24;
                over = word() % 2 ? 0 : 0x80402010u;
            }
            colours.push_back(static_cast<int32_t>(colour));
            surfaces.insert(surfaces.end(), {static_cast<int32_t>(normal), static_cast<int32_t>(rest)});
            depths.push_back(depth);
            overlay.push_back(static_cast<int32_t>(over));
        }
        for (size_t i = 0; i < size_t{k_resolution} * k_resolution * k_shadow_layers; ++i)
            shadows.push_back(static_cast<uint16_t>(word()));
        for (int i = 0; i < 16 * 16; ++i)
            lamps.emplace_back(static_cast<float>(word() % 100) * 0.01f,
                               static_cast<float>(word() % 100) * 0.01f, -0.3f, 0);
    }

    std::vector<uint32_t> lit(int threads, bool is_blue_first = false) const {
        const size_t width = k_width * static_cast<size_t>(frame.samples.x);
        const Unlit unlit{&frame,
                          {colours.data(), width},
                          {surfaces.data(), width},
                          {depths.data(), width},
                          {overlay.data(), width},
                          shadows.data(),
                          lamps,
                          16,
                          sky,
                          true};
        const WorkersPtr workers = make_workers(threads);
        LitPicture kept;
        std::vector<uint32_t> pixels(size_t{k_width} * k_height);
        light_picture(unlit, *workers, kept, is_blue_first, pixels.data());
        return pixels;
    }
};

TEST(Light, IsTheSameOnEveryInstructionSetAndByAnyNumberOfThreads) {
    for (const int samples : {1, 2})
        for (const bool is_night : {false, true}) {
            const Lot lot(static_cast<uint64_t>(samples * 7 + is_night), samples, is_night);
            const std::vector<uint32_t> picture = lot.lit(1);
            EXPECT_GT(std::set<uint32_t>(picture.begin(), picture.end()).size(), 1000u);
            for (const int threads : {2, 3, 8}) EXPECT_EQ(lot.lit(threads), picture) << threads << " threads";
            for (std::string_view isa : isa_names()) {
                ASSERT_TRUE(use_isa(isa));
                EXPECT_EQ(lot.lit(2), picture) << isa;
            }
            ASSERT_TRUE(use_isa("best"));
            std::vector<uint32_t> swapped = lot.lit(2, true);
            for (uint32_t& c : swapped) c = (c & 0xff00ff00u) | (c & 0xff) << 16 | (c >> 16 & 0xff);
            EXPECT_EQ(swapped, picture);
        }
}

}  // namespace
}  // namespace flaneur
