// The verdict proves itself on real pictures: each small thing that is wrong with a render is caught, and
// what is right though not equal passes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <map>

#include "tests/renderer/test_renderer.h"
#include "tools/extract/ids.h"
#include "tools/flaneur/view/camera.h"
#include "tools/flaneur/view/show.h"
#include "tools/rendercheck/verdict/verdict.h"

namespace flaneur {
namespace {

constexpr uint32_t k_width = 480, k_height = 270;
constexpr uint32_t k_seen = 20;  // pixels from which somebody counts as seen

CheckedPicture checked(const Image& image) {
    CheckedPicture out;
    out.width = static_cast<int>(image.width), out.height = static_cast<int>(image.height);
    out.rgba = image.rgba;
    return out;
}

// About `place`, 3 degrees.
JointTransform turned(const JointTransform& joint, glm::vec3 place, glm::vec3 axis) {
    const glm::quat turn = glm::angleAxis(glm::radians(3.0f), axis);
    const glm::quat was(joint.rotation.w, joint.rotation.x, joint.rotation.y, joint.rotation.z);
    const glm::quat now = turn * was;
    return {{now.x, now.y, now.z, now.w},
            glm::vec4(turn * (glm::vec3(joint.translation) - place) + place, joint.translation.w)};
}

class Mutations : public testing::Test {
  protected:
    // One show for all: each test draws from its own copies.
    static void SetUpTestSuite() {
        Options options;
        options.scene = load_scene("district").value();
        Result<RendererPtr> renderer = make_renderer(on_lavapipe());
        ASSERT_TRUE(renderer) << renderer.error().message;
        Result<PreparedShow> prepared = prepare_show(options);
        ASSERT_TRUE(prepared) << prepared.error().message;
        city = new CityMesh(prepared->meshes.city);
        show = new Show{};
        show->renderer = std::move(*renderer);
        ASSERT_TRUE(upload_show(*show, *prepared, options.scene.views));
        for (int i = 0; i < 90; ++i) step(*show);
        camera = street_camera(*show->loaded.city, *show->loaded.world);
    }
    static void TearDownTestSuite() { delete show, delete city; }

    void SetUp() override {
        ASSERT_TRUE(show && show->renderer);
        frame = extract_frame(*show, camera, {k_width, k_height}, 1);
        walkers = show->people.walkers;
        palette = show->people.palette;
        frame.walkers = walkers, frame.palette = palette;
        frame.wants_ids = frame.wants_depths = true;
        reference = draw();
        frame.wants_ids = frame.wants_depths = false;
        for (size_t i = 3; i < reference.rgba.size(); i += 4) reference.rgba[i] = 255;  // of the sky
        for (uint32_t id : reference.ids) ++pixels[id];
    }
    Image draw() { return draw_image(*show->renderer, frame, k_width, k_height).value(); }
    Judgement judged(const Image& image) { return judge(checked(image), checked(reference), {}); }
    void expect_caught(const Image& image) {
        const Judgement judgement = judged(image);
        EXPECT_FALSE(judgement.passes)
            << judgement.over << " pixels differ by more than 2/255, " << judgement.densest << " in a window";
    }
    // Who is seen, the fewest pixels first.
    std::vector<size_t> seen_walkers() {
        std::vector<size_t> out;
        for (size_t n = 0; n < walkers.size(); ++n)
            if (pixels[walkers[n].id] >= k_seen) out.push_back(n);
        std::sort(out.begin(), out.end(),
                  [&](size_t a, size_t b) { return pixels[walkers[a].id] < pixels[walkers[b].id]; });
        return out;
    }

