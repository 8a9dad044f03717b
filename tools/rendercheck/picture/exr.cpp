#include <tinyexr.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>

#include "tools/rendercheck/picture/picture.h"

namespace flaneur {
namespace {

// What TinyEXR could not read it has freed already.
struct ExrFile {
    EXRHeader header;
    EXRImage image;
    bool has_header = false, has_image = false;
    ExrFile() {
        InitEXRHeader(&header);
        InitEXRImage(&image);
    }
    ~ExrFile() {
        if (has_image) FreeEXRImage(&image);
        if (has_header) FreeEXRHeader(&header);
    }
    ExrFile(const ExrFile&) = delete;
    ExrFile& operator=(const ExrFile&) = delete;
};

Error refused(const char* why) {
    Error error{std::string("is no OpenEXR picture that can be read: ") + (why ? why : "unknown fault") +
                "."};
    if (why) FreeEXRErrorMessage(why);
    return error;
}

// Which of R, G, B, A a channel is, "layer.R" too; -1: none of them.
int place_of(std::string_view name) {
    const std::string_view last = name.substr(name.find_last_of('.') + 1);
    const size_t at = std::string_view("RGBA").find(last);
    return last.size() == 1 && at != std::string_view::npos ? static_cast<int>(at) : -1;
}

// No number is none.
uint8_t whole_share(float v) {
    return v > 0 ? static_cast<uint8_t>(std::lround(std::min(v, 1.0f) * 255)) : uint8_t{0};
}

uint8_t shown(float linear) {
    const float v = std::min(linear, 1.0f);
    return whole_share(v <= 0.0031308f ? v * 12.92f : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f);
}

}  // namespace

Result<CheckedPicture> read_exr(std::span<const uint8_t> bytes) {
    EXRVersion version;
    if (ParseEXRVersionFromMemory(&version, bytes.data(), bytes.size()) != TINYEXR_SUCCESS)
        return Error{"is no whole OpenEXR picture."};
    if (version.multipart || version.non_image || version.tiled)
        return Error{
            "is an OpenEXR file of several parts, of tiles or of deep pixels: write plain scan lines."};
    ExrFile file;
    const char* why = nullptr;
    if (ParseEXRHeaderFromMemory(&file.header, &version, bytes.data(), bytes.size(), &why) != TINYEXR_SUCCESS)
        return refused(why);
    file.has_header = true;
    const auto& window = file.header.data_window;
    const int64_t width = int64_t{window.max_x} - window.min_x + 1,
                  height = int64_t{window.max_y} - window.min_y + 1;
    if (width < 1 || height < 1 || width > int64_t{k_most_checked_pixels} ||
        height > int64_t{k_most_checked_pixels} || width * height > int64_t{k_most_checked_pixels})
        return Error{"has " + std::to_string(width) + "x" + std::to_string(height) + " pixels, and 1 to " +
                     std::to_string(k_most_checked_pixels) + " are looked at."};
    for (int c = 0; c < file.header.num_channels; ++c)
        if (file.header.pixel_types[c] == TINYEXR_PIXELTYPE_HALF)
            file.header.requested_pixel_types[c] = TINYEXR_PIXELTYPE_FLOAT;
    if (LoadEXRImageFromMemory(&file.image, &file.header, bytes.data(), bytes.size(), &why) !=
        TINYEXR_SUCCESS)
        return refused(why);
    file.has_image = true;
    CheckedPicture picture;
    picture.width = static_cast<int>(width), picture.height = static_cast<int>(height);
    picture.precision = Precision::floats;
    const size_t count = static_cast<size_t>(width * height);
    picture.deep.assign(count * 4, 0.0f);
    for (size_t i = 0; i < count; ++i) picture.deep[4 * i + 3] = 1;
    int coloured = 0;
    auto fill = [&](int channel, int place) {
        const unsigned char* plane = file.image.images[channel];
        const bool is_whole = file.header.pixel_types[channel] == TINYEXR_PIXELTYPE_UINT;
        for (size_t i = 0; i < count; ++i) {
            float value = 0;
            uint32_t whole = 0;
            std::memcpy(is_whole ? static_cast<void*>(&whole) : &value, plane + 4 * i, 4);
            picture.deep[4 * i + static_cast<size_t>(place)] = is_whole ? static_cast<float>(whole) : value;
        }
    };
    for (int c = 0; c < file.header.num_channels; ++c)
        if (const int place = place_of(file.header.channels[c].name); place >= 0) fill(c, place), ++coloured;
    // Depths, ids and greys: the first three channels, one of them in all three colours.
    if (coloured == 0)
        for (int c = 0; c < 3 && file.header.num_channels > 0; ++c)
            fill(std::min(c, file.header.num_channels - 1), c);
    picture.rgba.resize(count * 4);
    for (size_t i = 0; i < picture.deep.size(); ++i)
        picture.rgba[i] = i % 4 == 3 ? whole_share(picture.deep[i]) : shown(picture.deep[i]);
    return picture;
}

}  // namespace flaneur
