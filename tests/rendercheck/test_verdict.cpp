#include <gtest/gtest.h>

#include "tests/rendercheck/drawing.h"
#include "tools/rendercheck/verdict/boxes.h"

namespace flaneur {
namespace {

bool passes(const CheckedPicture& picture, const CheckedPicture& reference) {
    return judge(picture, reference, {}).passes;
}

TEST(Judgement, EqualPicturesPass) {
    const Judgement judgement = judge(street(), street(), {});
    EXPECT_TRUE(judgement.is_equal);
    EXPECT_TRUE(judgement.passes);
    EXPECT_EQ(judgement.pixels, 320u * 180u);
}

// Forty pixels of 57,600 are 0.07 %: what the densest window is for. It must see them by itself, without the
// shares.
TEST(Judgement, OneFarWalkerIsMissed) {
    Tolerance window_alone;
    window_alone.differing = window_alone.over = 1;
    for (int gone : {0, 5, 11}) {
        CheckedPicture without = street(0);
        for (int n = 0; n < 12; ++n)
            if (n != gone)
                paint(without, {20 + 20 * n, 100, 4, 10}, static_cast<uint8_t>(200 - 10 * n), 30,
                      static_cast<uint8_t>(20 * n));
        const Judgement judgement = judge(without, street(), window_alone);
        EXPECT_FALSE(judgement.passes);
        EXPECT_EQ(judgement.densest, 40);
        ASSERT_EQ(judgement.boxes.size(), 1u);
        EXPECT_EQ(judgement.boxes[0].box.left, 20 + 20 * gone);
        EXPECT_EQ(judgement.boxes[0].box.top, 100);
        EXPECT_EQ(judgement.boxes[0].box.width, 4);
        EXPECT_EQ(judgement.boxes[0].box.height, 10);
        EXPECT_EQ(judgement.boxes[0].pixels, 40u);
    }
}

TEST(Judgement, RoundingPasses) {
    CheckedPicture noisy = street();
    for (int n = 0; n < 57; ++n) pixel(noisy, (n * 97) % 320, (n * 31) % 180)[n % 3] ^= 1;  // 0.1 % of 57,600
    EXPECT_TRUE(passes(noisy, street()));
    // More of it does not.
    pixel(noisy, 5, 179)[0] ^= 1;
    EXPECT_FALSE(passes(noisy, street()));
}

TEST(Judgement, OnePixelsShiftFails) {
    CheckedPicture shifted = street();
    const CheckedPicture still = street();
    for (int y = 0; y < 180; ++y)
        for (int x = 319; x > 0; --x) std::copy_n(pixel(shifted, x - 1, y), 4, pixel(shifted, x, y));
    EXPECT_FALSE(passes(shifted, still));
}

TEST(Judgement, GammaTwiceFails) {
    CheckedPicture twice = street();
    for (size_t i = 0; i < twice.rgba.size(); ++i)
        if (i % 4 != 3) twice.rgba[i] = static_cast<uint8_t>(255 * std::pow(twice.rgba[i] / 255.0, 1 / 2.2));
    EXPECT_FALSE(passes(twice, street()));
}

// The smallest that is seen: a triangle of 6 by 6, of which 21 pixels are inside.
TEST(Judgement, OneTriangleLessFails) {
    CheckedPicture with = street();
    for (int y = 0; y < 6; ++y) paint(with, {200, 40 + y, 6 - y, 1}, 250, 250, 250);
    const Judgement judgement = judge(street(), with, {});
    EXPECT_FALSE(judgement.passes);
    EXPECT_EQ(judgement.densest, 21);
    EXPECT_EQ(judgement.worst_y / 6, 6);
}

TEST(Judgement, AlphaCounts) {
    CheckedPicture clear = street();
    for (int x = 0; x < 20; ++x) pixel(clear, x, 0)[3] = 0;
    EXPECT_FALSE(passes(clear, street()));
}

TEST(Judgement, SaysWhereAndHowMuch) {
    CheckedPicture spot = street(0);
    paint(spot, {60, 50, 5, 5}, 255, 0, 255);
    pixel(spot, 62, 51)[1] = 255;
    const Judgement judgement = judge(spot, street(0), {});
    EXPECT_EQ(judgement.over, 25u);
    EXPECT_EQ(judgement.beyond[0], 25u);
    EXPECT_GE(judgement.worst, 160);
    EXPECT_EQ(judgement.flip.size(), 320u * 180u);
    EXPECT_GT(judgement.max_flip, 0.3);
    EXPECT_LT(judgement.mean_flip, 0.01);
    ASSERT_FALSE(judgement.reasons.empty());
    EXPECT_NE(judgement.reasons.back().find("25 pixels"), std::string::npos) << judgement.reasons.back();
}

TEST(Judgement, MasksAndBoxesMayDiffer) {
    CheckedPicture spot = street(0);
    paint(spot, {60, 50, 8, 8}, 255, 0, 255);
    MayDiffer box;
    box.ignored = {{60, 50, 8, 8}};
    const Judgement judgement = judge(spot, street(0), {}, box);
    EXPECT_TRUE(judgement.is_equal);
    EXPECT_EQ(judgement.pixels, 320u * 180u - 64u);
    box.ignored = {{60, 50, 8, 4}};
    EXPECT_FALSE(judge(spot, street(0), {}, box).passes);
    box.ignored = {{300, 170, 5000, 5000}};  // beyond the picture
    EXPECT_FALSE(judge(spot, street(0), {}, box).passes);
    MayDiffer mask;
    mask.mask = street(0);
    paint(*mask.mask, {0, 0, 320, 180}, 0, 0, 0);
    paint(*mask.mask, {60, 50, 8, 8}, 255, 255, 255);
    EXPECT_TRUE(judge(spot, street(0), {}, mask).passes);
    mask.mask = street(0, 10, 10);
    EXPECT_FALSE(judge(street(0), street(0), {}, mask).passes);
}

// One pixel that is no number spreads in whatever comes after.
TEST(Judgement, NoToleranceCoversWhatIsNoNumber) {
    CheckedPicture right;
    right.width = 64, right.height = 64, right.precision = Precision::floats;
    right.deep.assign(64 * 64 * 4, 0.4f), right.rgba.assign(64 * 64 * 4, 100);
    Tolerance all{.differing = 1, .over = 1, .step = 255, .in_window = 256};
    for (const float value :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        CheckedPicture odd = right;
        odd.deep[400] = value;
        for (const auto& [a, b] : {std::pair(odd, right), std::pair(right, odd)}) {
            const Judgement judgement = judge(a, b, all);
            EXPECT_FALSE(judgement.passes);
            ASSERT_EQ(judgement.reasons.size(), 1u);
            EXPECT_NE(judgement.reasons[0].find("1 pixels are no numbers"), std::string::npos)
                << judgement.reasons[0];
        }
        EXPECT_TRUE(judge(odd, odd, all).passes);
    }
    CheckedPicture other = right;
    other.deep[400] = 3;
    EXPECT_TRUE(judge(other, right, all).passes);
}

TEST(Judgement, FlipMayJudge) {
    CheckedPicture faint = street(0);
    for (size_t i = 0; i < faint.rgba.size(); i += 4) faint.rgba[i] = static_cast<uint8_t>(faint.rgba[i] + 2);
    Tolerance tolerance;
    tolerance.differing = 1;
    EXPECT_TRUE(judge(faint, street(0), tolerance).passes);
    tolerance.flip = 0.001;
    EXPECT_FALSE(judge(faint, street(0), tolerance).passes);
}

TEST(Judgement, OtherSizesAndPrecisionsFail) {
    EXPECT_FALSE(passes(street(0, 319, 180), street(0)));
    CheckedPicture deep = street(0);
    deep.precision = Precision::sixteen;
    deep.deep.assign(deep.rgba.size(), 0.5f);
    EXPECT_FALSE(passes(deep, street(0)));
}

// A difference of one part in 65535 is seen, and is far below 2/255.
TEST(Judgement, SixteenBitsAreNotRoundedToEight) {
    CheckedPicture one = street(0);
    one.precision = Precision::sixteen;
    for (uint8_t v : one.rgba) one.deep.push_back(static_cast<float>(v) / 255);
    CheckedPicture other = one;
    for (size_t i = 0; i < 4 * 57; i += 4) other.deep[i] += 1 / 65535.0f;
    EXPECT_EQ(judge(other, one, {}).differing, 57u);
    EXPECT_TRUE(passes(other, one));
}

TEST(Judgement, LightBeyondOneIsASharing) {
    CheckedPicture one = street(0, 64, 64);
    one.precision = Precision::floats;
    one.deep.assign(one.rgba.size(), 500.0f);
    CheckedPicture other = one;
    other.deep[0] = 501;  // 0.2 % of a lamp: half of a 255th
    EXPECT_NEAR(judge(other, one, {}).worst, 0.509, 1e-3);
    other.deep[0] = std::nanf("");
    EXPECT_EQ(judge(other, one, {}).worst, 255);
}

TEST(Boxes, DensestWindowLiesAnywhere) {
    std::vector<float> differences(100 * 50, 0.0f);
    for (int y = 13; y < 18; ++y)
        for (int x = 83; x < 100; ++x) differences[static_cast<size_t>(y * 100 + x)] = 3;
    PixelBox where;
    EXPECT_EQ(densest_window(differences, 100, 2, 16, where), 80);
    EXPECT_EQ(where.left, 83);
    EXPECT_EQ(where.top, 2);
    EXPECT_EQ(densest_window(differences, 100, 3, 16, where), 0);
    // A picture smaller than a window is one.
    EXPECT_EQ(densest_window(std::vector<float>(12, 5.0f), 4, 2, 16, where), 12);
}

TEST(Boxes, AreApartWhereNothingLiesBetween) {
    std::vector<float> differences(200 * 100, 0.0f);
    auto set = [&](int x, int y) { differences[static_cast<size_t>(y * 200 + x)] = 9; };
    set(3, 3), set(9, 4);  // near: one box
    set(150, 90);
    size_t more = 7;
    std::vector<ChangedBox> boxes = changed_boxes(differences, 200, 2, more);
    ASSERT_EQ(boxes.size(), 2u);
    EXPECT_EQ(more, 0u);
    EXPECT_EQ(boxes[0].pixels, 2u);
    EXPECT_EQ(boxes[0].box.width, 7);
    EXPECT_EQ(boxes[1].box.left, 150);
    EXPECT_EQ(boxes[1].box.width, 1);
    for (int n = 0; n < 200; n += 17)
        for (int y = 0; y < 100; y += 17) set(n, y);
    boxes = changed_boxes(differences, 200, 2, more);
    EXPECT_EQ(boxes.size(), 24u);
    EXPECT_GT(more, 10u);
}

}  // namespace
}  // namespace flaneur
