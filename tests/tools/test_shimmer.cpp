// Shimmer: how far patterns of walls and of the ground are from what they would be if many samples were taken
// of each pixel, and how much of that changes while the eye moves by a centimetre at a time.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "assets/scene.h"
#include "tests/renderer/test_renderer.h"
#include "tools/flaneur/view/camera.h"
#include "tools/flaneur/view/show.h"

namespace flaneur {
namespace {

constexpr uint32_t k_width = 480, k_height = 270;
constexpr uint32_t k_fine = 8;  // samples of a pixel along each edge
constexpr int k_frames = 6;
constexpr float k_move = 0.01f;  // metres

struct Shimmer {
    double mean = 0, worst = 0;  // standard deviation, of 255; and of the worst hundredth of the pixels
    double bias = 0;             // mean distance of what is seen
    size_t pixels = 0;
};

struct Look {
    Show show;
    Camera camera;
};

Image draw(Look& look, Camera camera, uint32_t times, Surfaces surfaces = Surfaces::lit) {
    FrameInput frame = extract_frame(
        look.show, camera, {static_cast<int>(k_width * times), static_cast<int>(k_height * times)}, 1);
    frame.surfaces = surfaces;
    return draw_image(*look.show.renderer, frame, k_width * times, k_height * times).value();
}

// Pixels in the middle of a level or of an upright surface, by 1 and 2.
std::vector<uint8_t> middles(const Image& normals) {
    std::vector<uint8_t> out(size_t{k_width} * k_height);
    auto at = [&](uint32_t x, uint32_t y, size_t c) {
        return int{normals.rgba[4 * (size_t{y} * k_width + x) + c]};
    };
    for (uint32_t y = 2; y + 2 < k_height; ++y)
        for (uint32_t x = 2; x + 2 < k_width; ++x) {
            bool is_even = true;
            for (uint32_t j = y - 2; j <= y + 2; ++j)
                for (uint32_t i = x - 2; i <= x + 2; ++i)
                    for (size_t c = 0; c < 3; ++c) is_even &= std::abs(at(i, j, c) - at(x, y, c)) <= 1;
            const int up = at(x, y, 1);
            if (is_even && up >= 254) out[size_t{y} * k_width + x] = 1;
            if (is_even && up >= 126 && up <= 129) out[size_t{y} * k_width + x] = 2;
        }
    return out;
}

// What a pixel is if many samples are taken of it: their light is averaged, about the square of the number
// shown.
std::vector<float> averaged(const Image& fine) {
    std::vector<float> out(size_t{3} * k_width * k_height);
    for (uint32_t y = 0; y < k_height * k_fine; ++y)
        for (uint32_t x = 0; x < k_width * k_fine; ++x)
            for (size_t c = 0; c < 3; ++c) {
                const float shown = fine.rgba[4 * (size_t{y} * k_width * k_fine + x) + c];
                out[3 * (size_t{y / k_fine} * k_width + x / k_fine) + c] +=
                    shown * shown / static_cast<float>(k_fine * k_fine);
            }
    for (float& light : out) light = std::sqrt(light);
    return out;
}

// One of the samples of each pixel, as it would be seen if nothing were filtered.
std::vector<float> picked(const Image& fine) {
    std::vector<float> out(size_t{3} * k_width * k_height);
    for (size_t y = 0; y < k_height; ++y)
        for (size_t x = 0; x < k_width; ++x)
            for (size_t c = 0; c < 3; ++c)
                out[3 * (y * k_width + x) + c] =
                    fine.rgba[4 * ((y * k_fine + k_fine / 2) * k_width * k_fine + x * k_fine + k_fine / 2) +
                              c];
    return out;
}

struct Sums {
    explicit Sums(size_t pixels) : sum(3 * pixels), squares(3 * pixels) {}
    std::vector<float> sum, squares;  // over the frames
};
void add(Sums& sums, size_t at, float off) { sums.sum[at] += off, sums.squares[at] += off * off; }

// Of the ground and of walls.
std::array<Shimmer, 2> shimmers(const Sums& sums, const std::vector<uint8_t>& kinds) {
    std::array<std::vector<double>, 2> changes;
    std::array<Shimmer, 2> out;
    for (size_t i = 0; i < kinds.size(); ++i) {
        if (kinds[i] == 0) continue;
        double change = 0;
        for (size_t c = 0; c < 3; ++c) {
            const double mean = sums.sum[3 * i + c] / k_frames;
            change = std::max(change, sums.squares[3 * i + c] / k_frames - mean * mean);
            out[kinds[i] - 1].bias += std::fabs(mean) / 3;
        }
        changes[kinds[i] - 1].push_back(std::sqrt(change));
    }
    for (size_t k = 0; k < 2; ++k) {
        std::vector<double>& all = changes[k];
        if (all.empty()) continue;
        std::sort(all.begin(), all.end());
        const auto count = static_cast<double>(all.size());
        out[k] = {std::accumulate(all.begin(), all.end(), 0.0) / count, all[all.size() * 99 / 100],
                  out[k].bias / count, all.size()};
    }
    return out;
}

struct Shimmers {
    std::array<Shimmer, 2> seen, unfiltered;  // of the ground and of walls
};

Shimmers shimmer_of(Look& look) {
    const std::vector<uint8_t> kinds = middles(draw(look, look.camera, 1, Surfaces::normals));
    const glm::vec3 way = glm::normalize(look.camera.target - look.camera.eye), side(way.z, 0, -way.x);
    std::array<Sums, 2> sums{Sums(kinds.size()), Sums(kinds.size())};
    for (int n = 0; n < k_frames; ++n) {
        const Image fine = draw(look, look.camera, k_fine), seen = draw(look, look.camera, 1);
        const std::vector<float> truth = averaged(fine), one = picked(fine);
        for (size_t i = 0; i < kinds.size(); ++i)
            for (size_t c = 0; c < 3; ++c) {
                add(sums[0], 3 * i + c, static_cast<float>(seen.rgba[4 * i + c]) - truth[3 * i + c]);
                add(sums[1], 3 * i + c, one[3 * i + c] - truth[3 * i + c]);
            }
        look.camera.eye += (side + way) * k_move, look.camera.target += (side + way) * k_move;
    }
    return {shimmers(sums[0], kinds), shimmers(sums[1], kinds)};
}

// On average less than one of the 255 steps that a picture has, at the worst about as much as the eye can
// tell on a wall that moves; unfiltered patterns change by several times that.
TEST(Shimmer, IsHardlySeen) {
    Options options;
    options.scene = load_scene("district").value();
    options.scene.walkers = 0;
    RendererOptions plain = on_lavapipe();
    plain.quality = Quality::low;  // whose edges are left as they are
    Look look{make_show(make_renderer(plain).value(), options).value(), {}};
    const Camera street = street_camera(*look.show.loaded.city, *look.show.loaded.world);
    Camera above = street;
    above.eye.y += 60, above.target.y += 40;
    for (const bool is_overcast : {true, false})
        for (const Camera& camera : {street, above}) {
            look.show.is_overcast = is_overcast;
            look.camera = camera;
            const Shimmers all = shimmer_of(look);
            for (size_t k = 0; k < 2; ++k) {
                const Shimmer &seen = all.seen[k], &unfiltered = all.unfiltered[k];
                EXPECT_GT(seen.pixels, 10'000u);
                EXPECT_LE(seen.mean, unfiltered.mean / 2.5);
                EXPECT_LE(seen.worst, unfiltered.worst / 3);
                if (!is_overcast) continue;  // edges of shadows are not of patterns
                EXPECT_LE(seen.mean, 0.75);
                EXPECT_LE(seen.worst, 6);
                EXPECT_LE(seen.bias, 1.5);
                EXPECT_GT(unfiltered.worst, 10) << "the measure tells";
            }
        }
}

}  // namespace
}  // namespace flaneur
