// Where a walker's level of detail changes, nobody sees it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "assets/scene.h"
#include "renderer/loaded/impostors.h"
#include "renderer/renderer.h"
#include "renderer/visible/cull.h"
#include "tests/renderer/test_renderer.h"
#include "tools/extract/extract.h"
#include "tools/flaneur/load/load.h"
#include "tools/rendercheck/verdict/flip.h"

namespace flaneur {
namespace {

constexpr float k_away = 10;  // metres
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

// Walker `number` alone, so near that a sphere about it is `pixels` high, from a side of its own. It is drawn
// by the levels of somebody `larger` times as high, so that nothing changes but these.
Image look_at(People& people, size_t number, float pixels, float larger) {
    const uint32_t height = pixels < 380 ? 400 : 900, width = height * 2 / 3;
    WalkerDraw walker = people.frame.walkers[number];
    const float turn = 2.4f * static_cast<float>(number),
                tilt = 0.05f + 0.3f * static_cast<float>(number % 3) / 2;
    const glm::vec3 way(std::sin(turn) * std::cos(tilt), std::sin(tilt), std::cos(turn) * std::cos(tilt));
    FrameInput frame;
    frame.camera = {
        .eye = walker.centre + way * k_away,
        .target = walker.centre,
        .vertical_fov = 2 * std::atan(static_cast<float>(height) * walker.radius / (pixels * k_away)),
        .near_plane = 0.1f};
    walker.radius *= larger;
    frame.walkers = std::span(&walker, 1);
    frame.palette = people.frame.palette;
    frame.grounds = people.frame.grounds;
    frame.backdrop = k_backdrop;
    return *draw_image(*people.renderer, frame, width, height);
}

std::vector<uint8_t> cut_out(const Image& image, uint32_t left, uint32_t top, uint32_t right,
                             uint32_t bottom) {
    std::vector<uint8_t> out;
    for (uint32_t y = top; y <= bottom; ++y) {
        const auto row = image.rgba.begin() + 4 * (y * image.width);
        out.insert(out.end(), row + 4 * left, row + 4 * (right + 1));
    }
    return out;
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
    EXPECT_GT(bottom, top + 10);
    const int width = static_cast<int>(right + 1 - left);
    const std::vector<float> errors =
        flip(cut_out(a, left, top, right, bottom), cut_out(b, left, top, right, bottom), width);
    return std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
}

// How the pictures of walkers differ while their sizes pass a border by so many steps: mean FLIP.
struct Switch {
    double whole = 0;        // of one level and the next, over the walkers
    double step = 0;         // at the worst step, over the walkers
    double single_step = 0;  // and of one of them
};

Switch watch(People& people, float border, int steps) {
    constexpr size_t k_watched = 4;
    constexpr float k_beyond = 1.1f * k_turns;  // the way is as long on either side
    Switch seen;
    std::vector<double> means(static_cast<size_t>(steps));
    for (size_t i = 0; i < k_watched; ++i) {
        std::vector<Image> pictures;
        for (int n = 0; n <= steps; ++n)
            pictures.push_back(
                look_at(people, i, border,
                        1 + k_beyond * (1 - 2 * static_cast<float>(n) / static_cast<float>(steps))));
        for (size_t n = 0; n < means.size(); ++n) {
            const double step = flip_about_body(pictures[n], pictures[n + 1]);
            means[n] += step / k_watched;
            seen.single_step = std::max(seen.single_step, step);
        }
        seen.whole += flip_about_body(pictures.front(), pictures.back()) / k_watched;
    }
    seen.step = *std::max_element(means.begin(), means.end());
    return seen;
}

// Whoever walks takes more than thirty frames for the way on which a border is passed.
TEST(Switches, AreNotSeen) {
    constexpr double k_unseen = 0.05, k_hardly_seen = 0.08;
    People people = walking_people();
    std::vector<float> borders(std::begin(k_level_pixels), std::end(k_level_pixels));
    const auto cell = static_cast<float>(cell_grid(people.loaded.characters.size()).height);
    borders.push_back(cell);  // of impostors
    for (const float border : borders) {
        const Switch seen = watch(people, border, 20);
        const std::string name = "border_" + std::to_string(std::lround(border));
        RecordProperty(name, std::to_string(seen.step));
        RecordProperty(name + "_single", std::to_string(seen.single_step));
        RecordProperty(name + "_whole", std::to_string(seen.whole));
        EXPECT_LE(seen.step, k_unseen) << border;
        EXPECT_LE(seen.single_step, k_hardly_seen) << border;
        EXPECT_GT(seen.whole, 1.5 * seen.step) << border << ": nothing was passed, or all at once";
    }
    EXPECT_GT(watch(people, cell, 1).step, k_unseen) << "a switch all at once would be seen";
}

}  // namespace
}  // namespace flaneur
