#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/light/daylight.h"
#include "renderer/light/shadow_slices.h"

namespace flaneur {
namespace {

glm::vec3 project(const View& view, glm::vec3 point) {
    const glm::vec4 clip = view.clip_from_world * glm::vec4(point, 1);
    return glm::vec3(clip) / clip.w;
}

TEST(View, TargetIsInTheMiddleAndDepthIsReversed) {
    const Camera camera{.eye = {1, 2, 3}, .target = {4, 3, 9}, .vertical_fov = 0.8f, .near_plane = 0.25f};
    const View view = make_view(camera, 640, 360);
    const glm::vec3 at_target = project(view, camera.target);
    EXPECT_NEAR(at_target.x, 0, 1e-5f);
    EXPECT_NEAR(at_target.y, 0, 1e-5f);
    EXPECT_NEAR(project(view, view.eye + view.forward * 0.25f).z, 1, 1e-4f);
    EXPECT_NEAR(project(view, view.eye + view.forward * 1000.0f).z, 0.00025f, 1e-6f);
}

TEST(View, UpIsUpAndRightIsRight) {
    const View view = make_view({.eye = {0, 1, 0}, .target = {0, 1, 1}}, 640, 360);
    EXPECT_LT(project(view, {0, 2, 5}).y, 0);   // Vulkan's y runs down
    EXPECT_GT(project(view, {-1, 1, 5}).x, 0);  // facing +z, -x is to the right
    const glm::vec3 corner = view.eye + (view.forward + view.right + view.down) * 7.0f;
    EXPECT_NEAR(project(view, corner).x, 1, 1e-4f);
    EXPECT_NEAR(project(view, corner).y, 1, 1e-4f);
}

TEST(View, PlanesAgreeWithTheMatrix) {
    const View view = make_view({.eye = {3, 5, -2}, .target = {-4, 0, 9}, .near_plane = 0.5f}, 800, 600);
    int inside = 0;
    for (int i = 0; i < 4000; ++i) {
        const float t = static_cast<float>(i);
        const glm::vec3 point =
            view.eye + glm::vec3(std::sin(t * 1.3f), std::sin(t * 2.7f), std::cos(t * 0.9f)) * 30.0f;
        const glm::vec4 clip = view.clip_from_world * glm::vec4(point, 1);
        const bool is_in = clip.w > 0.5f && std::fabs(clip.x) < clip.w && std::fabs(clip.y) < clip.w;
        EXPECT_EQ(sees_sphere(view, point, 0), is_in) << i;
        EXPECT_EQ(sees_box(view, point, point), is_in) << i;
        inside += is_in;
    }
    EXPECT_GT(inside, 50);
    EXPECT_LT(inside, 3000);
}

TEST(View, OddCamerasStillMakeFiniteMatrices) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    const Camera cameras[] = {
        {.eye = {0, 0, 0}, .target = {0, 0, 0}},   {.eye = {0, 9, 0}, .target = {0, 0, 0}},
        {.eye = {nan, 0, 0}, .target = {0, 0, 1}}, {.eye = {0, 0, 0}, .target = {inf, 0, 1}},
        {.vertical_fov = 0, .near_plane = 0},      {.vertical_fov = nan, .near_plane = -inf}};
    for (const Camera& camera : cameras)
        for (uint32_t width : {1u, 8192u}) {
            const View view = make_view(camera, width, 1);
            for (int c = 0; c < 4; ++c)
                for (int r = 0; r < 4; ++r) EXPECT_TRUE(std::isfinite(view.clip_from_world[c][r]));
        }
}

TEST(Sun, IsAUnitVector) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (glm::vec3 direction :
         {glm::vec3(0), glm::vec3(0, -1, 0), glm::vec3(3, -1, 4), glm::vec3(nan), glm::vec3(0, 5, 0)}) {
        const glm::vec3 to_sun = sun_direction({direction});
        EXPECT_NEAR(glm::length(to_sun), 1, 1e-5f);
        const glm::vec3 raised = above_horizon(to_sun, 0.1f);
        EXPECT_NEAR(glm::length(raised), 1, 1e-5f);
        EXPECT_GE(raised.y, 0.0998f);
        EXPECT_NEAR(raised.x * to_sun.z, raised.z * to_sun.x, 1e-5f) << "turned to the side";
    }
}

TEST(Shadow, BoxHoldsTheSlice) {
    const glm::vec3 to_sun = sun_direction({});
    for (float turn = 0; turn < 6.3f; turn += 0.37f) {
        const View view = make_view(
            {.eye = {10, 1.6f, -7}, .target = {10 + std::sin(turn), 1.5f, -7 + std::cos(turn)}}, 1280, 720);
        const Slice slice{0, 60};
        const ShadowBox box = fit_shadow(view, to_sun, slice, 2048);
        for (float x : {-1.0f, 1.0f})
            for (float y : {-1.0f, 1.0f})
                for (float distance : {slice.near, slice.far}) {
                    const glm::vec3 corner =
                        view.eye + (view.forward + view.right * x + view.down * y) * distance;
                    const glm::vec3 at(box.map_from_world * glm::vec4(corner, 1));
                    for (int c = 0; c < 3; ++c) {
                        EXPECT_GE(at[c], 0);
                        EXPECT_LE(at[c], 1);
                    }
                }
        EXPECT_LT(box.texel, 0.06f);
    }
}

