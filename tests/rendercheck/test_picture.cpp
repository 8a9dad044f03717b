#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStdIO.h>
#include <ImfTiledOutputFile.h>
#include <gtest/gtest.h>
#include <png.h>
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

struct ExrChannel {
    const char* name;
    Imf::PixelType type;  // that it has in the file
    std::vector<float> values;
    int sampling = 1;
};

// An .exr of 2x2 pixels, whose window begins elsewhere than at 0.
std::vector<uint8_t> exr_of(const std::vector<ExrChannel>& channels, Imf::Compression compression,
                            bool is_tiled = false) {
    const Imath::Box2i window({4, -6}, {5, -5});
    Imf::Header header(window, window);
    header.compression() = compression;
    std::vector<std::vector<uint32_t>> whole(channels.size());
    std::vector<std::vector<Imath::half>> halves(channels.size());
    Imf::FrameBuffer pixels;
    for (size_t c = 0; c < channels.size(); ++c) {
        const ExrChannel& channel = channels[c];
        header.channels().insert(channel.name,
                                 Imf::Channel(channel.type, channel.sampling, channel.sampling));
        const bool is_whole = channel.type == Imf::UINT;
        if (is_whole) whole[c].assign(channel.values.begin(), channel.values.end());
        const void* from = is_whole ? static_cast<const void*>(whole[c].data()) : channel.values.data();
        halves[c].assign(channel.values.begin(), channel.values.end());
        if (channel.type == Imf::HALF) from = halves[c].data();
        pixels.insert(channel.name,
                      Imf::Slice::Make(channel.type, from, window, 0, 0, channel.sampling, channel.sampling));
    }
    Imf::StdOSStream bytes;
    if (is_tiled) {
        header.setTileDescription({16, 16});
        Imf::TiledOutputFile file(bytes, header, 0);
        file.setFrameBuffer(pixels);
        file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
    } else {
        Imf::OutputFile file(bytes, header, 0);
        file.setFrameBuffer(pixels);
        file.writePixels(2);
    }
    return bytes_of(bytes.str());
}

TEST(CheckedPicture, ReadsExr) {
    const std::vector<float> red{0, 0.5f, 1, 700}, green(4, 0.25f), blue(4, -1.0f), other(4, 9);
    for (const bool is_tiled : {false, true}) {
        for (const auto compression :
             {Imf::NO_COMPRESSION, Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION, Imf::PXR24_COMPRESSION}) {
            const std::vector<uint8_t> bytes = exr_of({{"R", Imf::HALF, red},
                                                       {"G", Imf::FLOAT, green},
                                                       {"B", Imf::FLOAT, blue},
                                                       {"Diffuse.R", Imf::FLOAT, other},
                                                       {"Z", Imf::FLOAT, other}},
                                                      compression, is_tiled);
            const Result<CheckedPicture> read = read_picture(bytes);
            ASSERT_TRUE(read) << read.error().message;
            EXPECT_EQ(told_size(*read), "2x2");
            EXPECT_EQ(read->precision, Precision::floats);
            for (size_t i = 0; i < 4; ++i) {
                EXPECT_EQ(read->deep[4 * i], red[i]);
                EXPECT_EQ(read->deep[4 * i + 1], 0.25f);
                EXPECT_EQ(read->deep[4 * i + 2], -1.0f);
                EXPECT_EQ(read->deep[4 * i + 3], 1);
            }
            EXPECT_EQ(read->rgba[0], 0);
            EXPECT_EQ(read->rgba[4], 188);  // half of the light, in sRGB
            EXPECT_EQ(read->rgba[12], 255);
            for (size_t cut = 0; cut < bytes.size(); cut += 7)
                EXPECT_FALSE(read_picture(std::span(bytes).first(cut))) << cut;
        }
    }
}

TEST(CheckedPicture, ReadsExrOfNoColours) {
    const std::vector<float> ids{0, 1, 70000, 16777215};
    const Result<CheckedPicture> read = read_picture(exr_of({{"id", Imf::UINT, ids}}, Imf::ZIP_COMPRESSION));
    ASSERT_TRUE(read) << read.error().message;
    for (size_t i = 0; i < 4; ++i)
        for (size_t c = 0; c < 3; ++c) EXPECT_EQ(read->deep[4 * i + c], ids[i]);
    const Result<CheckedPicture> layer = read_picture(
        exr_of({{"Diffuse.G", Imf::FLOAT, ids}, {"Depth.Z", Imf::FLOAT, ids}}, Imf::ZIP_COMPRESSION));
    ASSERT_TRUE(layer) << layer.error().message;
    EXPECT_EQ(layer->deep[9], 70000);
    EXPECT_EQ(layer->deep[8], 0);
    const Result<CheckedPicture> coarse =
        read_picture(exr_of({{"Y", Imf::FLOAT, ids}, {"BY", Imf::FLOAT, {1}, 2}}, Imf::ZIP_COMPRESSION));
    ASSERT_FALSE(coarse);
    EXPECT_NE(coarse.error().message.find("channel BY of fewer pixels"), std::string::npos)
        << coarse.error().message;
}

// Whatever is wrong with them: an error, or a picture.
TEST(CheckedPicture, TakesExrThatIsBroken) {
    const std::vector<uint8_t> good =
        exr_of({{"R", Imf::HALF, {1, 2, 3, 4}}, {"Z", Imf::FLOAT, {1, 2, 3, 4}}}, Imf::ZIP_COMPRESSION);
    for (size_t at = 4; at < good.size(); ++at)
        for (const int value : {0x00, 0x7f, 0xff}) {
            std::vector<uint8_t> bytes = good;
            bytes[at] = static_cast<uint8_t>(value);
            const Result<CheckedPicture> read = read_picture(bytes);
            EXPECT_TRUE(read || !read.error().message.empty()) << at;
        }
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
