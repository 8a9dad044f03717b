#include "assets/files/picture.h"

#include <png.h>
#include <webp/decode.h>
#include <zlib.h>

#include <algorithm>
#include <cassert>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <memory>
// After <cstdio>, which it needs.
#include <jerror.h>
#include <jpeglib.h>

namespace flaneur {

namespace {

constexpr const char* k_keyword = "Comment";  // of PNG texts
constexpr png_byte k_text_chunk[] = {'t', 'E', 'X', 't', 0};

Error undecodable() { return Error{"cannot be decoded"}; }

// How many pixels may be decoded, and how many were begun.
struct PixelRoom {
    size_t most = 0, begun = 0;
};

Result<DecodedPicture> blank(size_t width, size_t height, PixelRoom& room) {
    if (width == 0 || height == 0) return undecodable();
    if (width > room.most || height > room.most / width) return Error{"has more pixels than can be taken in"};
    room.begun = width * height;
    DecodedPicture picture{static_cast<int>(width), static_cast<int>(height), {}};
    picture.rgba.resize(width * height * 4);
    return picture;
}

// Both libraries leave by longjmp where a file is broken: it may pass over nothing that has a destructor, so
// what does lives in the structures below, and each step that may fail is a function of its own.

struct PngReader {
    png_structp png = nullptr;
    png_infop info = nullptr;
    std::span<const uint8_t> rest;
    std::vector<png_bytep> rows;