TEST(Shadow, BoxRestsWhileTheCameraMovesALittleAndMovesByWholeTexels) {
    const glm::vec3 to_sun = sun_direction({});
    auto box_at = [&](float x) {
        return fit_shadow(make_view({.eye = {x, 1.6f, 0}, .target = {x, 1.6f, 9}}, 1280, 720), to_sun,
                          {0, 60}, 2048);
    };
    int moves = 0;
    ShadowBox last = box_at(0);
    for (float x = 0; x < 20; x += 0.05f) {
        const ShadowBox box = box_at(x);
        moves += box != last;
        for (int c = 0; c < 2; ++c) {
            const float texels = (box.map_from_world[3][c] - last.map_from_world[3][c]) * 2048;
            EXPECT_NEAR(texels, std::round(texels), 0.01f);
        }
        last = box;
    }
    EXPECT_GE(moves, 1);
    EXPECT_LE(moves, 12);
}

// Whether a box holds the corners of what a slice may show.
bool holds(const ShadowBox& box, const View& view, Slice slice) {
    for (float x : {-1.0f, 1.0f})
        for (float y : {-1.0f, 1.0f})
            for (float distance : {slice.near, slice.far}) {
                const glm::vec3 place = view.eye + (view.forward + view.right * x + view.down * y) * distance;
                const glm::vec3 at(box.map_from_world * glm::vec4(place, 1));
                if (glm::any(glm::lessThan(at, glm::vec3(0))) || glm::any(glm::greaterThan(at, glm::vec3(1))))
                    return false;
            }
    return true;
}

// What one frame after the other of a moving camera asks of the city's shadow maps.
struct Walk {
    glm::vec3 to_sun = sun_direction({});
    Slice near{0, 60}, far{0, 250};
    ShadowState state;
    View last{};
    std::vector<ShadowSlices> drawn;

    ShadowBox box_of(const View& view, Slice slice) const { return fit_shadow(view, to_sun, slice, 2048); }
    uint32_t step(const View& view) {
        state = next_shadows(
            state, {wanted_box(last, view, to_sun, near, 2048), wanted_box(last, view, to_sun, far, 2048)},
            drawn);
        last = view;
        uint32_t count = 0;
        for (const ShadowSlices& slices : drawn) count += slices.count;
        return count;
    }
};

TEST(Shadow, MapsAreDrawnAheadBySlicesForACameraThatMoves) {
    for (const float speed :
         {1.4f, 5.0f, 20.0f}) {  // metres a second, along a wide circle, with a step's bobbing
        Walk walk;
        uint32_t slices = 0, late = 0, most = 0;
        auto seen_box = [&](Reach reach) {
            const auto r = static_cast<size_t>(reach);
            return walk.state.maps[r][walk.state.seen[r]].box;
        };
        for (int frame = 0; frame < 3000; ++frame) {
            const float turn = speed / 60 / 80 * static_cast<float>(frame);
            const glm::vec3 eye(80 * std::sin(turn),
                                1.6f + 0.03f * std::sin(0.2f * static_cast<float>(frame)),
                                80 * std::cos(turn));
            const View view = make_view(
                {.eye = eye, .target = eye + glm::vec3(std::cos(turn), 0.02f, -std::sin(turn))}, 1280, 720);
            const uint32_t drawn = walk.step(view);
            EXPECT_EQ(seen_box(Reach::near), walk.box_of(view, walk.near));
            EXPECT_EQ(seen_box(Reach::far), walk.box_of(view, walk.far));
            ASSERT_TRUE(holds(walk.box_of(view, walk.near), view, walk.near) &&
                        holds(walk.box_of(view, walk.far), view, walk.far));
            if (frame > 0) slices += drawn, late += drawn > 1, most = std::max(most, drawn);
        }
        EXPECT_GT(slices, 8 * k_shadow_slices) << "nothing moved at " << speed << " m/s";
        // Where two borders are crossed at once.
        EXPECT_LE(most, speed < 10 ? 8u : 12u) << "in one frame at " << speed << " m/s";
        EXPECT_LE(late, speed < 2    ? 3u
                        : speed < 10 ? 30u
                                     : 600u)
            << "frames that drew more at " << speed << " m/s";
    }
}

TEST(Shadow, BothMapsAreDrawnAtOnceWhereTheViewOrTheSunJumps) {
    const View view = make_view({}, 1280, 720);
    const View away = make_view({.eye = {200, 1.6f, 90}, .target = {0, 1.6f, 0}}, 1280, 720);
    Walk walk;
    EXPECT_EQ(walk.step(view), 2 * k_shadow_slices);
    EXPECT_EQ(walk.step(view), 0u);
    EXPECT_EQ(walk.step(away), 2 * k_shadow_slices);
    EXPECT_EQ(walk.step(view), 0u) << "the maps before are still there";
    walk.to_sun = glm::normalize(walk.to_sun + glm::vec3(0, 0.01f, 0));
    EXPECT_EQ(walk.step(view), 2 * k_shadow_slices);
}

