// What other programs write is decoded to the pixels that another decoder finds; what is broken is refused.
#include <gtest/gtest.h>
#include <png.h>
#include <stb/stb_image.h>
#include <sys/resource.h>
#include <zlib.h>

#include <algorithm>
#include <cstdlib>

#include "assets/files/picture.h"
#include "tests/assets/tiny/pictures.h"

namespace flaneur {
namespace {

constexpr int k_width = k_tiny_width, k_height = k_tiny_height;
constexpr size_t k_many = 1'000'000;

// By another decoder.
Bytes reference(const Bytes& file) {
    int width = 0, height = 0, channels = 0;
    uint8_t* pixels =
        stbi_load_from_memory(file.data(), static_cast<int>(file.size()), &width, &height, &channels, 4);
    EXPECT_TRUE(pixels);
    Bytes out(pixels, pixels + size_t{4} * k_width * k_height);
    stbi_image_free(pixels);
    return out;
}

TEST(Picture, PngsOfAllKindsAreDecoded) {
    for (int colour : {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_PALETTE,
                       PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_RGBA}) {
        for (int bits : {1, 4, 8, 16}) {
            bool few = colour == PNG_COLOR_TYPE_GRAY || colour == PNG_COLOR_TYPE_PALETTE;
            if ((bits < 8 && !few) || (bits > 4 && colour == PNG_COLOR_TYPE_PALETTE)) continue;
            for (bool interlaced : {false, true}) {
                for (bool see_through : {false, true}) {
                    if (see_through && (colour & PNG_COLOR_MASK_ALPHA || bits != 8) &&
                        colour != PNG_COLOR_TYPE_PALETTE)
                        continue;
                    if (see_through && bits == 1) continue;
                    Bytes file = png_of({colour, bits, interlaced, see_through});
                    auto picture = decode_picture(file, k_many);
                    ASSERT_TRUE(picture) << picture.error().message;
                    ASSERT_EQ(picture->width, k_width);
                    ASSERT_EQ(picture->height, k_height);
                    EXPECT_EQ(picture->rgba, reference(file))
                        << "colour " << colour << ", " << bits << " bits"
                        << (interlaced ? ", interlaced" : "") << (see_through ? ", transparent" : "");
                }
            }
        }
    }
}

TEST(Picture, JpegsOfAllKindsAreDecoded) {
    for (auto [space, channels] : {std::pair{JCS_GRAYSCALE, 1}, {JCS_RGB, 3}, {JCS_CMYK, 4}}) {
        for (bool progressive : {false, true}) {
            Bytes file = jpeg_of(space, channels, progressive);
            auto picture = decode_picture(file, k_many);
            ASSERT_TRUE(picture) << picture.error().message;
            Bytes wanted = reference(file);
            ASSERT_EQ(picture->rgba.size(), wanted.size());
            int most = 0;
            for (size_t i = 0; i < wanted.size(); ++i)
                most = std::max(most, std::abs(picture->rgba[i] - wanted[i]));
            EXPECT_LE(most, 6) << channels << " channels" << (progressive ? ", progressive" : "");
        }
    }
}

TEST(Picture, WhatIsWrittenIsWhatIsRead) {
    for (int channels : {3, 4}) {
        Bytes pixels, wanted;
        for (int i = 0; i < k_width * k_height; ++i) {
            for (int c = 0; c < channels; ++c) pixels.push_back(tiny_sample(i % k_width, i / k_width, c));
            for (int c = 0; c < 4; ++c)
                wanted.push_back(c < channels ? tiny_sample(i % k_width, i / k_width, c) : uint8_t{255});
        }
        std::string png = encode_png(pixels, k_width, k_height, channels, "made by hand");
        Bytes file(png.begin(), png.end());
        auto picture = decode_picture(file, k_many);
        ASSERT_TRUE(picture);
        EXPECT_EQ(picture->rgba, wanted);
        EXPECT_EQ(reference(file), wanted);
        EXPECT_EQ(png_comment(std::span(file).first(200)), "made by hand");
    }
    EXPECT_EQ(png_comment(png_of({PNG_COLOR_TYPE_RGB, 8})), "");
    EXPECT_EQ(png_comment({}), "");
}

TEST(Picture, WhatIsCutShortOrTooLargeIsRefused) {
    for (const Bytes& whole :
         {png_of({PNG_COLOR_TYPE_RGB, 8}), jpeg_of(JCS_RGB, 3, false), jpeg_of(JCS_RGB, 3, true)}) {
        for (size_t length = 0; length + 4 < whole.size(); length += 3)
            EXPECT_FALSE(decode_picture(std::span(whole).first(length), k_many))
                << length << " of " << whole.size();
        EXPECT_FALSE(decode_picture(whole, k_width * k_height - 1));
        EXPECT_TRUE(decode_picture(whole, k_width * k_height));
        for (size_t at = 0; at < whole.size(); ++at) {
            Bytes changed = whole;
            changed[at] ^= 0x15;
            (void)decode_picture(changed, k_many);
        }
    }
    EXPECT_NE(decode_picture(Bytes{'G', 'I', 'F', '8', '9'}, k_many).error().message.find("neither"),
              std::string::npos);
    EXPECT_FALSE(decode_picture({}, k_many));
}

// A picture with so many texts, each of which unpacks to megabytes.
Bytes png_with_texts(int count) {
    Bytes whole = png_of({PNG_COLOR_TYPE_RGB, 8}), text{'z', 'T', 'X', 't', 'a', 0, 0};
    Bytes blank(7'900'000, ' ');
    uLongf packed = compressBound(blank.size());
    text.resize(7 + packed);
    compress(&text[7], &packed, blank.data(), blank.size());
    text.resize(7 + packed);
    auto length = static_cast<uint32_t>(3 + packed),
         sum = static_cast<uint32_t>(crc32(0, text.data(), static_cast<uInt>(text.size())));
    auto put = [](Bytes& to, uint32_t number) {
        for (int shift = 24; shift >= 0; shift -= 8) to.push_back(static_cast<uint8_t>(number >> shift));
    };
    Bytes out(whole.begin(), whole.begin() + 33);  // up to the end of its header
    for (int i = 0; i < count; ++i) {
        put(out, length);
        out.insert(out.end(), text.begin(), text.end());
        put(out, sum);
    }
    out.insert(out.end(), whole.begin() + 33, whole.end());
    return out;
}

TEST(Picture, WhatItSaysBesidesTakesNoMemory) {
    Bytes file = png_with_texts(50);
    rusage before{}, after{};
    getrusage(RUSAGE_SELF, &before);
    auto picture = decode_picture(file, k_many);
    getrusage(RUSAGE_SELF, &after);
    ASSERT_TRUE(picture) << picture.error().message;
    EXPECT_EQ(picture->rgba, reference(png_of({PNG_COLOR_TYPE_RGB, 8})));
    EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 100 << 10) << "kilobytes";
}

// Broken ones count as well.
TEST(Picture, TellsHowManyPixelsItBegan) {
    Bytes whole = jpeg_of(JCS_RGB, 3, false);
    size_t begun = 0;
    EXPECT_FALSE(decode_picture(std::span(whole).first(whole.size() - 20), k_many, &begun));
    EXPECT_EQ(begun, size_t{k_width} * k_height);
    EXPECT_FALSE(decode_picture(whole, k_width * k_height - 1, &begun));
    EXPECT_EQ(begun, 0u);
}

// A header alone says how much memory it would take.
TEST(Picture, BombsAreRefusedByTheirHeaders) {
    Bytes bomb = png_of({PNG_COLOR_TYPE_RGB, 8});
    for (size_t at : {16, 20}) bomb[at] = 0x7f;  // two thousand million pixels a side
    auto sum = static_cast<uint32_t>(crc32(0, &bomb[12], 17));
    for (size_t i = 0; i < 4; ++i) bomb[29 + i] = static_cast<uint8_t>(sum >> (24 - 8 * i));
    auto picture = decode_picture(bomb, 32'000'000);
    ASSERT_FALSE(picture);
    EXPECT_NE(picture.error().message.find("more pixels"), std::string::npos) << picture.error().message;

    bomb = jpeg_of(JCS_RGB, 3, true);
    size_t frame = 2;
    while (bomb[frame + 1] != 0xc2) frame += 2 + size_t{bomb[frame + 2]} * 256 + bomb[frame + 3];
    for (size_t i : {5, 7}) bomb[frame + i] = 0xf0;  // 61 thousand a side
    picture = decode_picture(bomb, 32'000'000);
    ASSERT_FALSE(picture);
    EXPECT_NE(picture.error().message.find("more pixels"), std::string::npos) << picture.error().message;
}

TEST(Picture, WebpIsDecoded) {
    for (bool lossless : {true, false}) {
        auto picture = decode_picture(webp_of(lossless), k_many);
        ASSERT_TRUE(picture) << picture.error().message;
        ASSERT_EQ(picture->width, k_width);
        ASSERT_EQ(picture->height, k_height);
        int worst = 0, sum = 0;
        size_t at = 0;
        for (int y = 0; y < k_height; ++y)
            for (int x = 0; x < k_width; ++x)
                for (int channel = 0; channel < 4; ++channel, ++at) {
                    int off = std::abs(picture->rgba[at] - tiny_sample(x, y, channel));
                    worst = std::max(worst, off), sum += off;
                }
        if (lossless) {
            EXPECT_EQ(worst, 0);
        }
        EXPECT_LT(sum, 6 * 4 * k_width * k_height) << "colours are coarser than light at the edge";
    }
}

TEST(Picture, BrokenWebpIsRefused) {
    Bytes whole = webp_of(true);
    for (size_t length = 0; length < whole.size(); length += 3)
        EXPECT_FALSE(decode_picture(std::span(whole).first(length), k_many)) << length;
    auto many = decode_picture(whole, k_width * k_height - 1);
    ASSERT_FALSE(many);
    EXPECT_NE(many.error().message.find("more pixels"), std::string::npos);
    // A header of one that moves, 2 x 2.
    Bytes moving = {'R', 'I', 'F', 'F', 22, 0, 0, 0, 'W', 'E', 'B', 'P', 'V', 'P', '8',
                    'X', 10,  0,   0,   0,  2, 0, 0, 0,   1,   0,   0,   1,   0,   0};
    auto film = decode_picture(moving, k_many);
    ASSERT_FALSE(film);
    EXPECT_NE(film.error().message.find("still pictures"), std::string::npos) << film.error().message;
}

}  // namespace
}  // namespace flaneur
