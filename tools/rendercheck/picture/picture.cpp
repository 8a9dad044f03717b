#include "tools/rendercheck/picture/picture.h"

#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstring>
#include <string_view>

#include "tools/rendercheck/files/disk.h"

namespace flaneur {
namespace {

constexpr size_t k_most_file_bytes = size_t{1} << 30;

// What libpng reads from, and what it says when it gives up.
struct PngSource {
    std::span<const uint8_t> bytes;
    size_t at = 0;
    char why[160] = "";
    std::jmp_buf back;
};

void take(png_structp png, png_bytep to, png_size_t count) {
    auto* source = static_cast<PngSource*>(png_get_io_ptr(png));
    if (count > source->bytes.size() - source->at) png_error(png, "it ends too soon");
    std::memcpy(to, source->bytes.data() + source->at, count);
    source->at += count;
}

[[noreturn]] void give_up(png_structp png, png_const_charp why) {
    auto* source = static_cast<PngSource*>(png_get_error_ptr(png));
    std::snprintf(source->why, sizeof source->why, "%s", why);
    std::longjmp(source->back, 1);
}

void ignore(png_structp, png_const_charp) {}

struct PngHeader {
    png_uint_32 width = 0, height = 0;
    int bits = 0;
};

// The two that may jump own nothing but what the caller gave them.
bool read_header(png_structp png, png_infop info, PngSource& source, PngHeader& header) {
    if (setjmp(source.back)) return false;
    png_set_read_fn(png, &source, take);
    png_set_user_limits(png, 0x7fffffff, 0x7fffffff);
    png_read_info(png, info);
    header.width = png_get_image_width(png, info);
    header.height = png_get_image_height(png, info);
    header.bits = png_get_bit_depth(png, info);
    return true;
}

// Rows of RGBA, 8 bits, or 16 with the low byte first.
bool read_rows(png_structp png, png_infop info, PngSource& source, png_bytep* rows) {
    if (setjmp(source.back)) return false;
    png_set_expand(png);
    png_set_gray_to_rgb(png);
    const bool is_deep = png_get_bit_depth(png, info) == 16;
    if (is_deep) png_set_swap(png);
    png_set_add_alpha(png, 0xffff, PNG_FILLER_AFTER);
    png_set_interlace_handling(png);
    png_read_update_info(png, info);
    png_read_image(png, rows);
    png_read_end(png, nullptr);
    return true;
}

Result<CheckedPicture> read_png(std::span<const uint8_t> bytes) {
    PngSource source;
    source.bytes = bytes;
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, give_up, ignore);
    png_infop info = png ? png_create_info_struct(png) : nullptr;
    CheckedPicture picture;
    std::vector<uint16_t> wide;
    std::string refused;
    PngHeader header;
    if (!info || !read_header(png, info, source, header)) {
        refused = std::string("is no whole PNG: ") + source.why;
    } else if (uint64_t{header.width} * header.height > k_most_checked_pixels) {
        refused = "has " + std::to_string(header.width) + "x" + std::to_string(header.height) +
                  " pixels, more than the " + std::to_string(k_most_checked_pixels) +
                  " that are looked at: draw a smaller picture";
    } else {
        const size_t count = size_t{header.width} * header.height * 4;
        picture.width = static_cast<int>(header.width), picture.height = static_cast<int>(header.height);
        picture.precision = header.bits == 16 ? Precision::sixteen : Precision::eight;
        picture.rgba.resize(count);
        if (header.bits == 16) wide.resize(count);
        std::vector<png_bytep> rows(header.height);
        for (size_t y = 0; y < rows.size(); ++y) {
            const size_t at = y * header.width * 4;
            rows[y] = header.bits == 16 ? reinterpret_cast<png_bytep>(&wide[at]) : &picture.rgba[at];
        }
        if (!read_rows(png, info, source, rows.data()))
            refused = std::string("is no whole PNG: ") + source.why;
    }
    png_destroy_read_struct(&png, &info, nullptr);
    if (!refused.empty()) return Error{refused + "."};
    if (!wide.empty()) {
        picture.deep.resize(wide.size());
        for (size_t i = 0; i < wide.size(); ++i) {
            picture.deep[i] = static_cast<float>(wide[i]) / 65535.0f;
            picture.rgba[i] = static_cast<uint8_t>((wide[i] + 128u) / 257u);
        }
    }
    return picture;
}

}  // namespace

Result<CheckedPicture> read_picture(std::span<const uint8_t> bytes) {
    constexpr uint8_t k_png[] = {0x89, 'P', 'N', 'G'}, k_exr[] = {0x76, 0x2f, 0x31, 0x01};
    auto begins = [&](std::span<const uint8_t> with) {
        return bytes.size() >= with.size() && std::equal(with.begin(), with.end(), bytes.begin());
    };
    if (begins(k_png)) return read_png(bytes);
    if (begins(k_exr)) return read_exr(bytes);
    if (bytes.empty()) return Error{"is empty."};
    return Error{"is neither a PNG nor an OpenEXR picture."};
}

Result<CheckedPicture> load_picture(const std::string& path) {
    Result<std::vector<uint8_t>> bytes = read_whole(path, k_most_file_bytes);
    if (!bytes) return bytes.error();
    Result<CheckedPicture> picture = read_picture(*bytes);
    if (!picture) return Error{path + " " + picture.error().message};
    return picture;
}

std::string told_size(const CheckedPicture& picture) {
    return std::to_string(picture.width) + "x" + std::to_string(picture.height);
}

const char* told_precision(Precision precision) {
    switch (precision) {
        case Precision::eight:
            return "8 bits a channel";
        case Precision::sixteen:
            return "16 bits a channel";
        default:
            return "floating-point channels";
    }
}

Result<std::vector<uint8_t>> write_png(const std::vector<uint8_t>& rgba, int width, int height) {
    bool is_opaque = true;
    for (size_t i = 3; i < rgba.size() && is_opaque; i += 4) is_opaque = rgba[i] == 255;
    std::vector<uint8_t> pixels;
    if (is_opaque) {
        pixels.reserve(rgba.size() / 4 * 3);
        for (size_t i = 0; i < rgba.size(); i += 4)
            pixels.insert(pixels.end(), {rgba[i], rgba[i + 1], rgba[i + 2]});
    }
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(width), image.height = static_cast<png_uint_32>(height);
    image.format = is_opaque ? PNG_FORMAT_RGB : PNG_FORMAT_RGBA;
    const uint8_t* from = is_opaque ? pixels.data() : rgba.data();
    std::vector<uint8_t> bytes(PNG_IMAGE_PNG_SIZE_MAX(image));
    png_alloc_size_t size = bytes.size();
    if (!png_image_write_to_memory(&image, bytes.data(), &size, 0, from, 0, nullptr))
        return Error{std::string("A picture could not be encoded: ") + image.message + "."};
    bytes.resize(size);
    return bytes;
}

}  // namespace flaneur
