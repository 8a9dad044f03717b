// PNG, JPEG and WebP, by libpng, libjpeg-turbo and libwebp.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sim/base/result.h"

namespace flaneur {

struct DecodedPicture {
    int width = 0, height = 0;
    std::vector<uint8_t> rgba;  // rows from the top, as the file has them: no profile or gamma is applied
};

// A PNG, a JPEG or a still WebP of at most `most_pixels`, which are counted before any is decoded. The
// error's sentence has no subject: "cannot be decoded". `begun`, if given, is how many pixels time was spent
// on, those of a picture that turns out to be broken too.
Result<DecodedPicture> decode_picture(std::span<const uint8_t> bytes, size_t most_pixels,
                                      size_t* begun = nullptr);

// A PNG of 8 bits a channel, sRGB: rows from the top, of `channels` 3 (RGB) or 4 (RGBA) bytes a pixel. Empty
// where there is not enough memory. `comment`, in ASCII, is kept with the picture.
std::string encode_png(std::span<const uint8_t> pixels, int width, int height, int channels,
                       const std::string& comment = {});

// A PNG of one number of 16 bits a pixel, in greys; else the same.
std::string encode_png(std::span<const uint16_t> numbers, int width, int height,
                       const std::string& comment = {});

// The comment of a PNG; its first bytes, before those of the picture, do. Empty where it has none.
std::string png_comment(std::span<const uint8_t> bytes);

}  // namespace flaneur