TEST(Shadow, SlicesCoverTheMapOnce) {
    const ShadowBox box = fit_shadow(make_view({}, 1280, 720), sun_direction({}), {0, 60}, 1000);
    uint32_t row = 0;
    for (uint32_t i = 0; i < k_shadow_slices; ++i) {
        const TexelRect rows = rows_of({Reach::near, 0, box, i, 1}, 1000);
        EXPECT_EQ(rows.y, row);
        row += rows.height;
        const ShadowBox part = part_of(box, rows, 1000);
        for (const float y : {0.0f, 0.5f, 1.0f}) {
            const glm::vec4 at(
                0.3f, (static_cast<float>(rows.y) + y * static_cast<float>(rows.height)) / 1000, 0.4f, 1);
            const glm::vec4 seen = part.map_from_world * (glm::inverse(box.map_from_world) * at);
            EXPECT_NEAR(seen.y, y, 1e-3f);
            EXPECT_NEAR(seen.x, 0.3f, 1e-3f);
        }
    }
    EXPECT_EQ(row, 1000u);
}

TEST(Shadow, OnlyTilesBelowPeopleChange) {
    const ShadowBox box = fit_shadow(make_view({}, 1280, 720), sun_direction({}), {0, 60}, 2048);
    const ShadowTiles nobody = tiles_below(box, 2048, {});
    EXPECT_TRUE(changed_texels({}, nobody, 2048).empty());
    const glm::vec4 here(glm::vec3(glm::inverse(box.map_from_world) * glm::vec4(0.5f, 0.5f, 0.5f, 1)), 0.9f);
    const ShadowTiles one = tiles_below(box, 2048, std::span(&here, 1));
    const auto count = std::count(one.begin(), one.end(), 1);
    EXPECT_GE(count, 1);
    EXPECT_LE(count, 4);
    EXPECT_EQ(changed_texels(one, nobody, 2048).size(), changed_texels({}, one, 2048).size()) << "it went";
    const glm::vec4 everywhere(glm::vec3(here), 1000);
    uint32_t texels = 0;
    for (const TexelRect& rect : changed_texels({}, tiles_below(box, 2048, std::span(&everywhere, 1)), 2048))
        texels += rect.width * rect.height;
    EXPECT_EQ(texels, 2048u * 2048);
}

TEST(Shadow, LightTravelsIntoDepth) {
    const glm::vec3 to_sun = sun_direction({});
    const ShadowBox box = fit_shadow(make_view({}, 1280, 720), to_sun, {0, 60}, 2048);
    const glm::vec4 a = box.map_from_world * glm::vec4(0, 0, 0, 1),
                    b = box.map_from_world * glm::vec4(to_sun, 1);
    EXPECT_NEAR(a.x, b.x, 1e-5f);
    EXPECT_NEAR(a.y, b.y, 1e-5f);
    EXPECT_LT(b.z, a.z);
}

TEST(Sky, IsBlueOverheadAndBrightNearTheSun) {
    const glm::vec3 to_sun = sun_direction({});
    const SkyModel sky = make_sky(to_sun, 3);
    const glm::vec3 overhead = sky_luminance(sky, {0, 1, 0});
    EXPECT_GT(overhead.b, overhead.r);
    const glm::vec3 away(-to_sun.x, to_sun.y, -to_sun.z);
    EXPECT_GT(luminance(sky_luminance(sky, to_sun)), 2 * luminance(sky_luminance(sky, away)));
    EXPECT_GT(sky.sun.r, sky.sun.b);  // low sun is warm
}

TEST(Sky, LowerSunIsDimmerAndWarmer) {
    auto sun_at = [](float degrees) {
        const float angle = degrees * 0.0174533f;
        return make_sky({std::cos(angle), std::sin(angle), 0}, 3).sun;
    };
    EXPECT_GT(luminance(sun_at(60)), luminance(sun_at(10)));
    EXPECT_GT(sun_at(10).r / sun_at(10).b, sun_at(60).r / sun_at(60).b);
}

TEST(Sky, AmbientMatchesBruteForceWithinAFifth) {
    const SkyModel sky = make_sky(sun_direction({}), 3);
    const AmbientLight light = ambient_light(sky, glm::vec3(0));
    // The illuminance over pi on the ground, summed over the upper half.
    glm::vec3 sum(0);
    const int rings = 64, sectors = 128;
    for (int ring = 0; ring < rings; ++ring)
        for (int sector = 0; sector < sectors; ++sector) {
            const float y = (static_cast<float>(ring) + 0.5f) / rings, across = std::sqrt(1 - y * y);
            const float turn = (static_cast<float>(sector) + 0.5f) / sectors * 6.2831853f;
            sum += sky_luminance(sky, {across * std::cos(turn), y, across * std::sin(turn)}) * y *
                   (2.0f / (rings * sectors));
        }
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(
            (light.level + glm::vec3(light.slope[0].y, light.slope[1].y, light.slope[2].y))[c] / sum[c], 1,
            0.2f);
}

}  // namespace
}  // namespace flaneur