    explicit PngReader(std::span<const uint8_t> bytes) : rest(bytes) {
        auto fail = [](png_structp p, png_const_charp) { longjmp(png_jmpbuf(p), 1); };
        auto be_silent = [](png_structp, png_const_charp) {};
        png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, be_silent);
        if (png) info = png_create_info_struct(png);
    }
    PngReader(const PngReader&) = delete;
    ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
};

void take_png_bytes(png_structp png, png_bytep to, size_t count) {
    std::span<const uint8_t>& rest = static_cast<PngReader*>(png_get_io_ptr(png))->rest;
    if (count > rest.size()) png_error(png, "cut short");
    std::memcpy(to, rest.data(), count);
    rest = rest.subspan(count);
}

bool begin_png(PngReader& r) {
    if (setjmp(png_jmpbuf(r.png))) return false;
    png_set_read_fn(r.png, &r, take_png_bytes);
    png_set_user_limits(r.png, 0x7fffffff, 0x7fffffff);  // pixels are counted instead
    png_set_chunk_malloc_max(r.png, 8 << 20);
    // Packed texts and profiles, each of which may unpack to so much, are passed over.
    png_set_keep_unknown_chunks(r.png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
    png_set_keep_unknown_chunks(r.png, PNG_HANDLE_CHUNK_AS_DEFAULT, k_text_chunk, 1);
    png_read_info(r.png, r.info);
    return true;
}

// To four bytes a pixel. Takes memory for a row.
bool prepare_png(PngReader& r) {
    if (setjmp(png_jmpbuf(r.png))) return false;
    png_set_expand(r.png);    // palettes, few bits, one transparent colour
    png_set_strip_16(r.png);  // to 8 bits
    png_set_gray_to_rgb(r.png);
    png_set_add_alpha(r.png, 0xff, PNG_FILLER_AFTER);
    png_set_interlace_handling(r.png);
    png_read_update_info(r.png, r.info);
    return true;
}

bool finish_png(PngReader& r) {
    if (setjmp(png_jmpbuf(r.png))) return false;
    png_read_image(r.png, r.rows.data());
    png_read_end(r.png, nullptr);
    return true;
}

Result<DecodedPicture> decode_png(std::span<const uint8_t> bytes, PixelRoom& room) {
    PngReader reader(bytes);
    if (!reader.info || !begin_png(reader)) return undecodable();
    auto picture = blank(png_get_image_width(reader.png, reader.info),
                         png_get_image_height(reader.png, reader.info), room);
    if (!picture) return picture;
    size_t row = static_cast<size_t>(picture->width) * 4;
    if (!prepare_png(reader) || png_get_rowbytes(reader.png, reader.info) != row) return undecodable();
    for (size_t y = 0; y < static_cast<size_t>(picture->height); ++y)
        reader.rows.push_back(&picture->rgba[y * row]);
    if (!finish_png(reader)) return undecodable();
    return picture;
}

struct JpegReader {
    jpeg_decompress_struct jpeg{};
    jpeg_error_mgr errors{};
    jpeg_progress_mgr progress{};
    std::jmp_buf back;
    bool is_cut = false;

    JpegReader() = default;
    JpegReader(const JpegReader&) = delete;
    ~JpegReader() { jpeg_destroy_decompress(&jpeg); }
};

JpegReader& reader_of(j_common_ptr jpeg) { return *static_cast<JpegReader*>(jpeg->client_data); }

bool begin_jpeg(JpegReader& r, const uint8_t* bytes, size_t count) {
    r.jpeg.err = jpeg_std_error(&r.errors);
    r.errors.error_exit = [](j_common_ptr jpeg) { std::longjmp(reader_of(jpeg).back, 1); };
    r.errors.output_message = [](j_common_ptr) {};
    r.errors.emit_message = [](j_common_ptr jpeg, int) {
        int code = jpeg->err->msg_code;
        if (code == JWRN_JPEG_EOF || code == JWRN_HIT_MARKER) reader_of(jpeg).is_cut = true;
    };
    r.jpeg.client_data = &r;
    if (setjmp(r.back)) return false;
    jpeg_create_decompress(&r.jpeg);  // which keeps err and client_data
    // A progressive file may go over its pixels as often as it says.
    r.progress.progress_monitor = [](j_common_ptr jpeg) {
        constexpr int k_most_scans = 100;
        if (reinterpret_cast<j_decompress_ptr>(jpeg)->input_scan_number > k_most_scans)
            std::longjmp(reader_of(jpeg).back, 1);
    };
    r.jpeg.progress = &r.progress;
    jpeg_mem_src(&r.jpeg, bytes, static_cast<unsigned long>(count));
    return jpeg_read_header(&r.jpeg, TRUE) == JPEG_HEADER_OK;
}

// Fills four bytes a pixel, from the top.
bool finish_jpeg(JpegReader& r, uint8_t* rgba) {
    if (setjmp(r.back)) return false;
    bool inks = r.jpeg.jpeg_color_space == JCS_CMYK || r.jpeg.jpeg_color_space == JCS_YCCK;
    r.jpeg.out_color_space = inks ? JCS_CMYK : JCS_EXT_RGBA;
    jpeg_start_decompress(&r.jpeg);
    size_t row = static_cast<size_t>(r.jpeg.output_width) * 4;
    while (r.jpeg.output_scanline < r.jpeg.output_height) {
        uint8_t* to = rgba + r.jpeg.output_scanline * row;
        jpeg_read_scanlines(&r.jpeg, &to, 1);
        // Adobe's inks say how much is left of the paper.
        for (size_t i = 0; inks && i < row; i += 4) {
            for (size_t c = 0; c < 3; ++c)
                to[i + c] = static_cast<uint8_t>((to[i + c] * to[i + 3] + 127) / 255);
            to[i + 3] = 255;
        }
    }
    jpeg_finish_decompress(&r.jpeg);
    return !r.is_cut;
}

Result<DecodedPicture> decode_jpeg(std::span<const uint8_t> bytes, PixelRoom& room) {
    JpegReader reader;
    if (!begin_jpeg(reader, bytes.data(), bytes.size())) return undecodable();
    auto picture = blank(reader.jpeg.image_width, reader.jpeg.image_height, room);
    if (picture && !finish_jpeg(reader, picture->rgba.data())) return undecodable();
    return picture;
}

Result<DecodedPicture> decode_webp(std::span<const uint8_t> bytes, PixelRoom& room) {
    WebPBitstreamFeatures features;
    if (WebPGetFeatures(bytes.data(), bytes.size(), &features) != VP8_STATUS_OK) return undecodable();
    if (features.has_animation) return Error{"moves; still pictures are read"};
    auto picture = blank(size_t(features.width), size_t(features.height), room);
    if (picture && !WebPDecodeRGBAInto(bytes.data(), bytes.size(), picture->rgba.data(), picture->rgba.size(),
                                       picture->width * 4))
        return undecodable();
    return picture;
}

Result<DecodedPicture> decode(std::span<const uint8_t> bytes, PixelRoom& room) {
    auto begins = [&](std::initializer_list<uint8_t> magic) {
        return bytes.size() > magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin());
    };
    if (begins({0x89, 'P', 'N', 'G'})) return decode_png(bytes, room);
    if (begins({0xff, 0xd8, 0xff})) return decode_jpeg(bytes, room);
    if (begins({'R', 'I', 'F', 'F'}) && bytes.size() >= 12 && std::memcmp(&bytes[8], "WEBP", 4) == 0)
        return decode_webp(bytes, room);
    if (begins({0xab, 'K', 'T', 'X', ' '})) return Error{"is a KTX texture, which is not read"};
    return Error{"is neither PNG nor JPEG nor WebP"};
}

}  // namespace

