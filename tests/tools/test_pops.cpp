// Pops: what jumps on the picture although nothing in the city does. A pop is a square of 16 x 16 pixels two
// fifths of which change by more than an eighth of the range from one frame to the next, while the eye moves
// slowly.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "tests/renderer/test_renderer.h"
#include "tools/flaneur/view/camera.h"
#include "tools/flaneur/view/show.h"

namespace flaneur {
namespace {

constexpr uint32_t k_square = 16, k_width = 480, k_height = 270;
constexpr int k_jump = 32;      // of 255
constexpr float k_most = 0.4f;  // of a square's pixels

struct Jump {
    float share = 0;  // of the pixels of the square that changed most
    uint32_t x = 0, y = 0;
};

Jump largest_jump(const Image& a, const Image& b) {
    const uint32_t stride = a.width + 1;
    std::vector<uint32_t> sums(size_t{stride} * (a.height + 1));  // of changed pixels above and to the left
    for (uint32_t y = 0; y < a.height; ++y)
        for (uint32_t x = 0; x < a.width; ++x) {
            bool is_changed = false;
            for (size_t c = 0, at = 4 * (size_t{y} * a.width + x); c < 3; ++c)
                is_changed |= std::abs(a.rgba[at + c] - b.rgba[at + c]) > k_jump;
            const size_t at = size_t{y} * stride + x;
            sums[at + stride + 1] = sums[at + stride] + sums[at + 1] - sums[at] + is_changed;
        }
    Jump most;
    for (uint32_t y = 0; y + k_square <= a.height; ++y)
        for (uint32_t x = 0; x + k_square <= a.width; ++x) {
            const size_t at = size_t{y} * stride + x, below = at + size_t{k_square} * stride;
            const float share =
                static_cast<float>(sums[below + k_square] - sums[below] - sums[at + k_square] + sums[at]) /
                (k_square * k_square);
            if (share > most.share) most = {share, x, y};
        }
    return most;
}

class Pops : public testing::Test {
  protected:
    void SetUp() override {
        Options options;
        options.scene = load_scene("corner").value();
        Result<RendererPtr> renderer = make_renderer(on_lavapipe());
        ASSERT_TRUE(renderer) << renderer.error().message;
        Result<Show> made = make_show(std::move(*renderer), options);
        ASSERT_TRUE(made) << made.error().message;
        show = std::move(*made);
        for (int i = 0; i < 300; ++i) step(show);
        camera = street_camera(*show.loaded.city, *show.loaded.world);
    }
    Image draw() {
        return draw_image(*show.renderer, extract_frame(show, camera, {k_width, k_height}, 1), k_width,
                          k_height)
            .value();
    }
    // The largest jump while `move` moves the camera by 1/60 s, `frames` times.
    template <class Move>
    Jump largest_on_the_way(int frames, Move&& move) {
        Jump most;
        Image before = draw();
        for (int i = 0; i < frames; ++i) {
            move();
            Image now = draw();
            const Jump jump = largest_jump(before, now);
            if (jump.share > most.share) most = jump;
            before = std::move(now);
        }
        return most;
    }
    Show show;
    Camera camera;
};

// The measure itself: somebody who wears red all at once is a pop.
TEST_F(Pops, AreNoticed) {
    const Image before = draw();
    const FrameInput frame = extract_frame(show, camera, {k_width, k_height}, 1);
    const glm::vec3 ahead = glm::normalize(camera.target - camera.eye);
    WalkerDraw* nearest = nullptr;
    auto distance = [&](const WalkerDraw& w) { return glm::length(w.centre - camera.eye); };
    for (WalkerDraw& w : show.people.walkers)
        if (glm::dot(w.centre - camera.eye, ahead) > 0.95f * distance(w) &&
            (!nearest || distance(w) < distance(*nearest)))
            nearest = &w;
    ASSERT_TRUE(nearest);
    std::fill_n(nearest->instance.tints, k_tints, 0xff0000ffu);
    const Image after = draw_image(*show.renderer, frame, k_width, k_height).value();
    EXPECT_GT(largest_jump(before, after).share, k_most);
    EXPECT_EQ(largest_jump(before, before).share, 0);
}

TEST_F(Pops, AreNotSeenOnAWalk) {
    const glm::vec3 step = glm::normalize(camera.target - camera.eye) * (0.6f / 60);
    const Jump jump = largest_on_the_way(80, [&] { camera.eye += step, camera.target += step; });
    EXPECT_LT(jump.share, k_most) << "at " << jump.x << ", " << jump.y;
    EXPECT_GT(jump.share, 0);
}

TEST_F(Pops, AreNotSeenOnATurn) {
    const Jump jump = largest_on_the_way(80, [&] {
        const glm::vec3 way = camera.target - camera.eye;
        camera.target += 0.03f / 60 * glm::vec3(way.z, 0, -way.x);
    });
    EXPECT_LT(jump.share, k_most) << "at " << jump.x << ", " << jump.y;
    EXPECT_GT(jump.share, 0);
}

TEST_F(Pops, AreNotSeenOnALift) {
    const Jump jump =
        largest_on_the_way(80, [&] { camera.eye.y += 0.4f / 60, camera.target.y += 0.4f / 60; });
    EXPECT_LT(jump.share, k_most) << "at " << jump.x << ", " << jump.y;
    EXPECT_GT(jump.share, 0);
}

}  // namespace
}  // namespace flaneur