    static Show* show;
    static CityMesh* city;
    static Camera camera;
    FrameInput frame;
    std::vector<WalkerDraw> walkers;
    std::vector<JointTransform> palette;
    Image reference;
    std::map<uint32_t, uint32_t> pixels;  // of each id
};
Show* Mutations::show = nullptr;
CityMesh* Mutations::city = nullptr;
Camera Mutations::camera;

TEST_F(Mutations, TheSameFrameIsTheSamePicture) { EXPECT_TRUE(judged(draw()).is_equal); }

TEST_F(Mutations, OneFarWalkerMissing) {
    const std::vector<size_t> seen = seen_walkers();
    ASSERT_GE(seen.size(), 6u);
    for (size_t n = 0; n < 6; ++n) {
        std::vector<WalkerDraw> others = walkers;
        others.erase(others.begin() + static_cast<ptrdiff_t>(seen[n]));
        frame.walkers = others;
        SCOPED_TRACE(std::to_string(pixels[walkers[seen[n]].id]) + " pixels");
        expect_caught(draw());
    }
}

TEST_F(Mutations, ALevelOfDetailForced) {
    frame.is_finest = true;
    expect_caught(draw());
}

TEST_F(Mutations, ThePaletteATickOld) {
    PeopleFrame before;
    extract_people(*show->loaded.world, show->loaded.characters, before, 0,
                   pose_needs(*show->renderer, camera, frame.sun, k_width, k_height));
    ASSERT_EQ(before.palette.size(), palette.size());
    ASSERT_EQ(before.posed, show->people.posed);
    frame.palette = before.palette;
    expect_caught(draw());
}

TEST_F(Mutations, PeopleAFrameLate) {
    PeopleFrame before;
    extract_people(*show->loaded.world, show->loaded.characters, before, 0,
                   pose_needs(*show->renderer, camera, frame.sun, k_width, k_height));
    frame.palette = before.palette, frame.walkers = before.walkers, frame.grounds = before.grounds;
    expect_caught(draw());
}

TEST_F(Mutations, OneBoneBy3Degrees) {
    // The nearest of those who are in the picture from head to foot.
    std::vector<size_t> seen = seen_walkers();
    std::erase_if(seen, [&](size_t n) {
        for (uint32_t x = 0; x < k_width; ++x)
            if (reference.ids[(k_height - 1) * k_width + x] == walkers[n].id) return true;
        return false;
    });
    ASSERT_FALSE(seen.empty());
    const size_t nearest = seen.back();
    const uint32_t first = walkers[nearest].instance.palette;
    ASSERT_NE(first, k_no_palette);
    JointPose poses[k_joint_count];
    const World& world = *show->loaded.world;
    const auto ids = ::flaneur::walkers(world);
    const auto id = std::find_if(ids.begin(), ids.end(), [&](WalkerId one) { return one.index == nearest; });
    ASSERT_NE(id, ids.end());
    ASSERT_TRUE(pose_of(world, *id, poses));
    const glm::vec3 ahead = glm::normalize(camera.target - camera.eye);
    for (const std::vector<int>& limb : {std::vector<int>{right_upper_arm, right_lower_arm, right_hand},
                                         std::vector<int>{left_lower_leg, left_foot, left_toes}}) {
        std::vector<JointTransform> bent = palette;
        const Vec3 joint = poses[limb[0]].position;
        for (int bone : limb) {
            JointTransform& one = bent[first + static_cast<uint32_t>(bone)];
            one = turned(one, {joint.x, joint.y, joint.z}, ahead);
        }
        frame.palette = bent;
        SCOPED_TRACE(limb[0]);
        expect_caught(draw());
    }
}

// People without the shadows that they throw: they from one picture, all else from one without them.
TEST_F(Mutations, ShadowsOff) {
    frame.walkers = {};
    const Image nobody = draw();
    Image without = reference;
    for (size_t i = 0; i < without.ids.size(); ++i)
        if (kind_of_id(without.ids[i]) != IdKind::walker)
            std::copy_n(&nobody.rgba[4 * i], 4, &without.rgba[4 * i]);
    expect_caught(without);
}

TEST_F(Mutations, ColoursSwapped) {
    const std::vector<size_t> seen = seen_walkers();
    std::swap(walkers[seen.back()].instance.tints, walkers[seen[seen.size() - 2]].instance.tints);
    expect_caught(draw());
}

// A house's picture with red and blue exchanged, on the house that is smallest on the screen and seen.
TEST_F(Mutations, ATextureSwapped) {
    uint32_t smallest = 0;
    for (const auto& [id, count] : pixels)
        if (kind_of_id(id) == IdKind::house && count >= 40 && (!smallest || count < pixels[smallest]))
            smallest = id;
    ASSERT_NE(smallest, 0u);
    Image swapped = reference;
    for (size_t i = 0; i < swapped.ids.size(); ++i)
        if (swapped.ids[i] == smallest) std::swap(swapped.rgba[4 * i], swapped.rgba[4 * i + 2]);
    expect_caught(swapped);
}

TEST_F(Mutations, OnePixelsShift) {
    for (const auto& [dx, dy] : {std::pair(1, 0), std::pair(0, 1)}) {
        Image shifted = reference;
        for (uint32_t y = k_height; y-- > static_cast<uint32_t>(dy);)
            for (uint32_t x = k_width; x-- > static_cast<uint32_t>(dx);)
                std::copy_n(&reference.rgba[4 * ((y - static_cast<uint32_t>(dy)) * k_width + x -
                                                 static_cast<uint32_t>(dx))],
                            4, &shifted.rgba[4 * (y * k_width + x)]);
        expect_caught(shifted);
    }
}

TEST_F(Mutations, GammaTwice) {
    Image twice = reference;
    for (size_t i = 0; i < twice.rgba.size(); ++i)
        if (i % 4 != 3) twice.rgba[i] = static_cast<uint8_t>(255 * std::pow(twice.rgba[i] / 255.0, 1 / 2.2));
    expect_caught(twice);
}

// Triangles of the city that are small on the screen and, at their middle, in front of everything.
TEST_F(Mutations, OneTriangleMissing) {
    constexpr float k_least = 60, k_most = 400;  // pixels
    const View view = make_view(camera, k_width, k_height);
    auto on_screen = [&](glm::vec3 p) {
        const glm::vec4 clip = view.clip_from_world * glm::vec4(p, 1);
        return glm::vec3((clip.x / clip.w * 0.5f + 0.5f) * k_width,
                         (clip.y / clip.w * 0.5f + 0.5f) * k_height, clip.w);
    };
    int tried = 0;
    for (size_t t = 0; t + 2 < city->indices.size() && tried < 3; t += 3) {
        const CityVertex* corners[3];
        for (size_t c = 0; c < 3; ++c) corners[c] = &city->vertices[city->indices[t + c]];
        glm::vec3 at[3];
        bool is_within = true;
        for (size_t c = 0; c < 3; ++c) {
            at[c] = on_screen(corners[c]->position);
            is_within = is_within && at[c].z > 1 && at[c].x > 0 && at[c].x < k_width && at[c].y > 0 &&
                        at[c].y < k_height;
        }
        if (!is_within) continue;
        const float area = 0.5f * std::fabs((at[1].x - at[0].x) * (at[2].y - at[0].y) -
                                            (at[2].x - at[0].x) * (at[1].y - at[0].y));
        if (area < k_least || area > k_most) continue;
        // Whose depth and id the picture has there, in the middle and half way to each corner.
        const glm::vec3 middle = (corners[0]->position + corners[1]->position + corners[2]->position) / 3.0f;
        auto is_shown = [&](glm::vec3 place) {
            const glm::vec3 on = on_screen(place);
            const size_t pixel = static_cast<size_t>(on.y) * k_width + static_cast<size_t>(on.x);
            return reference.ids[pixel] == corners[0]->id &&
                   std::fabs(reference.depths[pixel] - on.z) < 0.002f * on.z;
        };
        bool is_seen = is_shown(middle) && kind_of_id(corners[0]->id) != IdKind::ground;
        for (const CityVertex* corner : corners)
            is_seen = is_seen && is_shown((corner->position + middle) * 0.5f);
        if (!is_seen) continue;
        CityMesh without = *city;
        without.indices.erase(without.indices.begin() + static_cast<ptrdiff_t>(t),
                              without.indices.begin() + static_cast<ptrdiff_t>(t + 3));
        if (!without.seen_from.empty())
            without.seen_from.erase(without.seen_from.begin() + static_cast<ptrdiff_t>(t / 3));
        const auto prepared = prepare_for_upload(without);
        ASSERT_TRUE(prepared);
        ASSERT_TRUE(upload_city(*show->renderer, **prepared));
        SCOPED_TRACE(std::to_string(area) + " pixels of id " + std::to_string(corners[0]->id));
        expect_caught(draw());
        ++tried;
    }
    EXPECT_GT(tried, 0);
    const auto whole = prepare_for_upload(*city);
    ASSERT_TRUE(whole);
    ASSERT_TRUE(upload_city(*show->renderer, **whole));
    EXPECT_TRUE(judged(draw()).is_equal);
}

// Two surfaces in one place: every other pixel of a patch is the other one's.
TEST_F(Mutations, ZFighting) {
    Image fights = reference;
    size_t count = 0;
    for (uint32_t y = 100; y < 108; ++y)
        for (uint32_t x = 200; x < 208; ++x)
            if ((x + y) % 2) fights.rgba[4 * (y * k_width + x)] ^= 0x40, ++count;
    ASSERT_EQ(count, 32u);
    expect_caught(fights);
}

// What must pass.

TEST_F(Mutations, RoundingPasses) {
    Image noisy = reference;
    uint32_t state = 1;
    for (uint32_t n = 0; n < k_width * k_height / 1000; ++n) {
        state = state * 1664525u + 1013904223u;
        uint8_t& channel = noisy.rgba[4 * ((state >> 8) % (k_width * k_height)) + n % 3];
        channel = static_cast<uint8_t>(channel == 255 ? 254 : channel + 1);
    }
    const Judgement judgement = judged(noisy);
    EXPECT_GT(judgement.differing, 100u);
    EXPECT_TRUE(judgement.passes);
}

TEST_F(Mutations, OtherWaysToTheSamePicturePass) {
    frame.skips_hidden = false;
    EXPECT_TRUE(judged(draw()).passes);
    frame.skips_hidden = true, frame.times_passes = true;
    EXPECT_TRUE(judged(draw()).passes);
}

}  // namespace
}  // namespace flaneur
