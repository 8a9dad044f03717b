#include "tests/assets/tiny/pictures.h"

#include <webp/encode.h>

#include <cstdlib>

namespace flaneur {

uint8_t tiny_sample(int x, int y, int channel) {
    return static_cast<uint8_t>(channel == 3 ? 255 - 3 * x
                                             : 2 * x + 3 * y + 40 * channel + (x > 20 ? 60 : 0));
}

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
    png_set_IHDR(png, info, k_tiny_width, k_tiny_height, kind.bits, kind.colour,
                 kind.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_set_gAMA(png, info, 1.0);  // which glTF wants ignored
    if (kind.colour == PNG_COLOR_TYPE_PALETTE) {
        png_color palette[16];
        for (int i = 0; i < 16; ++i)
            palette[i] = {tiny_sample(i, 1, 0), tiny_sample(i, 2, 1), tiny_sample(i, 3, 2)};
        png_set_PLTE(png, info, palette, 1 << kind.bits);
        png_byte alphas[] = {0, 100, 200};
        if (kind.see_through) png_set_tRNS(png, info, alphas, 3, nullptr);
    } else if (kind.see_through) {
        png_color_16 clear{0, tiny_sample(3, 4, 0), tiny_sample(3, 4, 1), tiny_sample(3, 4, 2),
                           tiny_sample(3, 4, 0)};
        png_set_tRNS(png, info, nullptr, 0, &clear);
    }
    png_write_info(png, info);
    size_t channels = png_get_channels(png, info);
    std::vector<Bytes> rows(k_tiny_height);
    std::vector<png_bytep> pointers;
    for (int y = 0; y < k_tiny_height; ++y) {
        Bytes& row = rows[static_cast<size_t>(y)];
        row.assign(png_get_rowbytes(png, info), 0);
        for (size_t i = 0; i < row.size(); ++i) {
            auto pixel = static_cast<int>(i * 8 / (channels * static_cast<size_t>(kind.bits)));
            row[i] =
                tiny_sample(pixel, y, static_cast<int>(i * 8 / static_cast<size_t>(kind.bits) % channels));
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
    jpeg.image_width = k_tiny_width;
    jpeg.image_height = k_tiny_height;
    jpeg.input_components = channels;
    jpeg.in_color_space = space;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, 95, TRUE);
    if (progressive) jpeg_simple_progression(&jpeg);
    jpeg_start_compress(&jpeg, TRUE);
    for (int y = 0; y < k_tiny_height; ++y) {
        Bytes row;
        for (int x = 0; x < k_tiny_width; ++x)
            for (int c = 0; c < channels; ++c) row.push_back(tiny_sample(x, y, c));
        JSAMPROW rows[] = {row.data()};
        jpeg_write_scanlines(&jpeg, rows, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    Bytes out(bytes, bytes + size);
    std::free(bytes);
    return out;
}

Bytes webp_of(bool lossless) {
    Bytes pixels;
    for (int y = 0; y < k_tiny_height; ++y)
        for (int x = 0; x < k_tiny_width; ++x)
            for (int channel = 0; channel < 4; ++channel) pixels.push_back(tiny_sample(x, y, channel));
    uint8_t* packed = nullptr;
    size_t size =
        lossless
            ? WebPEncodeLosslessRGBA(pixels.data(), k_tiny_width, k_tiny_height, k_tiny_width * 4, &packed)
            : WebPEncodeRGBA(pixels.data(), k_tiny_width, k_tiny_height, k_tiny_width * 4, 95, &packed);
    Bytes out(packed, packed + size);
    WebPFree(packed);
    return out;
}

}  // namespace flaneur
