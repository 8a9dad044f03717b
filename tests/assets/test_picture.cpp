// What other programs write is decoded to the pixels that another decoder finds; what is broken is refused.
#include <gtest/gtest.h>
#include <png.h>
#include <stb/stb_image.h>
#include <webp/encode.h>
#include <zlib.h>

#include <cstdlib>
#include <cstring>

#include "assets/files/picture.h"
// After <cstdlib>, which it needs.
#include <jpeglib.h>

namespace flaneur {
namespace {

using Bytes = std::vector<uint8_t>;

constexpr int k_width = 37, k_height = 21;
constexpr size_t k_many = 1'000'000;

// Slopes, and an edge.
uint8_t sample(int x, int y, int channel) {
    return static_cast<uint8_t>(channel == 3 ? 255 - 3 * x
                                             : 2 * x + 3 * y + 40 * channel + (x > 20 ? 60 : 0));
}

struct PngKind {
    int colour, bits;
    bool interlaced = false, see_through = false;
};

Bytes png_of(const PngKind& kind) {
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    Bytes out;
    png_set_write_fn(
        png, &out,
        [](png_structp p, png_bytep bytes, size_t count) {
            auto* to = static_cast<Bytes*>(png_get_io_ptr(p));
            to->insert(to->end(), bytes, bytes + count);
        },
        [](png_structp) {});
    png_set_IHDR(png, info, k_width, k_height, kind.bits, kind.colour,
                 kind.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_set_gAMA(png, info, 1.0);  // which glTF wants ignored
    if (kind.colour == PNG_COLOR_TYPE_PALETTE) {
        png_color palette[16];
        for (int i = 0; i < 16; ++i) palette[i] = {sample(i, 1, 0), sample(i, 2, 1), sample(i, 3, 2)};
        png_set_PLTE(png, info, palette, 1 << kind.bits);
        png_byte alphas[] = {0, 100, 200};
        if (kind.see_through) png_set_tRNS(png, info, alphas, 3, nullptr);
    } else if (kind.see_through) {
        png_color_16 clear{0, sample(3, 4, 0), sample(3, 4, 1), sample(3, 4, 2), sample(3, 4, 0)};
        png_set_tRNS(png, info, nullptr, 0, &clear);
    }
    png_write_info(png, info);
    size_t channels = png_get_channels(png, info);
    std::vector<Bytes> rows(k_height);
    std::vector<png_bytep> pointers;
    for (int y = 0; y < k_height; ++y) {
        Bytes& row = rows[static_cast<size_t>(y)];
        row.assign(png_get_rowbytes(png, info), 0);
        for (size_t i = 0; i < row.size(); ++i) {
            auto pixel = static_cast<int>(i * 8 / (channels * static_cast<size_t>(kind.bits)));
            row[i] = sample(pixel, y, static_cast<int>(i * 8 / static_cast<size_t>(kind.bits) % channels));
        }
        pointers.push_back(row.data());
    }
    png_write_image(png, pointers.data());
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return out;
}

Bytes jpeg_of(J_COLOR_SPACE space, int channels, bool progressive) {
    jpeg_compress_struct jpeg;
    jpeg_error_mgr errors;
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&jpeg, &bytes, &size);
    jpeg.image_width = k_width;
    jpeg.image_height = k_height;
    jpeg.input_components = channels;
    jpeg.in_color_space = space;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, 95, TRUE);
    if (progressive) jpeg_simple_progression(&jpeg);
    jpeg_start_compress(&jpeg, TRUE);
    for (int y = 0; y < k_height; ++y) {
        Bytes row;
        for (int x = 0; x < k_width; ++x)
            for (int c = 0; c < channels; ++c) row.push_back(sample(x, y, c));
        JSAMPROW rows[] = {row.data()};
        jpeg_write_scanlines(&jpeg, rows, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    Bytes out(bytes, bytes + size);
    std::free(bytes);
    return out;
}

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
            for (int c = 0; c < channels; ++c) pixels.push_back(sample(i % k_width, i / k_width, c));
            for (int c = 0; c < 4; ++c)
                wanted.push_back(c < channels ? sample(i % k_width, i / k_width, c) : uint8_t{255});
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

Bytes webp_of(bool lossless) {
    Bytes pixels;
    for (int y = 0; y < k_height; ++y)
        for (int x = 0; x < k_width; ++x)
            for (int channel = 0; channel < 4; ++channel) pixels.push_back(sample(x, y, channel));
    uint8_t* packed = nullptr;
    size_t size = lossless ? WebPEncodeLosslessRGBA(pixels.data(), k_width, k_height, k_width * 4, &packed)
                           : WebPEncodeRGBA(pixels.data(), k_width, k_height, k_width * 4, 95, &packed);
    Bytes out(packed, packed + size);
    WebPFree(packed);
    return out;
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
                    int off = std::abs(picture->rgba[at] - sample(x, y, channel));
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
