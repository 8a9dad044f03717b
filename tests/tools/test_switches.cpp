// Where a walker's level of detail changes, it looks much the same on both sides.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>

#include "assets/scene.h"
#include "renderer/renderer.h"
#include "tests/debt.h"
#include "tests/renderer/test_renderer.h"
#include "tools/extract/extract.h"
#include "tools/flaneur/load/load.h"
#include "tools/flaneur/output/flip.h"

namespace flaneur {
namespace {

constexpr float k_away = 40;  // metres
const glm::vec3 k_backdrop(0.45f, 0.44f, 0.42f);

struct People {
    Loaded loaded;
    PeopleFrame frame;
    RendererPtr renderer;
};

// Some walkers on their way, all with joints, and a renderer of theirs without the city.
People walking_people() {
    Options options;
    options.scene = *load_scene("corner");
    options.scene.walkers = 24;
    People people{std::move(*load(options)), {}, std::move(*make_renderer(on_lavapipe()))};
    World& world = *people.loaded.world;
    for (int i = 0; i < 150; ++i) step(world);
    SceneMeshes scene;
    for (const Character& c : people.loaded.characters) scene.people.push_back(extract_character(c));
    EXPECT_TRUE(upload_scene(*people.renderer, scene));
    const Camera all{.eye = {0, 900, 0}, .target = {1, 0, 0}, .vertical_fov = 1, .near_plane = 1};
    extract_people(world, people.loaded.characters, people.frame, 1, {make_view(all, 100, 100)});
    return people;
}

// Walker `number` alone, so near that a sphere about it is `pixels` high, from a side of its own. The eye
// stays where it is and looks closer, for a jump would be a cut.
Image look_at(People& people, size_t number, float pixels) {
    const uint32_t height = pixels < 380 ? 400 : 900, width = height * 2 / 3;
    const WalkerDraw& walker = people.frame.walkers[number];
    const float turn = 2.4f * static_cast<float>(number),
                tilt = 0.05f + 0.3f * static_cast<float>(number % 3) / 2;
    const glm::vec3 way(std::sin(turn) * std::cos(tilt), std::sin(tilt), std::cos(turn) * std::cos(tilt));
    FrameInput frame;
    frame.camera = {
        .eye = walker.centre + way * k_away,
        .target = walker.centre,
        .vertical_fov = 2 * std::atan(static_cast<float>(height) * walker.radius / (pixels * k_away)),
        .near_plane = 0.1f};
    frame.walkers = std::span(&walker, 1);
    frame.palette = people.frame.palette;
    frame.grounds = people.frame.grounds;
    frame.backdrop = k_backdrop;
    return *draw_image(*people.renderer, frame, width, height);
}

// The mean over the box about what either shows.
double flip_about_body(const Image& a, const Image& b) {
    auto shows = [](const Image& image, size_t i) {
        int most = 0;
        for (int c = 0; c < 3; ++c)
            most = std::max(most, std::abs(image.rgba[4 * i + static_cast<size_t>(c)] -
                                           static_cast<int>(std::lround(255 * k_backdrop[c]))));
        return most > 2;
    };
    uint32_t left = a.width, right = 0, top = a.height, bottom = 0;
    for (uint32_t i = 0; i < a.width * a.height; ++i) {
        if (!shows(a, i) && !shows(b, i)) continue;
        left = std::min(left, i % a.width), right = std::max(right, i % a.width);
        top = std::min(top, i / a.width), bottom = std::max(bottom, i / a.width);
    }
    const std::vector<float> errors = flip(a.rgba, b.rgba, static_cast<int>(a.width));
    double sum = 0, count = 0;
    for (uint32_t y = top; y <= bottom; ++y)
        for (uint32_t x = left; x <= right; ++x) sum += errors[y * a.width + x], ++count;
    EXPECT_GT(count, 100);
    return sum / count;
}

TEST(Switches, LookAlikeOnBothSides) {
    struct Border {
        float pixels;
        double most;  // mean FLIP
    };
    constexpr double k_unseen = 0.05;
    People people = walking_people();
    constexpr size_t k_watched = 8;
    ASSERT_GE(people.frame.walkers.size(), k_watched);
    for (const auto& [pixels, most] :
         {Border{840, 0.04}, Border{420, 0.05}, Border{150, 0.11}, Border{70, 0.118}, Border{36, 0.15}}) {
        const auto border = pixels;  // which Clang 14 lets lambdas see
        double mean = 0;
        for (size_t i = 0; i < k_watched; ++i) {
            // Near its border a level is kept, from whichever side one comes.
            auto coming_from = [&](float side, FrameStats& stats) {
                look_at(people, i, border * side * side);
                look_at(people, i, border * side);
                Image image = look_at(people, i, border);
                stats = frame_stats(*people.renderer);
                return image;
            };
            FrameStats fine, coarse;
            const Image near = coming_from(1.035f, fine), far = coming_from(0.965f, coarse);
            EXPECT_GT(fine.triangles, coarse.triangles) << border << " " << i;
            mean += flip_about_body(near, far) / k_watched;
        }
        RecordProperty("border_" + std::to_string(std::lround(border)), std::to_string(mean));
        expect_at_most("FLIP of a switch at " + std::to_string(std::lround(border)) + " pixels", mean,
                       k_unseen, most);
    }
}

}  // namespace
}  // namespace flaneur
