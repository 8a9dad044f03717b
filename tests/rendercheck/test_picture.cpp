#include <gtest/gtest.h>
#include <png.h>
#include <tinyexr.h>
#include <zlib.h>

#include <cstdlib>

#include "tests/rendercheck/drawing.h"

namespace flaneur {
namespace {

std::vector<uint8_t> bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

TEST(CheckedPicture, ComesBackAsItWasWritten) {
    CheckedPicture picture = street();
    Result<CheckedPicture> read = read_picture(bytes_of(png_text(picture)));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->rgba, picture.rgba);
    EXPECT_EQ(read->precision, Precision::eight);
    pixel(picture, 3, 4)[3] = 17;  // no longer opaque
    read = read_picture(bytes_of(png_text(picture)));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->rgba, picture.rgba);
}

// Greys of 16 bits, as depths are.
TEST(CheckedPicture, HasSixteenBits) {
    const uint16_t greys[] = {0, 1, 257, 65535};
    png_image image{};
    image.version = PNG_IMAGE_VERSION, image.width = 2, image.height = 2, image.format = PNG_FORMAT_LINEAR_Y;
    image.flags = 0;
    std::vector<uint8_t> bytes(PNG_IMAGE_PNG_SIZE_MAX(image));
    png_alloc_size_t size = bytes.size();
    ASSERT_TRUE(png_image_write_to_memory(&image, bytes.data(), &size, 0, greys, 0, nullptr));
    bytes.resize(size);
    const Result<CheckedPicture> read = read_picture(bytes);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->precision, Precision::sixteen);
    for (size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(read->deep[4 * i + 1], static_cast<float>(greys[i]) / 65535.0f);
        EXPECT_EQ(read->deep[4 * i + 3], 1);
    }
    EXPECT_EQ(read->rgba[8], 1);
}

TEST(CheckedPicture, ReadsExr) {
    std::vector<float> red{0, 0.5f, 1, 700}, green(4, 0.25f), blue(4, -1.0f);
    EXRHeader header;
    EXRImage image;
    InitEXRHeader(&header), InitEXRImage(&image);
    EXRChannelInfo channels[3]{};
    int types[3] = {TINYEXR_PIXELTYPE_FLOAT, TINYEXR_PIXELTYPE_FLOAT, TINYEXR_PIXELTYPE_FLOAT};
    int requested[3] = {TINYEXR_PIXELTYPE_HALF, TINYEXR_PIXELTYPE_FLOAT, TINYEXR_PIXELTYPE_FLOAT};
    std::snprintf(channels[0].name, sizeof channels[0].name, "R");
    std::snprintf(channels[1].name, sizeof channels[1].name, "G");
    std::snprintf(channels[2].name, sizeof channels[2].name, "B");
    unsigned char* planes[3] = {reinterpret_cast<unsigned char*>(red.data()),
                                reinterpret_cast<unsigned char*>(green.data()),
                                reinterpret_cast<unsigned char*>(blue.data())};
    header.num_channels = image.num_channels = 3;
    header.channels = channels, header.pixel_types = types, header.requested_pixel_types = requested;
    image.images = planes, image.width = 2, image.height = 2;
    unsigned char* made = nullptr;
    const char* why = nullptr;
    const size_t size = SaveEXRImageToMemory(&image, &header, &made, &why);
    ASSERT_GT(size, 0u);
    const std::vector<uint8_t> bytes(made, made + size);
    std::free(made);
    const Result<CheckedPicture> read = read_picture(bytes);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->precision, Precision::floats);
    for (size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(read->deep[4 * i], red[i]);
        EXPECT_EQ(read->deep[4 * i + 1], 0.25f);
        EXPECT_EQ(read->deep[4 * i + 2], -1.0f);
    }
    EXPECT_EQ(read->rgba[0], 0);
    EXPECT_EQ(read->rgba[4], 188);  // half of the light, in sRGB
    EXPECT_EQ(read->rgba[12], 255);
    for (size_t cut = 0; cut < size; cut += 7) EXPECT_FALSE(read_picture(std::span(bytes).first(cut)));
}

// A header is no promise: nothing is allocated for it.
TEST(CheckedPicture, RefusesHugeOnesByTheirHeader) {
    std::vector<uint8_t> bytes = bytes_of(png_text(street(0, 8, 8)));
    const uint8_t huge[] = {0, 0, 0x75, 0x30, 0, 0, 0x75, 0x30};  // 30,000 x 30,000
    std::copy(std::begin(huge), std::end(huge), bytes.begin() + 16);
    const uint32_t sum = static_cast<uint32_t>(crc32(crc32(0, nullptr, 0), &bytes[12], 17));
    for (size_t i = 0; i < 4; ++i) bytes[29 + i] = static_cast<uint8_t>(sum >> (24 - 8 * i));
    const Result<CheckedPicture> read = read_picture(bytes);
    ASSERT_FALSE(read);
    EXPECT_NE(read.error().message.find("30000x30000"), std::string::npos) << read.error().message;
}

TEST(CheckedPicture, RefusesWhatIsCutOrNoPicture) {
    const std::vector<uint8_t> bytes = bytes_of(png_text(street(2, 40, 30)));
    for (size_t cut = 0; cut + 1 < bytes.size(); cut += 11)
        EXPECT_FALSE(read_picture(std::span(bytes).first(cut))) << cut;
    EXPECT_FALSE(read_picture(bytes_of("P6 2 2 255")));
    const TestFolder folder;
    EXPECT_FALSE(load_picture(folder / "none.png"));
    EXPECT_FALSE(load_picture(folder.path.string()));
}

}  // namespace
}  // namespace flaneur