Result<DecodedPicture> decode_picture(std::span<const uint8_t> bytes, size_t most_pixels, size_t* begun) {
    PixelRoom room{most_pixels};
    auto picture = decode(bytes, room);
    if (begun) *begun = room.begun;
    return picture;
}

// A chunk of text, which goes behind the first chunk.
static void add_comment(std::string& png, const std::string& comment) {
    constexpr size_t k_behind_first = 8 + 25, k_name = 4;
    auto number = [](size_t value) {
        std::string bytes;
        for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xff);
        return bytes;
    };
    std::string chunk = std::string("tEXt") + k_keyword + '\0' + comment;
    size_t length = chunk.size() - k_name;
    chunk += number(crc32(0, reinterpret_cast<const Bytef*>(chunk.data()), static_cast<uInt>(chunk.size())));
    png.insert(k_behind_first, number(length) + chunk);
}

static std::string encode_png(png_uint_32 format, const void* pixels, int width, int height,
                              const std::string& comment) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(width);
    image.height = static_cast<png_uint_32>(height);
    image.format = format;
    image.flags = PNG_IMAGE_FLAG_FAST;  // a fifth of the time, for a third more bytes
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::string png(size, '\0');
    if (!png_image_write_to_memory(&image, png.data(), &size, 0, pixels, 0, nullptr)) return {};
    png.resize(size);
    png.shrink_to_fit();
    if (!comment.empty()) add_comment(png, comment);
    return png;
}

std::string encode_png(std::span<const uint8_t> pixels, int width, int height, int channels,
                       const std::string& comment) {
    assert(channels == 3 || channels == 4);
    assert(pixels.size() ==
           static_cast<size_t>(width) * static_cast<size_t>(height) * static_cast<size_t>(channels));
    return encode_png(channels == 3 ? PNG_FORMAT_RGB : PNG_FORMAT_RGBA, pixels.data(), width, height,
                      comment);
}

std::string encode_png(std::span<const uint16_t> numbers, int width, int height, const std::string& comment) {
    assert(numbers.size() == static_cast<size_t>(width) * static_cast<size_t>(height));
    return encode_png(PNG_FORMAT_LINEAR_Y, numbers.data(), width, height, comment);
}

std::string png_comment(std::span<const uint8_t> bytes) {
    PngReader reader(bytes);
    if (!reader.info || !begin_png(reader)) return {};
    png_textp texts = nullptr;
    int count = 0;
    png_get_text(reader.png, reader.info, &texts, &count);
    for (int i = 0; i < count; ++i)
        if (std::strcmp(texts[i].key, k_keyword) == 0) return {texts[i].text, texts[i].text_length};
    return {};
}

}  // namespace flaneur
